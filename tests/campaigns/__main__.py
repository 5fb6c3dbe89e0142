"""Run campaigns: python -m tests.campaigns [NAME …] [--cases N] [--seed S] [--jobs J] [--table docs/reliability.md].

Without a name all are run. What was found is kept below --folder by seed and by what was tried: a campaign that was
stopped goes on, and results of other code are not counted. Exit codes: 0 all promises hold, 1 one does not, 2 usage,
130 stopped by Ctrl-C, 143 by SIGTERM, 129 by SIGHUP. `--only N` makes one trial again, in this process.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from pathlib import Path

from harness.stopping import code_of, stoppable
from tests.campaigns import frame, table


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"one of {', '.join(frame.names())}")
    parser.add_argument("--cases", type=int, help="cases of each campaign, if not as many as it states")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--folder", type=Path, default=Path("build/campaigns"))
    parser.add_argument("--table", type=Path, help="a Markdown file whose table gets a row for each campaign")
    parser.add_argument("--only", type=int, metavar="N", help="make one trial again, in this process")
    options = parser.parse_args()
    if unknown := set(options.names) - set(frame.names()):
        parser.error(f"there is no campaign {', '.join(sorted(unknown))}; known: {', '.join(frame.names())}")
    fell = 0
    for name in options.names or frame.names():
        try:
            with stoppable():
                fell += _run(name, options)
        except KeyboardInterrupt as error:
            kept = frame.read_kept(frame.kept_in(options.folder / name, options.seed))[0]
            told = f"{kept.cases:,} cases of {name} are kept, and the same command goes on from there"
            print(f"stopped; {told}", file=sys.stderr, flush=True)
            return code_of(error)
    return 1 if fell else 0


def _run(name: str, options: argparse.Namespace) -> int:
    """Run one campaign, print what it found, and return how many trials fell."""
    campaign, folder = frame.campaign_named(name), options.folder / name
    count = options.cases or campaign.whole
    print(f"{name}: {count:,} cases, seed {options.seed}, code {frame.code()}; {campaign.promise}", flush=True)
    kept = frame.kept_in(folder, options.seed)
    if others := [path.name for path in sorted(folder.glob(f"seed-{options.seed}-*.jsonl")) if path != kept]:
        print(f"  not counted, since they are of other code: {', '.join(others)}", flush=True)
    if options.only is not None:
        shared = frame.prepared(campaign, folder)
        found = frame.trials(campaign, options.seed, range(options.only, options.only + 1), shared)
    else:
        found = frame.run(campaign, options.seed, count, folder, options.jobs, _teller(count))
    print("\n".join([table.line(name, found), *found.told]), flush=True)
    if options.table and options.only is None:
        table.write(options.table, campaign, found, options.seed)
    return found.fell


def _teller(count: int) -> Callable[[frame.Found], None]:
    last = time.monotonic()

    def tell(found: frame.Found) -> None:
        nonlocal last
        if time.monotonic() - last > 30.0:
            last = time.monotonic()
            print(f"  {found.cases} of {count}, {found.fell} fell", flush=True)

    return tell


if __name__ == "__main__":
    sys.exit(main())
