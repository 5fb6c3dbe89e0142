"""Let the disk refuse: full, over quota, without inodes, read-only, a file where a folder should be, files too long.

A command then ends with 3 and one line that names the file and the reason, or does without what it could not keep. What
the system does not allow here is done by a seam in the process, which refuses to open, flush or make files.
"""

from __future__ import annotations

import functools
import os
import random
import resource
import shutil
import subprocess
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from tests.campaigns import processes
from tests.campaigns.commands import COMMANDS, fill, prepare, ready_of
from tests.campaigns.frame import Campaign, Fell, Place
from tests.campaigns.processes import Command, done

SEAMS = ("ENOSPC", "EDQUOT", "EIO", "EROFS")
NAMES = ("run", "run", "run-all", "bless", "gate", "report", "publish", "history", "oracle")
ROOM = "512m"


@dataclass(frozen=True)
class Mounted:
    """Hold a small file system in a name space of its own, which its holder's process keeps."""

    pid: int
    place: Path  # in the name space

    @property
    def outside(self) -> Path:
        """Return the folder by which this process sees it."""
        return Path(f"/proc/{self.pid}/root{self.place}")

    def prefix(self) -> list[str]:
        """Return what begins the command line of a command that works there."""
        enter = ["nsenter", "--preserve-credentials", "-U", "-m", "-t", str(self.pid)]
        return [*enter, "sh", "-c", f'cd "{self.place}/work" && exec "$@"', "sh"]

    def remount(self, options: str) -> None:
        """Change the options of the file system."""
        subprocess.run([*self.prefix(), "mount", "-o", f"remount,{options}", self.place], check=True)


@contextmanager
def mounted(place: Path, options: str) -> Iterator[Mounted]:
    """Mount a file system in memory at `place`, seen by its own processes only. Raises OSError where none may be."""
    place.mkdir()
    script = f'mount -t tmpfs -o {options} none "{place}" && mkdir "{place}/work" && echo ready && read line'
    holder = subprocess.Popen(
        ["unshare", "-Urm", "sh", "-c", script],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    )
    try:
        assert holder.stdout
        if holder.stdout.readline() != "ready\n":
            raise OSError("no file system may be mounted here")
        yield Mounted(holder.pid, place)
    finally:
        holder.kill()
        holder.communicate()


@functools.cache
def can_mount() -> bool:
    """Tell whether a process may mount a file system in a name space of its own."""
    if not shutil.which("unshare") or not shutil.which("nsenter"):
        return False
    tried = ["unshare", "-Urm", "sh", "-c", "mount -t tmpfs none /tmp && echo ready"]
    return subprocess.run(tried, capture_output=True, check=False).stdout == b"ready\n"


def _trial(dice: random.Random, place: Place) -> Counter[str]:
    name, kind = dice.choice(NAMES), dice.choice(list(KINDS))
    return Counter([f"{kind}: {KINDS[kind](dice, name, place)}"])


def _work(name: str, place: Place, folder: Path) -> Path:
    folder.mkdir(exist_ok=True)
    fill(place.shared, COMMANDS[name], folder)
    return folder


def _refused(what: str, code: int, told: str, before: dict[str, bytes], work: Path) -> str:
    """Check how a command ended whose disk refuses, and what is left; return what happened."""
    what = f"{what} ended with {code}: {told[-1500:]}"
    if code not in (0, 3):
        raise Fell(what)
    if code == 3:
        last = [line for line in told.splitlines() if line.startswith("firsthit: ")]
        if not last or ("cannot" not in last[-1] and "is damaged" not in last[-1]):
            raise Fell(f"it does not say in its last line what cannot be written; {what}")
    processes.check_whole(work)
    after = processes.rows(work / "runs")
    if lost := [row for row, content in before.items() if after.get(row) != content]:
        raise Fell(f"finished rows are lost or changed: {lost}; {what}")
    return "told" if code == 3 else "did without"


def _complete(name: str, work: Path, shared: Path) -> None:
    """Let the command complete with space again, and check that the rows are those of an undisturbed run."""
    before = processes.rows(work / "runs")
    done(work, *COMMANDS[name].arguments)
    after = processes.rows(work / "runs")
    if changed := [row for row, content in before.items() if after.get(row) != content]:
        raise Fell(f"finished cells ran again: {changed}")
    processes.check_whole(work)
    if name.startswith("run"):
        ready = ready_of(shared, name)[0]
        processes.check_same(processes.facts(work / "runs"), processes.facts(ready / "runs"))
    processes.check_clean(work)


def _on_mount(dice: random.Random, name: str, place: Place, options: Callable[[int, int], str]) -> str:
    """Run on a file system that is too small; then make it larger and complete there."""
    if not can_mount():
        return "skipped: no file system may be mounted here"
    ready = ready_of(place.shared, name)[0]
    found = list(processes.files(ready))
    size, count = sum(-(-path.stat().st_size // 4096) * 4096 for path in found), len(found) + 20
    with mounted(place.own / "disk", f"size={ROOM}") as disk:
        work = _work(name, place, disk.outside / "work")
        given = list(processes.files(work))
        used = sum(-(-path.stat().st_size // 4096) * 4096 for path in given)
        more = dice.uniform(0.0, 1.1)
        whole = options(int(used + more * (size - used)), int(len(given) + 30 + more * (count - len(given))))
        disk.remount(whole)
        arguments = COMMANDS[name].arguments
        command = Command(work, arguments, prefix=disk.prefix(), logs=place.own)
        outcome = _refused(f"`{name}` with {whole}", *command.ended(), {}, work)
        disk.remount(f"size={ROOM},nr_inodes=1m,rw")
        copied = place.own / "work"
        shutil.copytree(work, copied)
    _complete(name, copied, place.shared)
    return outcome


def _full(dice: random.Random, name: str, place: Place) -> str:
    return _on_mount(dice, name, place, lambda size, _: f"size={max(size, 4096)}")


def _inodes(dice: random.Random, name: str, place: Place) -> str:
    return _on_mount(dice, name, place, lambda _, count: f"nr_inodes={count}")


def _read_only(dice: random.Random, name: str, place: Place) -> str:
    return _on_mount(dice, name, place, lambda *_: "ro")


def _long_files(dice: random.Random, name: str, place: Place) -> str:
    """Forbid files longer than a random size; the system then says EFBIG, since Python ignores its signal."""
    work = _work(name, place, place.own / "work")
    largest = max(path.stat().st_size for path in processes.files(ready_of(place.shared, name)[0]))
    most = dice.randint(0, largest)

    def limits() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (most, resource.RLIM_INFINITY))

    command = Command(work, COMMANDS[name].arguments, limits=limits, piped=True)
    outcome = _refused(f"`{name}` with files of at most {most} bytes", *command.ended(), {}, work)
    _complete(name, work, place.shared)
    return outcome


def _seam(dice: random.Random, name: str, place: Place) -> str:
    """Refuse in the process, from a random change of a file on."""
    work = _work(name, place, place.own / "work")
    at, errno = dice.randint(1, max(1, int(ready_of(place.shared, name)[1]["events"]))), dice.choice(SEAMS)
    command = Command(work, COMMANDS[name].arguments, seam={"at": at, "errno": errno})
    outcome = _refused(f"`{name}` with {errno} from change {at} on", *command.ended(), {}, work)
    _complete(name, work, place.shared)
    return outcome


def _file_for_folder(dice: random.Random, name: str, place: Place) -> str:
    """Put a file where the command makes a folder."""
    ready, work = ready_of(place.shared, name)[0], _work(name, place, place.own / "work")
    there = {path.relative_to(work) for path in work.rglob("*")}
    made = sorted(p.relative_to(ready) for p in ready.rglob("*") if p.is_dir() and p.relative_to(ready) not in there)
    if not made:
        return "skipped: it makes no folder"
    wrong = work / dice.choice(made)
    wrong.parent.mkdir(parents=True, exist_ok=True)
    wrong.write_text("a file of somebody else")
    arguments = COMMANDS[name].arguments
    code, told = Command(work, arguments).ended()
    if code == 2 and str(wrong.relative_to(work)) in told:
        outcome = "told as a mistake"
    else:
        outcome = _refused(f"`{name}` with a file at {wrong.relative_to(work)}", code, told, {}, work)
    if wrong.read_text() != "a file of somebody else":
        raise Fell(f"`{name}` changed somebody's file {wrong.relative_to(work)}")
    wrong.unlink()
    _complete(name, work, place.shared)
    return outcome


def _forbidden(dice: random.Random, name: str, place: Place) -> str:
    """Take away the right to write into a folder."""
    if os.geteuid() == 0:
        return "skipped: root may write anywhere"
    ready, work = ready_of(place.shared, name)[0], _work(name, place, place.own / "work")
    folders = sorted(path.relative_to(ready) for path in ready.rglob("*") if path.is_dir())
    wrong = work / dice.choice([*folders, Path()])
    wrong.mkdir(parents=True, exist_ok=True)
    wrong.chmod(0o500)
    try:
        outcome = _refused(f"`{name}` without the right", *Command(work, COMMANDS[name].arguments).ended(), {}, work)
    finally:
        wrong.chmod(0o700)
    _complete(name, work, place.shared)
    return outcome


KINDS: dict[str, Callable[[random.Random, str, Place], str]] = {
    "refused in the process": _seam,
    "full": _full,
    "no inodes": _inodes,
    "read-only": _read_only,
    "files too long": _long_files,
    "a file for a folder": _file_for_folder,
    "no right to write": _forbidden,
}

CAMPAIGN = Campaign(
    name="disk",
    tries="runs a command on a disk that refuses: full, no inodes, read-only, files too long, a file for a folder",
    promise="no traceback, no other exit code than 3 with the file and the reason in one line, no finished row lost, no"
    " half-written file; with space again, no row other than an undisturbed run's, and no litter",
    trial=_trial,
    small=1,
    whole=500,
    prepare=prepare,
    limit=300,
)
