"""Compare errors of tiles with bernstein's over whole frames: `python -m tests.benchmarks.tile_errors`.

Each row is a surface of the catalog that tiles accepts, in one of three views, or with `--views N` in one of N views
from random directions, which `--seed` chooses. All rays of a frame are cast by tiles
and by bernstein in float32, and by bernstein in float64, which tells their errors. Only rays count on which all three
hit and whose error is under MARGIN: a larger one belongs to another root.

Columns: rays that count; the 99.9th percentile and the largest of the errors, in domain radii, of tiles and of
bernstein; both of tiles over those of bernstein; the stage that answered the ray with tiles' largest error. A frame in
which no ray counts has no row. The last lines sum up the ratios of all views: those of the largest errors scatter
widely, since they are of one ray each. `--pairs 16` gives bernstein another value of its knob PAIRS than its default,
by which it is slower and more exact.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import surfaces
from harness.contract import RayStatus, Surface, View
from harness.devices.interface import open_device
from harness.devices.tiles import plan_of
from harness.plugins import find_methods
from harness.scenes.camera import camera_for, rays_of

from .tile_rays import MARGIN, Caster

VIEWS = (
    View("oblique", azimuth=30, elevation=35),
    View("low", azimuth=100, elevation=8),
    View("steep", azimuth=205, elevation=62),
)
QUANTILE = 0.999


@dataclass(frozen=True)
class Errors:
    """Hold a frame's errors in domain radii: (quantile, largest) of each method, and how many rays count.

    stage: the stage that answered the ray with tiles' largest error
    """

    rays: int
    tiles: tuple[float, float]
    bernstein: tuple[float, float]
    stage: str

    @property
    def ratios(self) -> tuple[float, float]:
        """Return quantile and largest of tiles over those of bernstein."""
        return self.tiles[0] / self.bernstein[0], self.tiles[1] / self.bernstein[1]


def compared(caster: Caster, view: View, size: int, **knobs: float) -> Errors | None:
    """Cast a frame of size x size pixels by both methods, and compare their errors; None if no ray counts.

    `knobs` are of bernstein in float32.
    """
    surface = caster.surface
    camera = camera_for(view, surface)
    rays = rays_of(camera, size)
    answer, exact, own = (
        caster.tiles(camera, rays),
        caster.alone("float64", rays),
        caster.alone("float32", rays, **knobs),
    )
    counts = np.logical_and.reduce([hits.status == RayStatus.HIT for hits in (answer.hits, exact, own)])
    errors = [np.abs(hits.t - exact.t) / surface.domain.radius for hits in (answer.hits, own)]
    with np.errstate(invalid="ignore"):
        counts &= (errors[0] < MARGIN) & (errors[1] < MARGIN)
    if not counts.any():
        return None
    found = [(float(np.quantile(e[counts], QUANTILE)), float(e[counts].max())) for e in errors]
    worst = int(np.argmax(np.where(counts, errors[0], 0.0)))
    stage = plan_of(caster.programs[0]).stages[answer.stages[worst]]
    return Errors(int(counts.sum()), found[0], found[1], stage)


def accepted() -> list[Surface]:
    """Return the surfaces of the catalog that tiles accepts."""
    method = find_methods().get("tiles").method
    return [surface for surface in map(surfaces.get, surfaces.names()) if method.accepts(surface) is None]


def row(name: str, view: str, errors: Errors) -> str:
    """Write a line of the table."""
    numbers = " ".join(f"{value:>9.2e}" for value in (*errors.tiles, *errors.bernstein))
    ratios = " ".join(f"{ratio:>6.2f}" for ratio in errors.ratios)
    return f"{name:<22} {view:<8} {errors.rays:>8} {numbers} {ratios}  {errors.stage}"


def main(arguments: Sequence[str]) -> int:
    """Print a row for each surface and view. Returns 1 if an error of tiles is above bernstein's."""
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks.tile_errors")
    parser.add_argument("names", nargs="*", help="surfaces; all that tiles accepts if none is given")
    parser.add_argument("--size", type=int, default=512)
    parser.add_argument("--device", default="opencl:intel")
    parser.add_argument("--views", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--pairs", type=int)
    options = parser.parse_args(arguments)
    device = open_device(options.device)
    heads = [f"{what:>9}" for what in ("tiles", "largest", "bernstein", "largest")]
    print(f"{'surface':<22} {'view':<8} {'rays':>8} {' '.join(heads)} {'ratio':>6} {'ratio':>6}  stage")
    ratios = list[tuple[float, float]]()
    knobs = {} if options.pairs is None else {"PAIRS": options.pairs}
    for surface in map(surfaces.get, options.names) if options.names else accepted():
        caster = Caster(device, surface)
        for view in random_views(options.views, options.seed) if options.views else VIEWS:
            if errors := compared(caster, view, options.size, **knobs):
                ratios.append(errors.ratios)
                print(row(surface.name, view.name, errors), flush=True)
    print(summary(np.array(ratios)))
    return int(np.max(ratios) > 1.0)


def random_views(count: int, seed: int) -> tuple[View, ...]:
    """Return views from random directions; the same seed makes the same ones."""
    random = np.random.default_rng(seed)
    angles = zip(random.uniform(0.0, 360.0, count), random.uniform(-80.0, 80.0, count), strict=True)
    return tuple(View(f"view {k}", azimuth=float(a), elevation=float(e)) for k, (a, e) in enumerate(angles))


def summary(ratios: NDArray[np.float64]) -> str:
    """Write what the ratios float64[n, 2] of quantiles and of largest errors come to."""
    lines = []
    for what, of in zip(("99.9th percentile", "largest"), ratios.T, strict=True):
        logs = np.log(of)
        spread = ", ".join(f"{value:.2f}" for value in np.quantile(of, [0.05, 0.25, 0.5, 0.75, 0.95]))
        lines.append(
            f"{what}: {len(of)} views; geometric mean {math.exp(logs.mean()):.3f}, its standard error "
            f"{logs.std() / math.sqrt(len(of)):.3f}; quantiles 5, 25, 50, 75 and 95 %: {spread}; at most "
            f"{of.max():.2f}; above 1 in {np.mean(of > 1.0):.2f} of the views"
        )
    return "\n".join(lines)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
