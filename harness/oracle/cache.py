"""Truth on disk, named by the content it answers for."""

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
    """Where the answers for exactly these rays from `t_min` on and this surface belong.

    The key holds the oracle's own files and the packages that it computes with: an edit there makes truth anew. Files
    of older keys are never read again.
    """
    decides = [_oracle(), surface.identity, rays.shape, t_min]
    key = hashlib.sha256(json.dumps(decides, sort_keys=True).encode())
    key.update(np.ascontiguousarray(rays, dtype="<f4").tobytes())
    return folder / f"truth-{key.hexdigest()[:24]}.npz"


@cache
def _oracle() -> list[object]:
    """What decides all answers: the files of sources.TRUTH, and the versions of the packages they compute with."""
    return [digest_of(*TRUTH), packages()]


def load(path: Path, count: int) -> Truth | None:
    """The stored answers for `count` rays; None where there are none or the file is damaged."""
    try:
        with np.load(path, allow_pickle=False) as stored:
            arrays: dict[str, Any] = {f.name: stored[f.name] for f in fields(Truth)}
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile):
        return None
    return Truth(**arrays) if all(a.shape == (count,) for a in arrays.values()) else None


def store(path: Path, truth: Truth) -> None:
    """Write answers whole or not at all, also when several processes write the same ones.

    Raises FirsthitError where they cannot be written.
    """
    with replacing(path) as temporary, temporary.open("wb") as file:
        np.savez(file, **{f.name: getattr(truth, f.name) for f in fields(Truth)})
