"""State how methods cast a shot: an image, or listed rays, that is cast once, to be looked at."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness.contract import Hits, Origin, Program, Surface
from harness.devices.messages import Check
from harness.experiment.kinds.methods import MethodKind
from harness.kernels.assemble import Entry


@dataclass(frozen=True, eq=False)
class Shot:
    """Hold rays that are cast once, to be looked at: for `firsthit trace` and `firsthit show`.

    rays: float32[n, 6]
    camera: float32[12], of the square image whose rays these are, row by row; None if they are of no image
    knobs: of the method's variant
    surface: at which they are cast
    t_min: where the rays begin, in units of t
    """

    rays: NDArray[np.float32]
    camera: NDArray[np.float32] | None
    knobs: Mapping[str, float | int]
    surface: Surface
    t_min: float = 0.0
    origin: Origin = "nearest"


class ShotKind(MethodKind):
    """State what follows for methods that can cast a shot."""

    @property
    @abstractmethod
    def shot_entries(self) -> tuple[Entry, ...]:
        """List the entries of the programs that cast a shot; kinds state it as a class attribute."""

    @abstractmethod
    def shot(self, programs: tuple[Program, ...], shot: Shot, index: NDArray[np.intp]) -> Check[Any]:
        """Make the check that casts the rays `index`, int[k], of a shot by the programs of `shot_entries`."""

    @abstractmethod
    def shot_hits(self, answer: Any) -> Hits:
        """Read the hits [k], with t along the rays, from what the check of `shot` answered."""

    @abstractmethod
    def validated(self, hits: Hits, surface: Surface, shot: Shot) -> Hits:
        """Mark impossible answers INVALID (harness.accuracy.answers); `hits` [n] are of all rays of a shot."""
