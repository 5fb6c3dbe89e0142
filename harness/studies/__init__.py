"""Studies: computations on the host that a paper tabulates beside its pictures. No device, no rays.

A module here is one study: its docstring says what the paper states and what is computed, TITLE names it, and
`compute()` returns its rows. A config names studies in `studies = [...]`; `firsthit run` stores each as
studies/<key>.json in the run folder. The key covers the module's text and what decides a cell's row, so that an edit
runs it again.
"""

from __future__ import annotations

import importlib
import json
import time
from pathlib import Path
from typing import Any

from harness.contract import digest
from harness.results import sources
from harness.results.store import FORMAT, write_atomically

NAMES = ("condition_numbers", "extrema_bounds", "form_ranges", "mesh_errors", "torus_along_rays")


def _module(name: str) -> Any:
    return importlib.import_module(f"harness.studies.{name}")


def key(name: str) -> str:
    """What decides a study's rows: its own text, the harness that it computes with, and the packages."""
    from harness.scenes import meshes

    own = sources.hashes("harness/studies/__init__.py", f"harness/studies/{name}.py")
    return digest(name, own, sources.methodology(), sources.packages(), None if meshes.missing() else meshes.mesher())


def is_done(name: str, folder: Path) -> bool:
    """Whether the run `folder` holds this study as it stands."""
    try:
        stored = json.loads(_path(name, folder).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return False
    return isinstance(stored, dict) and stored.get("format") == FORMAT and stored.get("key") == key(name)


def run(name: str, folder: Path) -> dict[str, Any]:
    """Compute a study and store it in the run `folder`; what was stored."""
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
    write_atomically(_path(name, folder), json.dumps(document, indent=1, allow_nan=False).encode())
    return document


def _path(name: str, folder: Path) -> Path:
    return folder / "studies" / f"{key(name)}.json"
