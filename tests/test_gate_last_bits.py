"""Answers of real rows, changed in their last bits a thousand times, raise no alarm; planted changes all do."""

import dataclasses
import functools
import math

import numpy as np
import pytest

from harness.accuracy.judge import Deviations, judge, summarize
from harness.accuracy.rungs import judge_group
from harness.contract import Hits, RayStatus
from harness.devices.executor import LocalExecutor
from harness.devices.messages import ListedCheck
from harness.experiment import plan, reading
from harness.experiment.kinds.comparing import last_bit
from harness.gate import judge as gate
from harness.gate.baseline import LAST_BIT, Baseline, device_key
from harness.gate.comparable import Rule
from harness.hardcases import groups
from harness.oracle import cached_first_hits
from harness.plugins import find_methods
from harness.results.figures import GATED, figures
from harness.scenes.camera import scene_radius

from .conftest import usable_devices

CHANGES = 1000
AT_ONCE = 3  # cells that are changed together, of which one may hide another
SIZE = 32
CONFIG = """title = "Last bits"
surfaces = ["torus", "kummer"]
families = ["grazing", "far_origin"]
precisions = ["float32", "float64"]
devices = ["{device}"]
method = [{{ name = "newton" }}, {{ name = "sturm" }}, {{ name = "interval_march" }}]
[accuracy]
size = {size}
"""
MOVED = 0.5  # share of the rays whose t is the float beside it
SITTING = 0.01  # share of the rays that sit at a threshold, and so spend one evaluation more or less
MARGIN = 1e-3
HERE = {"name": "a", "processor": "p", "arithmetic": {of: {"sums": "1"} for of in ("float32", "float64", "host")}}
THERE = HERE | {"name": "b", "arithmetic": HERE["arithmetic"] | {"host": {"sums": "2"}}}
TOLERANCES = gate.tolerances_of({})


@dataclasses.dataclass
class Answered:
    """Answers of one cell to rays whose truth is known: a view's, or those of a family's groups."""

    slot: str
    cell: object
    parts: list  # of (group or None, hits, truth)

    def entry(self, changed=lambda hits: hits):
        """The entry of a baseline that these answers give once they are changed."""
        row = {"slot": self.slot, "accuracy": None, "rungs": None}
        if self.cell.family:
            row["rungs"] = [
                rung
                for group, hits, truth in self.parts
                for rung in judge_group(group, changed(hits), truth, self.cell.precision)
            ]
        else:
            row["accuracy"] = self._accuracy(changed)
        found = {name: value for name, value in figures(row, ()).items() if name in GATED}
        return {"status": "ok", "scene": "s", LAST_BIT: last_bit(self.cell), **found}

    def _accuracy(self, changed):
        ((_, hits, truth),) = self.parts
        hits, surface = changed(hits), self.cell.surface
        verdicts = judge(hits, truth, scene_radius(surface), MARGIN, self.cell.precision)
        none = Deviations(*np.full((2, len(hits.t)), np.nan))
        stated = {"precision": self.cell.precision, "footprint": 0.01, "grazing_margin": MARGIN}
        return summarize(surface, hits, truth, verdicts, none, **stated)


@pytest.fixture(scope="module")
def answered(tmp_path_factory):
    """Real answers of several methods at surfaces and families, in both precisions."""
    folder = tmp_path_factory.mktemp("bits")
    info = next((info for info in usable_devices() if info.name.startswith("opencl:")), None)
    if info is None:
        pytest.skip("no OpenCL device")
    (folder / "bits.toml").write_text(CONFIG.format(device=info.name, size=SIZE))
    catalog = find_methods()
    planned = plan.plan(reading.load(folder / "bits.toml", catalog), catalog, [info], timed=False)
    executor = LocalExecutor(120.0)
    try:
        return [_answered(p, executor, folder) for p in planned if p.casting]
    finally:
        executor.close()


def _answered(planned, executor, folder):
    cell, parts = planned.cell, []
    if cell.family:
        for group, program in zip(groups.groups(cell.family), planned.checks, strict=True):
            hits = executor.check(cell.device, ListedCheck(program, group.rays)).answer
            parts.append((group, hits, cached_first_hits(group.surface, group.rays, folder)))
    else:
        cast = planned.casting.cast(executor, SIZE)
        parts.append((None, cast.hits, cached_first_hits(cell.surface, cast.rays, folder)))
    return Answered(cell.slot, cell, parts)


def _in_last_bits(cell, random):
    """A function that changes answers as other last bits may: t by one float, as the kernel counts it."""
    kind = np.float32 if cell.precision == "float32" else np.float64

    def changed(hits):
        float_beside = float(np.spacing(kind(cell.surface.domain.radius)))
        way = np.where(random.random(len(hits.t)) < MOVED, random.choice([-1.0, 1.0], len(hits.t)), 0.0)
        step = np.where(random.random(len(hits.t)) < SITTING, random.choice([-1, 1], len(hits.t)), 0)
        evaluations = np.where(hits.evaluations > 1, hits.evaluations + step, hits.evaluations)
        return Hits(hits.t + way * float_beside, hits.status, evaluations.astype(np.int32))

    return changed


def _judged(now, before, rule):
    facts = HERE if rule is Rule.EXACT else THERE
    one, other = (
        Baseline("t", {device_key(f): f}, {device_key(f): rows}) for f, rows in ((facts, now), (HERE, before))
    )
    return gate.judge(one, other, dict.fromkeys(now, "m"), TOLERANCES)


def test_a_thousand_changes_of_last_bits_raise_no_alarm(answered):
    before = {one.slot: one.entry() for one in answered}
    alarms = []
    for seed in range(-(-CHANGES // AT_ONCE)):
        random = np.random.default_rng(seed)
        some = random.choice(len(answered), AT_ONCE, replace=False)
        now = {answered[i].slot: answered[i].entry(_in_last_bits(answered[i].cell, random)) for i in some}
        blessed = {slot: before[slot] for slot in now}
        judged = _judged(now, blessed, Rule.LAST_BITS)
        assert {j.rule for j in judged} == {"last bits"}
        alarms += [(seed, j.slot, j.worst) for j in judged if j.verdict == "regressed"]
    assert not alarms, alarms[:5]


def _beyond(figure, allowed, random):
    """The figure's next value that is worse than allowed, or one that is worse still."""
    way = 1 if GATED[figure].better == "lower" else -1
    if isinstance(allowed, int) or figure not in ("error_max", "error_p99", "worst_ratio", "evaluations_mean"):
        return (math.floor(allowed) if way > 0 else math.ceil(allowed)) + way * int(random.integers(1, 5))
    return float(max(allowed, 1e-300) * random.choice([1.0 + 1e-9, 1.001, 2.0]))


@pytest.mark.parametrize("rule", list(Rule))
def test_a_thousand_planted_changes_of_figures_are_all_found(answered, rule):
    before = {one.slot: one.entry() for one in answered}
    missed = []
    for seed in range(CHANGES // 2):
        random = np.random.default_rng(seed)
        slots = random.choice(list(before), AT_ONCE, replace=False)
        now = {slot: dict(before[slot]) for slot in slots}
        slot = str(slots[0])
        bit, family = now[slot][LAST_BIT], "right" in now[slot]
        bounds = {name: TOLERANCES[name].under(rule, bit, family) for name in now[slot] if name in TOLERANCES}
        limits = {name: bound.allowed(before[slot][name]) for name, bound in bounds.items()}
        name = str(random.choice([name for name, allowed in limits.items() if math.isfinite(allowed)]))
        allowed = limits[name]
        now[slot][name] = _beyond(name, allowed, random)
        judged = _judged(now, {one: before[one] for one in now}, rule)
        regressed = {(j.slot, j.worst.figure) for j in judged if j.verdict == "regressed"}
        if regressed != {(slot, name)}:
            missed.append((seed, slot, name, regressed))
    assert not missed, missed[:5]


def _once_more(hits, **_):
    return dataclasses.replace(hits, evaluations=hits.evaluations + (hits.evaluations > 0))


def _missing(hits, random, family):
    """Lose 5 of 100 hits of a view, and all of a family, many of whose rays other last bits decide."""
    lost = (hits.status == RayStatus.HIT) & (random.random(len(hits.t)) < (1.0 if family else 0.05))
    status = np.where(lost, RayStatus.MISS, hits.status).astype(np.uint8)
    return Hits(np.where(lost, np.nan, hits.t), status, hits.evaluations)


def _far_off(hits, **_):
    return dataclasses.replace(hits, t=hits.t * (1.0 + 3e-4))


@pytest.mark.parametrize("planted", [_once_more, _missing, _far_off])
def test_planted_changes_of_answers_are_found_under_last_bits(answered, planted):
    for seed, one in enumerate(answered):
        if one.cell.family and planted is _once_more:
            continue  # evaluations are gated in views alone
        random = np.random.default_rng(seed)
        change = functools.partial(planted, random=random, family=bool(one.cell.family))
        before, now = one.entry(), one.entry(change)
        if before.get("right", 1) == 0 or before.get("evaluations_mean", 0.0) > 200.0:
            continue  # it has nothing to lose
        (judged,) = _judged({one.slot: now}, {one.slot: before}, Rule.LAST_BITS)
        assert judged.verdict == "regressed", (one.slot, before, now)
