"""Make random distance functions as formulas and in numpy, and rays that meet their kinks; march to check answers by.

Every function here is 1-Lipschitz, so no root lies within |f| of a point: marching by that much proves where there is
none. The numpy side shares nothing with formulas, lowering or oracle.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from harness.contract import Box, Sphere, Truth, TruthStatus

Field = Callable[[np.ndarray], np.ndarray]  # [n, 3] → [n]


@dataclass(frozen=True)
class Shape:
    """Hold a distance function twice: as a formula's text, and as a function in numpy from points [n, 3] to [n]."""

    text: str
    field: Field
    marks: tuple[tuple[float, float, float], ...]  # points where several kinks meet: centres, corners, ends


def _eighths(pick: random.Random, low: int, high: int) -> float:
    """Return a random multiple of 1/8 from low/8 to high/8."""
    return pick.randint(low, high) / 8


def _moved(name: str, by: float) -> str:
    """Write the coordinate `name` relative to `by`."""
    return f"({name} - ({by!r}))" if by else name


def sphere(pick: random.Random) -> Shape:
    """Make a random sphere."""
    c, r = tuple(_eighths(pick, -4, 4) for _ in range(3)), _eighths(pick, 2, 5)
    x, y, z = (_moved(n, v) for n, v in zip("xyz", c, strict=True))
    return Shape(
        f"(sqrt({x}^2 + {y}^2 + {z}^2) - {r!r})",
        lambda p: np.linalg.norm(p - c, axis=1) - r,
        (c, (c[0], c[1] + r, c[2])),
    )


def box(pick: random.Random) -> Shape:
    """Make a random box as shaders write it, whose distance is exact inside and outside; some are rounded."""
    c, b = tuple(_eighths(pick, -4, 4) for _ in range(3)), tuple(_eighths(pick, 2, 5) for _ in range(3))
    r = pick.choice([0.0, 0.0, 0.125])
    x, y, z = (f"(abs({_moved(n, v)}) - {h!r})" for n, v, h in zip("xyz", c, b, strict=True))
    outside = f"sqrt(max({x}, 0)^2 + max({y}, 0)^2 + max({z}, 0)^2)"

    def field(p: np.ndarray) -> np.ndarray:
        q = np.abs(p - c) - b
        return np.linalg.norm(np.maximum(q, 0.0), axis=1) + np.minimum(q.max(axis=1), 0.0) - r

    corner = tuple(u + v for u, v in zip(c, b, strict=True))
    return Shape(f"({outside} + min(max({x}, max({y}, {z})), 0) - {r!r})", field, (c, corner, (c[0], corner[1], c[2])))


def plain_box(pick: random.Random) -> Shape:
    """Make a random box as the largest of three distances, which is not the exact distance outside."""
    c, b = tuple(_eighths(pick, -4, 4) for _ in range(3)), tuple(_eighths(pick, 2, 5) for _ in range(3))
    x, y, z = (f"(abs({_moved(n, v)}) - {h!r})" for n, v, h in zip("xyz", c, b, strict=True))
    corner = tuple(u + v for u, v in zip(c, b, strict=True))
    return Shape(f"max({x}, {y}, {z})", lambda p: (np.abs(p - c) - b).max(axis=1), (c, corner))


def torus(pick: random.Random) -> Shape:
    """Make a random torus about one of the axes."""
    c, big, r = tuple(_eighths(pick, -3, 3) for _ in range(3)), _eighths(pick, 4, 6), _eighths(pick, 1, 3)
    a, b, k = pick.choice([(0, 1, 2), (1, 2, 0), (0, 2, 1)])
    names = [_moved(n, v) for n, v in zip("xyz", c, strict=True)]
    text = f"(sqrt((sqrt({names[a]}^2 + {names[b]}^2) - {big!r})^2 + {names[k]}^2) - {r!r})"

    def field(p: np.ndarray) -> np.ndarray:
        q = p - c
        return np.hypot(np.hypot(q[:, a], q[:, b]) - big, q[:, k]) - r

    ring, top = list(c), list(c)
    ring[a] += big
    top[a], top[k] = top[a] + big, top[k] + r
    return Shape(text, field, (c, tuple(ring), tuple(top)))


def capsule(pick: random.Random) -> Shape:
    """Make a random capsule along one of the axes."""
    c, h, r = tuple(_eighths(pick, -4, 4) for _ in range(3)), _eighths(pick, 1, 5), _eighths(pick, 1, 4)
    k = pick.randrange(3)
    names = [_moved(n, v) for n, v in zip("xyz", c, strict=True)]
    a, b = (i for i in range(3) if i != k)
    text = f"(sqrt({names[a]}^2 + {names[b]}^2 + max(abs({names[k]}) - {h!r}, 0)^2) - {r!r})"

    def field(p: np.ndarray) -> np.ndarray:
        q = p - c
        return np.sqrt(q[:, a] ** 2 + q[:, b] ** 2 + np.maximum(np.abs(q[:, k]) - h, 0.0) ** 2) - r

    end, side = list(c), list(c)
    end[k] += h
    side[k], side[a] = side[k] + h, side[a] + r
    return Shape(text, field, (c, tuple(end), tuple(side)))


def cone(pick: random.Random) -> Shape:
    """Make a random cone with its tip up and a flat base: the intersection of an endless cone and a half space."""
    c, h = tuple(_eighths(pick, -4, 4) for _ in range(3)), _eighths(pick, 4, 8)
    x, y, z = (_moved(n, v) for n, v in zip("xyz", c, strict=True))
    text = f"max(0.8*sqrt({x}^2 + {y}^2) + 0.6*{z}, -{z} - {h!r})"

    def field(p: np.ndarray) -> np.ndarray:
        q = p - c
        return np.maximum(0.8 * np.hypot(q[:, 0], q[:, 1]) + 0.6 * q[:, 2], -q[:, 2] - h)

    return Shape(text, field, (c, (c[0], c[1], c[2] - h), (c[0] + 0.75 * h, c[1], c[2] - h)))


PRIMITIVES = (sphere, box, plain_box, torus, capsule, cone)


def joined(pick: random.Random, a: Shape, b: Shape) -> Shape:
    """Join two shapes by a random operation: union, intersection, difference or smooth union."""
    marks = a.marks + b.marks
    match pick.choice(["union", "union", "intersection", "difference", "smooth"]):
        case "union":
            return Shape(f"min({a.text}, {b.text})", lambda p: np.minimum(a.field(p), b.field(p)), marks)
        case "intersection":
            return Shape(f"max({a.text}, {b.text})", lambda p: np.maximum(a.field(p), b.field(p)), marks)
        case "difference":
            return Shape(f"max({a.text}, -({b.text}))", lambda p: np.maximum(a.field(p), -b.field(p)), marks)

    def smooth(p: np.ndarray) -> np.ndarray:
        u, v = a.field(p), b.field(p)
        return np.minimum(u, v) - np.maximum(0.25 - np.abs(u - v), 0.0) ** 2

    return Shape(f"(min({a.text}, {b.text}) - max(0.25 - abs({a.text} - {b.text}), 0)^2)", smooth, marks)


def random_shape(pick: random.Random, parts: int) -> Shape:
    """Make a random tree of `parts` primitives; some of its nodes are hollowed, or grown by a sixteenth."""
    if parts == 1:
        return pick.choice(PRIMITIVES)(pick)
    left = pick.randint(1, parts - 1)
    shape = joined(pick, random_shape(pick, left), random_shape(pick, parts - left))
    match pick.choice(["", "", "", "hollow", "grown"]):
        case "hollow":
            return Shape(f"(abs({shape.text}) - 0.0625)", lambda p: np.abs(shape.field(p)) - 0.0625, shape.marks)
        case "grown":
            return Shape(f"({shape.text} - 0.0625)", lambda p: shape.field(p) - 0.0625, shape.marks)
    return shape


def rays_for(shape: Shape, count: int, seed: int) -> np.ndarray:
    """Return rays float32[count, 6] that meet the kinks of `shape`.

    They begin outside and inside. Some go along axes and diagonals through marks, some towards marks, some begin at
    marks, and some go any way.
    """
    rng = np.random.default_rng(seed)
    origins = rng.normal(size=(count, 3)) * rng.choice([0.4, 2.0], size=(count, 1))
    directions = rng.uniform(-0.8, 0.8, size=(count, 3)) - origins
    marks = np.array(shape.marks)
    kind = rng.integers(0, 5, count)
    for k in range(count):
        mark = marks[rng.integers(len(marks))]
        if kind[k] in (1, 2):  # along an axis or a diagonal, exactly through what the mark shares with edges
            step = rng.choice([0.0, 0.0, 1.0, -1.0], 3) if kind[k] == 2 else np.zeros(3)
            axis = rng.integers(3)
            step[axis] = rng.choice([-1.0, 1.0])
            origins[k] = mark - rng.choice([0.0, 0.25, 0.5, 3.0, 3.0]) * step
            directions[k] = step
            if kind[k] == 1:
                off = (axis + 1) % 3
                origins[k, off] = rng.choice([origins[k, off], marks[rng.integers(len(marks))][off], 0.3])
        elif kind[k] == 3:  # towards a mark, from eighths
            origins[k] = np.round(origins[k] * 8) / 8
            directions[k] = mark - origins[k]
        elif kind[k] == 4:  # starts at a mark
            origins[k] = mark
    directions[~directions.any(axis=1)] = (1.0, 0.0, 0.0)
    straight = (np.abs(directions) > 0).sum(axis=1) == 1
    directions /= np.where(straight | (kind == 2) | (kind == 3), 1.0, np.linalg.norm(directions, axis=1))[:, None]
    return np.hstack([origins, directions]).astype(np.float32)


def march(shape: Shape, rays: np.ndarray, start: np.ndarray, stop: np.ndarray, steps: int = 4000) -> np.ndarray:
    """Return the t, float64[n], up to which marching proves that no root lies from `start` on; at most `stop`.

    `rays` are [n, 6], `start` and `stop` [n]. A step is |f| over the length of the direction.
    """
    o, d = rays[:, :3].astype(float), rays[:, 3:].astype(float)
    length = np.linalg.norm(d, axis=1)
    t = start.copy()
    for _ in range(steps):
        distance = np.abs(shape.field(o + t[:, None] * d))
        going = (t < stop) & (distance > 1e-13)
        if not going.any():
            break
        t = np.where(going, np.minimum(t + 0.999 * distance / length, stop), t)
    return t


def clip(domain: Sphere | Box, rays: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the t, float64[n] each, where rays [n, 6] enter the domain, 0 or more, and where they leave it.

    A ray that misses the domain enters behind where it leaves.
    """
    o, d = rays[:, :3].astype(float), rays[:, 3:].astype(float)
    with np.errstate(all="ignore"):
        if isinstance(domain, Box):
            near, far = ((np.asarray(side) - o) / d for side in (domain.lower, domain.upper))
            near, far = np.minimum(near, far), np.maximum(near, far)
            inside = (o >= domain.lower) & (o <= domain.upper)
            still = d == 0.0
            near, far = np.where(still, -np.inf, near), np.where(still, np.where(inside, np.inf, -np.inf), far)
            return np.maximum(near.max(axis=1), 0.0), far.min(axis=1)
        a, b, c = (d * d).sum(axis=1), (o * d).sum(axis=1), (o * o).sum(axis=1) - domain.radius**2
        root = np.sqrt(b * b - a * c)
        enter, leave = np.maximum((-b - root) / a, 0.0), (root - b) / a
        return np.where(root >= 0.0, enter, 1.0), np.where(root >= 0.0, leave, 0.0)


def contradictions(shape: Shape, domain: Sphere | Box, rays: np.ndarray, truth: Truth) -> list[tuple[int, str]]:
    """Return the indices of rays whose answer float64 marching refutes beyond its own rounding, with the reasons.

    `rays` are [n, 6], `truth` has the answer to each.
    """
    o, d = rays[:, :3].astype(float), rays[:, 3:].astype(float)
    length = np.linalg.norm(d, axis=1)
    enter, leave = clip(domain, rays)
    hit = np.isin(truth.status, (TruthStatus.CROSSING, TruthStatus.TOUCH))
    miss = truth.status == TruthStatus.MISS
    stop = np.where(hit, truth.lower, leave)
    reached = march(shape, rays, enter, stop)

    def field(t: np.ndarray) -> np.ndarray:
        return shape.field(o + t[:, None] * d)

    # where marching stands still in front of the answer, a float64 root is there: a touch is within about 1e-6 of it
    early = (reached < stop - 4e-6 / length) & (np.abs(field(reached)) < 1e-13) & (enter < leave - 1e-9)
    stay = (1e-7 + 4e-6 * (truth.status == TruthStatus.TOUCH)) / length
    before, behind = field(truth.lower - stay), field(truth.upper + stay)
    clear = hit & (np.abs(before) > 1e-12) & (np.abs(behind) > 1e-12)
    clear &= (truth.lower - stay > enter) & (truth.upper + stay < leave)
    found: list[tuple[int, str]] = []
    for reason, bad in (
        ("a miss, but marching ends at a root", miss & early),
        ("an earlier root", hit & early),
        ("no root in the interval", hit & ~(np.abs(field(truth.lower)) < 1e-9)),
        ("outside the clip interval", hit & ((truth.lower < enter - 1e-9) | (truth.upper > leave + 1e-9))),
        ("too wide", hit & (truth.upper - truth.lower > 2.0**-40 * domain.radius / length + 2.0**-49 * truth.upper)),
        ("no change of sign", clear & (truth.status == TruthStatus.CROSSING) & (before * behind > 0)),
        ("a change of sign", clear & (truth.status == TruthStatus.TOUCH) & (before * behind < 0)),
    ):
        found += [(int(k), reason) for k in np.flatnonzero(bad)]
    return found
