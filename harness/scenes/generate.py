"""Scenes by number: the same count and seed give the same scene everywhere."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from harness.contract import Box, FirsthitError, Surface, Variant, View
from harness.scenes.model import Floats, Group, Scene

SPACING = 2.2  # of a lattice of tori of outer radius 1
CELL_FILL = 0.12  # of the lattice's cells, that hold a part of a pipe
WIDE, NARROW = "0.2", "0.12"  # radii of pipes, over a cell's side
RADII = {"C": 1.7, "N": 1.55, "O": 1.52, "H": 1.2}  # van der Waals, Å (A. Bondi 1964)
COLOURS = {"C": (0.45, 0.45, 0.45), "N": (0.25, 0.4, 0.9), "O": (0.85, 0.2, 0.2), "H": (0.9, 0.9, 0.9)}


def turns(source: np.random.Generator, count: int) -> Floats:
    """[count, 3, 3] rotations drawn uniformly, by unit quaternions."""
    w, x, y, z = (part for part in _unit(source.normal(size=(count, 4))).T)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.asarray(np.moveaxis(np.array(rows), 2, 0))


def _unit(vectors: Floats) -> Floats:
    return np.asarray(vectors / np.linalg.norm(vectors, axis=-1, keepdims=True))


def _colours(source: np.random.Generator, count: int) -> Floats:
    return np.asarray(0.25 + 0.65 * source.random((count, 3)))


def _tori(count: int, where: str) -> str:
    return "One torus" if count == 1 else f"{count:,} tori {where}"


def lattice(count: int, seed: int, view: View) -> Scene:
    """`count` tori R = 0.7, r = 0.3 in the first cells of a cubic lattice, each turned at random (toledo2007, 5.2)."""
    import surfaces

    source, side = np.random.default_rng([seed, count]), math.ceil(count ** (1.0 / 3.0) - 1e-9)
    cells = np.stack(np.unravel_index(np.arange(count), (side, side, side)), axis=1)
    place = SPACING * (cells - 0.5 * (side - 1))
    group = Group((surfaces.get("torus"),), place, turns(source, count), np.ones(count), _colours(source, count))
    return Scene(f"lattice {count}", _tori(count, "on a lattice"), (group,), view, "lattice")


def scattered(count: int, seed: int, view: View) -> Scene:
    """`count` tori of many radii and sizes, anywhere in a ball that they fill to about a twentieth."""
    import surfaces

    source = np.random.default_rng([seed, count, 1])
    tubes = [f"{tube:.2f}" for tube in source.uniform(0.1, 0.45, count)]
    chosen = tuple(surfaces.get("torus", R=f"{1.0 - float(tube):.2f}", r=tube) for tube in tubes)
    radius = (20.0 * count) ** (1.0 / 3.0) if count > 1 else 0.0
    place = radius * source.random((count, 1)) ** (1.0 / 3.0) * _unit(source.normal(size=(count, 3)))
    scale = source.uniform(0.5, 1.5, count)
    group = Group(chosen, place, turns(source, count), scale, _colours(source, count))
    return Scene(f"scattered {count}", _tori(count, "anywhere in a ball"), (group,), view, "scattered")


def molecule(count: int, seed: int, view: View) -> Scene:
    """`count` spheres of four elements' van der Waals radii, along a chain that winds at random through a ball of about
    10 Å³ for each."""
    import surfaces

    source, radius = np.random.default_rng([seed, count, 2]), 1.34 * count ** (1.0 / 3.0)
    place, way = np.zeros((count, 3)), np.array([0.0, 0.0, 1.0])
    for i in range(1, count):
        way = _unit(way + source.normal(size=3))
        if np.linalg.norm(place[i - 1] + 1.5 * way) > radius:  # turned back at the ball's edge
            way = _unit(0.5 * source.normal(size=3) - _unit(place[i - 1]) if i > 1 else -way)
        place[i] = place[i - 1] + 1.5 * way
    elements = source.choice(list(RADII), size=count, p=(0.4, 0.12, 0.13, 0.35))
    scale = np.array([RADII[element] for element in elements])
    colours = np.array([COLOURS[element] for element in elements])
    group = Group((surfaces.get("sphere"),), place, turns(source, count), scale, colours)
    return Scene(f"molecule {count}", f"A molecule of {count:,} spheres", (group,), view, "molecule")


def _part(name: str, formula: str, box: Box, distance: str | None = None, **parameters: str) -> Surface:
    """A surface of a pipe, of the families that harness.scenes.meshes knows."""
    from surfaces import formula as language

    bound = tuple(sorted(parameters.items()))
    degree = language.degree(language.parse(formula, dict(bound)))
    return Surface(name, name.capitalize(), formula, box, "a part of a pipe", degree, bound, distance)


def cylinder(radius: str) -> Surface:
    r = float(radius)
    box = Box((-r, -r, -0.5), (r, r, 0.5))
    return _part("cylinder", "x^2 + y^2 - r^2", box, "sqrt(x^2 + y^2) - r", r=radius)


def cone(wide: str, narrow: str) -> Surface:
    """Its radius goes from `wide` at z = -1/2 to `narrow` at 1/2."""
    w, n = float(wide), float(narrow)
    box = Box((-w, -w, -0.5), (w, w, 0.5))
    return _part("cone", "x^2 + y^2 - (a + b*z)^2", box, None, a=repr(0.5 * (w + n)), b=repr(n - w))


def plane(half: float) -> Surface:
    return _part("plane", "z", Box((-half, -half, -0.01), (half, half, 0.01)), "z")


def elbow(radius: str) -> Surface:
    """A quarter of a torus about the z axis, from (1/2, 0, 0) to (0, 1/2, 0): its box cuts it off."""
    import dataclasses

    import surfaces

    whole, outer, r = surfaces.get("torus", R="0.5", r=radius), 0.5 + float(radius), float(radius)
    box = Box((0.0, 0.0, -r), (outer, outer, r))
    return dataclasses.replace(whole, name="torus", domain=box, bounding_radius=None, facts=())


def pipes(count: int, seed: int, view: View) -> Scene:
    """`count` parts of pipes in the cells of a lattice: straight ones, quarter tori where they turn, cones where they
    get wider or narrower, and square plates, always of triangles, where they begin and end (toledo2007, section 6)."""
    source = np.random.default_rng([seed, count, 3])
    side = max(2, math.ceil((count / CELL_FILL) ** (1.0 / 3.0)))
    placed: dict[str, list[tuple[Floats, Floats, Floats]]] = {}
    taken = np.zeros((side, side, side), bool)
    steps: Any = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]])
    total = 0

    def put(kind: str, at: Floats, turn: Floats, colour: Floats) -> None:
        nonlocal total
        if total < count:
            placed.setdefault(kind, []).append((at - 0.5 * (side - 1), turn, colour))
            total += 1

    def free(cell: Floats) -> bool:
        return bool(((cell >= 0) & (cell < side)).all() and not taken[tuple(cell)])

    while total < count:
        cell: Any
        way: Any
        cell, way = source.integers(0, side, 3), steps[source.integers(6)]
        if not free(cell):
            continue
        end = cell
        colour, radius = 0.3 + 0.6 * source.random(3), WIDE if source.random() < 0.5 else NARROW
        put("plate", cell - 0.5 * way, _frame(way), colour)
        for _ in range(source.integers(4, 24)):
            taken[tuple(cell)] = True
            onward = [step for step in steps if abs(step @ way) == 0 and free(cell + step)]
            if onward and (source.random() < 0.35 or not free(cell + way)):
                new = onward[source.integers(len(onward))]
                # the quarter torus runs from the cell's face behind to the face ahead, about the edge between them
                corner = cell + 0.5 * (new - way)
                put(f"elbow {radius}", corner, np.stack([-new, way, np.cross(-new, way)], axis=1), colour)
                way = new
            elif source.random() < 0.1:
                other = NARROW if radius == WIDE else WIDE
                put("cone", cell, _frame(way if radius == WIDE else -way), colour)
                radius = other
            else:
                put(f"cylinder {radius}", cell, _frame(way), colour)
            end = cell + 0.5 * way
            if not free(cell + way):
                break
            cell = cell + way
        put("plate", end, _frame(way), colour)

    kinds = {f"cylinder {r}": cylinder(r) for r in (WIDE, NARROW)} | {f"elbow {r}": elbow(r) for r in (WIDE, NARROW)}
    kinds |= {"cone": cone(WIDE, NARROW), "plate": plane(0.3)}
    groups = []
    for kind, surface in kinds.items():
        if parts := placed.get(kind):
            place, turn, colours = (np.array(values, float) for values in zip(*parts, strict=True))
            own = Variant("polygon", (("N", 4),), "plates of triangles") if kind == "plate" else None
            groups.append(Group((surface,), place, turn, np.ones(len(parts)), colours, own))
    return Scene(f"pipes {count}", f"A pipe assembly of {count:,} parts", tuple(groups), view, "pipes")


def _frame(axis: Floats) -> Floats:
    """A rotation that takes the z axis to `axis`, one of the six along the coordinates."""
    other = np.roll(np.abs(axis), 1).astype(float)
    return np.stack([other, np.cross(axis, other), axis.astype(float)], axis=1)


GENERATORS: dict[str, Callable[[int, int, View], Scene]] = {
    "lattice": lattice,
    "scattered": scattered,
    "molecule": molecule,
    "pipes": pipes,
}


def generate(kind: str, count: int, seed: int, view: View) -> Scene:
    """The scene; FirsthitError for a count out of range."""
    if not 1 <= count <= 1_000_000:
        raise FirsthitError(f"a scene has 1 to 1,000,000 parts, not {count}")
    return GENERATORS[kind](count, seed, view)
