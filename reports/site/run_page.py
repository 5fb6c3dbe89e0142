"""Write the pages of runs and their machines: where and by which commands they were made, and what failed."""

from __future__ import annotations

from collections.abc import Mapping

from reports import wording
from reports.parts.last_page import environment
from reports.reading.run import Plan
from reports.site import cells
from reports.site.cells import Site
from reports.site.gather import Part, failed
from reports.site.markup import Head, Html, Line, code, day, folded, join, link, of_content, table, tag

UP = "../"
MOST = 200  # failed rows that a page lists
REASON = 300  # characters of a reason


def index(site: Site) -> list[Html]:
    """Write the list of all runs, and what of them could not be read."""
    lines = []
    for part in sorted(site.data.parts, key=lambda part: part.plan.created, reverse=True):
        devices = ", ".join(str(device.get("name")) for device in part.plan.devices)
        name = link(f"runs/{part.id}.html", part.plan.title or part.plan.name)
        told = (day(part.plan.created), part.machine, devices, part.commit, len(part.rows), len(failed(part.rows)))
        lines.append(Line((name, *told, _shows(site, part))))
    heads = (
        Head("run"),
        Head("date"),
        Head("machine"),
        Head("devices"),
        Head("commit"),
        Head("rows", True),
        Head("failed", True),
        Head("on the leaderboard"),
    )
    problems = [tag("li", problem) for problem in site.data.problems]
    below = [tag("h2", "What could not be used"), tag("ul", *problems, class_="problems")] if problems else []
    return [table("All runs, the newest first.", heads, lines), *below]


def _shows(site: Site, part: Part) -> str:
    """Say how many cells of the leaderboard are of a run, or why none is."""
    here = sum(race.first.at == part.id for race in site.cells)
    if here:
        return wording.plural(here, "cell")
    if any(race.first.at == part.id for race in site.races):
        return "none: other runs of its surfaces have more methods, or are newer"
    if any(other.first.at == part.id for race in site.races for other in race.older):
        return "none: replaced by other runs of its scenes"
    return f"none: {_nothing(part)}"


def _nothing(part: Part) -> str:
    """Say what a run holds in place of rows that race."""
    held = wording.listed(_held(part))
    return f"it holds {held}, and no timed view" if held else "it has no timed row with answers"


def _held(part: Part) -> list[str]:
    """Say what a run holds that its report shows, and this site does not."""
    ladders = [f"{wording.plural(part.families, 'ladder')} of hard rays"] if part.families else []
    return ladders + ([f"results of {wording.listed(part.studies)}"] if part.studies else [])


def body(site: Site, part: Part) -> list[Html]:
    """Write a run's page."""
    plan = part.plan
    missing = f"{wording.plural(part.not_run, 'planned cell')} had not run." if part.not_run else ""
    made: list[Html | None] = [
        tag("p", "Made on ", day(plan.created), f" on {part.machine}, commit {part.commit}.", class_="lead"),
        tag("p", f"On the leaderboard: {_shows(site, part)}. {missing}"),
        _elsewhere(part),
        _surfaces(site, part),
        tag("h2", "To run it again"),
        code("\n".join(cells.commands(part))),
        tag("p", "The command of this run was ", tag("code", plan.command), "."),
        tag("h2", "Machine and software"),
        _environment(plan),
        of_content(environment.devices_table(plan)) if plan.devices else None,
        folded("The config", code(plan.config_text), opened=len(plan.config_text) < 3000),
        _failures(part),
        _problems(part),
    ]
    return [one for one in made if one is not None]


def _elsewhere(part: Part) -> Html | None:
    """Say where one finds what this site does not show of a run."""
    held = wording.listed(_held(part))
    return tag("p", f"Its report, not this site, shows {held}.") if held else None


def _surfaces(site: Site, part: Part) -> Html | None:
    """Link to the surfaces that have rows of this run."""
    pages = {race.first.page for race in site.races}
    rows = (
        part.rows.merge(site.data.frame[["at", "key", "page"]], on=["at", "key"]).drop_duplicates("page")
        if len(part.rows)
        else part.rows
    )
    if rows.empty:
        return None
    names = [link(f"{UP}surfaces/{row.page}.html", row.surface_title) for row in rows.itertuples() if row.page in pages]
    return (
        tag("p", "Surfaces: ", join(*(join(", " if i else "", name) for i, name in enumerate(names))), ".")
        if names
        else None
    )


def _environment(plan: Plan) -> Html:
    """Write each fact about the machine and the software of a run."""
    told = {name: value for name, value in plan.environment.items() if not isinstance(value, Mapping)}
    packages = plan.environment.get("versions")
    if isinstance(packages, Mapping):
        told["packages"] = ", ".join(f"{name} {version}" for name, version in packages.items())
    lines = [Line((name, wording.text(value))) for name, value in {"config": plan.config, **told}.items()]
    whose = " of the first of its runs" if plan.merged else ""
    return table(f"The machine and the software{whose}.", (Head("fact"), Head("value")), lines)


def _failures(part: Part) -> Html | None:
    """List the rows that failed, with the reason of each."""
    rows = failed(part.rows)
    if rows.empty:
        return None
    lines = [
        Line((row.slot, row.status, wording.excerpt(wording.text(row.reason), REASON)))
        for row in rows.head(MOST).itertuples()
    ]
    caption = f"Cells that did not end well.{wording.first_of(len(lines), len(rows))}"
    return join(tag("h2", "Failures"), table(caption, (Head("cell"), Head("how it ended"), Head("why")), lines))


def _problems(part: Part) -> Html | None:
    if not part.problems:
        return None
    told = [tag("li", problem) for problem in part.problems]
    return join(tag("h2", "What could not be read"), tag("ul", *told, class_="problems"))
