"""Families of hard cases as cells: their rays grouped by surface, and each rung judged by itself."""

from __future__ import annotations

import hashlib
import itertools
from dataclasses import dataclass
from functools import cache, cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness import hardcases
from harness.contract import Hits, Precision, Surface, Truth
from harness.hardcases import Rung


@dataclass(frozen=True, eq=False)
class Group:
    """Neighbouring rungs of one surface, so that one program and one launch serve them all."""

    surface: Surface
    rungs: tuple[Rung, ...]

    @cached_property
    def rays(self) -> NDArray[np.float32]:
        """float32[n, 6] of all rungs, one after the other."""
        return np.concatenate([rung.rays for rung in self.rungs])

    def judge(self, hits: Hits, truth: Truth, precision: Precision) -> list[dict[str, Any]]:
        """One verdict for each rung; hits and truth are of `rays`."""
        from harness.accuracy.rungs import judge_rung

        verdicts, start = [], 0
        for rung in self.rungs:
            part = slice(start, start + len(rung.rays))
            verdicts.append(judge_rung(rung, _part(hits, part), _part(truth, part), precision))
            start = part.stop
        return verdicts


def _part(whole: Any, part: slice) -> Any:
    return type(whole)(**{name: values[part] for name, values in vars(whole).items()})


@cache
def groups(family: str) -> tuple[Group, ...]:
    """A family's rungs, grouped by surface."""
    grouped = itertools.groupby(hardcases.rungs(family), key=lambda rung: rung.surface)
    return tuple(Group(surface, tuple(rungs)) for surface, rungs in grouped)


@cache
def identity(family: str) -> list[Any]:
    """What decides a family's answers: its surfaces and the bytes of its rays."""
    return [
        {"surface": group.surface.identity, "rays": hashlib.sha256(group.rays.tobytes()).hexdigest()[:16]}
        for group in groups(family)
    ]


def facts(family: str) -> dict[str, str]:
    """What a report says of a family."""
    stated = hardcases.get(family)
    return {name: getattr(stated, name) for name in ("title", "parameter", "harder", "why", "source")}
