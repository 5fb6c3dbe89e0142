"""Prepare a family of hard rays for a cell: group its rungs by surface, identify the family and describe it."""

from __future__ import annotations

import hashlib
import itertools
from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np
from numpy.typing import NDArray

from harness import hardcases
from harness.contract import Surface
from harness.hardcases import Rung


@dataclass(frozen=True, eq=False)
class Group:
    """Hold neighbouring rungs of a ladder that share one surface, so that one program and one launch serve them all."""

    surface: Surface
    rungs: tuple[Rung, ...]

    @cached_property
    def rays(self) -> NDArray[np.float32]:
        """Return the rays of all rungs, one rung after the other: float32[n, 6]."""
        return np.concatenate([rung.rays for rung in self.rungs])


@cache
def groups(family: str) -> tuple[Group, ...]:
    """Group a family's rungs by surface, in the order of its ladder. Raises FirsthitError for an unknown name."""
    grouped = itertools.groupby(hardcases.rungs(family), key=lambda rung: rung.surface)
    return tuple(Group(surface, tuple(rungs)) for surface, rungs in grouped)


@cache
def identity(family: str) -> list[dict[str, object]]:
    """Return what decides a family's answers, for cache keys: each group's surface, and a hash of its rays' bytes."""
    return [
        {"surface": group.surface.identity, "rays": hashlib.sha256(group.rays.tobytes()).hexdigest()[:16]}
        for group in groups(family)
    ]


def facts(family: str) -> dict[str, str]:
    """Return what a report prints of a family: its title, parameter, direction, reason and source."""
    stated = hardcases.get(family)
    return {name: getattr(stated, name) for name in ("title", "parameter", "harder", "why", "source")}
