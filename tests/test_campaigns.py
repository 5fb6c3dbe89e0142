"""The small part of each campaign, and the frame: what it keeps, repeats and tells."""

from __future__ import annotations

import os
import random
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import mpmath
import pytest

from harness import ROOT
from tests.campaigns import frame, table
from tests.campaigns.frame import Campaign, Fell, Place
from tests.conftest import usable_devices
from tests.made_formulas import largest

pytestmark = pytest.mark.usefixtures("no_cache")


@pytest.mark.one_in(2)
@pytest.mark.parametrize("name", frame.names())
def test_the_small_part_of_a_campaign(name: str, tmp_path: Path) -> None:
    campaign = frame.campaign_named(name)
    if campaign.small:
        campaign.prepare(tmp_path)
    last = campaign.first - (-campaign.small // campaign.each)
    found = frame.trials(campaign, 1, range(campaign.first, last), tmp_path)
    assert not found.fell, "\n".join(found.told)
    if name == "plugins" and usable_devices():
        assert found.counts["ok"], "a plugin that is only odd has good rows"


def _trial(dice: random.Random, place: Place) -> str:
    assert not list(place.own.iterdir())
    (place.own / "file").touch()
    if dice.random() < 0.5:
        raise Fell("heads")
    return "tails"


COIN = Campaign("coin", "tosses a coin", "no heads", _trial, 1, 10)


def test_trials_are_made_by_the_seed_and_counted(tmp_path: Path) -> None:
    found, again, other = (frame.trials(COIN, seed, range(20), tmp_path) for seed in (1, 1, 2))
    assert found.counts == again.counts and found.told == again.told != other.told
    assert found.cases == 20 and found.fell == found.counts["fell"] > 0
    one = int(found.told[0].split()[1].rstrip(":"))
    assert frame.trials(COIN, 1, range(one, one + 1), tmp_path).fell == 1


def test_a_campaign_goes_on_where_it_was_stopped(tmp_path: Path) -> None:
    first = frame.run(frame.campaign_named("formulas"), 3, 1, tmp_path, 1, lambda _: None)
    kept = frame.kept_in(tmp_path, 3)
    kept.write_text(kept.read_text() + '{"first": 1, "ca')
    assert frame.run(frame.campaign_named("formulas"), 3, 1, tmp_path, 1, lambda _: None).counts == first.counts


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT, signal.SIGHUP, signal.SIGKILL])
def test_the_processes_of_a_campaign_end_with_it(tmp_path: Path, number: signal.Signals) -> None:
    code, told = _ended_by(number, tmp_path)
    if number == signal.SIGKILL:
        assert code == -number
        return
    assert code == 128 + number and "the same command goes on" in told and "Traceback" not in told, told


def _ended_by(number: signal.Signals, folder: Path) -> tuple[int, str]:
    """End a campaign by a signal, and return its exit code and what it told. Its processes have ended then too."""
    command = [sys.executable, "-m", "tests.campaigns", "formulas", "--jobs", "2", "--folder", str(folder)]
    options: dict[str, Any] = {"cwd": ROOT, "stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE, "text": True}
    options["preexec_fn"] = lambda: signal.signal(signal.SIGHUP, signal.SIG_DFL)  # which nohup ignores
    with subprocess.Popen(command, env=os.environ | {"PYTHONPATH": str(ROOT)}, **options) as campaign:
        try:
            until(lambda: len(_working(campaign.pid)) == 2)
            started = _children(campaign.pid)
            campaign.send_signal(number)
            told = campaign.communicate(timeout=60)[1]
        finally:
            campaign.kill()
    until(lambda: not any(map(_lives, started)))
    return campaign.returncode, told


@pytest.mark.parametrize(
    "doing",
    ["time.sleep(60)", "frame._block('formulas', 1, range(10**6), None)", "frame.trials = dropping; BLOCK"],
    ids=["between blocks", "in a block", "in a callback, which Python drops exceptions of"],
)
def test_a_process_of_a_campaign_ends_without_a_word_whatever_it_does(doing: str) -> None:
    block = "frame._block('formulas', 1, range(10**6), None)"
    lines = [
        "import os, threading, time, weakref",
        "from tests.campaigns import frame",
        "class Kept: pass",
        "def dropping(*_): weakref.finalize(Kept(), time.sleep, 60); time.sleep(60)",
        "frame._quiet()",
        "threading.Timer(0.5, os.kill, (os.getpid(), 15)).start()",
        doing.replace("BLOCK", block),
    ]
    options: dict[str, Any] = {"env": os.environ | {"PYTHONPATH": str(ROOT)}, "capture_output": True, "timeout": 30}
    ended = subprocess.run([sys.executable, "-c", "\n".join(lines)], **options)
    assert (ended.returncode, ended.stderr) == (128 + signal.SIGTERM, b"")


def _children(pid: int) -> list[int]:
    return [int(child) for child in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]


def _working(pid: int) -> list[int]:
    """The processes of its pool: those that have read what they are, and have a second thread."""
    spawned = [child for child in _children(pid) if b"spawn_main" in Path(f"/proc/{child}/cmdline").read_bytes()]
    return [child for child in spawned if len(list(Path(f"/proc/{child}/task").iterdir())) > 1]


def _lives(pid: int) -> bool:
    stat = Path(f"/proc/{pid}/stat")
    return stat.exists() and stat.read_text().rpartition(")")[2].split()[0] != "Z"


def until(holds: Callable[[], bool]) -> None:
    for _ in range(600):
        if holds():
            return
        time.sleep(0.1)
    raise AssertionError("it did not come to it in a minute")


def test_results_of_other_code_are_not_counted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    campaign = frame.campaign_named("formulas")
    frame.run(campaign, 3, 1, tmp_path, 1, lambda _: None)
    assert frame.read_kept(frame.kept_in(tmp_path, 3))[0].cases == campaign.each
    monkeypatch.setattr(frame, "code", lambda: "other")
    assert frame.read_kept(frame.kept_in(tmp_path, 3))[0].cases == 0


def test_what_a_trial_started_is_ended_however_it_ends(tmp_path: Path) -> None:
    ended: list[int] = []

    def trial(dice: random.Random, place: Place) -> str:
        del dice, place
        frame.ENDINGS.append(lambda: ended.append(1))
        raise Fell("it fell")

    frame.trials(Campaign("ends", "begins something", "nothing", trial, 1, 1), 1, range(2), tmp_path)
    assert ended == [1, 1] and not frame.ENDINGS


def test_the_table_has_one_row_for_each_campaign_that_was_run_and_keeps_all_of_others(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    other = [f"| other | {cases} | | | | | |" for cases in (20, 10)]
    page.write_text("\n".join(["# Page", "", table.HEAD, "|---|---|---|---|---|---|---|", *other, "", "more", ""]))
    for seed in (1, 2):
        table.write(page, COIN, frame.trials(COIN, seed, range(20), tmp_path), seed)
    lines = page.read_text().splitlines()
    assert lines[4].startswith("| coin | 20 | ") and "| 2 |" in lines[4] and lines[5:] == [*other, "", "more"]


def test_a_made_formula_has_no_value_where_one_of_its_parts_has_none() -> None:
    assert mpmath.isnan(largest(mpmath.mpf(1), mpmath.nan, mpmath.mpf(2)))
