"""Races of two revisions' programs, over made-up clocks: when they end, by which clock they count, what they decide."""

from collections import Counter
from pathlib import Path
from types import SimpleNamespace

import pytest

from harness.contract import DeviceInfo
from harness.devices.interface import Timing
from harness.experiment.config import BudgetChoice, GateChoice, ToleranceChoice
from harness.gate import against, race
from harness.gate.judge import Change, Judged, Tolerance, Verdict

BASE = Judged("m a: speed", "opencl:a", "m", Verdict.PASS)
GPU = DeviceInfo("opencl:a", "A", "1", "c", 4, False, "device", (), None, resident=1024)
CPU = DeviceInfo("opencl:a", "A", "1", "c", 4, False, "device", (), None)
TOLERANCE = Tolerance("lower", 0.0, 0.05)


class Frames:
    """Stands in for an executor: a frame of `now` takes what `times` says over the rounds, one of `then` takes 1 ms."""

    def __init__(self, times, clock="processor_ms"):
        self.times, self.clock, self.rounds, self.released = times, clock, 0, []

    def warm(self, *_):
        return SimpleNamespace(batch=1)

    def sample(self, _device, key, *_):
        if key.endswith("then"):
            return Timing(**{"wall_ms": 7.0, "device_ms": 7.0, "processor_ms": 7.0, self.clock: 1.0})
        self.rounds += 1
        told = self.times[(self.rounds - 1) % len(self.times)]
        return Timing(**{"wall_ms": 7.0, "device_ms": 7.0, "processor_ms": 7.0, self.clock: told})

    def release(self, _device, key):
        self.released.append(key)


def raced(frames, device=CPU, repetitions=20):
    planned = SimpleNamespace(device=device, key="k", cell=SimpleNamespace(device=device.name))
    sides = {side: SimpleNamespace(frame=lambda: "a frame") for side in ("now", "then")}
    budget = BudgetChoice(seconds=1e4, repetitions=repetitions)
    experiment = SimpleNamespace(config=SimpleNamespace(budget=budget, seed=1))
    return race.race(BASE, planned, sides, experiment, TOLERANCE, frames)


def test_a_device_of_the_processor_is_timed_by_what_it_spends_there_and_a_gpu_by_its_own_clock():
    assert raced(Frames([1.12])).verdict == "regressed"
    assert raced(Frames([1.12], "wall_ms")).verdict == "pass", "the host's clock counts other programs too"
    assert raced(Frames([1.12], "device_ms"), GPU).verdict == "regressed"
    assert raced(Frames([1.12], "processor_ms"), GPU).verdict == "pass"
    assert "by the processor clock" in raced(Frames([1.0])).reason


def test_a_narrow_interval_ends_a_race_and_an_undecided_one_gets_more_rounds():
    same, undecided = Frames([1.0]), Frames([0.9, 1.2])
    assert raced(same).verdict == "pass" and same.rounds == race.MINIMUM_ROUNDS
    assert raced(undecided).verdict == "pass" and undecided.rounds == 20 * race.LONGEST
    clear = Frames([1.1, 1.2, 1.3])
    assert raced(clear).verdict == "regressed" and clear.rounds == 20
    assert sorted(undecided.released) == ["k now", "k then"]


@pytest.mark.parametrize("told", [0.0, None, float("nan"), float("inf")])
def test_a_clock_that_tells_no_time_makes_the_cell_incomparable(told):
    judged = raced(Frames([told]))
    assert judged.verdict == "incomparable" and "the processor clock told" in judged.reason


def test_speed_is_gated_unless_the_config_says_otherwise():
    def of(**figures):
        config = SimpleNamespace(gate=GateChoice(figures=figures), budget=BudgetChoice())
        return race.tolerance_of(SimpleNamespace(config=config))

    assert of() == TOLERANCE
    assert of(speed=ToleranceChoice(relative=0.2)) == Tolerance("lower", 0.0, 0.2)
    assert of(speed=ToleranceChoice(gated=False)) is None


def test_ratios_stand_below_their_cells_where_a_table_is_wider_than_the_screen():
    slot, told = "newton torus default 256x256x1 float32 compute", f"{race.TOLD}1.090 to 1.112 (95 %, 10 rounds)"
    change = Change("speed", 1.0, 1.1, 1.05, Verdict.REGRESSED)
    judged = [Judged(f"{slot}: speed", "opengl:llvmpipe", "newton", Verdict.REGRESSED, told, (change,))]
    compared = against.Compared("v1", judged, Counter(), {}, Path())
    assert f"1.100  1.090 to 1.112 (95 %, 10 rounds)  {slot}  opengl:llvmpipe" in compared.told()
    narrow = compared.told(100).splitlines()
    assert narrow[-2:] == [f"{slot} on opengl:llvmpipe", "    1.100  1.090 to 1.112 (95 %, 10 rounds)"]
    assert max(map(len, narrow)) <= 100
