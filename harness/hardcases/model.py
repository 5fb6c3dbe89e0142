"""Define what a family of hard rays is, and the decorator that makes one of a function."""

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
    """Hold one value of a family's parameter, with its surface and its rays.

    `rays` is float32[n, 6]: origins, and directions whose length is 1 to float32 rounding.
    """

    parameter: float
    surface: Surface
    rays: Rays
    margin: float = inf  # no ray is farther than this, in scene units, from a ray with other roots; inf: not known


@dataclass(frozen=True)
class Family:
    """Describe rays that get harder as one parameter changes; everything else stays the same from rung to rung."""

    name: str
    title: str
    parameter: str  # what the parameter means, with its unit
    harder: Literal["smaller", "larger"]  # which values of the parameter are the harder ones
    why: str  # why methods break here, in one sentence
    source: str
    ladder: tuple[float, ...]  # the parameter's values, the easiest first
    build: Build  # makes the surface and the rays of one value of the parameter
    is_margin: bool  # whether moving a ray or a root by the parameter, a length, merges, adds or removes roots
    seed: int = SEED

    def make(self) -> tuple[Rung, ...]:
        """Return the ladder's rungs, which draw the same random numbers, so that only the parameter differs."""
        return tuple(self._rung(value) for value in self.ladder)

    def _rung(self, value: float) -> Rung:
        """Return one rung."""
        surface, rays = self.build(value, np.random.Generator(np.random.PCG64([self.seed, *self.name.encode()])))
        rays.setflags(write=False)
        return Rung(value, surface, rays, value if self.is_margin else inf)


def family(
    title: str,
    parameter: str,
    ladder: tuple[float, ...],
    *,
    why: str,
    source: str = "firsthit",
    is_margin: bool = False,
) -> Callable[[Build], Family]:
    """Return a decorator that makes a family of a function, which builds the surface and the rays of one rung.

    The family has the function's name. `title`, `parameter`, `why` and `source` are printed in reports; see Family.
    """
    harder: Literal["smaller", "larger"] = "smaller" if ladder[-1] < ladder[0] else "larger"
    return lambda build: Family(build.__name__, title, parameter, harder, why, source, ladder, build, is_margin)
