"""Store truth on disk, in files named by the rays and the surface that they answer for."""

from __future__ import annotations

import hashlib
import json
from dataclasses import fields
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from harness.contract import FirsthitError, Surface, Truth, TruthStatus
from harness.results import npz
from harness.results.sources import TRUTH, digest_of, packages
from harness.results.writing import replacing

MOST_UNWRITTEN = 16  # answers of so many sets of rays; cells that share rays run one after the other
_UNWRITTEN: dict[Path, Truth] = {}
_PROBLEMS: dict[Path, str] = {}  # why answers could not be written, by folder


def truth_path(folder: Path, surface: Surface, rays: NDArray[np.float32], t_min: float = 0.0) -> Path:
    """Return the file of the answers for exactly this surface, these rays and `t_min`.

    Its name covers the oracle's own files and the packages that it computes with, so that truth is computed again after
    an edit there. Files of older names are never read again.
    """
    decides = [_oracle(), surface.identity, rays.shape, t_min]
    key = hashlib.sha256(json.dumps(decides, sort_keys=True).encode())
    key.update(np.ascontiguousarray(rays, dtype="<f4").tobytes())
    return folder / f"truth-{key.hexdigest()[:24]}.npz"


@cache
def _oracle() -> list[object]:
    """Return what decides all answers: a hash of the files of sources.TRUTH, and the versions of packages."""
    return [digest_of(*TRUTH), packages()]


def load(path: Path, count: int) -> Truth | None:
    """Return the stored answers for `count` rays; None if there are none, or if the file is damaged."""
    if path in _UNWRITTEN:
        return _UNWRITTEN[path]
    kinds = {field.name: np.uint8 if field.name == "status" else np.float64 for field in fields(Truth)}
    try:
        truth = Truth(**npz.read(path, kinds, lambda _, shape: shape == (count,)))
    except (OSError, ValueError):
        return None
    return truth if _is_possible(truth) else None


def _is_possible(truth: Truth) -> bool:
    """Tell whether the answers agree with themselves, as the oracle's do."""
    hit = np.isin(truth.status, (TruthStatus.CROSSING, TruthStatus.TOUCH))
    ends = np.stack([truth.lower, truth.upper])
    placed = np.isfinite(ends[:, hit]).all() and (truth.lower[hit] <= truth.upper[hit]).all()
    return bool(placed and np.isnan(ends[:, ~hit]).all() and (truth.status <= max(TruthStatus)).all())


def store(path: Path, truth: Truth) -> None:
    """Write answers to a file, whole or not at all, also if several processes write the same answers.

    Where they cannot be written, this process keeps the newest of them, and `unwritten` says why.
    """
    try:
        with replacing(path) as temporary, temporary.open("wb") as file:
            np.savez(file, **{f.name: getattr(truth, f.name) for f in fields(Truth)})
    except FirsthitError as error:
        _PROBLEMS.setdefault(path.parent, str(error))
        _UNWRITTEN[path] = truth
        while len(_UNWRITTEN) > MOST_UNWRITTEN:
            del _UNWRITTEN[next(iter(_UNWRITTEN))]


def unwritten(folder: Path) -> str | None:
    """Say why answers could not be kept in `folder`, once; None where they could."""
    return _PROBLEMS.pop(folder, None)
