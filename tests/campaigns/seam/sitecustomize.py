"""Count what a process does to files below a folder and, at a number, send a signal or fail as a full disk does.

A process takes this up where its folder is on PYTHONPATH and FIRSTHIT_SEAM holds JSON: `below`, the folder; `at`, the
number of the event; `count`, a file for the number of events at the end; and either `signal` with `group`, or `errno`.
The processes that it starts do not take it up.
"""

import atexit
import errno
import json
import os
import signal
import sys
from pathlib import Path

WRITES = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC
CHANGES = ("os.rename", "os.remove", "os.mkdir", "os.rmdir", "os.chmod", "os.link", "os.symlink", "os.truncate")
MAKES = ("open", "os.mkdir", "os.link", "os.symlink", "fsync")  # what a full disk refuses


class Seam:
    """Hold what is to happen, and how many events there were."""

    def __init__(self, told):
        self.told, self.events, self.fired = told, 0, False
        self.below = told["below"] + os.sep

    def hook(self, event, arguments):
        """Hear an audit event of the interpreter."""
        if event in CHANGES or (event == "open" and isinstance(arguments[2], int) and arguments[2] & WRITES):
            path = arguments[0]
            if isinstance(path, str | bytes | os.PathLike) and str(Path(os.fsdecode(path)).absolute()).startswith(
                self.below
            ):
                self.happens(event, os.fsdecode(path))

    def happens(self, event, path):
        """Count an event, and do what is to be done at its number; a disk stays full from then on."""
        self.events += 1
        due = self.events >= self.told["at"]
        if due and "errno" in self.told and event in MAKES:
            self.fired = True
            code = getattr(errno, self.told["errno"])
            raise OSError(code, os.strerror(code), path)
        if due and "signal" in self.told and not self.fired:
            self.fired = True
            number = signal.Signals[self.told["signal"]]
            (os.killpg if self.told["group"] else os.kill)(os.getpgrp() if self.told["group"] else os.getpid(), number)

    def flushed(self, file):
        """Do what os.fsync does, as an event: some file systems say only there that they are full."""
        number = file if isinstance(file, int) else file.fileno()
        link = Path(f"/proc/self/fd/{number}")
        if link.exists() and str(link.readlink()).startswith(self.below):
            self.happens("fsync", str(link.readlink()))
        fsync(file)

    def tell(self):
        """Write how many events there were."""
        if "count" in self.told:
            Path(self.told["count"]).write_text(str(self.events))


if "FIRSTHIT_SEAM" in os.environ:
    seam = Seam(json.loads(os.environ.pop("FIRSTHIT_SEAM")))
    fsync, os.fsync = os.fsync, seam.flushed
    atexit.register(seam.tell)
    sys.addaudithook(seam.hook)
