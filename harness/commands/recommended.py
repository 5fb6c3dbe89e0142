"""Write the page of a recommendation: what `firsthit recommend -o FILE` makes of what was found."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path

import surfaces
from harness import __version__
from harness.commands.answers.recommending import Beside
from harness.recommend import telling
from harness.recommend.model import Recommendation, Wish, named
from harness.recommend.search import certified_error
from harness.recommend.telling import Told
from harness.shipping.program import domain_of
from reports import wording
from reports.recommended import Recommended, RunnerUp, write

LONGEST = 400  # characters of a formula
EARLY = "* in a first short timing, over the fastest variant's time there."
AGAIN, SHIP = "The same search again:", "The recommended program, with an example that draws it:"
NAMES = {"rule": "safety", "guarantee": "guarantee", "checked": "checked"}


def write_page(found: Recommendation, wish: Wish, beside: Beside, path: Path) -> None:
    """Write the page to `path`. Raises FirsthitError where it cannot be written."""
    created = datetime.now(UTC).isoformat(timespec="seconds")
    best = found.contenders[0] if found.contenders else None
    facts = [("device", f"{found.device.name}: {found.device.title}, {found.device.driver}")]
    facts += [("mind", telling.mind(found))] if found.extent else []
    facts += [(NAMES[name], text) for name, text in telling.certainty(found, wish).items()]
    formula = wording.excerpt(surfaces.canonical(wish.surface), LONGEST)
    facts += [("surface", f"{formula} = 0, in {domain_of(wish.surface)}")]
    runners_up = [_runner_up(other, found) for other in telling.others(found, wish)]
    picture, arrays = "", None
    if found.picture is not None and found.folder is not None:
        accuracy = found.picture["accuracy"]
        arrays = found.folder / str(found.picture["arrays"])
        size, largest = accuracy["size"], certified_error(accuracy, "max") or 0.0
        picture = f"{size}x{size} rays, {accuracy['truth_hits']:,} hits, largest error {largest:.2g}."
    page = Recommended(
        f"What draws {telling.subject(wish.surface)}?",
        f"firsthit {__version__} · {created[:10]} · {found.device.name}",
        telling.question(found, wish),
        telling.answer(found, wish),
        facts,
        arrays,
        picture,
        runners_up,
        f"Time is over that of {named(best.variant)}. {EARLY}" if best else EARLY,
        [(AGAIN, beside.again), *([(SHIP, beside.ship)] if beside.ship else [])],
    )
    write(page, path, created)


def _runner_up(other: Told, found: Recommendation) -> RunnerUp:
    held = any((c.variant, c.precision) == (other.best, other.precision) for c in found.contenders)
    variant = f"{telling.how(other.best).removeprefix('with ')}, {other.precision}"
    why = other.sentence.removeprefix(other.method).strip()
    return RunnerUp(other.method, variant, other.times, not held, other.error, why)
