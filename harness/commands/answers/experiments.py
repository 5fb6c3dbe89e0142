"""State what `firsthit plan` and `firsthit why` answer with --json."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

from harness.commands.answers.listed import Point
from harness.contract import Normal, Origin, Precision, Prepass, Proxy, Stage
from harness.experiment.identity import Difference
from harness.experiment.identity import changes as differences
from harness.experiment.plan import Planned
from harness.results.store import Row


@dataclass(frozen=True)
class ViewFacts:
    """Say from where a surface is seen.

    name: of the view
    azimuth, elevation: direction from the target to the eye, degrees
    fov: the full vertical angle of view, degrees
    distance: from the eye to the target, scene units; null where the domain just fits the field of view
    target: the point in the middle of the image; null for the domain's centre
    set: views of one set are compared with each other; null for no set
    """

    name: str
    azimuth: float
    elevation: float
    fov: float
    distance: float | None
    target: Point | None
    set: str | None


@dataclass(frozen=True)
class CellFacts:
    """Say what a cell of an experiment is, and whether it will run.

    key: names its result, `runs/NAME/cells/KEY.json`
    slot: its place in the grid, for people
    method: the method's name
    variant: the method with the knobs that are not at their defaults, as tables print it
    knobs: the value of every knob
    surface: its name; of a scene, of what stands for its surfaces
    scene: the scene's name; null where one surface is drawn
    family: the family of hard rays that replaces surface and view; null for a view
    view: from where it is seen
    size: pixels per side; 0 of a family
    samples_per_pixel: rays through a pixel
    precision: of the numbers that the kernel computes with
    stage: how rays are cast
    prepass: what narrows the rays before
    origin: where the method sees its rays begin
    proxy: of stage raster: the geometry whose fragments cast rays
    tolerance: of stage raster: pixels that the method's own tolerance may grow to
    normal: of stage raster: what hits are shaded by
    device: where it runs
    state: done, where a result is kept; skip, where it cannot run; else to run
    status: of the result that is kept: ok, skipped, failed, timeout or crashed; null without one
    reason: why it is skipped, did not finish or, where its method cannot be asked, will fail; null for others
    seconds: how long it will take, by what its slot took before, else by what rows of its method and device took, else
        by the budget and the number of its programs; 0 where it does not run
    """

    key: str
    slot: str
    method: str
    variant: str
    knobs: Mapping[str, float]
    surface: str
    scene: str | None
    family: str | None
    view: ViewFacts
    size: int
    samples_per_pixel: int
    precision: Precision
    stage: Stage
    prepass: Prepass
    origin: Origin
    proxy: Proxy
    tolerance: float
    normal: Normal
    device: str
    state: Literal["done", "skip", "to run"]
    status: str | None
    reason: str | None
    seconds: float


def cell(planned: Planned, row: Row | None, seconds: float) -> CellFacts:
    """Return what is said of a planned cell, of its row where one is kept, and of the seconds that it will take."""
    state: Literal["done", "skip", "to run"] = "done" if row else "skip" if planned.skip else "to run"
    own = planned.cell
    return CellFacts(
        key=planned.key,
        slot=own.slot,
        method=own.variant.method,
        variant=str(own.variant),
        knobs=dict(own.variant.parameters),
        surface=own.surface.name,
        scene=own.scene.name if own.scene else None,
        family=own.family,
        view=ViewFacts(**vars(own.view)),
        size=own.size,
        samples_per_pixel=own.samples_per_pixel,
        precision=own.precision,
        stage=own.stage,
        prepass=own.prepass,
        origin=own.origin,
        proxy=own.proxy,
        tolerance=own.tolerance,
        normal=own.normal,
        device=own.device,
        state=state,
        status=row["status"] if row else None,
        reason=(row["reason"] or None) if row else planned.skip or planned.failure,
        seconds=seconds,
    )


@dataclass(frozen=True)
class PlanFacts:
    """Say which cells a config has.

    config: its path
    title: of the config
    folder: where its results go
    cells: in the order in which they run
    to_run: how many of them have no result yet
    seconds: how long those will take, estimated
    """

    config: str
    title: str
    folder: str
    cells: Sequence[CellFacts]
    to_run: int
    seconds: float


@dataclass(frozen=True)
class Plan:
    """Say what `firsthit run` would do.

    parts: the config, or those that it includes
    """

    parts: Sequence[PlanFacts]


@dataclass(frozen=True)
class ChangeFacts:
    """Say what differs between two results of a cell, in what decides a result.

    part: what differs, from the whole to the part: ["device", "driver"], ["program", "methods/newton/kernel.glsl"]
    change: changed, new or gone
    before, now: its values; null where it is not there, and where it is known by a hash only
    """

    part: Sequence[str]
    change: Literal["changed", "new", "gone"]
    before: Any
    now: Any


@dataclass(frozen=True)
class OtherResult:
    """Name another result of the same cell.

    key: its own
    started: when its run was started (ISO 8601)
    changes: what differs from the older to the newer of the two results
    """

    key: str
    started: str
    changes: Sequence[ChangeFacts]


@dataclass(frozen=True)
class Why:
    """Say what set a cell apart from its last result and its next, and what would make it run again.

    key: of the cell that was asked about
    slot: its place in the grid, for people
    started: when its run was started (ISO 8601)
    status: ok, skipped, failed, timeout or crashed
    reason: why it was skipped or did not finish; null for others
    before: the result before this one; null where this is the first
    after: the result after this one; null where this is the newest
    since: of the newest result: what changed since then in the harness, the method, the packages and this machine, each
        of which makes the cell run again; null where there is a newer result
    """

    key: str
    slot: str
    started: str
    status: str
    reason: str | None
    before: OtherResult | None
    after: OtherResult | None
    since: Sequence[ChangeFacts] | None


def result(other: Row, older: Row, newer: Row) -> OtherResult:
    """Return what is said of another result of a cell; `older` and `newer` are the two that differ."""
    changes = _changes(differences(older["identity"], newer["identity"]))
    return OtherResult(other["key"], other["environment"]["started"], changes)


def why(row: Row, before: OtherResult | None, after: OtherResult | None, since: Sequence[Difference] | None) -> Why:
    """Return what is said of a cell's result; `since` is what changed after it, None where there is a newer one."""
    return Why(
        key=row["key"],
        slot=row["slot"],
        started=row["environment"]["started"],
        status=row["status"],
        reason=row["reason"] or None,
        before=before,
        after=after,
        since=None if since is None else _changes(since),
    )


def _changes(found: Sequence[Difference]) -> list[ChangeFacts]:
    return [ChangeFacts(one.part, one.change, one.before, one.now) for one in found]
