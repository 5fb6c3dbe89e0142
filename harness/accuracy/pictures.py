"""Make the pictures of a row: what was answered, what is true, and a shaded image."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness.accuracy import judge
from harness.contract import Hits, RayStatus, Surface, Truth


def pictures_of(
    surface: Surface,
    rays: NDArray[np.float32],
    hits: Hits,
    truth: Truth,
    verdicts: judge.Verdicts,
    size: int,
) -> dict[str, NDArray[Any]]:
    """Return the row's answers as pictures by name, [size, size] each, row 0 at the top."""
    pictures: dict[str, NDArray[Any]] = {
        "status": hits.status,
        "truth": truth.status,
        "wrong": verdicts.wrong,
        "grazing": verdicts.grazing,
        "drowned": verdicts.drowned,
        "error": verdicts.error.astype(np.float32),
        "evaluations": hits.evaluations,
        "condition": truth.condition.astype(np.float32),
        "shade": headlight(surface, rays, hits),
    }
    return {name: picture.reshape(size, size) for name, picture in pictures.items()}


def headlight(surface: Surface, rays: NDArray[np.float32], hits: Hits) -> NDArray[np.float32]:
    """Return float32[n]: the cosine between ray and surface normal at each hit, in [0, 1]; NaN without a hit."""
    import surfaces

    shade = np.full(len(hits.t), np.nan, np.float32)
    hit = hits.status == RayStatus.HIT
    if hit.any():
        directions = rays[hit, 3:].astype(np.float64)
        normals = surfaces.gradient(surface, rays[hit, :3] + hits.t[hit, None] * directions)
        lengths = np.linalg.norm(normals, axis=1)
        cosines = np.abs(np.einsum("ij,ij->i", normals, directions)) / np.where(lengths > 0.0, lengths, 1.0)
        shade[hit] = np.clip(cosines, 0.0, 1.0)
    return shade
