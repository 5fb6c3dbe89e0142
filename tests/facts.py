"""Recompute what surfaces state of themselves: singular points, by Newton's method on the gradient."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

import surfaces
from harness.contract import Surface
from surfaces import lowering
from surfaces.entries import SYMMETRIES
from surfaces.evaluation import Floats
from surfaces.tape import walk

Points = NDArray[np.float64]


def scattered(surface: Surface, count: int, reach: float = 1.0) -> Points:
    rng = np.random.default_rng(len(surface.name))
    return rng.uniform(-reach, reach, (count, 3)) * surface.domain.radius + surface.domain.center


def hessian(surface: Surface, points: Points) -> Points:
    """[n, 3, 3]"""
    tape = lowering.hessian_product(lowering.real_tape(surfaces.tape_of(surface)))
    columns = []
    for direction in np.eye(3):
        variables = dict(zip("xyz", points.T, strict=True)) | dict(zip(("vx", "vy", "vz"), direction, strict=True))
        with np.errstate(all="ignore"):
            outputs = walk(tape, Floats(), variables)
        columns.append(np.stack([np.broadcast_to(o, len(points)) for o in outputs], axis=1))
    return np.nan_to_num(np.stack(columns, axis=2))


def refined(surface: Surface, points: Points, steps: int) -> Points:
    """Newton's iteration on grad f = 0, damped so that singular Hessians give finite steps."""
    for _ in range(steps):
        matrix = hessian(surface, points)
        normal = np.einsum("nji,njk->nik", matrix, matrix)
        damping = 1e-14 * np.abs(normal).max(axis=(1, 2)) + 1e-290
        normal += damping[:, None, None] * np.eye(3)
        right = np.einsum("nji,nj->ni", matrix, surfaces.gradient(surface, points))
        step = np.nan_to_num(np.linalg.solve(normal, right[:, :, None])[:, :, 0])
        length = np.maximum(np.linalg.norm(step, axis=1, keepdims=True), 1e-300)
        points = points - step * np.minimum(1.0, 0.3 * surface.domain.radius / length)
    return points


def distinct(points: Points, apart: float) -> Points:
    kept: list[Points] = []
    for point in points:
        if all(np.linalg.norm(point - other) > apart for other in kept):
            kept.append(point)
    return np.array(kept).reshape(-1, 3)


def singular_points(surface: Surface, starts: Points | None = None) -> Points:
    """Isolated real points with f = 0 and grad f = 0: Newton from many starts, completed by the symmetries."""
    scale = np.abs(surfaces.evaluate(surface, scattered(surface, 1000))).mean()
    facts = dict(surface.facts)

    def singular(points: Points) -> Points:
        flat = np.linalg.norm(surfaces.gradient(surface, points), axis=1) < 1e-7 * scale
        near = np.linalg.norm(points - surface.domain.center, axis=1) < 10.0 * surface.domain.radius
        return points[(np.abs(surfaces.evaluate(surface, points)) < 1e-12 * scale) & flat & near]

    starts = scattered(surface, 1500, 1.05) if starts is None else starts
    apart = 1e-3 * surface.domain.radius
    found = distinct(singular(refined(surface, starts, 50)), apart)
    while True:
        images = [found @ np.array(SYMMETRIES[name]).T for name in facts.get("symmetries", ())]
        more = distinct(singular(refined(surface, np.vstack([found, *images]), 2)), apart)
        if len(more) == len(found):
            return found
        found = more
