"""Let several commands work in one folder at once: no row is lost or made twice, and one of them says who holds it."""

from __future__ import annotations

import json
import os
import random
import shutil
import signal
import socket
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path

from tests.campaigns import processes
from tests.campaigns.commands import COMMANDS, fill, prepare, ready_of
from tests.campaigns.frame import Campaign, Fell, Place
from tests.campaigns.processes import Command, done

HELD = "is being written by"
RUN, BLESS, GATE, REPORT, PUBLISH = (COMMANDS[name].arguments for name in ("run", "bless", "gate", "report", "publish"))
WAITS = (*RUN, "--wait")
RUN_REPORT = ("report", "runs/views", "-o", "out")
PAIRS: dict[str, tuple[tuple[tuple[str, ...], ...], tuple[str, ...]]] = {  # what starts, and what it reads
    "run, run": ((RUN, RUN), ()),
    "run, run, run": ((RUN, RUN, RUN), ()),
    "run, run --wait": ((RUN, WAITS), ()),
    "run, report": ((RUN, RUN_REPORT), ()),
    "run, report, report": ((RUN, RUN_REPORT, RUN_REPORT), ()),
    "run, gate": ((RUN, GATE), ("base.toml",)),
    "gate, gate": ((GATE, GATE), ("base.toml",)),
    "bless, gate": ((BLESS, GATE), ("base.toml",)),
    "bless, bless": ((BLESS, BLESS), ()),
    "run, publish": ((RUN, ("publish", "runs/views", "-o", "site")), ()),
    "report, report": ((REPORT, REPORT), ("runs",)),
    "publish, publish": ((PUBLISH, PUBLISH), ("runs",)),
}
MAKERS = {"base.toml": "bless", "runs": "run-all"}
READERS = ("report", "publish")


def _trial(dice: random.Random, place: Place) -> Counter[str]:
    kinds = [*PAIRS, "stale lock"]
    kind = dice.choices(kinds, [*(2 if "run, run" in pair else 1 for pair in PAIRS), 3])[0]
    work = place.own / "work"
    work.mkdir()
    fill(place.shared, COMMANDS["run"], work)
    ready, measured = ready_of(place.shared, "run")
    if kind == "stale lock":
        outcome = _stale(dice, work)
    else:
        outcome = _at_once(dice, kind, work, place.shared, measured["seconds"])
    done(work, *RUN)
    processes.check_whole(work)
    undisturbed = processes.facts(ready / "runs")
    processes.check_same({n: one for n, one in processes.facts(work / "runs").items() if n in undisturbed}, undisturbed)
    processes.check_clean(work)
    return Counter([f"{kind}: {outcome}"])


def _at_once(dice: random.Random, kind: str, work: Path, shared: Path, seconds: float) -> str:
    """Start the commands of a pair, each a while after the one before, and check how they end."""
    commands, needs = PAIRS[kind]
    for needed in needs:
        source = ready_of(shared, MAKERS[needed])[0] / needed
        (shutil.copytree if source.is_dir() else shutil.copy2)(source, work / needed)
    readers = any(arguments[0] in READERS for arguments in commands)
    if kind.startswith("run,") and readers:  # so that there is something to read
        source = ready_of(shared, "run")[0] / "runs"
        shutil.copytree(source, work / "runs", dirs_exist_ok=True)
        rows = sorted((work / "runs" / "views" / "cells").glob("[!.]*.json"))
        for row in dice.sample(rows, len(rows) // 2):
            row.unlink()
    started = []
    for arguments in commands:
        started.append(Command(work, arguments))
        time.sleep(dice.choice((0.0, 0.05, dice.uniform(0.0, seconds))))
    ended = [command.ended() for command in started]
    refused = 0
    for arguments, (code, told) in zip(commands, ended, strict=True):
        what = f"{kind}: `{' '.join(arguments)}` ended with {code}: {told[-1500:]}"
        if code == 0:
            continue
        if code != 3 or HELD not in told or arguments == WAITS or arguments[0] in READERS:
            raise Fell(what)
        if not any(word in told for word in ("process ", "does not say")):
            raise Fell(f"it does not say who holds the folder; {what}")
        refused += 1
    if refused == len(commands):
        raise Fell(f"{kind}: none of them ran: {[told[-500:] for _, told in ended]}")
    return f"{refused} refused" if refused else "all done"


def _stale(dice: random.Random, work: Path) -> str:
    """Put a lock by hand, and run: a stale one is recognised, one that may be alive is told."""
    name = dice.choice(list(LOCKS))
    folder = work / "runs" / "views"
    folder.mkdir(parents=True)
    lock = folder / ".lock"
    may_be_alive = LOCKS[name](lock, dice)
    code, told = Command(work, RUN).ended()
    if code != (3 if may_be_alive else 0):
        raise Fell(f"a lock that is {name}: exit code {code}: {told[-1500:]}")
    if may_be_alive and str(Path("runs", "views")) not in told:
        raise Fell(f"a lock that is {name}: it does not name the folder: {told[-1500:]}")
    if lock.is_dir() and not lock.is_symlink():
        lock.rmdir()
    elif may_be_alive:
        lock.unlink()
    return f"{name}: {'told' if may_be_alive else 'recognised'}"


def _text(**more: object) -> str:
    pid = _dead()
    said = {"pid": pid, "born": 1, "boot": _boot(), "host": socket.gethostname(), "user": "somebody"}
    return json.dumps(said | {"command": "firsthit run x", "started": "2026-01-01 00:00:00+00:00"} | more)


def _boot() -> str | None:
    path = Path("/proc/sys/kernel/random/boot_id")
    return path.read_text().strip() if path.exists() else None


def _dead() -> int:
    """Return the number of a process that has ended."""
    process = subprocess.Popen([sys.executable, "-c", ""])
    process.wait()
    return process.pid


def _written(content: bytes) -> Callable[[Path, random.Random], bool]:
    def put(lock: Path, dice: random.Random) -> bool:
        del dice
        lock.write_bytes(content)
        return False

    return put


def _dead_text(lock: Path, dice: random.Random) -> bool:
    del dice
    lock.write_text(_text())
    return False


def _born_later(lock: Path, dice: random.Random) -> bool:
    """Name a living process that is another than the one which wrote the text."""
    lock.write_text(_text(pid=os.getpid(), born=dice.randint(1, 10)))
    return False


def _elsewhere(lock: Path, dice: random.Random) -> bool:
    """Be the lock of another machine: alive if it was touched a moment ago."""
    alive = dice.random() < 0.5
    lock.write_text(_text(host="another-machine", boot="another"))
    if not alive:
        os.utime(lock, (1.0e9, 1.0e9))
    return alive


def _cut(lock: Path, dice: random.Random) -> bool:
    text = _text()
    lock.write_text(text[: dice.randint(1, len(text) - 1)])
    return False


def _folder(lock: Path, dice: random.Random) -> bool:
    del dice
    lock.mkdir()
    return True


def _killed(lock: Path, dice: random.Random) -> bool:
    """Be left by a run that was killed."""
    command = Command(lock.parents[2], RUN)
    time.sleep(dice.uniform(0.3, 1.5))
    command.process.send_signal(signal.SIGKILL)
    command.ended()
    return False


LOCKS: dict[str, Callable[[Path, random.Random], bool]] = {  # put a lock, and tell whether it may be alive
    "of a dead process": _dead_text,
    "of another process of its number": _born_later,
    "of another machine": _elsewhere,
    "cut off": _cut,
    "empty": _written(b""),
    "no text": _written(b"\xff\x00" * 50),
    "another's JSON": _written(b'{"pid": "many"}'),
    "deep": _written(b"[" * 50_000),
    "a folder": _folder,
    "of a run that was killed": _killed,
}

CAMPAIGN = Campaign(
    name="two",
    tries="starts two or three commands in one folder at once, or one beside a lock that was left there",
    promise="no row lost or made twice, no traceback, no half-written file, no command refused that does not say who"
    " holds the folder, no stale lock that stops one",
    trial=_trial,
    small=1,
    whole=300,
    prepare=prepare,
    limit=1200,
    first=1,  # it runs beside a lock that was left there
)
