"""Hold what a cell's checked programs answered against the oracle, in one way for all kinds of casting.

A kind states what was cast (`Cast`): the rays, the hits that it read, and what only it knows of them. All else is the
same for every kind: truth, verdicts, the figures of the row, its pictures, and whether the cell may be timed.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from harness import memory
from harness.accuracy import judge
from harness.accuracy.judge import Deviations, Verdicts
from harness.accuracy.pictures import pictures_of
from harness.contract import FirsthitError, Hits, Precision, Surface, Truth, plural
from harness.oracle import cached_first_hits
from harness.results.row import Accuracy, Lane
from harness.scenes.camera import meets, scene_radius

BYTES_PER_RAY = 600  # of this process while it checks: 340 to 540 were measured for 512x512 and 1024x1024 rays


def need_memory(rays: int) -> None:
    """Raise FirsthitError, with exit code 3, where this machine's memory does not hold a check of so many rays."""
    instead = "take a smaller [accuracy] size, a smaller size or fewer samples a pixel"
    if reason := memory.refusal(BYTES_PER_RAY * rays, f"a check of {plural(rays, 'ray')}", instead):
        raise FirsthitError(reason, exit_code=3)


@dataclass(frozen=True, eq=False)
class Certified:
    """Hold the oracle's answers for the rays of a cast; a kind that asks it for more derives from this class."""

    truth: Truth


@dataclass(frozen=True, eq=False)
class Cast:
    """Hold the answers for the rays of a square grid, one after the other, row by row from the top left.

    A kind whose answers say more than hits derives from this class.

    surface: the surface whose size lengths are compared with
    rays: float32[n, 6]
    hits: [n], along the rays, validated (harness.accuracy.answers)
    compile_ms: what building the programs took
    facts: leaves of the row's accuracy that only this kind has
    pictures: arrays of the row that only this kind has
    """

    surface: Surface
    rays: NDArray[np.float32]
    hits: Hits
    compile_ms: float
    facts: Mapping[str, int | float | list[Lane] | dict[str, float] | None]
    pictures: dict[str, NDArray[Any]]

    def certified(self, folder: Path, margin: float) -> Certified:
        """Certify the first hits of the rays; `folder` keeps the oracle's answers.

        With several surfaces, what a ray passes by within `margin`, in scene units, is certified too.
        """
        return Certified(cached_first_hits(self.surface, self.rays, folder))

    def judged(self, verdicts: Verdicts, certified: Certified) -> tuple[Verdicts, dict[str, int]]:
        """Correct verdicts by what only this kind knows.

        Returns the verdicts, and counts of what was corrected, by the names of leaves of the row's accuracy.
        """
        return verdicts, {}

    def deviations(self, truth: Truth, verdicts: Verdicts) -> Deviations:
        """Compute normal and residual errors of the right hits."""
        return judge.deviations(self.surface, self.rays, self.hits, truth, verdicts)


def figures(
    answered: Cast, truth_folder: Path, grazing_margin: float, precision: Precision, footprint: float
) -> tuple[Accuracy, dict[str, NDArray[Any]]]:
    """Return the figures of a row's accuracy, and its pictures by name, [size, size] each.

    `grazing_margin` is in scene radii, `footprint` is a pixel's height at distance 1. `truth_folder` keeps the oracle's
    answers.
    """
    surface, size = answered.surface, round(len(answered.rays) ** 0.5)
    radius = scene_radius(surface)
    certified = answered.certified(truth_folder, grazing_margin * radius)
    truth = certified.truth
    verdicts = judge.judge(answered.hits, truth, radius, grazing_margin, precision)
    verdicts, corrected = answered.judged(verdicts, certified)
    summary = judge.summarize(
        surface,
        answered.hits,
        truth,
        verdicts,
        answered.deviations(truth, verdicts),
        precision=precision,
        footprint=footprint,
        grazing_margin=grazing_margin,
    )
    inside = int(meets(surface.domain, answered.rays).sum())
    pictures = pictures_of(surface, answered.rays, answered.hits, truth, verdicts, size)
    found = {"size": size, "domain_rays": inside, **summary, **corrected, **answered.facts}
    return cast(Accuracy, found), pictures | answered.pictures


def unjudged(summary: Accuracy, undecided: float) -> str | None:
    """Say why a summary tells no accuracy; None if it does.

    `undecided` is the share of hits that the oracle may leave undecided.
    """
    reason = judge.undecided_hits(summary["truth_hits"], summary["undecided"], undecided)
    if reason or judge.wrong_share(summary) is None:
        return reason or judge.nothing_judged(summary["rays"])
    return None


def too_wrong(summary: Accuracy, most: float) -> str | None:
    """Say why a cell is too wrong to be timed; None if at most the share `most` of its judged rays is wrong."""
    share = judge.wrong_share(summary)
    if share is not None and not share <= most:
        return f"wrong on {share:.1%} of the rays that are neither grazing nor drowned: not timed"
    return None
