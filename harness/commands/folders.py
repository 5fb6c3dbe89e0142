"""Offer `firsthit merge`, `archive` and `clean`: what one does with finished runs as wholes."""

from __future__ import annotations

import argparse
import contextlib
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path

from harness import console
from harness.commands import Add
from harness.commands.options import add_wait, tell, tell_wrong, typed, writable
from harness.contract import FirsthitError, plural
from harness.merging.clean import Unnamed, clean
from harness.merging.found import Left, lists_of
from harness.merging.merge import Merged, merge
from harness.results import archive
from harness.results.writing import temporary_folder

CONTRADICTED, NOT_ALL = 1, 3  # exit codes
NAMED = 2  # cells that a line names
SHOWN = 5  # files that `clean` lists of each kind


def add_parsers(add: Add) -> None:
    parser = add(
        "merge",
        "firsthit merge runs/quick.shard-*-of-16 -o runs/quick",
        "Join runs of one config to one run, which report, verify and publish read as any other: shards, or the runs "
        "of several machines. Rows are taken over as they are. Where one name stands for different devices, the "
        "machine is added: opencl:nvidia@lab2. The first RUN states the config and the version of firsthit; what does "
        "not fit is named with its reason. Merging the same runs again changes nothing. Exit codes: 0 everything was "
        "merged, 1 two runs have other answers for one cell, 3 something does not fit or is damaged, and was left out.",
    )
    parser.add_argument(
        "folders", type=Path, metavar="RUN", nargs="+", help="a folder below runs/, or an archive of one"
    )
    help_ = "a new folder, or one that an earlier merge made and to which this one adds"
    parser.add_argument("-o", "--output", type=Path, metavar="DIR", required=True, help=help_)
    _add_truth(parser, "take over the oracle's answers too")
    add_wait(parser)
    parser.set_defaults(run=_merge)

    parser = add(
        "archive",
        "firsthit archive runs/quick -o quick.zip",
        "Pack a run into one zip file: its plan, the rows and studies that the plan names, and their answers ray by "
        "ray. `firsthit report`, `merge`, `verify`, `publish` and firsthit.load read the file as they read the folder. "
        "The same run gives the same bytes.",
    )
    parser.add_argument("folder", type=Path, metavar="RUN", help="a folder below runs/")
    parser.add_argument("-o", "--output", type=Path, metavar="FILE", required=True, help="the zip file")
    _add_truth(parser, "pack the oracle's answers too, by which `firsthit verify` checks all rows")
    parser.set_defaults(run=_archive)

    parser = add(
        "clean",
        "firsthit clean runs/quick --dry-run",
        "Remove the rows of a run's folder that its plan does not name, such as those of an older version or of "
        "another --device, with their answers, and studies of old keys. `firsthit why` then has no earlier results to "
        "tell of. Rows that the plan names stay.",
    )
    parser.add_argument("folders", type=Path, metavar="RUN", nargs="+", help="a folder below runs/")
    parser.add_argument("-n", "--dry-run", action="store_true", help="list what would be removed, and remove nothing")
    _add_truth(parser, "remove the oracle's answers too, which the next run makes anew")
    add_wait(parser)
    parser.set_defaults(run=_clean)


def _add_truth(parser: argparse.ArgumentParser, text: str) -> None:
    parser.add_argument("--truth", action="store_true", help=text)


@contextlib.contextmanager
def joined(runs: Sequence[Path], tell_step: Callable[[str], None]) -> Iterator[tuple[Path, list[str]]]:
    """Yield a folder with several runs merged while the block runs, and lines on what of them does not fit.

    Raises FirsthitError as `merge` does.
    """
    with temporary_folder(".firsthit-joined") as made:
        found = merge(runs, made / "runs", typed(), tell=tell_step)
        yield found.folder, [*_left_out(found.left), *_twice(found)]


def _merge(options: argparse.Namespace) -> int:
    """Merge runs; say what of them is not merged on standard error."""
    with console.working() as tell_step:
        found = merge(
            options.folders,
            options.output,
            typed(),
            truth=options.truth,
            wait=options.wait,
            tell=tell_step,
            doing=console.doing,
        )
    for line in (*_left_out(found.left), *_twice(found)):
        tell_wrong(f"firsthit: {line}")
    for run, count in found.elsewhere.items():
        tell(f"firsthit: {run}: {plural(count, 'cell')} that it skipped for want of a device were run by others")
    for line in filter(None, (found.shards, found.unpacked)):
        tell(f"firsthit: {line}")
    print(console.table(("run", "rows taken", "of cells"), [(run, *map(str, own)) for run, own in found.runs.items()]))
    rows = f"{found.rows} of {plural(found.cells, 'cell')} have a row"
    done = f"{plural(found.written, 'file')} written" if found.written else "nothing was new"
    print(f"{found.folder}: {rows}, on {', '.join(found.devices) or 'no device'}; {done}")
    if any(one.contradicts for one in found.twice):
        return CONTRADICTED
    return NOT_ALL if found.left else 0


def _left_out(left: Iterable[Left]) -> list[str]:
    """Say what was not merged: a line for each run and reason."""
    grouped: dict[tuple[str, str], list[str]] = {}
    for one in left:
        grouped.setdefault((one.run, one.reason), []).append(one.what)
    lines = []
    for (run, reason), what in grouped.items():
        if len(what) == 1:
            lines.append(f"{run}: {what[0]} was left out: {reason}")
        else:
            lines.append(
                f"{run}: {plural(len(what), 'cell')} were left out: {reason}; they are {lists_of(what, NAMED)}"
            )
    return lines


def _twice(found: Merged) -> list[str]:
    """Say which cells two runs have with other figures: one by one where they contradict each other, else counted."""
    lines = [f"{one.slot}: {one.kept} and {one.other} disagree; kept is {one.kept}'s row, since {one.why}"
             for one in found.twice if one.contradicts]  # fmt: skip
    alike = Counter((one.kept, one.other, one.why) for one in found.twice if not one.contradicts)
    for (kept, other, why), count in alike.items():
        cells = f"{plural(count, 'cell')} {'is' if count == 1 else 'are'}"
        lines.append(f"{cells} in {kept} and in {other}, with other times or figures; kept is {kept}'s, since {why}")
    return lines


def _archive(options: argparse.Namespace) -> int:
    count = archive.pack(options.folder, writable(options.output), options.truth)
    print(f"{options.output}: {plural(count, 'file')} of {options.folder}, {_size(options.output.stat().st_size)}")
    return 0


def _clean(options: argparse.Namespace) -> int:
    """Remove what no plan names, run by run, and list it. Raises FirsthitError as clean.clean does."""
    for folder in options.folders:
        if folder.is_file():
            raise FirsthitError(f"{folder} is a file; an archive holds only what the plan names")
        given = {"truth": options.truth, "dry": options.dry_run, "wait": options.wait}
        removed = clean(folder, typed(), **given, doing=console.doing)
        for line in _listed(removed):
            print(line)
        done = "would be removed" if options.dry_run else "removed"
        total = f"{plural(len(removed), 'file')}, {_size(sum(one.size for one in removed))}, {done}"
        print(f"{folder}: {total if removed else 'holds nothing that its plan does not name'}")
    return 0


def _listed(removed: Iterable[Unnamed]) -> list[str]:
    """Name files, the first few of each kind."""
    kinds: dict[str, list[Unnamed]] = {}
    for one in removed:
        kinds.setdefault(one.what.partition(":")[0], []).append(one)
    lines = []
    for kind, own in kinds.items():
        lines += [f"  {one.path}: {one.what}" for one in own[:SHOWN]]
        lines += [f"  and {len(own) - SHOWN} more: {kind}"] if len(own) > SHOWN else []
    return lines


def _size(count: int) -> str:
    """Write a number of bytes."""
    return f"{count / 1e6:.1f} MB" if count >= 1e5 else f"{count / 1e3:.1f} kB"
