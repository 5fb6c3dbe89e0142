"""Write the pages of surfaces: what each method drew, how far off and how fast, and how to run it again."""

from __future__ import annotations

from collections.abc import Sequence

from reports import wording
from reports.analysis.scene_names import picture_size
from reports.site import board, cells, pictures
from reports.site.cells import BOUNDS, RADIUS, Site, risk, row_link, rows_table
from reports.site.markup import Head, Html, Line, code, day, folded, join, link, table, tag
from reports.site.standings import LEVELS, Race

UP = "../"


def index(site: Site) -> list[Html]:
    """Write the list of all surfaces that have a cell."""
    order = board.kinds(site)
    every = by_surface(site.cells)
    lines = []
    for page in sorted(every, key=lambda page: order.index(every[page][0].first.kind)):
        own = every[page]
        race = max(own, key=lambda race: race.size)
        winner = race.won[board.FIRST].winner
        pair = site.pictures.get((winner.at, winner.key)) if winner is not None else None
        drawn = _thumbnail(pair) if pair else ""
        best = "none" if winner is None else row_link(winner, "")
        methods = {m for one in own for m in one.methods}
        told = (race.first.kind, wording.text(race.first.degree), len(methods), len({one.first.on for one in own}))
        lines.append(Line((link(f"surfaces/{page}.html", drawn, race.first.surface_title), *told, best)))
    heads = (
        Head("surface"),
        Head("class"),
        Head("degree", True),
        Head("methods", True),
        Head("devices", True),
        Head(f"fastest, {BOUNDS[board.FIRST]}"),
    )
    return [table("Every surface that was timed, class by class; the fastest where most methods were.", heads, lines)]


def by_surface(races: Sequence[Race]) -> dict[str, list[Race]]:
    """Sort races by their surface's page."""
    found: dict[str, list[Race]] = {}
    for race in races:
        found.setdefault(str(race.first.page), []).append(race)
    return found


def fullest(races: Sequence[Race]) -> list[Race]:
    """Return for each surface the race with most methods, the first of several; it shows pictures of all of them."""
    return [max(own, key=lambda race: race.size) for own in by_surface(races).values()]


def _thumbnail(pair: pictures.Pair) -> Html:
    return tag("img", src=pair.shade, alt="", width=48, height=48, loading="lazy", class_="thumb")


def body(site: Site, page: str) -> list[Html]:
    """Write a surface's page."""
    own = by_surface(site.cells)[page]
    others = [r for r in by_surface(site.races)[page] if not any(r is race for race in own)]
    first = own[0].first
    kind = () if str(first.kind).startswith("Degree") else (first.kind,)
    degree = () if wording.absent(first.degree) else (f"degree {first.degree}",)
    said = ", ".join((*kind, *degree, f"domain {wording.text(first.domain)}"))
    facts = tag("p", f"{said[0].upper()}{said[1:]}.", class_="lead")
    formula = code(f"{first.formula} = 0") if not wording.absent(first.formula) else None
    extent = None if wording.absent(first.extent) else tag("p", first.extent)
    jumps = tag(
        "nav", *(link(f"#{_id(race)}", site.place(race.first)) for race in own), aria_label="Devices", class_="jumps"
    )
    made: list[Html | None] = [facts, formula, extent, jumps if len(own) > 1 else None, pictures.legend(site.scale)]
    made += [_race(site, race, opened=True) for race in own]
    if others:
        made.append(tag("h2", "Other views, sizes and stages"))
        made += [_race(site, race, opened=False) for race in others]
    return [part for part in made if part is not None]


def _id(race: Race) -> str:
    """Return the id of a race on its surface's page."""
    row = race.first
    return f"c-{row.at}-{row.key}"


def _race(site: Site, race: Race, opened: bool) -> Html:
    """Write one race, under a heading to open unless it is `opened`."""
    row = race.first
    what = f"view {row.view}, {picture_size(row)}, {row.stage}"
    parts: list[object] = [
        _answers(race) if opened else None,
        cells.error_plot(site, race.rows, f"{row.surface_title} on {row.on}"),
        _gallery(site, race),
        rows_table(site, f"Every setting timed, fastest first: {what}. {_baseline(site, race)}", race.rows),
        _untimed(site, race),
        _source(site, race),
    ]
    title = f"{row.on}, {row.precision}"
    if opened:
        return tag(
            "section", tag("h2", title, id=_id(race)), tag("p", f"{what[0].upper()}{what[1:]}.", class_="faint"), *parts
        )
    return folded(tag("span", f"{title}: {what}", id=_id(race)), *parts)


def _untimed(site: Site, race: Race) -> Html | None:
    """Name the methods of which no setting could be timed, and how they ended; None where there are none."""
    told = [f"{site.label(method)} ({row.status})" for method, row in race.untimed.items()]
    return tag("p", f"No setting could be timed of {wording.listed(told)}.", class_="faint") if told else None


def _baseline(site: Site, race: Race) -> str:
    return f"Speed-ups are over {site.baseline(race.rows)}."


def _answers(race: Race) -> Html:
    """Write the winner at each bound, and what it risks to take a faster one."""
    lines = []
    for name, _ in LEVELS:
        won = race.won[name]
        if won.winner is None:
            lines.append(Line((BOUNDS[name], "none", "", "", "", "")))
            continue
        row = won.winner
        link_ = tag("a", row.label, href=f"#{pictures.anchor(row)}")
        tied = ", ".join(other.label for other in won.tied) or wording.NONE
        error = wording.error(row.relative_error_max)
        lines.append(Line((BOUNDS[name], link_, cells.speed(row, row.speedup), error, tied, risk(won) or wording.NONE)))
    heads = (
        Head("bound"),
        Head("fastest with every ray right"),
        Head("time, speed-up"),
        Head("largest error", True, RADIUS),
        Head("not told apart from"),
        Head("faster, and wrong"),
    )
    return table(f"The answer, at bounds on the largest error {RADIUS}.", heads, lines)


def _gallery(site: Site, race: Race) -> Html | None:
    """Write the pictures of a race's rows that have any."""
    drawn = [pictures.shown(pair, row, UP) for row in race.each if (pair := site.pictures.get((row.at, row.key)))]
    if not drawn:
        return None
    return join(tag("h3", "Pictures and error maps"), tag("div", *drawn, class_="gallery"))


def _source(site: Site, race: Race) -> Html:
    """Say where a race comes from, how to run it again, and which older ones it stands for."""
    row = race.first
    part = site.data.part(row.at)
    facts = (
        ("run", link(f"{UP}runs/{part.id}.html", part.plan.title or part.plan.name)),
        ("date", day(part.plan.created)),
        ("commit", part.commit),
        ("machine", row.processor),
        ("hardware", wording.text(row.hardware or None)),
        ("driver", wording.text(row.driver or None)),
    )
    told = tag("dl", *(join(tag("dt", name), tag("dd", value)) for name, value in facts))
    older = [_older(other) for other in race.older]
    rest = (
        join(tag("p", "The same scene was timed before, or with fewer methods:"), tag("ul", *older)) if older else None
    )
    return folded("Where this comes from, and how to run it again", told, cells.reproduce(part, row.device), rest)


def _older(race: Race) -> Html:
    row = race.first
    won = race.won["any"].winner
    fastest = (
        f"fastest {won.label}, {wording.number(won.median_ms)} ms"
        if won is not None
        else "no setting with every ray right"
    )
    run = link(f"{UP}runs/{row.at}.html", row.at)
    return tag("li", run, ", ", day(row.created), f", {wording.plural(race.size[0], 'method')}: {fastest}")
