"""What a family of hard cases is: one parameter, a ladder of its values, and rays that really are there."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import inf
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from harness.contract import Surface

SEED = 3
Rays = NDArray[np.float32]
Build = Callable[[float, np.random.Generator], tuple[Surface, Rays]]


@dataclass(frozen=True, eq=False)
class Rung:
    """One step of a family's ladder; `rays` float32[n, 6]: origins, and directions of length 1 to float32 rounding."""

    parameter: float
    surface: Surface
    rays: Rays
    margin: float = inf  # every ray is at most this far, in scene units, from one with other roots; by construction


@dataclass(frozen=True)
class Family:
    """Rays that get harder as one number changes; everything else stays the same from rung to rung."""

    name: str
    title: str
    parameter: str  # what the number means, with its unit
    harder: Literal["smaller", "larger"]
    why: str  # what breaks here, in one sentence
    source: str
    levels: tuple[float, ...]  # the parameter's values, going harder
    build: Build  # surface and rays of one level
    is_margin: bool  # whether moving a ray or a root by the parameter's length merges, adds or removes roots
    seed: int = SEED

    def make(self) -> tuple[Rung, ...]:
        """The ladder. Every rung draws the same random numbers, so that only the parameter tells rungs apart."""
        return tuple(self._rung(level) for level in self.levels)

    def _rung(self, level: float) -> Rung:
        surface, rays = self.build(level, np.random.Generator(np.random.PCG64([self.seed, *self.name.encode()])))
        rays.setflags(write=False)
        return Rung(level, surface, rays, level if self.is_margin else inf)


def family(
    title: str,
    parameter: str,
    levels: tuple[float, ...],
    *,
    why: str,
    source: str = "firsthit",
    is_margin: bool = False,
) -> Callable[[Build], Family]:
    """Makes a family of the function that builds one rung; its name is the function's."""
    harder: Literal["smaller", "larger"] = "smaller" if levels[-1] < levels[0] else "larger"
    return lambda build: Family(build.__name__, title, parameter, harder, why, source, levels, build, is_margin)
