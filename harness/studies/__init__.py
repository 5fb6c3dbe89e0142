"""Run studies: computations on the host that a paper tabulates beside its pictures. They need no device and no rays.

Each module here is one study. Its docstring says what the paper states and what is computed, TITLE names it, and
`compute()` returns its rows. A config names studies in `studies = [...]`; `firsthit run` stores each as
studies/<key>.json in the run folder. The key covers the module's text and what decides a cell's row, so that a study
runs again after an edit.
"""

from __future__ import annotations

import importlib
import time
from pathlib import Path
from typing import Any, Protocol, cast

from harness.contract import digest
from harness.results import sealed, sources, study_file
from harness.results.store import FORMAT
from harness.results.writing import write_atomically

NAMES = ("condition_numbers", "extrema_bounds", "form_ranges", "mesh_errors", "torus_along_rays")


class Study(Protocol):
    """State what a module of this folder holds."""

    TITLE: str

    def compute(self) -> list[dict[str, Any]]:
        """Return the study's rows, which are JSON."""
        ...


def _module(name: str) -> Study:
    """Import a study."""
    return cast(Study, importlib.import_module(f"harness.studies.{name}"))


def key(name: str) -> str:
    """Return a hash of what decides a study's rows: its own text, the harness that it computes with, and packages."""
    from harness.scenes import meshes

    own = sources.hashes("harness/studies/__init__.py", f"harness/studies/{name}.py")
    return digest(name, own, sources.methodology(), sources.packages(), None if meshes.missing() else meshes.mesher())


def is_done(name: str, folder: Path) -> bool:
    """Return whether the run `folder` holds this study's rows as its text now makes them."""
    try:
        study_file.read(_path(name, folder), name, key(name))
    except (OSError, ValueError):
        return False
    return True


def run(name: str, folder: Path) -> dict[str, Any]:
    """Compute a study, store it in the run `folder`, and return what was stored."""
    start = time.perf_counter()
    module = _module(name)
    document = {
        "format": FORMAT,
        "key": key(name),
        "study": name,
        "title": module.TITLE,
        "rows": module.compute(),
        "seconds": time.perf_counter() - start,
    }
    write_atomically(_path(name, folder), sealed.sealed(document))
    return document


def _path(name: str, folder: Path) -> Path:
    """Return the file of a study in a run folder."""
    return folder / "studies" / f"{key(name)}.json"
