"""Offer `firsthit history`: draw the gated figures of a config over the commits whose runs are kept."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from harness import console
from harness.commands import Add
from harness.commands.answers import gates
from harness.commands.machine import Answer, add_json
from harness.commands.options import add_history, history_of, tell_wrong
from harness.contract import FirsthitError, plural
from harness.escaping import shell
from harness.experiment import reading
from harness.experiment.shipped import located
from harness.gate import repository
from harness.gate.judge import Tolerance, tolerances_of
from harness.plugins import find_methods
from harness.results import commits
from harness.results.commits import Kept
from harness.results.figures import GATED

if TYPE_CHECKING:
    from reports.history.series import Step

SHOWN = 10  # steps that are printed
SUBJECT = 50  # letters of a commit's subject


def add_parsers(add: Add) -> None:
    parser = add(
        "history",
        "firsthit history configs/gate.toml",
        "Draw each gated figure over the commits whose runs `firsthit gate --keep` kept, as index.html and a PNG for "
        "each figure, with every step beyond the gate's tolerance marked and listed, the worst first. Runs nothing.",
    )
    parser.add_argument("config", type=Path, metavar="CONFIG", help="a TOML file, or a name of `firsthit list configs`")
    parser.add_argument("-o", "--output", type=Path, metavar="DIR", help="default: runs/history-NAME")
    add_history(parser)
    add_json(parser)
    parser.set_defaults(run=_history)


def _history(options: argparse.Namespace) -> int | Answer:
    """Draw the history of a config. Raises FirsthitError where nothing is kept, or a package is missing."""
    config = located(options.config)
    experiment = reading.load(config, find_methods(options.plugins).with_stand_ins())
    folder = history_of(options, config)
    kept, problems = commits.read_all(folder)
    for problem in problems:
        tell_wrong(f"firsthit: {problem}")
    if not kept:
        plugins = ["--plugins", str(options.plugins)] if options.plugins else []
        command = shell(["firsthit", *plugins, "gate", str(options.config), "--keep"])
        raise FirsthitError(f"{folder} holds no kept runs to draw; `{command}` keeps the rows of a commit")
    output = options.output or Path("runs") / f"history-{experiment.name}"
    steps = _draw(kept, problems, options.plugins, config, tolerances_of(experiment.config.gate.figures), output)
    if options.json:
        return Answer(gates.history(output / "index.html", len(kept), steps))
    listed = [
        (
            f"{'crept ' if step.crept else ''}{'worse' if step.worse else 'better'}",
            step.figure,
            step.slot,
            step.device,
            f"{step.before} → {step.now}",
            step.commit.hash[:8],
            step.commit.subject[:SUBJECT],
        )
        for step in steps[:SHOWN]
    ]
    if listed:
        print(console.table(("step", "figure", "cell", "device", "before → now", "commit", "subject"), listed))
    more = f", {len(steps) - SHOWN} of them not listed here" if len(steps) > SHOWN else ""
    runs, found = plural(len(kept), "kept run"), plural(len(steps), "step")
    print(f"{output / 'index.html'}: {runs}, {found}{more}")
    return 0


def _draw(
    kept: Sequence[Kept],
    problems: Sequence[str],
    plugins: Path | None,
    config: Path,
    tolerances: dict[str, Tolerance],
    output: Path,
) -> list[Step]:
    """Draw kept runs into a folder and return the steps. Raises FirsthitError where a package is missing."""
    try:
        from reports.history import draw
    except ModuleNotFoundError as error:
        message = f"a history needs the package {error.name}: pip install 'firsthit[report]'"
        raise FirsthitError(message, exit_code=3) from None
    top = repository.holding(plugins, config)
    hashes = {one.commit.hash for one in kept}
    line = repository.line(top, hashes) if top else None
    ordered = (
        "Commits are in the order of HEAD's first parents."
        if line is not None
        else "Commits are ordered by their dates, since no full clone here knows them."
    )
    meanings = {name: _meaning(name, tolerance) for name, tolerance in tolerances.items()}
    told = draw.Told(kept[0].config, tolerances, meanings, (ordered,), problems)
    return draw.build(kept, line, told, output)


def _meaning(name: str, tolerance: Tolerance) -> str:
    """Say what a figure is, which way it is better, and what change of it makes a step."""
    absolute = f"{tolerance.absolute:g}" if tolerance.absolute else ""
    relative = f"{tolerance.relative:.4g} × the value before" if tolerance.relative else ""
    slack = " + ".join(filter(None, (absolute, relative)))
    change = f"a change by more than {slack}" if slack else "any change"
    return f"{GATED[name].meaning}; {tolerance.better} is better. A step is {change}."
