"""Watch from outside how much memory another process holds, while this one waits for its answer.

A driver, a kernel or a plugin may ask for any amount. The system's own way out, which is to end some process when all
memory is spent, may end the wrong one. So whoever waits for such a process looks at it every WATCHED_SECONDS and ends
it beyond a share of the machine's memory.
"""

from __future__ import annotations

import contextlib
import importlib
import importlib.util
import os
import signal
import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cache
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

SHARE = 0.5  # of the machine's memory that a process may hold, if nobody says otherwise
WATCHED_SECONDS = 0.05  # between two looks: at 10 GB a second, which is fast, a process grows by 0.5 GB meanwhile
FAMILY_SECONDS = 1.0  # between two searches for a process's children, which take a millisecond or more
GIGA = 1e9


class TooMuch(Exception):
    """Report that a process held more memory than it may; the message says how much, as "held more than ..."."""


@cache
def of_machine() -> int | None:
    """Return the bytes of memory that this process and its children can have: the machine's, or its container's.

    None where the system does not tell, as on Windows without psutil.
    """
    told = [*_of_containers(Path("/proc/self/cgroup"), Path("/sys/fs/cgroup")), *_physical()]
    return min(told, default=None)


def _physical() -> Iterator[int]:
    try:
        yield os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, ValueError, OSError):  # none of these on Windows
        if psutil := _psutil():
            yield int(psutil.virtual_memory().total)


def _of_containers(told: Path, root: Path) -> Iterator[int]:
    """Yield the memory limit of each control group that holds this process, of version 1 and 2, and of their parents.

    `told` is the list of a process's groups, `root` the folder in which groups are mounted. A container may see its
    own group as the root, while the list names it as the machine does; so the root is looked at too.
    """
    try:
        lines = told.read_text(encoding="utf-8").splitlines()
    except (OSError, ValueError):
        return
    for line in lines:
        _, controllers, path = line.split(":", 2) if line.count(":") >= 2 else ("", "-", "")
        mounts: tuple[Path, ...]
        if controllers == "":
            mounts, name = (root, root / "unified"), "memory.max"
        elif "memory" in controllers.split(","):
            mounts, name = (root / "memory",), "memory.limit_in_bytes"
        else:
            continue
        group = Path(path.lstrip("/"))
        for mount in mounts:
            for folder in dict.fromkeys((group, *group.parents)):
                try:
                    yield int((mount / folder / name).read_text(encoding="utf-8"))
                except (OSError, ValueError):  # no such group, or "max"
                    continue


def _psutil() -> Any:
    """Return the module psutil, which is asked where the system has no /proc; None where it is not installed."""
    return importlib.import_module("psutil") if importlib.util.find_spec("psutil") else None


def unwatched() -> str | None:
    """Say why no memory limit is kept on this machine; None where one is."""
    if of_machine() is None or not (sys.platform == "linux" or _psutil()):
        return "no memory limit is kept here, since the system does not tell what a process holds: install psutil"
    return None


@dataclass(eq=False)
class Watch:
    """Watch a process and its children, which together may hold `share` of the machine's memory.

    A process that is `alone` starts no children, and none are searched for.
    """

    pid: int
    share: float = SHARE
    alone: bool = False
    _family: list[int] = field(default_factory=list)
    _searched: float = 0.0

    def look(self) -> None:
        """Raise TooMuch if the process and its children hold more than they may."""
        whole = of_machine()
        if whole is None:
            return
        most = self.share * whole
        if self.held() > most:
            told = f"held more than {most / GIGA:.3g} GB of memory"
            limit = f"the limit ([budget] memory = {self.share:g} of {whole / GIGA:.1f} GB)"
            raise TooMuch(f"{told}, its part of what all may hold" if self.alone else f"{told}, {limit}")

    def kill(self) -> None:
        """Kill the process and all its children: a compiler that it started would go on to grow without it."""
        for pid in (self.pid, *_descendants(self.pid)):
            with contextlib.suppress(OSError):  # it has ended meanwhile
                os.kill(pid, getattr(signal, "SIGKILL", signal.SIGTERM))  # Windows has one way to end a process

    def held(self) -> int:
        """Return the bytes of memory that the process and its children hold now; 0 of what has ended."""
        if sys.platform != "linux":
            return _held_elsewhere(self.pid)
        if self.alone:
            return _resident(self.pid)
        if not self._family or time.monotonic() - self._searched > FAMILY_SECONDS:
            self._family, self._searched = [self.pid, *_descendants(self.pid)], time.monotonic()
        return sum(map(_resident, self._family))


def _resident(pid: int) -> int:
    try:
        text = Path(f"/proc/{pid}/statm").read_text(encoding="ascii")
        return int(text.split()[1]) * os.sysconf("SC_PAGE_SIZE")
    except (OSError, ValueError, IndexError):
        return 0


def _descendants(pid: int) -> list[int]:
    """List the processes that a process has started, and those that these have started; [] elsewhere than on Linux."""
    children: dict[int, list[int]] = {}
    if sys.platform != "linux":
        return []
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                text = (entry / "stat").read_text(encoding="utf-8", errors="replace")
                parent = int(text.rpartition(")")[2].split()[1])
            except (OSError, ValueError, IndexError):  # it has ended meanwhile
                continue
            children.setdefault(parent, []).append(int(entry.name))
    found, todo = [], [pid]
    while todo:
        todo = [child for one in todo for child in children.get(one, ())]
        found += todo
    return found


def _held_elsewhere(pid: int) -> int:
    psutil = _psutil()
    if psutil is None:
        return 0
    held = 0
    try:
        process = psutil.Process(pid)
        for one in (process, *process.children(recursive=True)):
            held += int(one.memory_info().rss)
    except psutil.Error:  # it has ended meanwhile
        pass
    return held


def answered(connection: Connection, watch: Watch, seconds: float) -> bool:
    """Wait until something can be read from `connection`; return False where nothing can after `seconds`.

    Raises TooMuch as soon as the process that `watch` looks at holds too much. What answers within WATCHED_SECONDS is
    not looked at, so that short timed samples are not disturbed.
    """
    end = time.monotonic() + seconds
    while not connection.poll(max(0.0, min(WATCHED_SECONDS, end - time.monotonic()))):
        if time.monotonic() >= end:
            return False
        watch.look()
    return True


def refusal(wanted: float, what: str, instead: str, share: float = SHARE) -> str | None:
    """Say why this process should not make `what`, of `wanted` bytes, and what to do `instead`; None where it may.

    Both this process and one that it watches may then hold `share` of the machine's memory. The command's estimate is
    asked before any array is made, since the system may end some other process once memory is spent.
    """
    whole = of_machine()
    if whole is None or wanted <= share * whole:
        return None
    limit = f"over the limit of {share * whole / GIGA:.3g} GB"
    return f"{what} would take {wanted / GIGA:.3g} GB of memory, {limit}; {instead}"
