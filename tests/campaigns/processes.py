"""Run real processes of firsthit on small configs, and say of what they leave behind whether it is whole."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
import uuid
import zipfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from harness.devices.discovery import discover_devices
from tests.campaigns import frame
from tests.campaigns.frame import Fell

ROOT = Path(__file__).parents[2]
SEAM = Path(__file__).parent / "seam"
GONE = 20.0  # seconds within which no process of a command may be left
MARK = "FIRSTHIT_CAMPAIGN"  # in the environment of all processes of a command
EARLY = (130, -2)  # Ctrl-C while the interpreter starts: its own traceback names no file of OURS
NOT_BEGUN = "Fatal Python error: init_"  # what Python says where it is stopped still earlier
OURS = ("harness", "surfaces", "methods", "reports", "firsthit")
UNFINISHED = ("failed", "timeout", "crashed")

VIEWS = """title = "Views"
surfaces = ["sphere"]
sizes = [8]
devices = ["{device}"]
stages = ["compute"]
prepass = ["none", "beams"]
baseline = "newton"
[[method]]
name = "newton"
[[method]]
name = "null"
[directions]
count = 2
seed = 1
[accuracy]
size = 4
max_wrong_share = 1.0
[budget]
seconds = 0.001
rounds = 3
"""
HARD = """title = "Hard rays"
surfaces = ["sphere"]
sizes = [8]
devices = ["{device}"]
stages = {stages}
families = ["tangent_plane"]
studies = ["torus_along_rays"]
baseline = "newton"
[[method]]
name = "newton"
[[method]]
name = "null"
[accuracy]
size = 4
max_wrong_share = 1.0
[budget]
seconds = 0.001
rounds = 2
"""
GATED = """title = "Gated"
surfaces = ["sphere"]
sizes = [8]
devices = ["{device}"]
families = ["tangent_plane"]
[[method]]
name = "newton"
[[method]]
name = "sturm"
[accuracy]
size = 4
max_wrong_share = 1.0
"""
WHOLE = """title = "Views and hard rays"
include = ["views.toml", "hard.toml"]
"""


def device_here() -> str:
    """Return the device that campaigns run on: llvmpipe where it is, since it builds fastest, else any usable one."""
    found = [info.name for info in discover_devices({"opengl", "opencl", "any"}) if not info.problem]
    if not found:
        raise Fell("no device on this machine can be used")
    return next((name for name in found if "llvmpipe" in name), found[0])


def write_configs(folder: Path) -> None:
    """Write the configs of campaigns into a folder: whole.toml, which includes two others, and gated.toml."""
    device = device_here()
    stages = '["rays", "raster"]' if device.startswith("opengl") else '["rays"]'
    for name, text in (("views", VIEWS), ("hard", HARD), ("gated", GATED), ("whole", WHOLE)):
        (folder / f"{name}.toml").write_text(text.format(device=device, stages=stages))


@dataclass
class Command:
    """Hold a process of `firsthit` that runs in a session of its own, in `folder`."""

    folder: Path
    arguments: Sequence[str]
    seam: Mapping[str, Any] | None = None
    environment: Mapping[str, str] = field(default_factory=dict)
    prefix: Sequence[str] = ()  # of the command line, as `nsenter …`
    limits: Any = None  # what is called in the process before it becomes the command
    logs: Path | None = None  # the folder that keeps what the command tells; else the one around `folder`
    piped: bool = False  # what it tells goes through a pipe, where files may not grow

    def __post_init__(self) -> None:
        self.token = uuid.uuid4().hex
        self._out, self._err = ((self.logs or self.folder.parent) / f"{self.token}.{name}" for name in ("out", "err"))
        paths = [str(ROOT), *([str(SEAM)] if self.seam else [])]
        environment = {**os.environ, **self.environment, MARK: self.token, "PYTHONPATH": os.pathsep.join(paths)}
        if self.seam:
            environment["FIRSTHIT_SEAM"] = json.dumps({"below": str(self.folder), **self.seam})
        with self._out.open("wb") as out, self._err.open("wb") as err:
            self.process = subprocess.Popen(
                [*self.prefix, sys.executable, "-m", "harness.start", *self.arguments],
                cwd=self.folder,
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE if self.piped else out,
                stderr=subprocess.STDOUT if self.piped else err,
                start_new_session=True,
                preexec_fn=self.limits,
            )

        frame.ENDINGS.append(self.end)

    def processes(self) -> list[int]:
        """List the processes of the command that have not ended, the first one and all that it started."""
        mark, found = f"{MARK}={self.token}".encode(), []
        for entry in Path("/proc").glob("[0-9]*"):
            try:
                if mark in (entry / "environ").read_bytes().split(b"\0"):
                    state = (entry / "stat").read_text().rpartition(")")[2].split()[0]
                    found += [int(entry.name)] if state != "Z" else []
            except OSError:  # it has ended since
                continue
        return sorted(found)

    def workers(self) -> list[int]:
        """List the processes that the command has started."""
        return [pid for pid in self.processes() if pid != self.process.pid]

    def told(self) -> str:
        """Return what it has told so far on standard error, then on standard output."""
        return "".join(path.read_text(errors="replace") for path in (self._err, self._out))

    def ended(self, within: float = 300.0) -> tuple[int, str]:
        """Wait for the end; return the exit code and standard error, then standard output.

        Raises Fell where the command hangs, shows a traceback or leaves a process behind.
        """
        try:
            if self.piped:
                self._out.write_bytes(self.process.communicate(timeout=within)[0])
            code = self.process.wait(within)
        except subprocess.TimeoutExpired:
            told = self._err.read_text(errors="replace")
            self.end()
            raise Fell(f"`firsthit {' '.join(self.arguments)}` hangs; it told {told[-2000:]}") from None
        told = self.told()
        if NOT_BEGUN in told:
            code = -2  # as where Python is a little further on; it ends with 1
        if "Traceback" in told and (any(str(ROOT / room) in told for room in OURS) or code not in EARLY):
            self.end()
            raise Fell(f"`firsthit {' '.join(self.arguments)}` shows a traceback: {told[-3000:]}")
        start = time.monotonic()
        while left := self.processes():
            if time.monotonic() - start > GONE:
                names = [Path(f"/proc/{pid}/cmdline").read_bytes().replace(b"\0", b" ").decode() for pid in left]
                self.end()
                raise Fell(f"`firsthit {' '.join(self.arguments)}` leaves processes behind: {names}")
            time.sleep(0.02)
        return code, told

    def end(self) -> None:
        """Kill what is left of the command."""
        for pid in self.processes():
            try:
                os.kill(pid, signal.SIGKILL)
            except OSError:
                continue
        self.process.wait()


def done(folder: Path, *arguments: str, codes: Sequence[int] = (0,), **more: Any) -> tuple[int, str]:
    """Run a command to its end and return its exit code and what it told. Raises Fell for a code not among `codes`."""
    code, told = Command(folder, arguments, **more).ended()
    if code not in codes:
        raise Fell(f"`firsthit {' '.join(arguments)}` ended with {code}, not {codes}: {told[-2000:]}")
    return code, told


def files(folder: Path) -> Iterator[Path]:
    """Yield all files below a folder, sorted."""
    yield from sorted(path for path in folder.rglob("*") if path.is_file() and not path.is_symlink())


def is_litter(path: Path) -> bool:
    """Tell whether a file or folder is one that a command makes on the way to another: its name begins with a dot."""
    return any(part.startswith(".") and part != ".lock" for part in path.parts)


def check_whole(folder: Path) -> None:
    """Raise Fell for a file below a folder that is half-written; litter on the way to a file may be."""
    for path in files(folder):
        relative = path.relative_to(folder)
        if is_litter(relative):
            continue
        try:
            _parse(path)
        except Exception as error:
            raise Fell(f"{relative} is half-written: {type(error).__name__}: {error}") from error


def _parse(path: Path) -> None:
    if path.suffix == ".npy":
        np.load(path, allow_pickle=False)
    elif path.suffix == ".npz":
        with np.load(path, allow_pickle=False) as stored:
            for name in stored.files:
                stored[name]
    elif path.suffix == ".json":
        json.loads(path.read_text(encoding="utf-8"))
    elif path.suffix in ENDS:
        start, end = ENDS[path.suffix]
        content = path.read_bytes().strip(b"\r\n")
        if not (content.startswith(start) and content.endswith(end)):
            raise ValueError(f"it has {len(content)} bytes, and ends with {content[-20:]!r}")
    elif path.suffix in (".zip",):
        zipfile.ZipFile(path).testzip()


ENDS = {
    ".pdf": (b"%PDF", b"%%EOF"),
    ".png": (b"\x89PNG", b"IEND\xaeB`\x82"),
    ".html": (b"<!", b"</html>"),
    ".svg": (b"<", b"</svg>"),
    ".parquet": (b"PAR1", b"PAR1"),
}


def rows(runs: Path) -> dict[str, bytes]:
    """Return the bytes of each stored row below a folder of runs, by its path there."""
    return {str(path.relative_to(runs)): path.read_bytes() for path in sorted(runs.glob("*/cells/[!.]*.json"))}


def facts(runs: Path) -> dict[str, Any]:
    """Return what rows below a folder of runs say that no clock decides, by their paths there, with their arrays.

    In which order work items put boxes into a queue changes from launch to launch, and with it how many lanes are idle.
    """
    found: dict[str, Any] = {}
    for name in rows(runs):
        row = json.loads((runs / name).read_text(encoding="utf-8"))
        clockless = {key: value for key, value in row.items() if key not in ("time", "build", "seconds", "environment")}
        found[name] = {key: value for key, value in clockless.items() if key != "checksum"}
        for level in (row.get("accuracy") or {}).get("lanes") or ():
            del level["idle"]
        if row["arrays"]:
            with np.load(runs / name.split("/")[0] / row["arrays"], allow_pickle=False) as stored:
                found[name]["arrays"] = {key: stored[key].tobytes() for key in stored.files}
    return found


def check_same(found: Mapping[str, Any], undisturbed: Mapping[str, Any]) -> None:
    """Raise Fell where facts are not those of the undisturbed run."""
    if missing := sorted(undisturbed.keys() - found.keys()):
        raise Fell(f"rows are lost: {missing}")
    if more := sorted(found.keys() - undisturbed.keys()):
        raise Fell(f"rows are there that the undisturbed run has not: {more}")
    for name, one in found.items():
        for key in one.keys() | undisturbed[name].keys():
            if one.get(key) != undisturbed[name].get(key):
                told = f"{str(one.get(key))[:300]} and not {str(undisturbed[name].get(key))[:300]}"
                raise Fell(f"{name} has another {key}: {told}")


def check_clean(folder: Path) -> None:
    """Raise Fell where a command that was completed leaves litter of those that were stopped before it."""
    left = [str(p.relative_to(folder)) for p in folder.rglob("*") if is_litter(Path(p.name))]
    left += [str(p.relative_to(folder)) for p in folder.glob("runs/*/begun/*") if not is_litter(Path(p.name))]
    if left:
        raise Fell(f"litter is left: {sorted(left)}")
