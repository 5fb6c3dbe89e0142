"""Kill commands at random moments and complete them: nothing that was finished may be lost, and nothing be half-made.

A trial makes a folder, kills one command in it EACH times, and then lets the same command complete. A kill is a signal
to the main process, to one of its workers or to all, after a random time or at a random change of a file.
"""

from __future__ import annotations

import json
import os
import random
import shutil
import signal
import time
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from tests.campaigns import processes
from tests.campaigns.commands import COMMANDS, STORE_ROWS, fill, prepare, ready_of
from tests.campaigns.frame import Campaign, Fell, Place
from tests.campaigns.processes import Command, done

EACH = 3
SIGNALS = ("INT", "TERM", "HUP", "KILL")
ENDED_BY = {"INT": (130, -2), "TERM": (143, -15), "HUP": (129, -1), "KILL": (-9,)}  # the latter before it has begun
WHOM = ("main", "main", "worker", "group")
KEPT_ROWS = "finished cells are kept"  # of the message of a command that stores rows


def _trial(dice: random.Random, place: Place) -> Counter[str]:
    name = dice.choices(list(COMMANDS), [command.weight for command in COMMANDS.values()])[0]
    command, work = COMMANDS[name], place.own / "work"
    ready, measured = ready_of(place.shared, name)
    work.mkdir()
    fill(place.shared, command, work)
    if name.startswith("run") and dice.random() < 0.5:  # truth and probes are there already: kills hit cells more often
        for kept in (*ready.glob("runs/*/truth"), *ready.glob("runs/*/probes")):
            shutil.copytree(kept, work / kept.relative_to(ready))
    outcomes: Counter[str] = Counter()
    for _ in range(EACH):
        outcomes[f"{name}: {_kill(dice, name, command.arguments, work, measured)}"] += 1
    _complete(dice, name, work, ready)
    return outcomes


def _kill(dice: random.Random, name: str, arguments: Sequence[str], work: Path, measured: dict[str, float]) -> str:
    """Start the command, kill it, and check what it left; return what happened."""
    number, whom = dice.choice(SIGNALS), dice.choice(WHOM if name in STORE_ROWS else ("main", "group"))
    before = processes.rows(work / "runs")
    by_event = whom != "worker" and dice.random() < 0.4
    told_signal = f"SIG{number}"
    if by_event:
        at = dice.randint(1, max(1, int(measured["events"])))
        command = Command(work, arguments, seam={"at": at, "signal": told_signal, "group": whom == "group"})
    else:
        command = Command(work, arguments)
        time.sleep(dice.uniform(0.0, 1.1) * measured["seconds"])
        _send(dice, command, whom, getattr(signal, told_signal))
    code, told = command.ended()
    what = f"`{name}` after SIG{number} to {whom}{' at a change of a file' * by_event}"
    processes.check_whole(work)
    after = processes.rows(work / "runs")
    if lost := [row for row, content in before.items() if after.get(row) != content and _is_finished(content)]:
        raise Fell(f"{what}: finished rows are lost or changed: {lost}")
    if whom != "worker" and (new := [row for row, one in after.items() if row not in before and not _is_finished(one)]):
        raise Fell(f"{what}: a cell has a row as if its worker had crashed: {new}")
    crashed = any(not _is_finished(content) for content in after.values())  # since a worker was killed, now or before
    regressed = name == "gate" and crashed and " regressed" in told  # a crash where the baseline has none is one
    if code not in (0, *ENDED_BY[number], *([3] if crashed or whom == "worker" else []), *([1] if regressed else [])):
        raise Fell(f"{what}: exit code {code}; it told {told[-1500:]}")
    if code in (129, 130, 143) and told.strip():
        _check_told(what, name, told)
    if code == 0:
        return "ended before the kill" if whom != "worker" else "went on without the worker"
    return f"{number} to {whom}" if whom != "worker" else "a worker's death told"


def _send(dice: random.Random, command: Command, whom: str, number: signal.Signals) -> None:
    """Send a signal to the command's main process, a worker of it (if there is one) or all of them."""
    pids = [command.process.pid] if whom == "main" else command.workers()
    if whom != "group" and pids:
        try:
            os.kill(dice.choice(pids), number)
        except OSError:
            return
    elif whom == "group":
        try:
            os.killpg(command.process.pid, number)
        except OSError:
            return


def _check_told(what: str, name: str, told: str) -> None:
    """Raise Fell where a command that was stopped does not say so, or does not say that cells are kept.

    One that had not begun says only that it was stopped.
    """
    last = told.strip().splitlines()
    if last == ["firsthit: stopped"]:
        return
    if not any("stopped" in line for line in last) or (
        name in STORE_ROWS and not any(KEPT_ROWS in line for line in last)
    ):
        raise Fell(f"{what}: it does not say what is kept: {told[-800:]}")


def _is_finished(content: bytes) -> bool:
    return json.loads(content)["status"] not in processes.UNFINISHED


def _complete(dice: random.Random, name: str, work: Path, ready: Path) -> None:
    """Let the command complete, and check that nothing is lost, made twice or left over."""
    command, before = COMMANDS[name], processes.rows(work / "runs")
    code, told = done(work, *command.arguments, codes=(0, 3))
    if code == 3:
        if not command.again:
            raise Fell(f"`{name}` ended with 3 when it was completed: {told[-1500:]}")
        done(work, *command.arguments, *command.again)
    after = processes.rows(work / "runs")
    forced = "--force" in command.again and code == 3
    if changed := [row for row, one in before.items() if _is_finished(one) and after.get(row) != one and not forced]:
        raise Fell(f"finished cells ran again: {changed}")
    processes.check_whole(work)
    if name.startswith("run"):
        processes.check_same(processes.facts(work / "runs"), processes.facts(ready / "runs"))
        if dice.random() < 0.2 and " 0 cells run" not in (told := done(work, *command.arguments)[1]):
            raise Fell(f"a complete run runs cells again: {told[-500:]}")
    if name == "bless" and _blessed(work) != _blessed(ready):
        raise Fell("the baseline is not that of an undisturbed `bless`")
    processes.check_clean(work)


def _blessed(folder: Path) -> list[str]:
    """Return the lines of a baseline that do not say when it was written."""
    return [line for line in (folder / "base.toml").read_text().splitlines() if not line.startswith("blessed = ")]


CAMPAIGN = Campaign(
    name="kills",
    tries="sends INT, TERM, HUP or KILL to a command, one of its workers or all of them, at a random moment, EACH"
    " times, and then completes it",
    promise="no finished cell lost or run again, no half-written file, no process left behind, no traceback, no wrong"
    " exit code, no litter after the same command has completed, no other result than an undisturbed run's",
    trial=_trial,
    small=1,
    whole=1000,
    each=EACH,
    prepare=prepare,
    limit=1200,
    first=1,  # it kills `run`
)
