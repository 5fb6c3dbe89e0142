"""A run's folder has one writer: a second one is told who it is, or waits; what a dead one left holds nobody up."""

import contextlib
import errno
import json
import os
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

from harness.contract import FirsthitError
from harness.results import lock, owner, writing
from harness.results.lock import Lock, locked
from harness.results.writing import replacing, sweep, sweep_below, temporary_folder

ROOT = Path(__file__).parents[1]
DEAD = {"pid": 2**22 + 1, "born": 1, "boot": owner.boot(), "host": owner.host(), "user": "anna"}
DEAD |= {"command": "firsthit run quick", "started": "2026-01-02 03:04:05+00:00"}
ELSEWHERE = DEAD | {"boot": "another", "host": "node7"}
HOLDS = """import sys
from pathlib import Path
from harness.results.lock import Lock
lock = Lock(Path(sys.argv[1]), "firsthit run quick")
lock.take()
print("taken", flush=True)
sys.stdin.read()
"""
TAKES_TURNS = """import os, sys
from pathlib import Path
from harness.contract import FirsthitError
from harness.results.lock import Lock
folder, own, turns = Path(sys.argv[1]), Path(sys.argv[2]), 0
print("ready", flush=True)
sys.stdin.read(1)
while turns < 500:
    with Lock(folder, "turn") as lock:
        try:
            lock.take()
        except FirsthitError as error:
            assert "is being written" in str(error), error
            continue
        os.close(os.open(own, os.O_CREAT | os.O_EXCL))  # fails where the other process has it
        own.unlink()
        turns += 1
"""


def write(folder, said):
    (folder / lock.NAME).write_text(said if isinstance(said, str) else json.dumps(said))


def refusal(folder):
    with pytest.raises(FirsthitError) as refused, Lock(folder, "second") as second:
        second.take()
    assert refused.value.exit_code == 3
    return str(refused.value)


@pytest.fixture
def holder(tmp_path):
    """A process that holds the lock of a folder until its input ends."""
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
    process = subprocess.Popen([sys.executable, "-c", HOLDS, str(tmp_path)], env=environment, **pipes)
    assert process.stdout.readline() == b"taken\n"
    yield process
    process.kill()
    process.wait()


def test_a_second_writer_is_told_who_the_first_is(tmp_path, holder):
    told = refusal(tmp_path)
    assert f"`firsthit run quick` (process {holder.pid} of {owner.user()}) since 20" in told
    assert "--wait" in told
    holder.kill()
    holder.wait()
    assert (tmp_path / lock.NAME).read_text(), "its text is left"
    with Lock(tmp_path, "second") as second:
        second.take()
        second.take()  # it has it already
        assert "second" in refusal(tmp_path), "another object of this process is another writer"
    assert not (tmp_path / lock.NAME).read_text()


def test_who_waits_says_so_and_goes_on(tmp_path, holder):
    told = []

    def doing(what):
        told.append(what)
        threading.Timer(0.2, holder.kill).start()
        return contextlib.nullcontext()

    with Lock(tmp_path, "second", wait=True, doing=doing) as second:
        second.take()
    assert len(told) == 1
    assert told[0].startswith(f"waiting: {tmp_path} is being written by `firsthit run quick`")


@pytest.mark.parametrize("said", [DEAD, DEAD | {"pid": os.getpid()}, "", "{", '{"pid": 1}', "[" * 5000, "\0" * 99])
def test_what_a_dead_or_damaged_text_says_holds_nobody_up(tmp_path, said):
    write(tmp_path, said)
    with Lock(tmp_path, "second") as second:
        second.take()
        assert json.loads((tmp_path / lock.NAME).read_text())["command"] == "second"


def test_another_machine_holds_for_as_long_as_it_gives_signs_of_life(tmp_path):
    write(tmp_path, ELSEWHERE)
    told = refusal(tmp_path)
    assert "of anna on node7" in told
    assert told.endswith("this command waits for it")
    assert f"0 s ago; if it has ended, remove {tmp_path / lock.NAME}" in told
    os.utime(tmp_path / lock.NAME, (time.time() - 1.5 * lock.SILENT,) * 2)
    with Lock(tmp_path, "second") as second:
        second.take()
    write(tmp_path, DEAD | {"host": "a-container"})  # of this machine, whose locks are seen
    with Lock(tmp_path, "second") as second:
        second.take()


def test_the_holder_gives_signs_of_life(tmp_path, monkeypatch):
    monkeypatch.setattr(lock, "BEAT", 0.01)
    with Lock(tmp_path, "first") as first:
        first.take()
        os.utime(tmp_path / lock.NAME, (0, 0))
        end = time.monotonic() + 30.0
        while (tmp_path / lock.NAME).stat().st_mtime < 1.0:
            assert time.monotonic() < end
            time.sleep(0.01)


@pytest.mark.parametrize("number", [errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP])
def test_without_locks_of_the_system_the_text_decides(tmp_path, monkeypatch, number):
    def refuses(*_):
        raise OSError(number, "no locks")

    monkeypatch.setattr(lock.fcntl, "flock", refuses)
    write(tmp_path, DEAD)
    with Lock(tmp_path, "first") as first:
        first.take()
        assert f"process {os.getpid()}" in refusal(tmp_path)
    write(tmp_path, ELSEWHERE)
    assert "node7" in refusal(tmp_path)


def test_a_folder_that_cannot_be_written_is_told(tmp_path):
    (tmp_path / "file").write_text("")
    assert "cannot write" in refusal(tmp_path / "file")
    (tmp_path / lock.NAME).mkdir()
    assert "cannot write" in refusal(tmp_path)


def test_several_folders_are_taken_together_or_not_at_all(tmp_path):
    folders = [tmp_path / name for name in "bab"]
    with locked(folders, "all"):
        assert all("all" in refusal(folder) for folder in folders)
    with Lock(tmp_path / "b", "one") as one:
        one.take()
        with pytest.raises(FirsthitError), locked(folders, "all"):
            raise AssertionError("one of the folders is another's")
        with Lock(tmp_path / "a", "free") as free:
            free.take()


def test_two_that_make_and_remove_the_folder_in_turn_never_hold_it_both(tmp_path):
    command = [sys.executable, "-c", TAKES_TURNS, str(tmp_path / "run"), str(tmp_path / "own")]
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
    both = [subprocess.Popen(command, env=os.environ | {"PYTHONPATH": str(ROOT)}, **pipes) for _ in range(2)]
    for process in both:
        assert process.stdout.readline() == b"ready\n"
    for process in both:
        process.stdin.close()
    assert [process.wait() for process in both] == [0, 0]


def test_a_folder_goes_if_it_was_made_for_the_lock_and_nothing_was_written(tmp_path):
    made, filled, found = (tmp_path / name for name in ("made", "filled", "found"))
    found.mkdir()
    with locked([made, filled, found], "first"):
        (filled / "plan.json").write_text("{}")
    assert (made.exists(), filled.exists(), found.exists()) == (False, True, True)


def test_a_lock_that_was_removed_by_hand_takes_no_other_away(tmp_path):
    folder = tmp_path / "run"
    with Lock(folder, "second") as second:
        with Lock(folder, "first") as first:
            first.take()
            (folder / lock.NAME).unlink()
            second.take()
        assert "`second`" in refusal(folder)


def test_an_error_in_the_block_gives_the_lock_back(tmp_path):
    with pytest.raises(KeyboardInterrupt), locked([tmp_path], "first"):
        raise KeyboardInterrupt
    with Lock(tmp_path, "second") as second:
        second.take()


@pytest.mark.skipif(sys.platform != "linux", reason="tells a process from another of its number")
def test_litter_is_removed_once_its_process_has_ended(tmp_path):
    code = (
        "import os, sys; from pathlib import Path; from harness.results.writing import *\n"
        "folder = Path(sys.argv[1])\n"
        "with replacing(folder / 'a.json') as new, replacing_together(folder, 'all') as made:\n"
        "    (made / 'b').write_text('b'); os._exit(0)\n"
    )
    for place in (tmp_path, tmp_path / "cells"):
        place.mkdir(exist_ok=True)
        subprocess.run([sys.executable, "-c", code, place], env=os.environ | {"PYTHONPATH": str(ROOT)}, check=True)
        assert len([path for path in place.iterdir() if path.name.startswith(".new-")]) == 2
    machine, pid, born = owner.machine(), os.getpid(), owner.born(os.getpid())
    kept = {
        f".new-{machine}-{pid}-{born}-abcdefgh.json",  # of a process that goes on: this one
        f".new-0badcafe-{DEAD['pid']}-1-abcdefgh",  # of another machine
        f".new-{machine}-{DEAD['pid']}-1-abcdefgh-mine",  # none of ours
        ".new-mine",
        "mine",
    }
    for name in kept:
        (tmp_path / name).write_text("")
    assert len(sweep_below(tmp_path)) == 4
    assert {path.name for path in tmp_path.iterdir()} == {*kept, "cells"}
    assert not list((tmp_path / "cells").iterdir())
    os.utime(tmp_path / f".new-0badcafe-{DEAD['pid']}-1-abcdefgh", (0, 0))
    (tmp_path / f".new-{machine}-{pid}-{born - 1}-abcdefgh").mkdir()  # the number was another's before
    assert len(sweep(tmp_path)) == 2


def test_the_next_writer_removes_what_a_killed_one_left(tmp_path, monkeypatch):
    left = tmp_path / f".new-{owner.machine()}-{DEAD['pid']}-1-abcdefgh.txt"
    for name, place in ((left.name, tmp_path), (left.name.replace(".new", "firsthit-page"), tmp_path / "t")):
        place.mkdir(exist_ok=True)
        (place / name).write_text("")
    with replacing(tmp_path / "a.txt") as new:
        new.write_text("whole")
    assert not left.exists()
    monkeypatch.setattr(writing.tempfile, "tempdir", str(tmp_path / "t"))
    with temporary_folder("firsthit-page") as folder:
        assert [path.name for path in (tmp_path / "t").iterdir()] == [folder.name]
