"""Hold a config against another git revision, without a baseline's file.

Both revisions' programs run on this machine and on the same rays, and their figures are judged row by row. Then those
that are timed race each other (harness.gate.race).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from harness import console
from harness.accuracy.check import too_wrong
from harness.contract import CellStatus, FirsthitError, digest, plural
from harness.devices.discovery import discover_devices
from harness.devices.executor import LocalExecutor
from harness.experiment import plan, reading
from harness.experiment.kinds.model import RacedCasting
from harness.experiment.plan import Planned
from harness.experiment.size import check_size
from harness.gate import race, revision
from harness.gate.about import Place
from harness.gate.baseline import Entry
from harness.gate.checked import Checked
from harness.gate.chosen import Only
from harness.gate.entries import slot_of
from harness.gate.judge import Change, Judged, Verdict, judge_row, tolerances_of
from harness.gate.outputs import INDENT, wrapped
from harness.gate.revision import Former, Formers, Revision
from harness.plugins import find_methods
from harness.results.figures import SPEED, figures
from harness.results.lock import Lock
from harness.results.store import Row, Store
from harness.running import batch
from harness.running.environment import describe, probed
from harness.running.fastest import settled
from harness.running.run import Watcher

ASKED = ("surface", "view", "sampling", "family", "precision", "raster")  # parts of an identity that a method is asked
METHODS_OWN = ("meshes", "mesher", "variant")  # what methods decide of these
SAME = "the same program"
KEPT = "against"  # the folder of the other revision's rows, below that of a gate's
SKIPPED = "skipped at both revisions"


@dataclass(frozen=True, eq=False)
class Other:
    """Hold the other revision, and what it makes of the config's cells."""

    revision: Revision
    formers: Formers

    @property
    def slots(self) -> frozenset[str]:
        """Return the slots of its cells, without their devices."""
        return frozenset(slot.rpartition(" ")[0] for slot in self.formers.cells)


@dataclass(frozen=True, eq=False)
class Compared:
    """Hold the verdicts on all cells.

    name: the revision's, as it was given
    unraced: why cells whose program changed are never raced, counted
    before: the other revision's rows by the cells' slots, device included; their arrays lie below `folder`
    """

    name: str
    judged: list[Judged]
    unraced: Counter[str]
    before: Mapping[str, Row]
    folder: Path

    def stored(self) -> dict[Place, Row]:
        """Read the other revision's rows, which name the files of their arrays, by the cells' slots and devices."""
        store = Store(self.folder)
        read = ((slot, store.read(row["key"])) for slot, row in self.before.items())
        return {(slot.rpartition(" ")[0], slot.rpartition(" ")[2]): row for slot, row in read if row}

    def told(self, width: int | None = None) -> str:
        """Tell how much of the accuracy is the same, and every ratio that was measured, those that pass included.

        The ratios are a table; where that is wider than `width` columns, each has lines of its own. None: any width.
        """
        accuracy = [j for j in self.judged if j.slot.endswith(": accuracy")]
        compared = [j for j in accuracy if j.changes and j.reason != SAME]
        equal = sum(all(change.before == change.now for change in j.changes) for j in compared)
        counts = {
            SAME: sum(j.reason == SAME for j in accuracy),
            "the same to the last digit": equal,
            "with other figures": len(compared) - equal,
            "skipped at both revisions": sum(j.reason.startswith(SKIPPED) for j in accuracy),
        }
        counts["not compared"] = len(accuracy) - sum(counts.values())
        said = ", ".join(f"{count} {what}" for what, count in counts.items() if count) or "no cells"
        lines = [f"accuracy against {self.name}: {said}"]
        if raced := [_ratio_line(j) for j in self.judged if j.changes and j.changes[0].figure == SPEED.name]:
            lines += [f"speed against {self.name}:", _ratios(raced, width)]
        lines += [
            f"not raced: {plural(count, 'cell')} whose program changed; {why}" for why, count in self.unraced.items()
        ]
        return "\n".join(lines)


@dataclass(eq=False)
class _Pair:
    """Hold a cell at both revisions.

    told: the verdict, as soon as there is one
    then: the cell with the other revision's programs, where these must be run; its row is `before`
    """

    planned: Planned
    now: Row
    former: Former | None
    told: Judged | None = None
    then: Planned | None = None
    before: Row | None = None
    base: Judged = field(init=False)

    def __post_init__(self) -> None:
        cell = self.planned.cell
        self.base = Judged(f"{slot_of(self.planned)}: accuracy", cell.device, cell.variant.method, Verdict.INCOMPARABLE)

    def tell(self, verdict: Verdict, reason: str, *changes: Change) -> None:
        self.told = replace(self.base, verdict=verdict, reason=reason, changes=changes)


def at(
    name: str, config: Path, plugins: Path | None, devices: Sequence[str], watcher: Watcher, yes: bool = False
) -> Other:
    """Find the revision `name`, and let its code make the programs of a config. No cell is run.

    `plugins`, `devices` and `yes` are as for harness.gate.checked.prepare. Raises FirsthitError where there is
    no such revision or its code cannot plan the config, and where the config cannot be planned now.
    """
    there = revision.found(name, plugins)
    catalog = find_methods(plugins).with_stand_ins()
    experiment = reading.load_one(config, catalog)
    experiment = experiment.on(devices)
    check_size(experiment, catalog, yes=yes)
    found = discover_devices(experiment.wanted_devices())
    (experiment,) = settled([experiment], found, watcher).parts
    check_size(experiment, catalog, found, yes)
    cells = plan.grid(experiment, catalog, found)
    here = dict.fromkeys(info.name for _, info in cells if info)
    if not here:
        raise FirsthitError(f"--against: {config} has no cell on a device that is here", exit_code=3)
    with watcher.doing(f"making the programs of {name}"):
        own = {str(variant): names for variant, names in experiment.own_devices.items()}
        return Other(there, revision.programs_at(there, config, experiment.config.devices if own else list(here), own))


def compare(checked: Checked, other: Other, only: Only, watcher: Watcher, lock: Lock, force: bool = False) -> Compared:
    """Judge every cell of `checked` against the other revision: its figures to their tolerances, and its speed.

    Cells that only the other revision has are missing, if `only` chooses them.
    Times are by the clock that the device's probes support. The other revision's rows are kept below the folder of
    `checked`, whose `lock` is taken to make them, in `against`; with `force` they are made again. `watcher` is told of
    each cell. A failure of one cell is its verdict, and raises nothing; raises FirsthitError where the lock is
    another's, or a row cannot be stored.
    """
    pairs = [_pair(p, checked.rows[p.key], other) for p in checked.planned]
    name, budget = other.revision.name, checked.experiment.config.budget
    executor = LocalExecutor(budget.timeout, budget.memory)
    try:
        _run(pairs, checked, other.revision, executor, watcher, lock, force)
        _judge(pairs, checked)
        speeds = [*_race(pairs, checked, name, executor, watcher)]
    finally:
        executor.close()
    judged = [pair.told for pair in pairs if pair.told] + speeds + _missing(checked, other, only)
    changed = (p.planned.casting for p in pairs if p.then and p.planned.kind.is_timed)
    unraced = Counter(casting.not_raced for casting in changed if casting and casting.not_raced)
    before = {pair.planned.cell.slot: pair.before for pair in pairs if pair.then and pair.before}
    return Compared(name, judged, unraced, before, checked.folder / KEPT)


def differing(now: Mapping[str, Any], then: Mapping[str, Any]) -> list[str]:
    """List the parts of two cells' identities that ask something else of the method: `view`, `surface`.

    Only what both revisions say is compared.
    """
    return [name for name in ASKED if name in now and name in then and _differ(now[name], then[name])]


def _differ(a: Any, b: Any) -> bool:
    if isinstance(a, Mapping) and isinstance(b, Mapping):
        return any(_differ(a[key], b[key]) for key in a.keys() & b.keys() - set(METHODS_OWN))
    if isinstance(a, list | tuple) and isinstance(b, list | tuple):
        return len(a) != len(b) or any(map(_differ, a, b))
    return bool(a != b)


def _pair(planned: Planned, row: Row, other: Other) -> _Pair:
    """Put a cell beside the other revision's, and give the verdict where nothing has to be run for it."""
    former = other.formers.cells.get(planned.cell.slot)
    pair, casting = _Pair(planned, row, former), planned.casting
    if planned.device is None:
        pair.tell(Verdict.INCOMPARABLE, str(planned.skip))
    elif planned.failure is not None:
        pair.tell(Verdict.INCOMPARABLE, planned.failure)
    elif why_not := other.formers.failure(planned.cell.slot, planned.cell.variant.method):
        pair.tell(Verdict.INCOMPARABLE, f"at the other revision {why_not}")
    elif former is None:
        names = (planned.cell.variant.method, *planned.cell.comparison.split())
        why = [other.formers.left_out[name] for name in names if name in other.formers.left_out]
        reason = ": ".join(["the other revision has no such cell", *why])
        done = row["status"] in (CellStatus.OK, CellStatus.SKIPPED)
        pair.tell(*((Verdict.NEW, reason) if done else (Verdict.INCOMPARABLE, f"{row['reason']}; {reason}")))
    elif parts := differing(planned.identity, former.identity):
        pair.tell(Verdict.INCOMPARABLE, f"the other revision has another {' and '.join(parts)} under this name")
    elif casting is None and former.skip is None:
        change = Change("status", "cast", CellStatus.SKIPPED, "cast", Verdict.REGRESSED)
        pair.tell(Verdict.REGRESSED, f"{planned.skip}; the other revision casts it", change)
    elif casting is None:
        pair.tell(Verdict.PASS, f"{SKIPPED}: {planned.skip}")
    elif former.skip is not None:
        pair.before = row | {"status": CellStatus.SKIPPED, "reason": former.skip, "accuracy": None, "rungs": None}
    elif former.programs.hash == casting.programs.hash:
        pair.before = row
    elif not former.programs.launched_as(casting.programs):
        pair.tell(Verdict.INCOMPARABLE, "the other revision's programs are launched in another way")
    else:
        try:
            pair.then = _former_cell(planned, former)
        except FirsthitError as error:
            pair.tell(Verdict.INCOMPARABLE, f"the other revision's programs cannot be run: {error}")
    return pair


def _former_cell(planned: Planned, former: Former) -> Planned:
    """Return the cell with the other revision's programs, and a key of its own.

    Raises FirsthitError where these lack what belongs to them.
    """
    assert planned.casting
    programs, cell = former.programs, planned.cell
    casting = planned.casting.with_programs(programs)
    identity = planned.identity | {
        "program": {},
        "program order": [p.hash for p in (*programs.checks, *programs.others)],
        "parameters": dict(programs.parameters),
        "method": {},
        "another revision's": programs.hash,
    }
    variant = replace(cell.variant, parameters=tuple(sorted(programs.parameters.items())))
    key = digest(cell.slot, identity)
    return replace(planned, cell=replace(cell, variant=variant), key=key, identity=identity, casting=casting)


def _run(
    pairs: list[_Pair],
    checked: Checked,
    there: Revision,
    executor: LocalExecutor,
    watcher: Watcher,
    lock: Lock,
    force: bool,
) -> None:
    """Check the cells with the other revision's programs, and keep their rows; certified answers are shared."""
    store = Store(checked.folder / KEPT)
    store.truth = checked.folder / "truth"
    planned = [pair.then for pair in pairs if pair.then]
    environment = describe() | {"commit": there.commit[:12], "dirty": False}
    stated = planned, checked.experiment.config, checked.catalog, store, executor, watcher, lock
    rows, _ = batch.rows_of(*stated, force, environment)
    for pair in pairs:
        if pair.then:
            pair.before = rows[pair.then.key]


def _judge(pairs: list[_Pair], checked: Checked) -> None:
    """Judge the figures of the cells that have a row at both revisions, to the last digit."""
    tolerances = tolerances_of(checked.experiment.config.gate.figures)
    for pair in pairs:
        if pair.told or pair.before is None or pair.former is None:
            continue
        method = checked.catalog.get(pair.base.method).method
        theirs = method.claims if pair.former.claims is None else pair.former.claims
        try:
            now, then = (
                _entry(row, claims if method.answers else None)
                for row, claims in ((pair.now, method.claims), (pair.before, theirs))
            )
        except FirsthitError as error:  # a figure that is no number
            pair.tell(Verdict.INCOMPARABLE, str(error))
            continue
        base = pair.base
        told = judge_row(base.slot, base.device, base.method, now, then, tolerances)
        if told.verdict is Verdict.INCOMPARABLE:
            told = replace(told, reason=f"{now['status']} at both revisions: {now.get('reason', '')}")
        pair.told = replace(told, reason=told.reason or ("" if pair.then else SAME))


def _entry(row: Row, claims: Any) -> Entry:
    """Return status, reason and gated figures of a row; `claims` are its method's, None where it answers nothing."""
    entry: Entry = {"status": row["status"], "scene": "", "reason": row["reason"] or ""}
    return entry if claims is None else entry | figures(row, claims)


def _missing(checked: Checked, other: Other, only: Only) -> list[Judged]:
    """Return a verdict on each cell that only the other revision has, and that `only` chooses."""
    here, wanted = {p.cell.slot for p in checked.planned}, only.slots(map(slot_of, checked.planned))
    devices = {p.cell.device for p in checked.planned}
    gone = ((slot, former) for slot, former in other.formers.cells.items() if slot not in here)
    judged = []
    for slot, former in gone:
        device = slot.rpartition(" ")[2]
        name = slot.removesuffix(f" {device}")
        if device in devices and name in wanted and not former.failure:
            reason = "the other revision has it, and this one does not"
            judged.append(Judged(f"{name}: accuracy", device, former.method, Verdict.MISSING, reason))
    return judged


def _race(
    pairs: list[_Pair], checked: Checked, name: str, executor: LocalExecutor, watcher: Watcher
) -> Iterator[Judged]:
    """Judge the speed of each cell that is timed and can be raced."""
    experiment, by_slot = checked.experiment, {pair.planned.cell.slot: pair for pair in pairs}
    tolerance = race.tolerance_of(experiment)
    if tolerance is None:
        return
    infos = {p.cell.device: p.device for p in checked.planned if p.device}
    timed = [p for p in plan.plan(experiment, checked.catalog, list(infos.values())) if p.skip is None and p.timed]
    raced = [p for p in timed if isinstance(p.casting, RacedCasting) and p.cell.slot in by_slot]
    told = {p.cell.slot: _unraced(p, by_slot[p.cell.slot], experiment.config.accuracy.max_wrong_share) for p in raced}
    yield from (judged for judged in told.values() if judged)
    todo = [p for p in raced if told[p.cell.slot] is None]
    for device in dict.fromkeys(p.cell.device for p in todo):
        infos[device] = probed(executor, infos[device], checked.folder / "probes")[0]
    for i, p in enumerate(todo, 1):
        former = by_slot[p.cell.slot].former
        assert former and isinstance(p.casting, RacedCasting)
        sides = {"now": p.casting, "then": p.casting.with_programs(former.programs)}
        with watcher.doing(f"[{i}/{len(todo)}] racing {name}: {p.cell.slot}"):
            yield race.race(_speed(p), replace(p, device=infos[p.cell.device]), sides, experiment, tolerance, executor)


def _unraced(planned: Planned, pair: _Pair, most_wrong: float) -> Judged | None:
    """Judge the speed of a cell where there is no race; None where there is one."""
    base, former = _speed(planned), pair.former
    if pair.told and pair.told.verdict is Verdict.INCOMPARABLE:
        return replace(base, verdict=Verdict.INCOMPARABLE, reason=pair.told.reason)
    if former is None or former.programs.timed is None:
        reason = f"the other revision skips it: {former.skip}" if former else "the other revision has no such cell"
        return replace(base, verdict=Verdict.NEW, reason=reason)
    assert planned.timed and pair.before
    assert planned.casting
    if former.programs.frame_hash == planned.casting.programs.frame_hash:
        return replace(base, reason=SAME)
    if wrong := _unfit(pair.now, most_wrong):
        return replace(base, verdict=Verdict.INCOMPARABLE, reason=f"{wrong} (now)")
    if wrong := _unfit(pair.before, most_wrong):
        return replace(base, verdict=Verdict.NEW, reason=f"{wrong} (at the other revision)")
    return None


def _unfit(row: Row, most_wrong: float) -> str | None:
    """Say why a row's program must not be timed; None where it answers as the oracle does."""
    if row["status"] != CellStatus.OK:
        return f"{row['status']}: {row['reason']}"
    return too_wrong(row["accuracy"], most_wrong) if row["accuracy"] else None


def _speed(planned: Planned) -> Judged:
    """Return the verdict on a cell's speed as it is before there is anything to say against it."""
    return Judged(f"{slot_of(planned)}: speed", planned.cell.device, planned.cell.variant.method, Verdict.PASS)


def _ratios(raced: list[tuple[str, str, str, str]], width: int | None) -> str:
    """Write the ratios as a table, or below each cell where that is too wide."""
    text = console.table(("ratio", "interval", "cell", "device"), raced)
    if width is None or all(len(line) <= width for line in text.splitlines()):
        return text
    return "\n".join(
        line
        for ratio, interval, cell, device in raced
        for line in (*wrapped(f"{cell} on {device}", width, ""), *wrapped(f"{ratio}  {interval}", width, INDENT))
    )


def _ratio_line(judged: Judged) -> tuple[str, str, str, str]:
    """Return what a table says of a cell that was raced."""
    ratio, interval = judged.changes[0].now, judged.reason.removeprefix(race.TOLD)
    return f"{ratio:.3f}", interval, judged.slot.removesuffix(": speed"), judged.device
