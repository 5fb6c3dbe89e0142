"""Offer `firsthit plan`, `run`, `why` and `report`: what one does with a config and its results."""

from __future__ import annotations

import argparse
import contextlib
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from harness import console
from harness.commands import Add
from harness.commands.answers import experiments
from harness.commands.machine import Answer, add_json
from harness.commands.options import add_jobs, add_wait, add_yes, tell, tell_wrong, typed
from harness.commands.printer import Printer
from harness.contract import FirsthitError, plural
from harness.experiment import config, identity, plan
from harness.experiment.identity import Difference
from harness.experiment.shards import Share
from harness.experiment.size import cells_of
from harness.limits import Name
from harness.plugins import find_methods
from harness.results.begun import Begun
from harness.results.history import past_of
from harness.results.store import Row, Store
from harness.running.due import due, estimates
from harness.running.failures import first_line
from harness.running.run import Loaded, Read, load, read, remarks, run

FIGURES, TABLES = ("svg", "pdf", "png"), ("latex", "csv", "markdown")  # forms; reports.for_papers.files writes them


def add_parsers(add: Add) -> None:
    parser = add("plan", "firsthit plan quick")
    _add_config(parser)
    _add_shard(parser)
    add_yes(parser)
    add_json(parser)
    parser.set_defaults(run=_plan)

    parser = add("run", "firsthit run quick --retry failed")
    _add_config(parser)
    parser.add_argument("--force", action="store_true", help="run every cell again")
    parser.add_argument("--retry", choices=["failed"], help="run failed, timed out and crashed cells again")
    parser.add_argument("--device", action="append", metavar="NAME", help="run on this device only; may be repeated")
    help_ = (
        "run on the devices of a Dask cluster: HOST:PORT of its scheduler, local or local:N for one on this machine "
        "with N cores for the oracle, or a TOML file for Slurm"
    )
    parser.add_argument("--cluster", metavar="WHERE", help=help_)
    add_jobs(parser)
    _add_shard(parser)
    help_ = "how rows name this machine (default: its short name in its network); merged runs tell devices apart by it"
    parser.add_argument("--machine", type=_machine, metavar="NAME", help=help_)
    add_wait(parser)
    add_yes(parser)
    parser.set_defaults(run=_run)

    parser = add("why", "firsthit why runs/quick/cells/0123456789abcdef.json")
    parser.add_argument("cell", help="a cell's key (or its beginning), or its file")
    parser.add_argument("--runs", type=Path, default=Path("runs"), metavar="DIR", help="where to look (default: runs)")
    add_json(parser)
    parser.set_defaults(run=_why)

    parser = add(
        "report",
        "firsthit report runs/quick -o paper --figures svg,pdf --tables latex",
        "Write report.pdf, report.html, results.csv and results.parquet about a run, about what changed from one to "
        "another, or about three or more runs of one config, as of several machines, which are joined as `firsthit "
        "merge` joins them. Nothing is written into a run. With --figures and --tables there are also folders for a "
        "paper: a file for each figure and table, named by what it shows (figures/speed-error-torus.pdf, "
        "tables/results-torus.tex), with captions.md, and captions.tex to copy floats from. Figures are 84 mm wide, "
        "with text of 8 points; pictures are PNG, whatever the forms. The tables of LaTeX need booktabs and graphicx.",
    )
    help_ = "a folder below runs/, or an archive of one; of two runs, what changed from the first to the second"
    parser.add_argument("folders", type=Path, metavar="RUN", nargs="+", help=help_)
    help_ = "report on two runs of one config as on one, as on three or more: devices against each other"
    parser.add_argument("--together", action="store_true", help=help_)
    parser.add_argument(
        "--baseline",
        metavar="NAME",
        help="the method or variant that speed-ups are over (default: the config's, else ray_march)",
    )
    parser.add_argument(
        "--focus", metavar="NAME", help="the method or variant that the report is about (default: the config's)"
    )
    parser.add_argument("-o", "--output", type=Path, metavar="DIR", help="a folder (default: RUN.report, beside RUN)")
    parser.add_argument("--appendix", action="store_true", help="end the PDF with the tables that else only HTML has")
    for what, forms in (("figures", FIGURES), ("tables", TABLES)):
        told = f"write each of the {what} of a paper as a file too, in some of {', '.join(forms)}: FORM,FORM"
        parser.add_argument(f"--{what}", type=_forms(forms), default=(), metavar="FORM", help=told)
    parser.set_defaults(run=_report)


def _forms(known: Sequence[str]) -> Callable[[str], tuple[str, ...]]:
    """Return what reads a list of forms, separated by commas; an unknown one is an error that names the `known`."""

    def read(text: str) -> tuple[str, ...]:
        named = tuple(dict.fromkeys(form.strip().lower() for form in text.split(",") if form.strip()))
        unknown = next((form for form in named if form not in known), None)
        if unknown is not None or not named:
            raise argparse.ArgumentTypeError(f"unknown form {unknown or text!r}; known: {', '.join(known)}")
        return named

    return read


def _add_config(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("config", type=Path, metavar="CONFIG", help="a TOML file, or a name of `firsthit list configs`")
    parser.add_argument(
        "--runs", type=Path, default=Path("runs"), metavar="DIR", help="results go here (default: runs)"
    )


def _add_shard(parser: argparse.ArgumentParser) -> None:
    help_ = (
        "the K-th of N parts of the config, the same on each machine; what is compared stays together. Its results go "
        "into a folder of their own, NAME.shard-K-of-N, and `firsthit merge` joins them"
    )
    parser.add_argument("--shard", metavar="K/N", help=help_)


def _machine(text: str) -> str:
    """Read the name of a machine. Raises ArgumentTypeError for a text that is no name, or holds a blank or an @."""
    if problem := Name().broken(text):
        raise argparse.ArgumentTypeError(problem)
    if "@" in text or len(text.split()) != 1:
        raise argparse.ArgumentTypeError(f"{text[:40]!r} holds a blank or an @, which separate it from other words")
    return text


def _read(options: argparse.Namespace, printer: Printer) -> Read:
    devices, machine = (getattr(options, name, None) for name in ("device", "machine"))
    named = {"shard": options.shard, "machine": machine}
    return read(options.config, options.plugins, devices or (), printer, options.yes, **named)


def _plan(options: argparse.Namespace) -> int | Answer:
    """Tell each config's cells, and how long those that must run will take."""
    printer = Printer()
    loaded = load(_read(options, printer), printer)
    shares = zip(loaded.parts, loaded.shares(), strict=True)
    made = [_planned(part, share, loaded, options.runs) for part, share in shares]
    parts = [facts for facts, _ in made]
    failures = dict.fromkeys(reason for _, reasons in made for reason in reasons)
    for reason in failures.keys() - set(loaded.catalog.warnings):  # those were told already
        tell_wrong(f"firsthit: {reason}")
    code = 3 if failures else 0
    if options.json:
        return Answer(experiments.Plan(parts), code)
    for part in parts:
        print(console.table(("key", "cell", "state"), [(cell.key, cell.slot, _state(cell)) for cell in part.cells]))
        cells, seconds = plural(len(part.cells), "cell"), console.duration(part.seconds)
        print(f"{part.config}: {cells}, {part.to_run} to run, about {seconds}")
    return code


def _planned(
    part: config.Experiment, share: Share | None, loaded: Loaded, runs: Path
) -> tuple[experiments.PlanFacts, list[str]]:
    """Say which cells a config has, and which have a row below `runs`; on standard error what domains leave out.

    The second part has the reasons of the cells that fail before they run.
    """
    for told in remarks(part):
        tell(f"firsthit: {told}")
    cells, of = cells_of(part, loaded.catalog, loaded.devices), f"shard {loaded.shard} of " if loaded.shard else ""
    with console.doing(f"{part.path}: {of}{cells:,} cells; preparing them") as tell_step:
        only = share.groups if share else None
        planned = plan.plan(part, loaded.catalog, loaded.devices, tell=tell_step, only=only)
    store = Store(loaded.folder(runs, part))
    found = due(planned, store, asked=Begun(store.folder).again)
    for message in store.unreadable.values():
        tell_wrong(f"firsthit: {message}; `firsthit run` makes it again")
    seconds = estimates(found, store, part.config.budget.seconds)
    facts = experiments.PlanFacts(
        str(part.path),
        part.config.title,
        str(store.folder),
        [experiments.cell(p, found.kept.get(p.key), seconds.get(p.key, 0.0)) for p in planned],
        len(found.todo),
        sum(seconds.values()),
    )
    return facts, [p.failure for p in planned if p.failure is not None]


def _state(cell: experiments.CellFacts) -> str:
    waits = f"fails: {first_line(cell.reason)}" if cell.reason else "to run"
    return {"done": f"done: {cell.status}", "skip": f"skip: {cell.reason}"}.get(cell.state, waits)


def _run(options: argparse.Namespace) -> int:
    printer = Printer()
    again: dict[str, Any] = {"force": options.force, "retry_failed": options.retry == "failed", "wait": options.wait}
    given = _read(options, printer)
    with contextlib.ExitStack() as held:
        if options.cluster is not None:
            from harness.cluster import starting

            again["fleet"] = held.enter_context(starting.opened(options.cluster, given, printer.warned))
        found = run(given, options.runs, typed(), watcher=printer, **again)
    return 3 if found.unfinished or found.lost else 0


def _why(options: argparse.Namespace) -> int | Answer:
    """Tell what set a cell apart from its last result and its next, and what would make it run again now."""
    past = past_of(Path(options.cell).stem, options.runs)
    row, before, after = past.row, past.before, past.after
    since = None if after else identity.since(row["identity"], find_methods(options.plugins))
    if options.json:
        earlier = experiments.result(before, before, row) if before else None
        later = experiments.result(after, row, after) if after else None
        return Answer(experiments.why(row, earlier, later, since))
    print(f"{row['key']}  {row['slot']}\nrun {row['environment']['started']}: {row['status']}")
    if row["reason"]:
        print(f"reason: {row['reason']}")
    if not before and not after:
        print("the only result of this cell so far")
    if before:
        _print_changes("before", before, before, row)
    if after:
        _print_changes("after", after, row, after)
    if since is not None:
        _why_again(since)
    return 0


def _print_changes(word: str, other: Row, older: Row, newer: Row) -> None:
    """Print what changed between two results of a cell; `other` is the one that is not asked about."""
    print(f"\n{word} it: {other['key']}, run {other['environment']['started']}; between the two changed:")
    for line in identity.changes(older["identity"], newer["identity"]):
        print(f"  {line}")


def _why_again(changed: Sequence[Difference]) -> None:
    """Print what changed in the harness, the method and this machine since a cell's newest row was made."""
    if not changed:
        print(
            "\nsince then nothing changed in the harness, the method or the packages; a config may ask for another cell"
        )
        return
    print("\nsince then changed, so that it would run again:")
    for line in changed:
        print(f"  {line}")


def _report(options: argparse.Namespace) -> int:
    """Build a report. Raises FirsthitError if a package is missing, or if --baseline is given with two runs."""
    try:
        from harness.commands import folders
        from reports import compare, report
        from reports.place import place

        runs, names = options.folders, ("baseline", "focus", "appendix", "figures", "tables")
        changed = len(runs) == 2 and not options.together
        if changed and (given := next((name for name in names if getattr(options, name)), None)):
            raise FirsthitError(
                f"--{given} goes with one run, or with --together: of two, each cell is held against itself"
            )
        about = {name: getattr(options, name) for name in names}
        with contextlib.ExitStack() as stack:
            tell_step = stack.enter_context(console.working())
            if changed:
                tell_step(f"comparing {runs[0]} with {runs[1]}")
                made = compare.build(runs[0], runs[1], options.output)
            elif len(runs) == 1:
                tell_step(f"reading {runs[0]}")
                made = report.build(runs[0], options.output, **about, tell=tell_step)
            else:
                joined, lines = stack.enter_context(folders.joined(runs, tell_step))
                made = report.build(joined, options.output or place(*runs, joined=True), **about, tell=tell_step)
                for line in lines:
                    tell_wrong(f"firsthit: {line}")
        print(made, *(made.with_name(name) for name in ("figures", "tables") if getattr(options, name)), sep="\n")
    except ModuleNotFoundError as error:
        message = (
            f"a report needs the package {error.name}: pip install 'firsthit[report]'; runs/ can be copied elsewhere"
        )
        raise FirsthitError(message, exit_code=3) from None
    return 0
