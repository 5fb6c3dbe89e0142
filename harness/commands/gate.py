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
from harness.gate.baseline import Baseline
from harness.gate.checked import Checked, Prepared, prepare
from harness.gate.foretold import foretold
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
    parser.add_argument("--against", metavar="REV", help="also time every cell against this git revision's program")
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


def _prepare(options: argparse.Namespace) -> Prepared:
    return prepare(options.config, options.plugins, options.device or ())


def _check(options: argparse.Namespace, prepared: Prepared) -> Checked:
    return prepared.check(options.runs, Printer(), options.force)


def _gate(options: argparse.Namespace) -> int:
    options.config = located(options.config)
    for path in filter(None, (options.junit, options.markdown)):
        writable(path)
    path = _path(options)
    before = baseline.read(path)
    prepared = _prepare(options)
    hopeless, total = prepared.incomparable(before), len(prepared.planned)
    if told := foretold(hopeless, total, options.config, path):
        print(told, file=sys.stderr)
    if len(hopeless) == total and not options.against:
        judged = sorted(hopeless, key=rank)
        _tell(options, prepared, judged, path, exit_code(judged, ()))
        return exit_code(judged, ())
    checked = _check(options, prepared)
    judged = checked.judged(before)
    if options.against:
        judged += against.speeds(checked, options.against, options.config, options.plugins)
    judged.sort(key=rank)
    code = exit_code(judged, checked.unfinished)
    _tell(options, checked, judged, path, code)
    return code


def _tell(options: argparse.Namespace, prepared: Prepared, judged: list[Judged], path: Path, code: int) -> None:
    """Write the files that are asked for, and then print the table."""
    title = prepared.experiment.name
    if options.junit:  # files come first, since the table's reader may go away
        write_atomically(options.junit, outputs.junit(judged, title).encode())
    if options.markdown:
        write_atomically(options.markdown, outputs.markdown(judged, title, path, code).encode())
    print(outputs.table(judged))
    if options.github:
        kernels = {name: plugin.folder / "kernel.glsl" for name, plugin in prepared.catalog.plugins.items()}
        if written := outputs.github(judged, kernels):
            print(written)
    if any(j.verdict is Verdict.INCOMPARABLE for j in judged):
        print("firsthit: incomparable is no pass", file=sys.stderr)


def _bless(options: argparse.Namespace) -> int:
    """Run the config's cells, and keep their rows as the baseline. Raises FirsthitError if the reason is empty."""
    if not options.reason.strip():
        raise FirsthitError("--reason: say why the results are as they should be")
    options.config = located(options.config)
    path = _path(options)
    old = baseline.read(path) if path.exists() else Baseline()
    made = _check(options, _prepare(options)).blessed(options.reason.strip())
    baseline.write(path, baseline.merged(old, made))
    total = sum(map(len, made.rows.values()))
    print(f"{path}: {total} rows blessed on {', '.join(facts['name'] for facts in made.devices.values())}")
    return 0
