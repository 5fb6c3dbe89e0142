"""Write a history into a folder: index.html, and a PNG for each figure."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from harness.contract import FirsthitError
from harness.results.commits import Kept
from harness.results.writing import replacing_together
from reports import wording
from reports.history import multiples, page, series
from reports.history.page import History
from reports.history.series import Graph, Rule, Step


@dataclass(frozen=True, eq=False)
class Told:
    """Hold what is told of a history: its title, each figure's tolerance and meaning, by name, and what is not read."""

    title: str
    rules: Mapping[str, Rule]
    meanings: Mapping[str, str]
    notes: Sequence[str] = ()
    problems: Sequence[str] = ()


def build(kept: Sequence[Kept], line: Sequence[str] | None, told: Told, folder: Path) -> list[Step]:
    """Write the history of `kept`, at least one run, into `folder`, and return its steps, the worst first.

    line: hashes of the commits that follow each other, the oldest first; None takes all clean commits by their dates
    No older file is replaced before all new ones are complete. Raises FirsthitError where they cannot be written.
    """
    graphs = series.graphs(kept, line, told.rules)
    places = sorted(series.places(kept, line).values(), key=lambda place: place.at)
    steps = series.steps(graphs)
    meanings = {series.STATUS: "How the row ended."} | dict(told.meanings)
    notes = [*told.notes, *series.devices(kept), *_notes(places)]
    history = History(told.title, graphs, steps, places, meanings, notes, told.problems)
    by_figure: dict[str, list[Graph]] = {}
    for graph in graphs:
        by_figure.setdefault(graph.figure, []).append(graph)
    if folder.exists() and not folder.is_dir():
        raise FirsthitError(f"cannot write the history into {folder}: it is no folder")
    with replacing_together(folder, "the history") as made:
        (made / "index.html").write_text(
            page.page(history, {name: f"{name}.png" for name in by_figure}), encoding="utf-8", errors="replace"
        )
        for name, own in by_figure.items():
            ends = f"{places[0].commit.date[:10]} to {places[-1].commit.date[:10]}"
            many = (
                f"{wording.plural(history.commits, 'commit')} on the line, {ends}; {wording.plural(len(own), 'graph')}"
            )
            below = (meanings.get(name, ""), f"{many}; ▲ a step for the worse, ▼ for the better, ○ apart")
            multiples.write(own, history.commits, f"{told.title}: {name}", below, made / f"{name}.png")
    return steps


def _notes(places: Sequence[series.Place]) -> list[str]:
    """Say what the drawings show, and why commits are apart."""
    on = sum(not place.apart for place in places)
    notes = []
    if on < 2:
        notes.append(
            f"{'One commit is' if on else 'No commit is'} on the line; a step needs two: keep the next ones too."
        )
    for apart in (series.DIRTY, series.ASIDE):
        if count := sum(place.apart == apart for place in places):
            notes.append(f"Rings are commits {apart} ({count} kept so): they are on no line and make no step.")
    return notes
