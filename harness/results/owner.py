"""Name the process that holds or writes something, and tell whether it has ended."""

from __future__ import annotations

import getpass
import hashlib
import os
import platform
import sys
from functools import cache
from pathlib import Path


@cache
def boot() -> str | None:
    """Return what names the running kernel until the machine starts anew, the same in all its containers.

    None where the system does not say; Linux does.
    """
    try:
        return Path("/proc/sys/kernel/random/boot_id").read_text(encoding="ascii").strip()
    except (OSError, ValueError):
        return None


@cache
def machine() -> str:
    """Return 8 digits that name all processes which can see each other: of one kernel, and of one container of it."""
    try:
        numbered = str(Path("/proc/self/ns/pid").readlink())
    except OSError:
        numbered = ""
    return hashlib.sha256(f"{boot() or host()} {numbered}".encode()).hexdigest()[:8]


@cache
def host() -> str:
    """Return this machine's name in its network."""
    return platform.node() or "a machine without a name"


def machine_name() -> str:
    """Return this machine's short name in its network, which rows tell: what stands before the first point."""
    return host().partition(".")[0] or host()


@cache
def user() -> str:
    """Return the name of the user, or the number where there is no name."""
    try:
        return getpass.getuser()
    except (OSError, KeyError, ImportError):
        return str(os.getuid()) if sys.platform != "win32" else "somebody"


def born(pid: int) -> int:
    """Return when a process began, in the system's ticks, since its number may be another's later; 0: unknown.

    Raises ProcessLookupError where there is no such process.
    """
    try:
        fields = Path(f"/proc/{pid}/stat").read_text(encoding="ascii", errors="replace").rpartition(")")[2].split()
    except OSError:
        if boot() is not None:  # Linux, which would have said it
            raise ProcessLookupError(pid) from None
        if sys.platform != "win32":  # where the signal 0 would end it
            try:
                os.kill(pid, 0)
            except PermissionError:
                pass
            except OverflowError:
                raise ProcessLookupError(pid) from None
        return 0
    if fields[0] in "ZX":  # it has ended, and nobody has asked how
        raise ProcessLookupError(pid)
    return int(fields[19])


def has_ended(pid: int, since: int) -> bool:
    """Tell whether the process of this machine that had this number, and was `born` at `since`, has ended."""
    try:
        return born(pid) != since
    except ProcessLookupError:
        return True
