"""Run git in a folder, whichever repository the environment names."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType

# A hook of git finds these set. They say which repository, tree and index git is to use, wherever it is started.
NAMES_A_REPOSITORY = (
    "GIT_DIR",
    "GIT_COMMON_DIR",
    "GIT_WORK_TREE",
    "GIT_INDEX_FILE",
    "GIT_OBJECT_DIRECTORY",
    "GIT_ALTERNATE_OBJECT_DIRECTORIES",
    "GIT_NAMESPACE",
    "GIT_PREFIX",
)
NOTHING: Mapping[str, str] = MappingProxyType({})


def ran(folder: Path, *arguments: str, own: Mapping[str, str] = NOTHING) -> subprocess.CompletedProcess[str]:
    """Run git in a folder, in English, with the variables `own`; raises OSError where there is no git.

    Git finds the repository that holds the folder, and no other one, even within a hook of git.
    """
    inherited = {name: value for name, value in os.environ.items() if name not in NAMES_A_REPOSITORY}
    return subprocess.run(
        ["git", "-C", str(folder), *arguments],
        env={**inherited, "LC_ALL": "C", **own},
        capture_output=True,
        encoding="utf-8",
        errors="surrogateescape",
        check=False,
    )
