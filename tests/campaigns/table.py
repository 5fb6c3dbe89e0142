"""Write what campaigns found as rows of the table of docs/reliability.md."""

from __future__ import annotations

from collections import Counter
from datetime import date
from pathlib import Path

from harness.running.environment import describe
from tests.campaigns.frame import Campaign, Found

HEAD = "| Campaign | Cases | What happened | Promise | Fell | Seed | Date, commit, machine |"

MANY = 12  # outcomes, beyond which those of many kinds are counted together


def line(name: str, found: Found) -> str:
    """Return one line for the terminal."""
    return f"{name}: {found.cases:,} cases in {found.seconds:.0f} s; {_counts(found)}; {found.fell} fell"


def _counts(found: Found) -> str:
    """Say how often each outcome was met; of outcomes `KIND: WHAT` how often each WHAT, if there are many."""
    counts, kinds = found.counts, {outcome.partition(": ")[0] for outcome in found.counts if ": " in outcome}
    if len(counts) > MANY and kinds:
        counts = Counter()
        for outcome, count in found.counts.items():
            counts[outcome.rpartition(": ")[2]] += count
    told = ", ".join(f"{count:,} {outcome}" for outcome, count in counts.most_common())
    return f"{told}, of {len(kinds)} kinds" if counts is not found.counts else told


def write(path: Path, campaign: Campaign, found: Found, seed: int) -> None:
    """Put the campaign's row into the table of a Markdown file, in the place of its former ones; others stay."""
    here = describe()
    where = f"{date.today().isoformat()}, {str(here['commit'])[:7]}{'+' * bool(here['dirty'])}, {here['cpu']}"
    cells = (campaign.name, f"{found.cases:,}", _counts(found), campaign.promise, str(found.fell), str(seed), where)
    row = f"| {' | '.join(cells)} |"
    lines = path.read_text(encoding="utf-8").splitlines()
    at = lines.index(HEAD) + 2
    end = next((i for i in range(at, len(lines)) if not lines[i].startswith("|")), len(lines))
    rows = [*(text for text in lines[at:end] if _campaign(text) != campaign.name), row]
    lines[at:end] = sorted(rows, key=_campaign)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _campaign(row: str) -> str:
    return row.split("|")[1].strip()
