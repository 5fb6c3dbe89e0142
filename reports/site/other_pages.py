"""Write the page of the data to download, and that which says how to send a run."""

from __future__ import annotations

from collections.abc import Mapping

from harness.results.columns import TYPES
from harness.results.schema import DERIVED, SCHEMA, Field
from reports import wording
from reports.site.cells import Site
from reports.site.markup import Head, Html, Line, code, folded, join, link, table, tag

MORE: tuple[Field, ...] = (  # the columns that only a site's data has, beside those of results.csv
    Field(
        "processor",
        "text",
        ("processor",),
        "the processor of the machine, and its system where two share the processor",
    ),
    Field("on", "text", ("on",), "the device, with hardware, driver and machine where others have its name too"),
    Field("driver", "text", ("driver",), "the device's driver"),
    Field("created", "text", ("created",), "when the run was planned, ISO 8601"),
)
BARE = ("identity",)  # what CSV lacks, since it is longer than all other columns together
EXAMPLE = """import pandas
rows = pandas.read_parquet("results.parquet")
right = rows[(rows.status == "ok") & (rows.wrong_rays == 0)]
print(right.groupby(["on", "method"]).speedup.median().unstack())"""


def data(site: Site, sizes: Mapping[str, int]) -> list[Html]:
    """Write the page of downloads; `sizes` has the bytes of each file by its path."""
    lines = [
        Line(
            (
                link(path, path.rpartition("/")[2], download=True),
                f"{bytes_ / 1e6:.1f} MB" if bytes_ > 1e5 else f"{bytes_ / 1e3:.0f} kB",
            )
        )
        for path, bytes_ in sizes.items()
    ]
    count = wording.plural(len(site.data.frame), "row")
    fields = (*SCHEMA, *DERIVED, *MORE)
    columns = [Line((field.name, TYPES[field.kind], field.meaning)) for field in fields]
    return [
        tag(
            "p",
            f"{count} of {wording.plural(len(site.data.parts), 'run')}: all that these pages are made of, and more. A "
            "row is a variant on a view of a surface, on a device. Lengths are in scene units, the surface's own "
            "coordinates, unless a column says otherwise.",
            class_="lead",
        ),
        table("Downloads.", (Head("file"), Head("size", True)), lines),
        tag(
            "p",
            "Only Parquet has the column identity, all that decides a row. There missing values are nulls; in CSV they "
            "are empty, and lists and objects are JSON.",
        ),
        tag("h2", "In Python"),
        code(EXAMPLE),
        tag("h2", "Columns"),
        tag("p", "docs/columns.md of firsthit says the same, with the leaves of the stored rows that they come from."),
        folded(
            f"{len(fields)} columns",
            table("What each column means.", (Head("column"), Head("type"), Head("meaning")), columns),
        ),
    ]


RUN = """make .venv/ready
.venv/bin/firsthit devices
.venv/bin/firsthit run quick"""
SEND = "tar czf quick-$(date +%F).tar.gz -C runs quick"
PUBLISH = """mkdir -p runs/theirs
tar xzf quick-2026-01-31.tar.gz -C runs/theirs
.venv/bin/firsthit publish runs/mine runs/theirs/quick -o site"""


def submit(site: Site) -> list[Html]:
    """Write how to run a config on a machine of one's own and send the run, and what is looked at then."""
    to = site.contact
    address = link(to, to) if to.startswith(("https://", "http://", "mailto:")) else to
    whom = join("Send the file to ", address, ".") if to else "Send the file to those who keep this site."
    return [
        tag(
            "p",
            "Run the suite on your machine, pack the run's folder, send it. That takes ten minutes and no account.",
            class_="lead",
        ),
        tag("h2", "1. Run"),
        tag("p", "In a clone of firsthit without changes of yours, so that the commit says what ran:"),
        code(RUN),
        tag(
            "p",
            "The second command lists the devices here and whether they can be used; the third runs the config quick "
            "on all of them. Any other config does too: ",
            tag("code", "firsthit list configs"),
            " names them. A run that was stopped goes on where it was.",
        ),
        tag("h2", "2. Look at it"),
        code(".venv/bin/firsthit report runs/quick"),
        tag("h2", "3. Send"),
        code(SEND),
        tag(
            "p",
            whom,
            " The folder holds rows, answers ray by ray, the config, versions, and the names of processor, devices and "
            "drivers. User and host names are not among them, but for what you write into a config, and the paths that "
            "you typed.",
        ),
        tag("h2", "What is looked at"),
        tag(
            "ul",
            tag(
                "li",
                "Each row's key is a hash of all that decides the row: surface, view, kernel and harness sources, "
                "device, driver, versions. ",
                tag("code", "firsthit publish"),
                " computes it anew, and leaves a row out whose key is not its own.",
            ),
            tag(
                "li",
                "The answers that a row has pictures of are counted anew: wrong rays by kind, and the largest error. A "
                "row whose figures are not those of its answers is named on the page of runs.",
            ),
            tag(
                "li",
                "The certified first hits follow from surface and view alone. Whoever keeps the site runs the "
                "same config at the same commit: on a device with the same arithmetic the answers agree to the last "
                "digit, on any other the errors stay in the gate's tolerance. ",
                tag("code", "firsthit report"),
                " with both runs lists every answer that changed.",
            ),
            tag(
                "li",
                "Times cannot be checked from afar. They stand beside machine, driver and commit.",
            ),
            tag("li", "A file that is damaged is named, and the rest is shown."),
        ),
        tag("h2", "Where it goes"),
        tag("p", "Whoever keeps the site unpacks the file and makes the pages again:"),
        code(PUBLISH),
    ]
