"""Tell what a gate found, in every form that its options ask for: files, pictures, annotations and a table."""

from __future__ import annotations

import argparse
import importlib
import shutil
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from harness import escaping
from harness.contract import FirsthitError, plural
from harness.gate import outputs, pictures, servers
from harness.gate.about import About, Place, abouts, cell_slot
from harness.gate.checked import Checked, Prepared
from harness.gate.judge import Judged
from harness.gate.pictures import Before
from harness.results.writing import write_atomically
from harness.terminal import command

RUNS = Path("runs")


def add_outputs(parser: argparse.ArgumentParser) -> None:
    """Add the options that say in which forms a gate tells what it found."""
    parser.add_argument("--junit", type=Path, metavar="FILE", help="write the verdicts as JUnit XML")
    parser.add_argument("--markdown", type=Path, metavar="FILE", help="write a summary as Markdown")
    parser.add_argument(
        "--github", action="store_true", help="print annotations for GitHub Actions, and write the step's summary"
    )
    parser.add_argument(
        "--pictures", type=Path, metavar="DIR", help="draw the wrong rays of each row that fell, before and after"
    )


def ready_to_draw(options: argparse.Namespace) -> None:
    """Make ready for --pictures, so that what is missing is said before any work; do nothing without that option.

    Raises FirsthitError where a package is missing or the folder cannot be made.
    """
    if options.pictures is None:
        return
    try:
        importlib.import_module("reports.drawing.pairs")
    except ModuleNotFoundError as error:
        message = f"--pictures needs the package {error.name}: pip install 'firsthit[report]'"
        raise FirsthitError(message, exit_code=3) from None
    try:
        options.pictures.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FirsthitError(f"--pictures {options.pictures}: {error.strerror or error}") from None


def drawn(options: argparse.Namespace, checked: Checked, judged: Sequence[Judged], before: Before) -> dict[Place, Path]:
    """Draw the rows that fell into the folder of --pictures; return their files. Without that option draw nothing.

    `before` says what a row's answers were. Raises FirsthitError where a file cannot be written.
    """
    if options.pictures is None:
        return {}
    from reports.drawing import pairs

    made = {}
    for pair in pictures.pairs(checked, judged, before):
        path = options.pictures / pair.file
        write_atomically(path, pairs.png(pair.heading, pair.before, pair.now, pair.parameter, pair.evaluations))
        made[pair.judged.slot, pair.judged.device] = path
    return made


def _command(options: argparse.Namespace, judged: Judged) -> str:
    """Return the command that gates one row anew; `options` are those of the gate that judged it."""
    plugins = ["--plugins", str(options.plugins)] if options.plugins else []
    words = ["firsthit", *plugins, "gate", str(options.typed), "--device", judged.device, "--only", cell_slot(judged)]
    runs = options.runs if options.runs != RUNS else None
    for name, value in (("--baseline", options.baseline), ("--against", options.against), ("--runs", runs)):
        if value:
            words += [name, str(value)]
    return escaping.shell([*words, *["--yes"] * options.yes, "--force"])


def about_rows(
    options: argparse.Namespace, prepared: Prepared, judged: Sequence[Judged], shown: Mapping[Place, Path]
) -> dict[Place, About]:
    """Say of every row what is told beside its verdict; `shown` has the pictures that were drawn."""
    rows, earlier = (prepared.rows, prepared.earlier) if isinstance(prepared, Checked) else ({}, frozenset())
    return abouts(judged, lambda j: _command(options, j), prepared.planned, rows, earlier, shown)


def tell(
    options: argparse.Namespace,
    prepared: Prepared,
    judged: Sequence[Judged],
    held: str,
    code: int,
    about: Mapping[Place, About],
    more: Callable[[int | None], str] | None = None,
) -> None:
    """Write the files that are asked for, and then print the table, or with --json no table.

    `held` names what the rows are held against. `more` returns what is told after the table, for so many columns; None:
    any width.
    """
    title = prepared.experiment.name
    if options.junit:  # files come first, since the table's reader may go away
        write_atomically(options.junit, servers.junit(judged, title, about).encode())
    summary = outputs.markdown(judged, title, held, code, about)
    summary += f"\n{escaping.fenced(more(None))}\n" if more else ""
    if options.markdown:
        write_atomically(options.markdown, summary.encode())
    if options.github:
        servers.summarize(summary)
    if not options.json:
        width = shutil.get_terminal_size().columns if sys.stdout.isatty() else None
        print(outputs.table(judged, width))
        if more:
            print(more(width))
    if options.pictures:
        count = sum(1 for own in about.values() if own.picture)
        print(f"{options.pictures}: {plural(count, 'picture')} of wrong rays")
    if options.github:
        kernels = {name: plugin.folder / "kernel.glsl" for name, plugin in prepared.catalog.plugins.items()}
        if written := servers.github(judged, kernels, about):
            command(written)
