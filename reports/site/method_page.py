"""Write the pages of methods: what each is and claims, whether that held, where it is fast, and what was tried."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from harness.contract import CLAIMS
from reports import wording
from reports.claims import Outcome
from reports.parts import method_cards
from reports.site import cells
from reports.site.board import FIRST, places, said
from reports.site.cells import BOUNDS, RADIUS, Site, row_link
from reports.site.markup import Head, Html, Line, folded, join, paragraphs, table, tag
from reports.site.pictures import anchor
from reports.site.scatter import Point, chip, scatter
from reports.site.standings import LEVELS, Race, standings

UP = "../"
AMONG = "the runs of this site"


def index(site: Site) -> list[Html]:
    """Write the list of all methods."""
    at = {found.method: found for found in standings(site.cells, FIRST)}
    lines = []
    for name in sorted(site.pages, key=site.label):
        told = site.data.methods.get(name, {})
        cells_of = said(at[name])[:3] if name in at else (wording.NONE,) * 3
        lines.append(Line((site.method(name, ""), told.get("title") or "", *cells_of)))
    heads = (
        Head("method"),
        Head("what it is"),
        Head("fastest", True),
        Head("within the bound", True),
        Head("median speed-up", True),
    )
    caption = (
        f"Every method of these runs; figures are at {BOUNDS[FIRST]} {RADIUS}, over all cells of the leaderboard. "
        f"Speed-ups are over {site.overall}, in so many cells as both are right in."
    )
    return [table(caption, heads, lines)]


def body(site: Site, name: str) -> list[Html]:
    """Write a method's page."""
    told = site.data.methods.get(name, {})
    own = [race for race in site.cells if name in race.entered]
    made: list[Html | None] = [
        tag(
            "p", chip(site.marks[name]), told.get("title") or f"The runs here do not say what {name} is.", class_="lead"
        ),
        tag("p", told["summary"]) if told.get("summary") else None,
        tag("p", tag("b", "Source: "), told["source"]) if told.get("source") else None,
        _here(site, name, own) if own else tag("p", "It was cast in no cell of the leaderboard."),
        _claims(site, name, told),
        *_doc(told),
        _parameters(told.get("parameters", [])),
    ]
    return [part for part in made if part is not None]


def _here(site: Site, name: str, own: Sequence[Race]) -> Html:
    """Write how the method did: where it wins, its speeds and errors over surfaces, and each cell."""
    counted = []
    for column in places(site):
        at = [race for race in own if (race.first.on, race.first.precision) == (column.on, column.precision)]
        if not at:
            continue
        told: list[str] = []
        for level, _ in LEVELS:
            found = next(s for s in standings(at, level) if s.method == name)
            told += said(found)[:3]
        counted.append(Line((site.place(column), *told)))
    heads = [Head("device")]
    for level, _ in LEVELS:
        heads += [Head(f"{title}, {BOUNDS[level]}", True) for title in ("fastest", "within", "speed-up")]
    caption = (
        "In how many cells it is the fastest, in how many a setting of it keeps the bound with every clear ray right, "
        f"and its median speed-up over {site.overall} there, in so many cells as both are right in."
    )
    return join(
        tag("h2", "How it did"),
        table(caption, heads, counted),
        _plot(site, name, own),
        folded("Every cell", _cells_table(site, name, own), opened=len(own) <= 24),
    )


def _plot(site: Site, name: str, own: Sequence[Race]) -> Html:
    """Draw the speed of the method's fastest settings against their errors, a point for each surface of one device."""
    column = max(places(site), key=lambda c: sum((r.first.on, r.first.precision) == (c.on, c.precision) for r in own))
    points = []
    for race in own:
        if name not in race.methods or (race.first.on, race.first.precision) != (column.on, column.precision):
            continue
        row = _best(race, name)
        if wording.absent(row.relative_error_max) or wording.absent(row.wrong_rays):
            continue
        title = f"{row.surface_title}: {row.label}, {cells.speed(row, row.over_baseline)}, "
        title += f"largest error {wording.error(row.relative_error_max)}"
        to = f"{UP}surfaces/{row.page}.html#{anchor(row)}"
        points.append(
            Point(
                row.median_ms,
                row.relative_error_max,
                site.marks[name],
                row.surface_title,
                title,
                to,
                bool(row.wrong_rays > 0),
            )
        )
    what = f"{site.label(name)} on {site.place(column)}: time against error, surface by surface"
    drawn = scatter(points, "ms a frame", f"largest error, {RADIUS}", what)
    return cells.plot(
        drawn, f"{what}; its fastest setting within {BOUNDS[FIRST]}, else its fastest. Hollow: some rays wrong."
    )


def _best(race: Race, name: str) -> Any:
    """Return the method's fastest row within the first bound, else its fastest; where none was timed, what failed."""
    own = race.won[FIRST].usable.get(name)
    return own if own is not None else race.entered[name]


def _cells_table(site: Site, name: str, own: Sequence[Race]) -> Html:
    """Write the method's best row of each cell."""
    lines = []
    for race in own:
        row, won = _best(race, name), race.won[FIRST].winner
        first = (
            "none"
            if won is None
            else "itself"
            if won.method == name
            else join(row_link(won, UP), f", {wording.number(won.median_ms)} ms")
        )
        told = (
            site.place(row),
            row_link(row, UP) if name in race.methods else row.label,
            cells.milliseconds(row) if name in race.methods else row.status,
            wording.factor(row.over_baseline),
            wording.error(row.relative_error_max),
            wording.count(row.wrong_rays),
            first,
        )
        lines.append(Line((row.surface_title, *told)))
    heads = (
        Head("surface"),
        Head("device"),
        Head("setting"),
        Head("ms", True),
        Head("speed-up", True),
        Head("largest error", True, RADIUS),
        Head("wrong rays", True),
        Head("fastest"),
    )
    caption = f"Its fastest setting within {BOUNDS[FIRST]}, else its fastest, beside the winner there. "
    return table(f"{caption}Speed-ups are over {site.overall}.", heads, lines)


def _claims(site: Site, name: str, told: Mapping[str, Any]) -> Html | None:
    """Write what the method and its papers claim, and whether that held in these runs."""
    rows = site.data.frame[site.data.frame["method"] == name]
    at_defaults = method_cards.at_defaults(told, rows)
    lines = [
        Line((claim.replace("_", " "), CLAIMS.get(claim, ""), method_cards.held(name, claim, at_defaults, AMONG)))
        for claim in sorted(told.get("claims", []))
    ]
    for claim, verdict, run in site.data.verdicts:
        if name in claim.methods:
            outcome = f"{verdict.outcome.value.capitalize()}: {verdict.figure}. In “{run}”."
            kind = "wrong" if verdict.outcome is Outcome.REFUTED else None
            lines.append(Line((f"{claim.paper}, {claim.section}", claim.text, outcome), kind=kind))
    if not lines:
        return None
    heads = (Head("claim"), Head("what it says"), Head("in these runs"))
    return join(tag("h2", "Claims"), table("What is claimed, and whether the runs here bear it out.", heads, lines))


def _doc(told: Mapping[str, Any]) -> list[Html]:
    """Write the parts of the method's own page with their tables: theory, deviations from its paper, what was tried."""
    made = []
    for part, text in told.get("doc", {}).items():
        tables = [found for found in told.get("tables", []) if found["part"] == part]
        made += [tag("h2", part), paragraphs(text)]  # which says of its tables what they show
        for found in tables:
            lines = [Line(tuple(row)) for row in found["rows"]]
            own = table(f"{part}.", [Head(title) for title in found["header"]], lines)
            made.append(tag("div", own, class_="quiet"))
    return made


def _parameters(knobs: Sequence[Mapping[str, Any]]) -> Html | None:
    """Write the method's knobs."""
    if not knobs:
        return None
    lines = [
        Line(
            (
                knob["name"],
                f"{knob['default']:g}",
                wording.NONE if knob.get("printed") is None else f"{knob['printed']:g}",
                knob["meaning"],
            )
        )
        for knob in knobs
    ]
    heads = (Head("knob"), Head("default", True), Head("as printed", True), Head("meaning"))
    return join(tag("h2", "Knobs"), table("What may be set of it, for each run of a config.", heads, lines))
