"""Store truth on disk, in files named by the rays and the surface that they answer for."""

from __future__ import annotations

import hashlib
import json
import zipfile
from dataclasses import fields
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness.contract import Surface, Truth
from harness.results.sources import TRUTH, digest_of, packages
from harness.results.writing import replacing


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
    try:
        with np.load(path, allow_pickle=False) as stored:
            arrays: dict[str, NDArray[Any]] = {f.name: stored[f.name] for f in fields(Truth)}
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile):
        return None
    return Truth(**arrays) if all(a.shape == (count,) for a in arrays.values()) else None


def store(path: Path, truth: Truth) -> None:
    """Write answers to a file, whole or not at all, also if several processes write the same answers.

    Raises FirsthitError if they cannot be written.
    """
    with replacing(path) as temporary, temporary.open("wb") as file:
        np.savez(file, **{f.name: getattr(truth, f.name) for f in fields(Truth)})
