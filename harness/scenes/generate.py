"""Generate scenes of any number of instances: the same count and seed give the same scene everywhere."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from harness.contract import Box, FirsthitError, Surface, Variant, View, plural
from harness.limits import Within
from harness.scenes.model import Floats, Group, Scene

Cell = NDArray[np.int64]  # [3], a cell of a lattice, or a step from one to a neighbour
Directions = NDArray[np.int64] | Floats  # [3, 3], a rotation by quarter turns

SPACING = 2.2  # of a lattice of tori whose outer radius is 1
CELL_FILL = 0.12  # the share of a lattice's cells that hold a part of a pipe
WIDE, NARROW = "0.2", "0.12"  # radii of pipes, over a cell's side
STEPS: Cell = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]])
RADII = {"C": 1.7, "N": 1.55, "O": 1.52, "H": 1.2}  # van der Waals, Å (A. Bondi 1964)
COLOURS = {"C": (0.45, 0.45, 0.45), "N": (0.25, 0.4, 0.9), "O": (0.85, 0.2, 0.2), "H": (0.9, 0.9, 0.9)}


def turns(source: np.random.Generator, count: int) -> Floats:
    """Draw rotations uniformly, by unit quaternions: float64[count, 3, 3]."""
    w, x, y, z = (part for part in _unit(source.normal(size=(count, 4))).T)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.asarray(np.moveaxis(np.array(rows), 2, 0))


def _unit(vectors: Floats) -> Floats:
    """Return vectors float64[..., k] divided by their lengths."""
    return np.asarray(vectors / np.linalg.norm(vectors, axis=-1, keepdims=True))


def _colours(source: np.random.Generator, count: int) -> Floats:
    """Draw colours, float64[count, 3] from 0.25 to 0.9."""
    return np.asarray(0.25 + 0.65 * source.random((count, 3)))


def _tori(count: int, where: str) -> str:
    """Return a scene's title."""
    return "One torus" if count == 1 else f"{count:,} tori {where}"


def lattice(count: int, seed: int, view: View) -> Scene:
    """Place `count` tori with R = 0.7, r = 0.3 in a cubic lattice, each turned at random (toledo2007, section 5.2)."""
    import surfaces

    source, side = np.random.default_rng([seed, count]), math.ceil(count ** (1.0 / 3.0) - 1e-9)
    cells = np.stack(np.unravel_index(np.arange(count), (side, side, side)), axis=1)
    place = SPACING * (cells - 0.5 * (side - 1))
    group = Group((surfaces.get("torus"),), place, turns(source, count), np.ones(count), _colours(source, count))
    return Scene(f"lattice {count}", _tori(count, "on a lattice"), (group,), view, "lattice")


def scattered(count: int, seed: int, view: View) -> Scene:
    """Place `count` tori of various radii and sizes at random in a ball, of which they fill about a twentieth."""
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
    """Place `count` spheres along a chain that winds at random through a ball of about 10 Å³ for each sphere.

    Their radii are the van der Waals radii of four elements.
    """
    import surfaces

    source, radius = np.random.default_rng([seed, count, 2]), 1.34 * count ** (1.0 / 3.0)
    place, way = np.zeros((count, 3)), np.array([0.0, 0.0, 1.0])
    for i in range(1, count):
        way = _unit(way + source.normal(size=3))
        if np.linalg.norm(place[i - 1] + 1.5 * way) > radius:  # the chain turns back at the ball's edge
            way = _unit(0.5 * source.normal(size=3) - _unit(place[i - 1]) if i > 1 else -way)
        place[i] = place[i - 1] + 1.5 * way
    elements = source.choice(list(RADII), size=count, p=(0.4, 0.12, 0.13, 0.35))
    scale = np.array([RADII[element] for element in elements])
    colours = np.array([COLOURS[element] for element in elements])
    group = Group((surfaces.get("sphere"),), place, turns(source, count), scale, colours)
    return Scene(f"molecule {count}", f"A molecule of {plural(count, 'sphere')}", (group,), view, "molecule")


def _part(name: str, formula: str, box: Box, distance: str | None = None, **parameters: str) -> Surface:
    """Return the surface of a part of a pipe; harness.scenes.meshes knows a parametric form of its formula."""
    from surfaces import formula as language

    bound = tuple(sorted(parameters.items()))
    degree = language.degree(language.parse(formula, dict(bound)))
    return Surface(name, name.capitalize(), formula, box, "a part of a pipe", degree, bound, distance)


def cylinder(radius: str) -> Surface:
    """Return a cylinder about the z axis, from z = -1/2 to 1/2."""
    r = float(radius)
    box = Box((-r, -r, -0.5), (r, r, 0.5))
    return _part("cylinder", "x^2 + y^2 - r^2", box, "sqrt(x^2 + y^2) - r", r=radius)


def cone(wide: str, narrow: str) -> Surface:
    """Return a cone about the z axis whose radius goes from `wide` at z = -1/2 to `narrow` at z = 1/2."""
    w, n = float(wide), float(narrow)
    box = Box((-w, -w, -0.5), (w, w, 0.5))
    return _part("cone", "x^2 + y^2 - (a + b*z)^2", box, None, a=repr(0.5 * (w + n)), b=repr(n - w))


def plane(half: float) -> Surface:
    """Return the square with sides of 2 `half` about the origin in the plane z = 0."""
    return _part("plane", "z", Box((-half, -half, -0.01), (half, half, 0.01)), "z")


def elbow(radius: str) -> Surface:
    """Return a quarter of a torus about the z axis, from (1/2, 0, 0) to (0, 1/2, 0), which its domain cuts out."""
    import dataclasses

    import surfaces

    whole, outer, r = surfaces.get("torus", R="0.5", r=radius), 0.5 + float(radius), float(radius)
    box = Box((0.0, 0.0, -r), (outer, outer, r))
    return dataclasses.replace(whole, name="torus", domain=box, bounding_radius=None, facts=())


@dataclass
class _Assembly:
    """Hold parts of pipes in the cells of a cubic lattice with `side` cells a side, `count` of them at most."""

    count: int
    side: int
    taken: NDArray[np.bool_]  # [side, side, side], the cells that hold a part
    placed: dict[str, list[tuple[Floats, Directions, Floats]]] = field(default_factory=dict)  # place, turn, colour
    total: int = 0

    def put(self, kind: str, at: Floats, turn: Directions, colour: Floats) -> None:
        """Place a part at a point of the lattice, in cells; do nothing once there are `count` parts."""
        if self.total < self.count:
            self.placed.setdefault(kind, []).append((at - 0.5 * (self.side - 1), turn, colour))
            self.total += 1

    def free(self, cell: Cell) -> bool:
        """Return whether a cell is inside the lattice and empty."""
        return bool(((cell >= 0) & (cell < self.side)).all() and not self.taken[tuple(cell)])

    def grow(self, source: np.random.Generator) -> None:
        """Lay one pipe of random length from a random cell, with a plate at each end; none if the cell is taken."""
        cell, way = source.integers(0, self.side, 3), STEPS[source.integers(6)]
        if not self.free(cell):
            return
        end: Floats = cell.astype(np.float64)
        colour, radius = 0.3 + 0.6 * source.random(3), WIDE if source.random() < 0.5 else NARROW
        self.put("plate", cell - 0.5 * way, _frame(way), colour)
        for _ in range(source.integers(4, 24)):
            self.taken[tuple(cell)] = True
            onward = [step for step in STEPS if abs(step @ way) == 0 and self.free(cell + step)]
            if onward and (source.random() < 0.35 or not self.free(cell + way)):
                new = onward[source.integers(len(onward))]
                # the quarter torus leads from the cell's face behind to the face ahead, about the edge between them
                corner = cell + 0.5 * (new - way)
                self.put(f"elbow {radius}", corner, np.stack([-new, way, np.cross(-new, way)], axis=1), colour)
                way = new
            elif source.random() < 0.1:
                self.put("cone", cell.astype(np.float64), _frame(way if radius == WIDE else -way), colour)
                radius = NARROW if radius == WIDE else WIDE
            else:
                self.put(f"cylinder {radius}", cell.astype(np.float64), _frame(way), colour)
            end = cell + 0.5 * way
            if not self.free(cell + way):
                break
            cell = cell + way
        self.put("plate", end, _frame(way), colour)


def pipes(count: int, seed: int, view: View) -> Scene:
    """Lay pipes of `count` parts through the cells of a lattice (toledo2007, section 6).

    Parts are straight ones, quarter tori where a pipe turns, and cones where it gets wider or narrower. A square plate,
    always drawn as triangles, closes each end.
    """
    source = np.random.default_rng([seed, count, 3])
    side = max(2, math.ceil((count / CELL_FILL) ** (1.0 / 3.0)))
    assembly = _Assembly(count, side, np.zeros((side, side, side), bool))
    while assembly.total < count:
        assembly.grow(source)
    kinds = {f"cylinder {r}": cylinder(r) for r in (WIDE, NARROW)} | {f"elbow {r}": elbow(r) for r in (WIDE, NARROW)}
    kinds |= {"cone": cone(WIDE, NARROW), "plate": plane(0.3)}
    groups = []
    for kind, surface in kinds.items():
        if parts := assembly.placed.get(kind):
            place, turn, colours = (np.array(values, float) for values in zip(*parts, strict=True))
            own = Variant("polygon", (("N", 4),), "plates of triangles") if kind == "plate" else None
            groups.append(Group((surface,), place, turn, np.ones(len(parts)), colours, own))
    return Scene(f"pipes {count}", f"A pipe assembly of {plural(count, 'part')}", tuple(groups), view, "pipes")


def _frame(axis: Cell) -> Floats:
    """Return a rotation, float64[3, 3], that takes the z axis to `axis`, one of STEPS."""
    other = np.roll(np.abs(axis), 1).astype(float)
    return np.stack([other, np.cross(axis, other), axis.astype(float)], axis=1)


COUNT = Within(1, 1_000_000, "a scene has 1 to 1,000,000 parts, not {value}")
GENERATORS: dict[str, Callable[[int, int, View], Scene]] = {
    "lattice": lattice,
    "scattered": scattered,
    "molecule": molecule,
    "pipes": pipes,
}


def generate(kind: str, count: int, seed: int, view: View) -> Scene:
    """Return the scene of a kind in GENERATORS. Raises FirsthitError if the count is not within COUNT."""
    if wrong := COUNT.broken(count):
        raise FirsthitError(f"count: {wrong}")
    return GENERATORS[kind](count, seed, view)
