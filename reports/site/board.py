"""Write the leaderboard: how often each method wins, by class of surface, and who wins each surface on each device."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable, Sequence
from typing import Any

import pandas as pd

from reports import wording
from reports.analysis import ties
from reports.site.cells import BOUNDS, Site, risk, row_link, speed, unsteady
from reports.site.gather import DEGREES, HIGHER, NO_POLYNOMIAL, SCENES
from reports.site.markup import Head, Html, Line, folded, join, link, table, tag
from reports.site.scatter import chip
from reports.site.standings import FULL, LEVELS, RISKY, Race, Standing, standings

FIRST = LEVELS[0][0]  # the level that a page shows before anything is chosen
NAMED = 3  # methods that a class names


def body(site: Site) -> list[Html]:
    """Write the page's content."""
    if not site.cells:
        return [tag("p", "No run here has a timed row with answers, so that there is nothing to rank.")]
    return [
        _lead(site),
        *filter(None, [_noise(site)]),
        _filters(site),
        tag(
            "div",
            tag("p", "", id="said", role="status", class_="faint"),
            _standings(site),
            _classes(site),
            _winners(site),
            id="board",
            data_error=FIRST,
        ),
        _rules(site),
    ]


def data(site: Site) -> dict[str, Any]:
    """Return what the page's script counts: of each cell its place, and what its methods do there."""
    cells = [
        {
            "kind": race.first.kind,
            "device": race.first.on,
            "precision": race.first.precision,
            "machine": race.first.processor,
            "m": race.counted,
        }
        for race in site.cells
    ]
    return {"levels": [name for name, _ in LEVELS], "cells": cells}


def kinds(site: Site) -> list[str]:
    """Return the classes of surfaces that have a cell: by degree, then others by name."""
    order = [name for _, name in DEGREES] + [HIGHER, NO_POLYNOMIAL, SCENES]
    found = {str(race.first.kind) for race in site.cells}
    return [name for name in order if name in found] + sorted(found - set(order))


def places(site: Site) -> list[Any]:
    """Return a row of each device and precision that has a cell, those with most cells first."""
    counted = Counter((race.first.on, race.first.precision) for race in site.cells)
    rows = {(race.first.on, race.first.precision): race.first for race in site.cells}
    return [rows[at] for at, _ in counted.most_common()]


def _lead(site: Site) -> Html:
    frame = site.data.frame
    surfaces = wording.plural(len({race.first.page for race in site.cells}), "surface")
    methods = wording.plural(len({m for race in site.cells for m in race.entered}), "method")
    devices = wording.plural(len({race.first.on for race in site.cells}), "device")
    machines = wording.plural(frame["processor"].nunique(), "machine")
    runs = wording.plural(len(site.data.parts), "run")
    newest = max(part.plan.created for part in site.data.parts)[:10]
    return tag(
        "p",
        f"Which method finds fastest where a ray first hits an implicit surface? {methods} on {surfaces}, on {devices} "
        f"of {machines}, from ",
        link("runs.html", f"{runs} up to {newest}"),
        ". Before a setting was timed, its answers to a grid of rays were held against certified first hits",
        _undecided(site),
        ".",
        class_="lead",
    )


def _undecided(site: Site) -> str:
    """Say, with a comma before it, of which share of the checked rays no first hit is certified; "" for none."""
    checked = pd.concat([race.rows[["undecided", "accuracy_rays"]] for race in site.cells]).dropna().sum()
    if not checked["undecided"]:
        return ""
    share = wording.share(float(checked["undecided"] / checked["accuracy_rays"]))
    return f"; {share} of these rays are undecided, and do not count"


def _noise(site: Site) -> Html | None:
    """Say in how many cells the winner's times are not steady; None where all are."""
    winners = [won for race in site.cells if (won := race.won[FIRST].winner) is not None]
    noisy = sum(bool(unsteady(won)) for won in winners)
    if not noisy:
        return None
    return tag(
        "p",
        f"At {BOUNDS[FIRST]} the times of {noisy} of {len(winners)} winners are noisy or drift, as on a busy machine, "
        "so that their speed-ups are rough. Such times are marked.",
        class_="faint",
    )


def _filters(site: Site) -> Html:
    """Write the choices by which the script filters; a choice that has one value is left out."""
    rows = [race.first for race in site.cells]
    methods = {m: site.label(m) for m in sorted({m for race in site.cells for m in race.entered}, key=site.label)}
    given = (
        ("kind", "Surfaces", kinds(site)),
        ("device", "Device", list(dict.fromkeys(row.on for row in places(site)))),
        ("precision", "Precision", sorted({row.precision for row in rows})),
        ("machine", "Machine", sorted({row.processor for row in rows})),
    )
    levels = [tag("option", BOUNDS[name], value=name) for name, _ in LEVELS]
    every = [_choice("error", "Error bound", levels)]
    for name, title, values in given:
        if len(values) > 1:
            options = [tag("option", "all", value=""), *(tag("option", value, value=value) for value in values)]
            every.append(_choice(name, title, options))
    told = [tag("option", "all", value=""), *(tag("option", label, value=name) for name, label in methods.items())]
    every.append(_choice("method", "Method", told))
    without = tag("noscript", tag("p", "The choices need JavaScript; the tables below are of all cells."))
    return join(tag("form", *every, class_="filters", aria_label="Filters", hidden=True, id="filters"), without)


def _choice(name: str, title: str, options: Sequence[Html]) -> Html:
    return tag("label", title, " ", tag("select", *options, name=name, autocomplete="off"))


def _standings(site: Site) -> Html:
    """Write how often each method wins, over all cells."""
    heads = (
        Head("method"),
        Head(
            "fastest",
            True,
            "cells in which it is the fastest; tied are those in which it is not told apart from the fastest",
        ),
        Head(
            "within the bound",
            True,
            "cells in which a setting of it answers every clear ray rightly within the bound, of those that it could "
            "be cast in, also where it failed, crashed or ran out of time",
        ),
        Head(
            "median speed-up",
            True,
            f"over {site.overall}, of its fastest setting within the bound, in so many cells: those in which both "
            "answer every clear ray rightly. Medians of different cells are not comparable",
        ),
        Head(
            "wrong rays",
            True,
            "of its fastest setting, whatever its errors, and of how many clear rays: what speed risks; of that with "
            "fewest where none was timed",
        ),
    )
    lines = []
    for found in standings(site.cells, FIRST):
        share = f"--share: {found.won / max(len(site.cells), 1):.3f}"
        told = said(found)
        cells = (site.method(found.method, ""), tag("span", told[0], class_="share", style=share), *told[1:])
        lines.append(Line(cells, f"m-{site.pages[found.method]}"))
    caption = (
        "How often each method is the fastest of those that were cast in the same cell, which may be few. A cell is a "
        "surface on a device, in a precision, from the view and size that most methods were timed at."
    )
    names = json.dumps([found.method for found in standings(site.cells, FIRST)])
    return tag(
        "section",
        tag("h2", "Standings"),
        tag("div", table(caption, heads, lines, "standings"), data_methods=names, id="of"),
    )


def said(found: Standing) -> tuple[str, str, str, str]:
    """Write a standing. The site's script writes them alike."""
    tied = f" + {found.tied} tied" if found.tied else ""
    wrong = f"{found.wrong:,} of {found.rays:,}" if found.wrong else "0"
    speedup = f"{wording.factor(found.speedup)} in {found.compared}" if found.compared else wording.NONE
    return f"{found.won}{tied}", f"{found.usable} of {found.raced}", speedup, wrong


def _at_levels(cells: Iterable[Sequence[object]]) -> Html:
    """Write what a cell says at each of LEVELS, of which the page shows that which is chosen."""
    every = zip(LEVELS, cells, strict=True)
    return join(*(tag("div", *cell, class_="at", data_level=name) for (name, _), cell in every))


def _classes(site: Site) -> Html:
    """Write for each class of surfaces and each device which methods win how often."""
    columns = places(site)
    lines = []
    for kind in kinds(site):
        cells: list[object] = [link(f"#{_kind_id(kind)}", kind)]
        for column in columns:
            own = [
                r
                for r in site.cells
                if (r.first.kind, r.first.on, r.first.precision) == (kind, column.on, column.precision)
            ]
            cells.append(_at_levels(_class_cell(site, own, name) for name, _ in LEVELS) if own else "")
        lines.append(Line(cells, kind="kind"))
    heads = [Head("surfaces"), *(Head(site.place(column)) for column in columns)]
    caption = (
        "Which methods win how often, by class of surface: alone, or not told apart from the fastest; then the median "
        f"speed-up over {site.overall}, and in how many cells it is known."
    )
    return tag("section", tag("h2", "By class of surface"), table(caption, heads, lines, "classes"))


def _class_cell(site: Site, own: Sequence[Race], level: str) -> list[object]:
    """Write the methods that win most in the cells of a class."""
    found = [s for s in standings(own, level) if s.won + s.tied]
    if not found:
        return [tag("span", f"none within the bound, of {len(own)}", class_="faint")]
    told = []
    for standing in sorted(found, key=lambda s: (-s.won - s.tied, -s.won))[:NAMED]:
        over = f", {said(standing)[2]}" if standing.compared else ""
        count = f" {standing.won + standing.tied} of {len(own)}{over}"
        told.append(tag("div", chip(site.marks[standing.method]), tag("b", site.label(standing.method)), count))
    more = len(found) - len(told)
    return [*told, tag("div", f"{more} more", class_="faint") if more > 0 else None]


def _kind_id(kind: str) -> str:
    return "k-" + kind.lower().replace(" ", "-")


def _winners(site: Site) -> Html:
    """Write the winner of each surface on each device, class by class; a cell leads to its row and its picture."""
    columns = places(site)
    at = {(r.first.page, r.first.on, r.first.precision): r for r in site.cells}
    sections = []
    for kind in kinds(site):
        lines = []
        for page, title in dict.fromkeys(
            (r.first.page, r.first.surface_title) for r in site.cells if r.first.kind == kind
        ):
            cells: list[object] = [link(f"surfaces/{page}.html", title)]
            for column in columns:
                race = at.get((page, column.on, column.precision))
                told = [_winner_cell(site, race, name) for name, _ in LEVELS] if race else []
                cells.append(_at_levels(told) if told else "")
            lines.append(Line(cells, kind="cell"))
        heads = [Head("surface"), *(Head(site.place(column)) for column in columns)]
        caption = f"Winners of the class {kind}."
        sections.append(
            tag("section", tag("h3", kind, id=_kind_id(kind)), table(caption, heads, lines), data_kind=kind)
        )
    named = json.dumps(
        [{"device": column.on, "precision": column.precision, "machine": column.processor} for column in columns]
    )
    lead = tag(
        "p",
        f"The fastest setting with every clear ray right, its time and its speed-up over {site.overall}. Behind ≈ are "
        "methods that are not told to be slower. In red: what is faster, and answers wrongly at most "
        f"{100 * RISKY:g} % of the clear rays.",
        class_="faint",
    )
    title = tag("h2", "Winner of each surface")
    return tag("section", title, lead, *sections, id="winners", class_="quiet", data_columns=named)


def _winner_cell(site: Site, race: Race, level: str) -> list[object]:
    """Write a cell at one level: its winner, what ties with it, and what is faster but wrong."""
    won = race.won[level]
    if won.winner is None:
        return [tag("span", f"none of {len(race.entered)} methods", class_="faint")]
    methods = " ".join(dict.fromkeys(str(row.method) for row in (won.winner, *won.tied)))
    name = tag("span", chip(site.marks[won.winner.method]), row_link(won.winner, ""), class_="won", data_won=methods)
    tied = f"≈ {', '.join(row.label for row in won.tied)}" if won.tied else ""
    return [
        name,
        tag("div", speed(won.winner, won.winner.over_baseline)),
        tag("div", tied, class_="faint") if tied else None,
        tag("div", risk(won), class_="risk") if won.faster is not None else None,
    ]


def _rules(site: Site) -> Html:
    return folded(
        "How this is counted",
        tag(
            "p", f"{ties.RULE}. Rows are compared only with rows of their own run, which were timed in turns with them."
        ),
        tag(
            "p",
            "The error is the largest |t − t*| over the radius of the scene, of rays that neither graze the surface "
            "nor drown in rounding; a ray counts as wrong where it is a miss, a false hit, given up, a wrong root or "
            "an impossible answer. A setting with one wrong ray does not win. A method that fails, crashes or runs out "
            "of time in a cell does not keep the bound there; a method that no other was held against wins nothing. A "
            "surface on which no method could be timed has no cell.",
        ),
        tag(
            "p",
            f"A median speed-up is over {site.overall} and of the cells whose number stands behind it: those in which "
            "a setting keeps the bound, and the baseline was timed in turns with it and answers every clear ray "
            "rightly. Two methods' medians may be of different cells; the winners tell who is faster in one cell. The "
            f"pages of surfaces have speed-ups over the baseline of each run: {site.baseline(site.data.frame)}.",
        ),
        tag(
            "p",
            f"A surface is shown from the view that most methods were timed at, in a frame of {FULL} pixels a side or "
            "more where there is one. Of several runs of one scene on one device that counts which timed most methods "
            "and, of equals, the newest; the page of the surface lists the others. Devices with one name and different "
            "hardware, driver or machine are told apart.",
        ),
    )
