"""Pack a run into one file, and read it from there as from its folder.

The file is a zip archive; any program that unpacks one gives the run's folder. Its members, run by run:

    archive.json             FORMAT, the name of the run, those of all runs that are packed, and whether with truth
    RUN/plan.json            what the run set out to do
    RUN/cells/KEY.json       the rows of cells that the plan names, from files and Parquet parts alike
    RUN/arrays/KEY.npz       their answers ray by ray
    RUN/studies/KEY.json     the studies that the plan names
    RUN/truth/HASH.npz       the oracle's answers, on request

A run that collects others is packed with these. The same run gives the same bytes, with one version of zlib: members
have no times. Reading trusts nothing: other members are never written, none lies outside the folder, sizes are limited,
and a member that is damaged becomes a file that is damaged, which its reader names as it names any other.
"""

from __future__ import annotations

import contextlib
import os
import re
import shutil
import zipfile
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, BinaryIO, TypedDict

from harness.contract import FirsthitError
from harness.results import declared, npz, plan_file, sealed
from harness.results.store import Store
from harness.results.writing import replacing, temporary_folder

FORMAT = 1
FACTS = "archive.json"
LARGEST = 2**40  # bytes of an archive
MOST_MEMBERS = 5_000_000
TIMES_LARGER = 200  # times an archive's own bytes: what it may unpack to; rows are packed to a tenth
AT_LEAST = 2**26  # bytes that each archive may unpack to
_CHUNK = 2**20
_MEMBER = re.compile(r"plan\.json|(?:cells|studies)/[0-9A-Za-z]{1,64}\.json|(?:arrays|truth)/[0-9A-Za-z]{1,64}\.npz")


class _Facts(TypedDict):
    """Declare archive.json."""

    format: int
    run: str
    runs: list[str]
    truth: bool


_CHECK = declared.checker(_Facts)


def pack(folder: Path, target: Path, truth: bool = False) -> int:
    """Pack a run, and those that it collects, into the file `target`; return how many files of it that holds.

    With `truth` the oracle's answers that the folder keeps are packed too. A damaged file is packed as it is. Raises
    FirsthitError where the folder holds no run, or the file cannot be written or lies in the run.
    """
    if target.resolve().is_relative_to(folder.resolve()):
        raise FirsthitError(f"{target} lies in the run that is to be packed; name a file outside it")
    runs, count = _runs(folder), 0
    facts = {"format": FORMAT, "run": runs[0].name, "runs": [one.name for one in runs], "truth": truth}
    with replacing(target) as temporary, zipfile.ZipFile(temporary, "w") as packed:
        packed.writestr(_entry(FACTS), sealed.sealed(facts))
        for run in runs:
            store = Store(run)
            for name in _files(store, truth):
                _pack(packed, store, name)
                count += 1
    return count


def _pack(packed: zipfile.ZipFile, store: Store, name: str) -> None:
    """Pack a file of a run. One that cannot be read is packed as an empty one, which its reader finds damaged."""
    entry = _entry(f"{store.folder.name}/{name}")
    inner, _, key = name.partition("/")
    try:
        if inner == "cells":
            packed.writestr(entry, store.text(Path(key).stem))
        else:
            with (
                sealed.opened(store.folder / name, npz.LARGEST) as file,
                packed.open(entry, "w", force_zip64=True) as to,
            ):
                shutil.copyfileobj(file, to, _CHUNK)
    except ValueError:
        packed.writestr(entry, b"")


def _entry(name: str) -> zipfile.ZipInfo:
    """Return what an archive says of a member: the same whenever and by whomever it is packed."""
    entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
    entry.compress_type = zipfile.ZIP_STORED if name.endswith(".npz") else zipfile.ZIP_DEFLATED
    entry.external_attr, entry.create_system = 0o644 << 16, 3
    return entry


def _runs(folder: Path) -> list[Path]:
    """Return a run's folder, and those of the runs that it collects and that are there. Raises FirsthitError."""
    if not _is_name(folder.name):
        folder = folder.resolve()
    parts = [folder.parent / name for name in _plan(folder).get("include", ())]
    return [folder, *(part for part in parts if (part / "plan.json").exists())]


def _plan(folder: Path) -> Mapping[str, Any]:
    try:
        return plan_file.read(folder / "plan.json")
    except FileNotFoundError:
        raise FirsthitError(f"there is no run folder {folder}; `firsthit run CONFIG` makes one under runs/") from None
    except (OSError, ValueError) as error:
        raise FirsthitError(f"{folder / 'plan.json'} is damaged ({sealed.problem(error)})", exit_code=3) from None


def _files(store: Store, truth: bool) -> list[str]:
    """List the files of a run that are packed, by their paths in its folder; rows follow in the plan's order."""
    plan = _plan(store.folder)
    keys = dict.fromkeys(cell["key"] for cell in (*plan["cells"], *plan.get("families", ())))
    named = ["plan.json", *(f"arrays/{key}.npz" for key in keys)]
    named += [f"studies/{study['key']}.json" for study in plan.get("studies", ())]
    named += [f"truth/{path.name}" for path in (store.folder / "truth").glob("*.npz")] if truth else []
    there = sorted(name for name in named if (store.folder / name).exists())
    rows = set(store.keys())
    return [name for name in (*there, *(f"cells/{key}.json" for key in keys if key in rows)) if _MEMBER.fullmatch(name)]


def _is_name(name: str) -> bool:
    """Tell whether a text can be the name of a run's folder on every system, and leads nowhere else."""
    return (
        0 < len(name) <= 255 and name.isprintable() and not name.startswith(".") and not set('/\\:<>"|?*') & set(name)
    )


@contextlib.contextmanager
def opened(run: Path) -> Iterator[Path]:
    """Yield the folder of a run: `run` itself or, of an archive, a folder that holds its files while the block runs.

    Raises FirsthitError where `run` is a file and no archive of a run, or cannot be unpacked. An error that is raised
    within the block names the archive instead of that folder.
    """
    if not run.is_file():
        yield run
        return
    with temporary_folder(".firsthit-archive") as made:
        folder = _unpacked(run, made)
        try:
            yield folder
        except FirsthitError as error:
            raise FirsthitError(str(error).replace(str(folder), str(run)), exit_code=error.exit_code) from None


@contextlib.contextmanager
def all_opened(runs: Iterable[Path]) -> Iterator[list[Path]]:
    """Yield the folders of several runs, as `opened` does each."""
    with contextlib.ExitStack() as stack:
        yield [stack.enter_context(opened(run)) for run in runs]


def _unpacked(archive: Path, made: Path) -> Path:
    """Unpack an archive into the folder `made`; return the folder of its run. Raises FirsthitError."""
    try:
        with sealed.opened(archive, LARGEST) as file, zipfile.ZipFile(file) as packed:
            return _extracted(packed, os.fstat(file.fileno()).st_size, made)
    except zipfile.BadZipFile as error:
        told = f"{archive} is no run folder, and no whole archive of one ({sealed.problem(error)})"
        raise FirsthitError(f"{told}; `firsthit archive RUN` makes one", exit_code=3) from None
    except npz.DAMAGE as error:
        told = sealed.problem(error) or type(error).__name__
        raise FirsthitError(f"cannot read the archive {archive}: {told}", exit_code=3) from None


def _extracted(packed: zipfile.ZipFile, size: int, made: Path) -> Path:
    """Write the members that an archive of `size` bytes may have. Raises ValueError, OSError or one of npz.DAMAGE."""
    members = {entry.filename: entry for entry in packed.infolist()}
    if len(packed.infolist()) > MOST_MEMBERS or len(members) != len(packed.infolist()):
        raise ValueError("it has too many members, or two of one name")
    if FACTS not in members or members[FACTS].file_size > sealed.LARGEST:
        raise ValueError(f"it has no {FACTS}: it is no archive of a run, or not a whole one")
    facts = sealed.unsealed(packed.read(FACTS))
    _CHECK(facts, FACTS)
    if facts["format"] != FORMAT:
        raise ValueError(f"its format is {facts['format']}, not {FORMAT}")
    if facts["run"] not in facts["runs"] or not all(map(_is_name, facts["runs"])):
        raise ValueError(f"{FACTS} names no run")
    wanted = {name: entry for name, entry in members.items() if _is_wanted(name, facts["runs"])}
    total, most = sum(entry.file_size for entry in wanted.values()), max(AT_LEAST, TIMES_LARGER * size)
    if total > most:
        raise ValueError(f"it would unpack to {total:,} bytes, more than {most:,}, {TIMES_LARGER} times its own")
    for name, entry in wanted.items():
        path = made / name
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open("wb") as file:
            _write_member(packed, entry, file)
    return made / str(facts["run"])


def _is_wanted(name: str, runs: list[str]) -> bool:
    run, _, inner = name.partition("/")
    return run in runs and _MEMBER.fullmatch(inner) is not None


def _write_member(packed: zipfile.ZipFile, entry: zipfile.ZipInfo, file: BinaryIO) -> None:
    """Write what can be read of a member. Of a damaged one that is its beginning, which its reader finds damaged.

    Raises OSError where the file cannot be written.
    """
    if entry.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        return
    with contextlib.ExitStack() as open_members:
        try:
            member = open_members.enter_context(packed.open(entry))
        except npz.DAMAGE:
            return
        while True:
            try:
                chunk = member.read(_CHUNK)
            except npz.DAMAGE:
                file.truncate(max(0, file.tell() - 1))  # all bytes may be there, and only their checksum not hold
                return
            if not chunk:
                return
            file.write(chunk)
