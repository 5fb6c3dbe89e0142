"""Offer `firsthit gate` and `bless`: hold a config against its blessed baseline, and make that baseline."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from harness.commands import Add, telling
from harness.commands.answers import gates
from harness.commands.machine import Answer, add_json
from harness.commands.options import add_history, add_jobs, add_wait, add_yes, history_of, tell, typed, writable
from harness.commands.printer import Printer
from harness.contract import FirsthitError, plural
from harness.experiment import toml_file
from harness.experiment.shipped import located
from harness.gate import against, baseline, chosen
from harness.gate.about import cell_slot
from harness.gate.against import Compared, Other
from harness.gate.baseline import Baseline
from harness.gate.checked import Checked, Prepared, prepare
from harness.gate.chosen import Only
from harness.gate.entries import slot_of
from harness.gate.foretold import foretold
from harness.gate.judge import Judged, Verdict, exit_code, rank, unloaded
from harness.gate.keep import Keeping, keeping
from harness.gate.pictures import Before, blessed_in, rows_in
from harness.results.lock import Lock


def add_parsers(add: Add) -> None:
    parser = add(
        "gate",
        "firsthit gate configs/gate.toml --junit gate.xml",
        "Check every cell of a config (untimed) and hold errors, wrong rays, claims and evaluations "
        "against a blessed baseline. Exit codes: 0 nothing got worse, 1 a row regressed or is missing, 2 usage, "
        "3 a row could not be run or compared.",
    )
    _add_shared(parser)
    parser.add_argument(
        "--only",
        action="append",
        default=[],
        metavar="TEXT",
        help="judge only rows whose name holds TEXT, in which * stands for any characters; the whole name of a row "
        "chooses that row alone; may be repeated",
    )
    telling.add_outputs(parser)
    parser.add_argument(
        "--against",
        metavar="REV",
        help="hold errors, wrong rays, claims, evaluations and speed against this git revision instead of a baseline "
        "(beside it, where --baseline is given); REV is of the repository that holds the folder for --plugins, else of "
        "this project. Both revisions' programs run on this machine; CONFIG is read as it stands now for both",
    )
    parser.add_argument("--keep", action="store_true", help="keep the figures by commit, for `firsthit history`")
    add_history(parser)
    add_json(parser)
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
    add_jobs(parser)
    add_wait(parser)
    add_yes(parser)


def _path(options: argparse.Namespace) -> Path:
    """Return the path of the baseline's file: --baseline if it is given, else baselines/NAME.toml beside NAME.toml."""
    path: Path = options.baseline or options.config.parent / "baselines" / options.config.name
    return path


def _prepare(options: argparse.Namespace, printer: Printer) -> Prepared:
    return prepare(options.config, options.plugins, options.device or (), printer, options.yes)


def _lock(options: argparse.Namespace, prepared: Prepared) -> Lock:
    return prepared.lock(options.runs, typed(), options.wait, Printer())


def _gate(options: argparse.Namespace) -> int | Answer:
    options.typed, options.config = options.config, located(options.config)
    toml_file.read(options.config)  # a config that cannot be read is told before a baseline of it is missed
    for path in filter(None, (options.junit, options.markdown)):
        writable(path)
    telling.ready_to_draw(options)
    path = _path(options)
    before = baseline.read(path) if options.baseline or options.against is None else None
    other = _other(options) if options.against is not None else None
    only = Only(tuple(options.only), _known(before, other))
    kept = _keeping(options, path) if options.keep else None
    printer = Printer()
    prepared = _prepare(options, printer).chosen(only)
    before = before and only.narrowed(before, map(slot_of, prepared.whole))
    hopeless = _hopeless(options, prepared, before, path) if before else []
    if not other and hopeless and len(hopeless) == len(prepared.planned):
        return _tell(options, prepared, hopeless, before, path)
    with _lock(options, prepared) as lock:
        checked = prepared.check(lock, printer, options.force)
        if kept:
            _keep(kept, checked)
        judged = checked.judged(before) if before else []
        compared = against.compare(checked, other, only, Printer(), lock, options.force) if other else None
    return _tell(options, checked, judged + (compared.judged if compared else []), before, path, compared)


def _hopeless(options: argparse.Namespace, prepared: Prepared, before: Baseline, path: Path) -> list[Judged]:
    """Judge the rows that cannot be held against a baseline, and say so before anything runs."""
    hopeless = prepared.incomparable(before)
    if told := foretold(hopeless, len(prepared.planned), options.config, path):
        print(told, file=sys.stderr)
    return hopeless


def _tell(
    options: argparse.Namespace,
    prepared: Prepared,
    judged: list[Judged],
    before: Baseline | None,
    path: Path,
    compared: Compared | None = None,
) -> int | Answer:
    """Draw and tell the verdicts in every form that is asked for, and return the exit code, or the answer that has it.

    `prepared` is a Checked, if anything ran. `before` is the baseline that `path` holds, None if nothing was held
    against it.
    """
    judged.sort(key=rank)
    ran = prepared if isinstance(prepared, Checked) else None
    code = exit_code(judged, ran.unfinished if ran else ()) or (3 if prepared.catalog.broken else 0)
    shown = telling.drawn(options, ran, judged, _answers_before(ran, before, compared)) if ran else {}
    held = " and ".join([str(path)] * bool(before) + [f"revision {options.against}"] * bool(options.against))
    about, more = telling.about_rows(options, prepared, judged, shown), compared.told if compared else None
    shown_too = sorted([*judged, *unloaded(prepared.catalog.broken, judged)], key=rank)
    telling.tell(options, prepared, shown_too, held, code, about, more)
    if any(j.verdict is Verdict.INCOMPARABLE for j in shown_too):
        print("firsthit: incomparable is no pass", file=sys.stderr)
    if judged and all(j.verdict is Verdict.NEW for j in judged):
        told = "all rows are new, and nothing was compared, which is no pass; `firsthit bless` makes a baseline of them"
        print(f"firsthit: {told}", file=sys.stderr)
    if options.json:
        held_against, broken = (path if before else None, options.against), prepared.catalog.broken
        return Answer(gates.gate(options.config, *held_against, judged, about, compared, broken), code)
    return code


def _other(options: argparse.Namespace) -> Other:
    """Find the revision that --against names, before anything is run."""
    return against.at(options.against, options.config, options.plugins, options.device or (), Printer(), options.yes)


def _known(before: Baseline | None, other: Other | None) -> frozenset[str]:
    """Return the slots that are known beside those of the config, some of which may be gone from it."""
    blessed = chosen.among(before) if before else frozenset()
    return blessed | (other.slots if other else frozenset())


def _answers_before(checked: Checked, before: Baseline | None, compared: Compared | None) -> Before:
    """Make the function that finds what a row answered before: at the other revision, or as it was blessed."""
    blessed = blessed_in(before or Baseline(), checked.folder)
    there = rows_in(compared.stored(), compared.folder, f"at {compared.name}") if compared else blessed
    return lambda judged, row: (blessed if judged.slot == cell_slot(judged) else there)(judged, row)


def _keeping(options: argparse.Namespace, path: Path) -> Keeping:
    """Say which commit the rows will be kept by.

    Raises FirsthitError, before anything runs, where there is none, or where not all rows would be kept.
    """
    if options.only:
        raise FirsthitError("--keep keeps all rows of a config: leave out --only")
    folder = history_of(options, options.config)
    return keeping(options.plugins, options.config, folder, [path, options.runs])


def _keep(kept: Keeping, checked: Checked) -> None:
    """Keep the rows, and say where and, of a dirty tree, why they will be drawn apart."""
    for path in kept.keep(checked):
        tell(f"firsthit: kept {path}")
    if kept.because:
        more = f" and {len(kept.because) - 1} more" if len(kept.because) > 1 else ""
        reason = f"{kept.because[0]}{more} not as committed"
        tell(f"firsthit: kept apart from the commits' line, since the tree has {reason}")


def _bless(options: argparse.Namespace) -> int:
    """Run the config's cells, and keep their rows as the baseline. Raises FirsthitError if the reason is empty."""
    if not options.reason.strip():
        raise FirsthitError("--reason: say why the results are as they should be")
    options.config = located(options.config)
    path = _path(options)
    _blessed_so_far(path)  # a damaged one is told before anything runs
    printer = Printer()
    prepared = _prepare(options, printer)
    with _lock(options, prepared) as lock:
        made = prepared.check(lock, printer, options.force).blessed(options.reason.strip())
        lock.take()  # also where nothing was run: what another blesses meanwhile would be lost
        baseline.write(path, baseline.merged(_blessed_so_far(path), made))
    total = sum(map(len, made.rows.values()))
    print(f"{path}: {plural(total, 'row')} blessed on {', '.join(facts['name'] for facts in made.devices.values())}")
    return 0


def _blessed_so_far(path: Path) -> Baseline:
    return baseline.read(path) if path.exists() else Baseline()
