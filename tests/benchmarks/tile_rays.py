"""Hold many rays of tiles: `python -m tests.benchmarks.tile_rays N --seed S`, 10,000,000 rays at full size.

With `--every K` only each K-th surface is cast, beginning with number S modulo K, since compiling the programs of a
surface takes longer than casting a window.

The rays are pixels of windows: images of WINDOW x WINDOW pixels, each a part of a larger image, from eyes all around
the surface and in its domain. Surfaces are the catalog's polynomials that tiles accepts, and dense random ones of
degrees 3 to 20. The same seed casts the same rays.

Certifying every ray would take long. So each answer is first compared with bernstein's in float64, on the same ray,
and the oracle is asked only of rays where the two differ in status, or by more than `suspect` domain radii, and of a
random SAMPLE of each window. An answer of these is outside the promise as methods/bernstein states it: the first root
has a condition times roundoff under CONDITION, the nearest other answer is MARGIN domain radii away, and the answer is
wrong, or its error above the tolerance and what rounding adds. Where the two answers differ by less than `suspect`,
which is half of the least error that is so allowed, no error is above what is allowed unless bernstein's in float64 is.

Columns: rays cast, hits among them, rays asked of the oracle, those of them in the promise, wrong answers among all
that were asked, answers outside the promise; errors in domain radii as bernstein in float64 tells them, tiles and
bernstein in the same precision (99.9 % and largest; in float64 the latter are 0, since it is held against itself);
shares of pixels in percent by the stage that answered them.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import get_args

import numpy as np
from numpy.typing import NDArray

import surfaces
from harness import conformance
from harness.accuracy.judge import judge
from harness.conformance import dense
from harness.conformance.cases import some
from harness.conformance.checks import ROUNDINGS
from harness.contract import UNIT_ROUNDOFF, Hits, Precision, Program, RayStatus, Surface
from harness.devices.interface import Built, Device, open_device
from harness.devices.messages import ListedCheck
from harness.devices.tiles import TileAnswer, TileCheck
from harness.experiment.kinds.tiles import CHECKED, frame_of
from harness.kernels.assemble import Entry, method_program
from harness.oracle import first_hits
from harness.plugins import find_methods
from harness.scenes.camera import rays_of, scene_radius

DEGREES = range(3, 21)  # of the dense random polynomials
WINDOW = 128  # pixels a side; tiles of both levels fill it
PIXELS = 1024  # a side of the image of 30 degrees whose pixels are as wide as a window's; also a half and twice that
INSIDE = 0.2  # of the eyes are in the domain
SAMPLE = 8  # rays of a window that are certified whatever was answered
MARGIN = 2.0**-11  # of the domain's radius
CONDITION = 2.0**-8  # of the first root's condition times the unit roundoff

Edit = Callable[[Program], Program]


def unchanged(program: Program) -> Program:
    """Return the program as it is."""
    return program


def candidates() -> list[Surface]:
    """Return the surfaces: the catalog's that tiles accepts, and one dense polynomial of each of DEGREES."""
    method = find_methods().get("tiles").method
    listed = [surface for surface in map(surfaces.get, surfaces.names()) if method.accepts(surface) is None]
    return [*listed, *(dense.surface_of(degree, dense.seed_of(degree)) for degree in DEGREES)]


def window(surface: Surface, rng: np.random.Generator, size: int = WINDOW) -> NDArray[np.float32]:
    """Return the camera float32[12] of a random window of size x size pixels, towards a point in the domain."""
    radius, center = surface.domain.radius, np.array(surface.domain.center)
    away = rng.normal(size=3)
    away *= rng.uniform(0.2, 0.9) if rng.random() < INSIDE else rng.uniform(1.5, 5.0) / np.linalg.norm(away)
    target = 0.6 * rng.uniform(-1.0, 1.0, 3) / math.sqrt(3.0)
    forward = target - away
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, rng.normal(size=3))
    right *= size * math.tan(math.radians(15.0)) / (PIXELS * rng.choice([0.5, 1.0, 2.0])) / np.linalg.norm(right)
    return np.concatenate([center + radius * away, forward, right, np.cross(right, forward)]).astype(np.float32)


class Caster:
    """Cast windows of a surface on a device, by the programs of tiles and by bernstein's."""

    def __init__(
        self,
        device: Device,
        surface: Surface,
        edit: Edit = unchanged,
        precision: Precision = "float32",
        **knobs: float,
    ) -> None:
        """Build the programs of tiles, each changed by `edit`; `knobs` are of tiles."""
        self.device, self.surface, self.precision = device, surface, precision
        self.programs = tuple(edit(self._program("tiles", precision, entry, **knobs)) for entry in CHECKED)
        self.built = [device.build(program) for program in self.programs]
        self.others: dict[tuple[Precision, tuple[tuple[str, float], ...]], tuple[Program, Built]] = {}

    def _program(self, name: str, precision: Precision, entry: Entry, **knobs: float) -> Program:
        plugin = find_methods().get(name)
        stated = plugin.method, plugin.folder, plugin.variant(knobs), self.surface, precision, self.device.language
        return method_program(*stated, entry)

    def tiles(self, camera: NDArray[np.float32], rays: NDArray[np.float32]) -> TileAnswer:
        """Return the answers to a window's rays, all of them listed."""
        frame = frame_of(self.programs, self.surface, camera, math.isqrt(len(rays)))
        return TileCheck(frame, rays, 1, np.arange(len(rays))).run(self.device, self.built)

    def alone(self, precision: Precision, rays: NDArray[np.float32], **knobs: float) -> Hits:
        """Return bernstein's answers to listed rays; `knobs` are of bernstein."""
        made_for = precision, tuple(knobs.items())
        if made_for not in self.others:
            made = self._program("bernstein", precision, "rays", **knobs)
            self.others[made_for] = made, self.device.build(made)
        program, built = self.others[made_for]
        return ListedCheck(program, rays).run(self.device, [built])


@dataclass
class Held:
    """Sum up what was found on windows of one surface.

    counts: by the name of what was counted
    shares: of pixels, by stage, summed over windows
    errors: in domain radii, by method: one array for each window
    outside: ray and answer of each that is outside the promise
    """

    counts: dict[str, int] = field(default_factory=dict)
    shares: dict[str, float] = field(default_factory=dict)
    errors: dict[str, list[NDArray[np.float64]]] = field(default_factory=lambda: {"tiles": [], "bernstein": []})
    outside: list[str] = field(default_factory=list)

    def count(self, **numbers: int) -> None:
        for name, number in numbers.items():
            self.counts[name] = self.counts.get(name, 0) + int(number)

    def add(self, other: Held) -> None:
        self.count(**other.counts)
        for stage, share in other.shares.items():
            self.shares[stage] = self.shares.get(stage, 0.0) + share
        for name, errors in other.errors.items():
            self.errors[name] += errors
        self.outside += other.outside


def tolerance() -> float:
    """Return the error, in domain radii, that the default of tiles may leave beside rounding."""
    knobs = {parameter.name: parameter.default for parameter in find_methods().get("tiles").method.parameters}
    return 2.0 * float(knobs["TOLERANCE"])


def suspect(precision: Precision) -> float:
    """Return the difference of answers, in domain radii, above which a ray is certified.

    It is half of the least error that the promise allows, on a ray whose condition is 1.
    """
    return 0.5 * (tolerance() + ROUNDINGS * UNIT_ROUNDOFF[precision])


def suspects(hits: Hits, exact: Hits, beyond: float) -> NDArray[np.bool_]:
    """Return bool[n]: answers that differ from bernstein's in float64 in status, or by more than `beyond`, in t."""
    with np.errstate(invalid="ignore"):
        apart = np.abs(hits.t - exact.t) > beyond
    return np.asarray((hits.status != exact.status) | apart | (hits.status > RayStatus.HIT))


def errors_of(hits: Hits, exact: Hits, radius: float) -> NDArray[np.float64]:
    """Return errors in domain radii, of rays that hit the same root as bernstein in float64 does."""
    both = (hits.status == RayStatus.HIT) & (exact.status == RayStatus.HIT)
    errors = np.abs(hits.t - exact.t)[both] / radius
    return np.asarray(errors[errors < MARGIN])


def certify(surface: Surface, rays: NDArray[np.float32], hits: Hits, precision: Precision) -> Held:
    """Hold answers to rays against the oracle's, and tell those that are outside the promise."""
    held, radius, truth = Held(), surface.domain.radius, first_hits(surface, rays)
    case = conformance.Case(surface, rays, truth)
    verdicts = judge(hits, truth, scene_radius(surface), 0.0)
    promised = ~(truth.margin < MARGIN * radius) & ~(truth.condition * UNIT_ROUNDOFF[precision] > CONDITION)
    allowed = radius * tolerance() + conformance.rounding_adds(case, precision)
    with np.errstate(invalid="ignore"):
        outside = promised & ((verdicts.wrong > 0) | (verdicts.error > allowed))
    held.count(asked=len(rays), promised=promised.sum(), wrong=(verdicts.wrong > 0).sum(), outside=outside.sum())
    for k in np.flatnonzero(outside):
        told = f"status {hits.status[k]} at {hits.t[k]:.9g}, the root at {truth.lower[k]:.9g}"
        held.outside.append(f"{surface.name}: ray {rays[k].tolist()}: {told}")
    return held


def hold(caster: Caster, rng: np.random.Generator, size: int = WINDOW) -> Held:
    """Cast a random window and hold all of its rays."""
    surface, radius = caster.surface, caster.surface.domain.radius
    camera = window(surface, rng, size)
    rays = rays_of(camera, size)
    answer, exact, own = caster.tiles(camera, rays), caster.alone("float64", rays), caster.alone(caster.precision, rays)
    asked = suspects(answer.hits, exact, radius * suspect(caster.precision))
    asked[rng.integers(0, len(rays), SAMPLE)] = True
    held = certify(surface, rays[asked], some(answer.hits, asked), caster.precision)
    held.count(rays=len(rays), hits=(answer.hits.status == RayStatus.HIT).sum())
    held.shares = dict(answer.shares)
    for name, hits in (("tiles", answer.hits), ("bernstein", own)):
        held.errors[name].append(errors_of(hits, exact, radius))
    return held


COUNTED = ("rays", "hits", "asked", "promised", "wrong", "outside")
STAGES = ("empty_16", "empty_8", "single_16", "single_8", "packets", "rest")


def row(name: str, held: Held, windows: int) -> str:
    """Write a line of the table."""
    cells = [f"{held.counts.get(what, 0):>{9 if what in ('rays', 'hits') else 8}}" for what in COUNTED]
    for method in ("tiles", "bernstein"):
        errors = np.concatenate(held.errors[method] or [np.zeros(0)])
        top = (np.quantile(errors, 0.999), errors.max()) if len(errors) else (math.nan, math.nan)
        cells += [f"{value:>8.1e}" for value in top]
    cells += [f"{100.0 * held.shares.get(stage, 0.0) / windows:>5.1f}" for stage in STAGES]
    return f"{name:<22} {' '.join(cells)}"


def runs(
    device: Device, count: int, seed: int, precision: Precision = "float32", every: int = 1
) -> Iterator[tuple[str, Held, int]]:
    """Yield for each surface its name, what was found, and of how many windows; together they have `count` rays.

    Of the candidates each `every`-th is cast, beginning with number seed modulo `every`.
    """
    chosen = candidates()[seed % every :: every]
    windows = max(1, round(count / (len(chosen) * WINDOW**2)))
    for surface in chosen:
        caster, held = Caster(device, surface, precision=precision), Held()
        for k in range(windows):
            held.add(hold(caster, np.random.default_rng([seed, len(surface.formula), k])))
        yield surface.name, held, windows


def main(arguments: list[str]) -> int:
    """Print a row for each surface and one for all. Returns 1 if an answer is outside the promise."""
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks.tile_rays")
    parser.add_argument("rays", type=int)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--device", default="opencl:intel")
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--precision", choices=get_args(Precision), default="float32")
    options = parser.parse_args(arguments)
    head = [f"{what:>{9 if what in ('rays', 'hits') else 8}}" for what in COUNTED]
    head += [f"{what:>8}" for what in ("tiles", "largest", "alone", "largest")]
    head += [f"{what:>5}" for what in ("e16", "e8", "s16", "s8", "pack", "rest")]
    print(f"{'surface':<22} {' '.join(head)}")
    whole, total = Held(), 0
    stated = options.rays, options.seed, options.precision, options.every
    for name, held, windows in runs(open_device(options.device), *stated):
        print("\n".join([row(name, held, windows), *held.outside]), flush=True)
        whole.add(held)
        total += windows
    print(row("all", whole, total))
    return 1 if whole.outside else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
