"""Cast families of hard rays: listed rays that are checked rung by rung, and never timed.

A method that casts frames, and no listed rays, casts a small frame about each ray, whose middle pixel has the ray.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from harness.accuracy.answers import validated
from harness.accuracy.judge import undecided_hits
from harness.accuracy.rungs import judge_group
from harness.contract import FirsthitError, Program, Surface
from harness.devices.messages import Frame
from harness.devices.steps import Executor
from harness.experiment.cells import Cell
from harness.experiment.config import AccuracyChoice, Config
from harness.experiment.kinds.model import Asked, Casting, Kind, KindFacts, Outcome
from harness.experiment.kinds.narrowed import REFUSAL as NO_PREPASS
from harness.experiment.kinds.programs import Programs
from harness.hardcases import groups
from harness.oracle import cached_first_hits
from harness.results.row import RungVerdict


class FamilyCasting(Casting):
    """Cast the rays of a family by the programs of each of its surfaces, one surface after the other."""

    def __init__(self, asked: Asked, checks: tuple[Program, ...]) -> None:
        super().__init__(asked, checks, None)

    def frame(self) -> Frame | None:
        return None

    def check(self, executor: Executor, choice: AccuracyChoice, folder: Path, framed: bool) -> Outcome:
        cell, compile_ms, rungs = self.cell, 0.0, list[RungVerdict]()
        assert cell.family
        kind, of_family = self.asked.method_kind, groups.groups(cell.family)
        each = len(self.checks) // len(of_family)
        for number, group in enumerate(of_family):
            truth = cached_first_hits(group.surface, group.rays, folder)
            programs = self.checks[each * number : each * (number + 1)]
            checked = executor.check(cell.device, kind.hard_check(programs, group.surface, group.rays))
            hits = validated(checked.answer, group.surface.domain, group.rays, origin=cell.origin)
            compile_ms += checked.compile_ms
            rungs += judge_group(group, hits, truth, cell.precision)
        rays, undecided = (sum(rung["rays"] for rung in rungs), sum(rung["undecided"] for rung in rungs))
        reason = undecided_hits(rays - undecided, undecided, choice.undecided, "rays")
        return Outcome(compile_ms, reason, rungs=None if reason else rungs)

    def with_programs(self, programs: Programs) -> Casting:
        if len(programs.checks) != len(self.checks):
            raise FirsthitError("the family has another number of surfaces there")
        return FamilyCasting(self.asked, programs.checks)


class Family(Kind):
    """Make castings of families."""

    is_timed = False
    listed = "families"

    def surfaces(self, cell: Cell) -> Sequence[Surface]:
        assert cell.family
        return [group.surface for group in groups.groups(cell.family)]

    def stage_refusal(self, asked: Asked) -> str | None:
        return None if asked.method_kind.hard_entries else super().stage_refusal(asked)

    def unable(self, asked: Asked) -> str | None:
        return None if asked.cell.prepass == "none" else NO_PREPASS

    def facts(self, cell: Cell) -> KindFacts:
        return {"camera": None, "proxy": None, "normal": None, "pixel_tolerance": None}

    def question(self, cell: Cell, config: Config, timed: bool) -> dict[str, Any]:
        assert cell.family
        return {"family": groups.identity(cell.family)}

    def casting(self, asked: Asked) -> Casting:
        entries = asked.method_kind.hard_entries
        checks = tuple(asked.program(surface, entry) for surface in self.surfaces(asked.cell) for entry in entries)
        return FamilyCasting(asked, checks)
