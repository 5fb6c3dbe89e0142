"""Offer `firsthit gate` and `bless`: hold a config against its blessed baseline, and make that baseline."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from harness.commands import Add
from harness.commands.options import writable
from harness.commands.printer import Printer
from harness.contract import FirsthitError
from harness.experiment.shipped import located
from harness.gate import against, baseline, outputs
from harness.gate.against import Other
from harness.gate.baseline import Baseline
from harness.gate.checked import Checked, check
from harness.gate.judge import Judged, Verdict, exit_code, rank
from harness.results.writing import write_atomically


def add_parsers(add: Add) -> None:
    parser = add(
        "gate",
        "firsthit gate configs/gate.toml --junit gate.xml",
        "Check every cell of a config (untimed) and hold errors, wrong rays, claims and evaluations "
        "against a blessed baseline. Exit codes: 0 nothing got worse, 1 a row regressed or is missing, 2 usage, "
        "3 a row could not be run or compared.",
    )
    _add_shared(parser)
    parser.add_argument("--junit", type=Path, metavar="FILE", help="write the verdicts as JUnit XML")
    parser.add_argument("--markdown", type=Path, metavar="FILE", help="write a summary as Markdown")
    parser.add_argument("--github", action="store_true", help="print annotations for GitHub Actions")
    parser.add_argument(
        "--against",
        metavar="REV",
        help="hold errors, wrong rays, claims, evaluations and speed against this git revision instead of a baseline "
        "(beside it, where --baseline is given); REV is of the repository that holds the folder for --plugins, else of "
        "this project. Both revisions' programs run on this machine; CONFIG is read as it stands now for both",
    )
    parser.set_defaults(run=_gate)

    parser = add(
        "bless",
        'firsthit bless configs/gate.toml --reason "newton stops at a smaller step"',
        "Check every cell of a config (untimed) and write its results into the baseline, for the devices "
        "here; what the baseline holds of other machines is kept.",
    )
    _add_shared(parser)
    parser.add_argument("--reason", required=True, metavar="TEXT", help="why the results are as they should be")
    parser.set_defaults(run=_bless)


def _add_shared(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("config", type=Path, metavar="CONFIG", help="a TOML file, or a name of `firsthit list configs`")
    parser.add_argument(
        "--baseline", type=Path, metavar="FILE", help="default: baselines/NAME.toml beside the config NAME.toml"
    )
    parser.add_argument("--runs", type=Path, default=Path("runs"), metavar="DIR", help="rows go here (default: runs)")
    parser.add_argument("--device", action="append", metavar="NAME", help="on this device only; may be repeated")
    parser.add_argument("--force", action="store_true", help="run every cell again")


def _path(options: argparse.Namespace) -> Path:
    """Return the path of the baseline's file: --baseline if it is given, else baselines/NAME.toml beside NAME.toml."""
    path: Path = options.baseline or options.config.parent / "baselines" / options.config.name
    return path


def _check(options: argparse.Namespace) -> Checked:
    return check(options.config, options.plugins, options.device or (), options.runs, Printer(), options.force)


def _gate(options: argparse.Namespace) -> int:
    options.config = located(options.config)
    for path in filter(None, (options.junit, options.markdown)):
        writable(path)
    path = _path(options)
    before = baseline.read(path) if options.baseline or not options.against else None
    other = _other(options) if options.against else None
    checked = _check(options)
    judged = checked.judged(before) if before else []
    compared = against.compare(checked, other, Printer(), options.force) if other else None
    judged += compared.judged if compared else []
    judged.sort(key=rank)
    code = exit_code(judged, checked.unfinished)
    _tell(options, checked, judged, path if before else options.against, code)
    if compared:
        print(compared.told())
    return code


def _other(options: argparse.Namespace) -> Other:
    """Find the revision that --against names, before anything is run."""
    return against.at(options.against, options.config, options.plugins, options.device or (), Printer())


def _tell(options: argparse.Namespace, checked: Checked, judged: list[Judged], held: Path | str, code: int) -> None:
    """Write the files that are asked for, and then print the table.

    `held` names what the rows are held against: a baseline's file, or a revision.
    """
    title = checked.experiment.name
    if options.junit:  # files come first, since the table's reader may go away
        write_atomically(options.junit, outputs.junit(judged, title).encode())
    if options.markdown:
        write_atomically(options.markdown, outputs.markdown(judged, title, held, code).encode())
    print(outputs.table(judged))
    if options.github:
        kernels = {name: plugin.folder / "kernel.glsl" for name, plugin in checked.catalog.plugins.items()}
        if written := outputs.github(judged, kernels):
            print(written)
    if any(j.verdict is Verdict.INCOMPARABLE for j in judged) and isinstance(held, Path):
        print("firsthit: incomparable is no pass; bless the baseline on this machine and device", file=sys.stderr)


def _bless(options: argparse.Namespace) -> int:
    """Run the config's cells, and keep their rows as the baseline. Raises FirsthitError if the reason is empty."""
    if not options.reason.strip():
        raise FirsthitError("--reason: say why the results are as they should be")
    options.config = located(options.config)
    path = _path(options)
    old = baseline.read(path) if path.exists() else Baseline()
    made = _check(options).blessed(options.reason.strip())
    baseline.write(path, baseline.merged(old, made))
    total = sum(map(len, made.rows.values()))
    print(f"{path}: {total} rows blessed on {', '.join(facts['name'] for facts in made.devices.values())}")
    return 0
