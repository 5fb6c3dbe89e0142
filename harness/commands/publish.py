"""Offer `firsthit publish`: make a static site from many runs."""

from __future__ import annotations

import argparse
from pathlib import Path

from harness.commands import Add
from harness.commands.options import tell_wrong
from harness.contract import FirsthitError
from harness.results import archive


def add_parsers(add: Add) -> None:
    parser = add(
        "publish",
        "firsthit publish runs/papers runs/front -o site",
        "Make a static site from many runs, of any machines, devices and commits: a leaderboard with filters, a page "
        "for each surface, method and run, pictures with error maps, and all rows as Parquet and CSV. It needs no "
        "server. A run that cannot be read is named, there and on standard error, and the others are shown. Runs "
        "nothing.",
    )
    parser.add_argument("folders", type=Path, metavar="RUN", nargs="+", help="a folder below runs/, or an archive")
    parser.add_argument(
        "-o", "--output", type=Path, metavar="DIR", required=True, help="a new folder, or an older site"
    )
    parser.add_argument("--title", metavar="TEXT", help="what the site is called")
    parser.add_argument("--contact", metavar="TEXT", default="", help="whom one sends a run to: an address, or words")
    parser.set_defaults(run=_publish)


def _publish(options: argparse.Namespace) -> int:
    """Make the site. Raises FirsthitError if a package is missing."""
    try:
        from reports.site import build
    except ModuleNotFoundError as error:
        message = (
            f"a site needs the package {error.name}: pip install 'firsthit[report]'; runs/ can be copied elsewhere"
        )
        raise FirsthitError(message, exit_code=3) from None
    with archive.all_opened(options.folders) as folders:
        index, problems = build.build(folders, options.output, options.title or build.TITLE, options.contact)
    for problem in problems:
        tell_wrong(f"firsthit: {problem}")
    print(index)
    return 0
