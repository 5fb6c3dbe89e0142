"""Define what a run folder holds: its plan, its finished cells as rows, and which files could not be read."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pandas as pd

from harness.contract import BASELINE
from reports.reading.columns import Columns


@dataclass(frozen=True)
class Facts:
    """Hold what a family of hard rays is: rays that get harder as one parameter grows or shrinks."""

    title: str
    parameter: str  # what the number means, with its unit
    harder: str  # "smaller" or "larger"
    why: str
    source: str


@dataclass(frozen=True)
class Plan:
    """Hold plan.json: what the run set out to do, where, and by which command."""

    name: str
    title: str
    config: str
    config_text: str
    command: str
    created: str  # ISO 8601
    environment: Mapping[str, Any]
    devices: tuple[Mapping[str, Any], ...]
    slots: Mapping[str, str]  # key → slot of every cell, in the plan's order; families after views
    facts: Mapping[str, Facts]  # by family, in the plan's order
    studies: Mapping[str, str]  # name → key
    methods: Mapping[str, Mapping[str, Any]]  # what the methods say of themselves, by name
    include: tuple[str, ...]  # run folders beside this one that its report collects
    baseline: str = BASELINE  # the method or variant that speed-ups are over
    focus: str = ""  # the method or variant that the report is about; "" for none
    shard: tuple[int, int] | None = None  # which of how many shards of the config; None for the whole
    told: Mapping[str, str] = field(default_factory=dict)  # of a merged run: key → device, where the row names another
    merged: tuple[Mapping[str, Any], ...] = ()  # the runs that went into it (plan_file.Merged)

    @property
    def part(self) -> str:
        """Say which shard of its config a run is, ", shard 3 of 16", or "" of a whole one."""
        return f", shard {self.shard[0]} of {self.shard[1]}" if self.shard else ""

    @property
    def commits(self) -> tuple[str, ...]:
        """Write the commit of each run that went into this one, or its own, each once, and whether it was changed."""
        told = [(one.get("commit"), one.get("dirty")) for one in self.merged or (self.environment,)]
        each = (f"{commit}{' with uncommitted changes' if dirty else ''}" for commit, dirty in told if commit)
        return tuple(dict.fromkeys(each))

    @property
    def peaks(self) -> dict[str, float]:
        """Return the rate of float32 multiply-adds that each device's probe measured, in 1e9 operations per second."""
        probed = ((device.get("name"), device.get("probes")) for device in self.devices)
        rates = ((name, probes.get("peak_gflops")) for name, probes in probed if isinstance(probes, Mapping))
        return {str(name): float(rate) for name, rate in rates if isinstance(rate, int | float) and rate > 0.0}


@dataclass(frozen=True)
class Unreadable:
    """Name a file of the run that could not be used, and say why."""

    file: str  # below the run folder
    problem: str


@dataclass(frozen=True, eq=False)
class Run:
    """Hold what the plan's finished cells say, in the plan's order."""

    folder: Path
    plan: Plan
    frame: pd.DataFrame  # SCHEMA, or what was asked for: one row for each cell that is a view
    families: pd.DataFrame  # FAMILY: one row for each cell that is a family of hard rays
    rungs: pd.DataFrame  # RUNG: one row for each rung of the latter
    unreadable: tuple[Unreadable, ...]
    not_run: tuple[str, ...]  # slots
    studies: Mapping[str, list[dict[str, Any]]]  # rows by study
    folders: Mapping[str, Path]  # by the name of the run; several where this one collects others
    columns: Columns  # of the rows of `frame`, those too that it lacks
