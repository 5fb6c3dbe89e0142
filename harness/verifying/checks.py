"""Check all rows of run folders again, and collect what does not hold.

Rows are read and checked in chunks, which processes may take (harness.spreading). Then the rows of the sample are held
against truth that is certified anew: rows that share it one after the other, so that one truth at a time is held.
"""

from __future__ import annotations

import itertools
import random
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from harness import spreading
from harness.contract import FirsthitError, Surface, Truth
from harness.oracle import cache, first_hits
from harness.results import plan_file, sealed
from harness.results.store import Store
from harness.verifying.columns import columns_of, groups_of
from harness.verifying.model import Wrong
from harness.verifying.one import FAMILY, Held, Place, Rows, Sampled, checked, family_anew, hold_anew, row_of
from harness.verifying.truth import Rays, rays_for

CHECKS = {
    "file": "it can be read, its checksum holds, and it does not contradict itself",
    "stated": "key, slot and columns follow from the identity",
    "columns": "the columns of a Parquet part, which reports read, are those of its rows",
    "times": "times follow from their samples",
    "answers": "counts and errors follow from the answers ray by ray",
    "truth": "the truth certified anew is the one it was judged by",
    "stored truth": "the truth that the run's folder keeps is the one it was judged by",
}
CHUNK = 32  # rows that one process takes at a time
AT_ONCE = 32  # chunks between two lines that tell how far it is


@dataclass(frozen=True)
class Failing:
    """Say which value of which row does not hold; `check` is a name of CHECKS."""

    file: Path
    slot: str
    check: str
    wrong: Wrong


@dataclass
class Verified:
    """Hold what checking rows again found.

    rows: how many were looked at
    checked: how many rows each of CHECKS was made for
    not_checked: how many it says nothing of, by check and reason
    failing: what does not hold
    missing: cells that a plan names and that have no row; no fault
    certifiable: how many rows are of rays whose truth can be certified anew, or of a family
    sampled: of how many of these it was, or was tried
    seed: what chose them
    """

    rows: int = 0
    checked: Counter[str] = field(default_factory=Counter)
    not_checked: Counter[tuple[str, str]] = field(default_factory=Counter)
    failing: list[Failing] = field(default_factory=list)
    missing: int = 0
    certifiable: int = 0
    sampled: int = 0
    seed: int = 0

    def add(self, held: Held) -> None:
        """Add what was found of a row."""
        self.rows += 1
        self.checked.update(held.checked)
        self.not_checked.update(held.not_checked)
        self.failing += [Failing(held.place.file, held.slot, check, wrong) for check, wrong in held.failing]


def folders_of(folder: Path) -> list[Path]:
    """Return a run's folder or, of a run that collects others, theirs.

    Raises FirsthitError where there is no run, or its plan cannot be read.
    """
    plan = _plan(folder)
    parts = plan.get("include", ())
    return [folder.parent / part for part in parts] if parts else [folder]


def _plan(folder: Path) -> Mapping[str, Any]:
    path = folder / "plan.json"
    try:
        return plan_file.read(path)
    except FileNotFoundError:
        raise FirsthitError(f"there is no run folder {folder}; `firsthit run CONFIG` makes one under runs/") from None
    except (OSError, ValueError) as error:
        raise FirsthitError(f"{path} is damaged ({sealed.problem(error)})", exit_code=3) from None


def verify(
    folders: Iterable[Path],
    sample: Callable[[int], int],
    seed: int,
    tell: Callable[[str], None] = lambda _: None,
) -> Verified:
    """Check the rows of run folders again.

    The truth of as many rows as `sample` says of their number is certified anew; `seed` chooses them. Raises
    FirsthitError where a folder is no run.
    """
    found = Verified(seed=seed)
    every = [folder for one in folders for folder in folders_of(one)]
    chunks = [chunk for folder in every for chunk in _chunks(folder, found)]
    number = sum(len(chunk.keys) for chunk in chunks)
    held: list[Held] = []
    for start in range(0, len(chunks), AT_ONCE):
        tell(f"checking [{len(held) + 1}/{number}] {chunks[start].folder}")
        held += itertools.chain.from_iterable(spreading.answers(checked, chunks[start : start + AT_ONCE]))
    certifiable = [k for k, one in enumerate(held) if one.certifiable]
    chosen = random.Random(seed).sample(certifiable, min(len(certifiable), sample(len(certifiable))))
    found.certifiable, found.sampled = len(certifiable), len(chosen)
    for k, anew in _anew(held, sorted(chosen), tell):
        held[k] = held[k].with_anew(anew)
    for one in held:
        found.add(one)
    _columns(every, found)
    return found


def _chunks(folder: Path, found: Verified) -> list[Rows]:
    """Return a folder's rows in chunks, as they lie; note damaged parts, and what the plan names twice or in vain."""
    plan = _plan(folder)
    listed = [*plan["cells"], *plan.get("families", ())]
    slots = {cell["key"]: cell["slot"] for cell in listed}
    for slot, count in Counter(cell["slot"] for cell in listed).items():
        if count > 1:
            found.failing.append(Failing(folder / "plan.json", slot, "file", Wrong("cells", f"{count} cells", "one")))
    store = Store(folder)
    for name, why in store.parts.problems().items():
        found.failing.append(Failing(folder / name, "", "file", Wrong("the part", why, "rows")))
    keys = store.in_storage_order(store.keys())
    found.missing += len(slots.keys() - set(keys))
    chunks = [keys[k : k + CHUNK] for k in range(0, len(keys), CHUNK)]
    state = store.parts.state()
    return [Rows(folder, state, tuple(own), {key: slots[key] for key in own if key in slots}) for own in chunks]


def _columns(folders: Iterable[Path], found: Verified) -> None:
    """Hold the columns of parts against their rows."""
    groups = [group for folder in folders for group in groups_of(folder)]
    for rows, wrong in spreading.answers(columns_of, groups):
        found.checked["columns"] += rows
        found.failing += [Failing(file, slot, "columns", one) for file, slot, one in wrong]


def _anew(held: list[Held], chosen: list[int], tell: Callable[[str], None]) -> Iterator[tuple[int, Held]]:
    """Yield the numbers of chosen rows, and what holding them against truth that is certified anew found.

    Rays are certified here, by as many processes as there are; then these hold the rows against that.
    """
    sharing: dict[str, list[int]] = {}
    for k in chosen:
        sharing.setdefault(held[k].truth, []).append(k)
    done = 0
    for name, numbers in sorted(sharing.items()):
        tell(f"certifying [{done + 1}/{len(chosen)}] {held[numbers[0]].slot}")
        done += len(numbers)
        places = [held[k].place for k in numbers]
        if name.startswith(FAMILY):
            yield from zip(numbers, _of_family(places), strict=True)
            continue
        tried = Held(places[0], "")
        truth = _certified(tried) if name else None
        if tried.failing:  # the row that was asked for them names rays that are none, and so do the others
            yield from ((k, tried) for k in numbers)
            continue
        parts = [Sampled(tuple(places[k : k + CHUNK]), truth) for k in range(0, len(places), CHUNK)]
        answers = spreading.answers(hold_anew, parts)
        yield from zip(numbers, itertools.chain.from_iterable(answers), strict=True)


def _certified(tried: Held) -> Truth | None:
    """Certify the rays of a row; None where that cannot be done, which `tried` then holds."""
    found: list[Truth] = []

    def certify() -> Iterable[Wrong]:
        found.append(first_hits(*rays_for(row_of(tried.place))))
        return ()

    tried.check("truth", certify)
    return found[0] if found else None


def _of_family(places: Iterable[Place]) -> list[Held]:
    """Hold rows of one family against the truth of its rays, which is certified once."""
    known: dict[str, Truth] = {}

    def certified(surface: Surface, rays: Rays) -> Truth:
        name = cache.truth_path(Path(), surface, rays).name
        if name not in known:
            known[name] = first_hits(surface, rays)
        return known[name]

    return [family_anew(place, certified) for place in places]
