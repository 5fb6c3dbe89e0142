"""Write a history as one HTML page that needs no script, no network and no other file."""

from __future__ import annotations

import itertools
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from harness.escaping import html as escaped
from harness.results.commits import Commit
from reports import wording
from reports.history.axes import Scale, across, labels
from reports.history.series import Graph, Place, Point, Span, Step

HERE = Path(__file__).parent
LEFT, WIDTH, TOP, HEIGHT = 60.0, 234.0, 10.0, 58.0  # of the plot in a drawing of 300 × 84
DOTTED = 60  # commits that have dots; of more, dots would run together
LISTED = 40  # steps that are listed at once; the others are under a heading to open
STEPS = 1000  # steps that are listed at all; the drawings mark every one
SPANS = 6000  # spans that the page tells in numbers; histories that hold more tell the newest of each graph


@dataclass(frozen=True, eq=False)
class History:
    """Hold what a page shows.

    steps: the worst first, as series.steps returns them
    meanings: what each figure is, by name
    notes: sentences for the top of the page
    problems: why kept files could not be read
    """

    title: str
    graphs: Sequence[Graph]
    steps: Sequence[Step]
    places: Sequence[Place]
    meanings: Mapping[str, str]
    notes: Sequence[str] = ()
    problems: Sequence[str] = ()

    @property
    def commits(self) -> int:
        """Return how many commits are on the line."""
        return sum(not place.apart for place in self.places)

    @property
    def figures(self) -> list[str]:
        """List the figures that have a graph, in their order."""
        return list(dict.fromkeys(graph.figure for graph in self.graphs))


def page(history: History, pictures: Mapping[str, str]) -> str:
    """Return the page as HTML. `pictures` names the PNG of each figure."""
    changed = [graph for graph in history.graphs if not graph.flat]
    ids = {id(graph): f"g{i}" for i, graph in enumerate(changed)}
    numbers = {id(step): i for i, step in enumerate(history.steps[:STEPS])}
    most = _most([len(graph.spans) for graph in changed])
    of_step = {id(step): ids[id(graph)] for graph in changed for step in graph.told}
    counts = {name: sum(step.figure == name for step in history.steps) for name in history.figures}
    sections = [_figure_section(history, name, ids, numbers, most, pictures[name]) for name in history.figures]
    wide = WIDTH / max(history.commits, 1)
    told = [f'<p class="warn">{escaped(problem)}</p>' for problem in history.problems]
    parts = {
        "title": escaped(f"History of {history.title}"),
        "subtitle": escaped(_subtitle(history)),
        "style": (HERE / "page.css").read_text(encoding="utf-8"),
        "apart": f"{wide:.4f}",
        "dot": f"{min(5.0, max(1.6, 0.7 * wide)):.2f}",
        "notes": "".join([*told, *(f'<p class="faint">{escaped(note)}</p>' for note in history.notes)]),
        "links": '<li><a href="#steps">steps</a></li>'
        + "".join(f'<li><a href="#{name}">{name}</a>{_count(counts[name])}</li>' for name in history.figures)
        + '<li><a href="#commits">commits</a></li>',
        "body": "".join([_steps(history, of_step), *sections, _commits(history)]),
    }
    template = (HERE / "page.html").read_text(encoding="utf-8")
    return re.sub(r"\{\{(\w+)\}\}", lambda found: parts[found[1]], template)


def _count(steps: int) -> str:
    return f" ({steps})" if steps else ""


def _subtitle(history: History) -> str:
    """Say how many commits there are, and from when to when."""
    dates = sorted(place.commit.date[:10] for place in history.places)
    apart = len(history.places) - history.commits
    more = f", {apart} drawn apart" if apart else ""
    return f"{wording.plural(history.commits, 'commit')}{more}, {dates[0]} to {dates[-1]}"


def _most(lengths: Sequence[int]) -> int:
    """Return how many spans of a graph are told in numbers, so that the page stays small; at least 1."""
    longest = max(lengths, default=1)
    return next((most for most in range(longest, 1, -1) if sum(min(n, most) for n in lengths) <= SPANS), 1)


def _commit(commit: Commit) -> str:
    return f"{commit.hash[:8]} {commit.date[:10]}"


def _steps(history: History, of_step: Mapping[int, str]) -> str:
    """Write the list of steps, the worst first, each with a link to its graph."""
    items = [_step(step, i, of_step[id(step)]) for i, step in enumerate(history.steps[:STEPS])]
    if not items:
        few = history.commits < 2
        none = "No figure has changed beyond its tolerance, at once or in several changes."
        text = "Steps need two kept commits on one device." if few else none
        return f'<h2 id="steps">Steps</h2><p>{text}</p>'
    many = len(history.steps) - len(items)
    left_out = f"<p>{many} smaller ones are marked in the graphs alone.</p>" if many else ""
    first, rest = "".join(items[:LISTED]), "".join(items[LISTED:])
    more = (
        f"<details><summary>{len(items) - LISTED} more</summary>"
        f'<ol class="steps" start="{LISTED + 1}">{rest}</ol>{left_out}</details>'
        if rest
        else ""
    )
    worse = sum(step.worse for step in history.steps)
    better = len(history.steps) - worse
    said = f"{worse} for the worse, {better} for the better; the worst first, by how far they are beyond tolerance. "
    said += "The graphs mark them with ▲ and ▼."
    return f'<h2 id="steps">Steps</h2><p class="faint">{said}</p><ol class="steps">{first}</ol>{more}'


def _step(step: Step, number: int, graph: str) -> str:
    """Write one step as an item of the list."""
    notes = "".join(f"; {escaped(note)}" for note in step.notes)
    since = "crept in smaller changes since" if step.crept else "last kept before:"
    told = f"{step.commit.date[:10]} {step.commit.subject}; {since} {_commit(step.since)}; on {step.device}"
    return (
        f'<li id="s{number}"><a href="#{graph}">{step.figure} of {escaped(step.slot)}</a>: '
        f'<span class="{_kind(step)}">{escaped(step.before)} → {escaped(step.now)}</span> at commit '
        f"<code>{step.commit.hash[:8]}</code> <small>{escaped(told)}{notes}</small></li>"
    )


def _figure_section(
    history: History, name: str, ids: Mapping[int, str], numbers: Mapping[int, int], most: int, picture: str
) -> str:
    """Write the graphs of one figure: those with steps first, the worst first, and those that never change last."""
    own = [graph for graph in history.graphs if graph.figure == name]
    changed = sorted(
        (graph for graph in own if not graph.flat),
        key=lambda graph: min((numbers.get(id(step), STEPS) for step in graph.told), default=STEPS + 1),
    )
    flat = [graph for graph in own if graph.flat]
    cards = "".join(_card(history, graph, ids[id(graph)], numbers, most) for graph in changed)
    grid = f'<div class="grid">{cards}</div>' if cards else ""
    meaning = escaped(history.meanings.get(name, ""))
    return (
        f'<section><h2 id="{name}">{name}</h2>'
        f'<p class="faint">{meaning} <a href="{escaped(picture)}">as a picture</a></p>'
        f"{grid}{_flat(history, flat, opened=not changed and (len(flat) <= LISTED or history.commits < 2))}</section>"
    )


def _card(history: History, graph: Graph, name: str, numbers: Mapping[int, int], most: int) -> str:
    """Write one graph with its numbers below it."""
    spans, left_out = graph.spans[-most:], max(0, len(graph.spans) - most)
    rows = "".join(
        f'<tr><td class="n">{escaped(graph.said(span.value))}</td><td class="n">{len(span.points)}</td>'
        f"<td>{_range(span)}</td></tr>"
        for span in reversed(spans)
    )
    rows += "".join(
        f'<tr><td class="n">{escaped(graph.said(point.value or 0))}</td><td></td>'
        f"<td>{_commit(point.place.commit)}, apart: {point.place.apart}</td></tr>"
        for point in graph.apart
    )
    older = f"<p>{left_out} older values are in the kept files</p>" if left_out else ""
    head = (
        '<tr><th scope="col" class="n">value</th><th scope="col" class="n">commits</th><th scope="col">kept</th></tr>'
    )
    return (
        f'<figure id="{name}"><figcaption>{escaped(graph.slot)} <small>{escaped(graph.device)}</small></figcaption>'
        f"{_drawing(history, graph, spans, numbers)}"
        f'<details><summary>numbers</summary><div class="scroll" tabindex="0"><table><thead>{head}</thead>'
        f"<tbody>{rows}</tbody></table></div>{older}</details></figure>"
    )


def _range(span: Span) -> str:
    first, last = span.points[0].place.commit, span.points[-1].place.commit
    return _commit(first) if first == last else f"{_commit(first)} to {_commit(last)}"


def _title(graph: Graph, span: Span) -> str:
    commits = f"{len(span.points)} commits, " if len(span.points) > 1 else ""
    return f"<title>{escaped(graph.said(span.value))}: {commits}{_range(span)}</title>"


def _drawing(history: History, graph: Graph, spans: Sequence[Span], numbers: Mapping[int, int]) -> str:
    """Draw a graph as SVG. What `spans` holds tells its values under the pointer."""
    scale = Scale.of(graph)

    def x(at: float) -> float:
        return LEFT + WIDTH * across(at, history.commits)

    def y(value: float) -> float:
        return TOP + HEIGHT * (1.0 - scale.position(value))

    wide = WIDTH / max(history.commits, 1)
    hovers = "".join(
        f'<rect class="h" x="{x(span.points[0].place.at) - wide / 2:.1f}" y="4" '
        f'width="{x(span.points[-1].place.at) - x(span.points[0].place.at) + wide:.1f}" height="{HEIGHT + 12:.0f}">'
        f"{_title(graph, span)}</rect>"
        for span in spans
    )
    marks = _marks(graph, numbers, x)
    texts = "".join(
        f'<text x="{LEFT - 5:.0f}" y="{TOP + HEIGHT * (1 - position) + 3:.1f}" text-anchor="end">{escaped(text)}</text>'
        for position, text in labels(graph, scale)
    )
    first, last = _ends(history)
    dates = (
        f'<text x="{LEFT:.0f}" y="82">{first}</text><text x="{LEFT + WIDTH:.0f}" y="82" text-anchor="end">{last}</text>'
    )
    log = '<text x="2" y="82">log</text>' if scale.logarithmic else ""
    counts = f"{wording.plural(len(graph.spans), 'value')}, {wording.plural(len(graph.told), 'step')}"
    said = f"{graph.figure} of {graph.slot} on {graph.device}: {counts}"
    return (
        f'<svg viewBox="0 0 300 84" role="group" aria-label="{escaped(said)}">'
        f'<path class="axis" d="M{LEFT:.0f} {TOP + HEIGHT + 4:.0f}h{WIDTH:.0f}"/>{texts}{dates}{log}'
        f"{_paths(graph.spans, x, y, history.commits)}{hovers}{_apart(graph, x, y)}{marks}</svg>"
    )


def _ends(history: History) -> tuple[str, str]:
    """Return the dates of the first and the last commit on the line, or of all where none is."""
    on = [place.commit.date[:10] for place in history.places if not place.apart]
    every = on or sorted(place.commit.date[:10] for place in history.places)
    return every[0], every[-1] if len(every) > 1 else ""


def _paths(spans: Sequence[Span], x: Callable[[float], float], y: Callable[[float], float], commits: int) -> str:
    """Draw the line through all spans and, of DOTTED commits at most, a dot for each: a dash of no length."""
    line, dots = [], []
    for span in spans:
        first, last, level = x(span.points[0].place.at), x(span.points[-1].place.at), y(span.value)
        line.append(f"{'L' if span.joined else 'M'}{first:.1f} {level:.1f}" + ("" if span.joined else "h.05"))
        line.append(f"H{last:.1f}" if last > first else "")
        for _, group in itertools.groupby(enumerate(span.points), key=lambda pair: pair[1].place.at - pair[0]):
            block = [point for _, point in group]
            start, end = x(block[0].place.at), x(block[-1].place.at)
            dots.append(f"M{start:.2f} {level:.1f}h{end - start + 0.05:.2f}")
    dotted = f'<path class="d" d="{"".join(dots)}"/>' if dots and commits <= DOTTED else ""
    return f'<path class="l" d="{"".join(line)}"/>{dotted}' if line else ""


def _apart(graph: Graph, x: Callable[[float], float], y: Callable[[float], float]) -> str:
    """Draw the points that are not on the line as rings."""
    return "".join(_ring(graph, point, x(point.place.at), y(point.value or 0)) for point in graph.apart)


def _ring(graph: Graph, point: Point, x: float, y: float) -> str:
    title = f"{graph.said(point.value or 0)}: {_commit(point.place.commit)}, {point.place.apart}"
    return f'<circle class="apart" cx="{x:.1f}" cy="{y:.1f}" r="2.5"><title>{escaped(title)}</title></circle>'


def _marks(graph: Graph, numbers: Mapping[int, int], x: Callable[[float], float]) -> str:
    """Draw the steps. Those that the list holds link to their place in it; of others a short line is drawn."""
    listed = [step for step in graph.told if id(step) in numbers]
    drawn = "".join(_mark(step, numbers[id(step)], x(step.at)) for step in listed)
    for kind in ("worse", "better"):
        others = (step for step in graph.told if id(step) not in numbers and _kind(step) == kind)
        if path := "".join(f"M{x(step.at):.1f} 1v7" for step in others):
            drawn += f'<path class="axis {kind}" d="{path}"/>'
    return drawn


def _mark(step: Step, number: int, x: float) -> str:
    """Draw a step as a dashed line and a triangle that link to its place in the list."""
    triangle = f"M{x:.1f} 1l4 6h-8z" if step.worse else f"M{x - 4:.1f} 1h8l-4 6z"  # up for the worse
    what, at = "crept" if step.crept else "step", f"{_commit(step.commit)} {step.commit.subject}"
    title = f"{what}: {step.before} → {step.now} at {at}"
    return (
        f'<a href="#s{number}" class="mark {_kind(step)}"><title>{escaped(title)}</title>'
        f'<line x1="{x:.1f}" x2="{x:.1f}" y1="8" y2="{TOP + HEIGHT + 4:.0f}"/><path d="{triangle}"/></a>'
    )


def _kind(step: Step) -> str:
    return "worse" if step.worse else "better"


def _flat(history: History, graphs: Sequence[Graph], opened: bool) -> str:
    """Write the graphs that never change as a table with a small drawing in each line."""
    if not graphs:
        return ""
    rows = []

    def x(at: float) -> float:
        return LEFT + WIDTH * across(at, history.commits)

    for graph in graphs:
        points = [*(point for span in graph.spans for point in span.points), *graph.apart]
        value, count = graph.said(graph.values[0]), len(points)
        title = _title(graph, Span(tuple(points), False))
        drawn = f"{_paths(graph.spans, x, lambda _: 6.0, history.commits)}{_apart(graph, x, lambda _: 6.0)}"
        svg = f'<svg viewBox="{LEFT:.0f} 0 {WIDTH:.0f} 12" role="img">{title}{drawn}</svg>'
        rows.append(
            f'<tr><td>{escaped(graph.slot)}</td><td>{escaped(graph.device)}</td><td class="n">{escaped(value)}</td>'
            f'<td class="n">{count}</td><td>{svg}</td></tr>'
        )
    head = (
        '<tr><th scope="col">row</th><th scope="col">device</th><th scope="col" class="n">value</th>'
        '<th scope="col" class="n">kept</th><th scope="col">over commits</th></tr>'
    )
    many = wording.plural(len(graphs), "row")
    return (
        f"<details{' open' if opened else ''}><summary>{many} with the same value at every commit</summary>"
        f'<div class="scroll" tabindex="0"><table><thead>{head}</thead><tbody>{"".join(rows)}</tbody></table></div>'
        "</details>"
    )


def _commits(history: History) -> str:
    """Write the table of all kept commits, the newest first."""
    rows = "".join(
        f"<tr><td><code>{place.commit.short}</code></td><td>{place.commit.date[:10]}</td>"
        f"<td>{escaped(place.commit.subject)}</td><td>{place.apart}</td></tr>"
        for place in sorted(history.places, key=lambda place: -place.at)
    )
    head = "".join(f'<th scope="col">{name}</th>' for name in ("commit", "date", "subject", "drawn apart"))
    return (
        f'<section><h2 id="commits">Commits</h2><div class="scroll" tabindex="0"><table><thead><tr>{head}</tr></thead>'
        f"<tbody>{rows}</tbody></table></div></section>"
    )
