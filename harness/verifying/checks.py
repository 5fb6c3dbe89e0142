"""Check all rows of run folders again, and collect what does not hold."""

from __future__ import annotations

import random
from collections import Counter, OrderedDict
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from harness.contract import FirsthitError, Surface, Truth
from harness.oracle import cache, first_hits
from harness.results import compaction, plan_file, sealed
from harness.results.parts import KEY, TEXT, Part
from harness.results.store import Row, Store, row_of
from harness.verifying import answers, rungs, stated, times
from harness.verifying import truth as truths
from harness.verifying.model import CannotTell, Wrong
from harness.verifying.truth import Rays

CHECKS = {
    "file": "it can be read, its checksum holds, and it does not contradict itself",
    "stated": "key, slot and columns follow from the identity",
    "columns": "the columns of a Parquet part, which reports read, are those of its rows",
    "times": "times follow from their samples",
    "answers": "counts and errors follow from the answers ray by ray",
    "truth": "the truth certified anew is the one it was judged by",
    "stored truth": "the truth that the run's folder keeps is the one it was judged by",
}
MOST_TRUTHS = 16  # that are held at once
DAMAGED = (KeyError, TypeError, ValueError, AttributeError, IndexError, ArithmeticError, RecursionError, MemoryError)


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
    """

    rows: int = 0
    checked: Counter[str] = field(default_factory=Counter)
    not_checked: Counter[tuple[str, str]] = field(default_factory=Counter)
    failing: list[Failing] = field(default_factory=list)
    missing: int = 0


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
    found, rows = Verified(), list[tuple[Store, Path, Row]]()
    for folder in (part for one in folders for part in folders_of(one)):
        rows += _rows_of(folder, found)
    certifiable = [i for i, (_, _, row) in enumerate(rows) if row.get("accuracy") or row.get("rungs")]
    chosen = set(random.Random(seed).sample(certifiable, min(len(certifiable), sample(len(certifiable)))))
    kept = _Truths()
    for number, (store, file, row) in enumerate(rows):
        tell(f"checking [{number + 1}/{len(rows)}] {row['slot']}")
        found.rows += 1
        _Row(store, file, row, found, kept).check(anew=number in chosen)
    return found


def _rows_of(folder: Path, found: Verified) -> Iterator[tuple[Store, Path, Row]]:
    """Yield a folder's rows in the order of their files; note those that cannot be read, or contradict its plan."""
    store, plan = Store(folder), _plan(folder)
    listed = [*plan["cells"], *plan.get("families", ())]
    slots = {cell["key"]: cell["slot"] for cell in listed}
    named = Counter(cell["slot"] for cell in listed)
    for slot, count in named.items():
        if count > 1:
            found.failing.append(Failing(folder / "plan.json", slot, "file", Wrong("cells", f"{count} cells", "one")))
    for part in store.parts.all():
        if not part.problem:
            _columns(part, found)
    there = set()  # keys of rows, damaged ones too, which are no missing ones
    for name, why in store.parts.problems().items():
        found.failing.append(Failing(folder / name, "", "file", Wrong("the part", why, "rows")))
    for key in store.in_storage_order(store.keys()):
        file, row = store.place(key), store.read(key, older=True)
        there.add(key)
        if row is None:
            why = store.unreadable.get(key, "it is gone").removeprefix(f"{file} is ")
            found.rows += 1
            found.failing.append(Failing(file, slots.get(key, ""), "file", Wrong("the file", why, "a row")))
            continue
        if slots.get(key, row["slot"]) != row["slot"]:
            wrong = Wrong("slot", row["slot"], slots[key])
            found.failing.append(Failing(file, row["slot"], "file", wrong))
        if sealed.has_seal(store.text(key)):
            found.checked["file"] += 1
        else:
            found.not_checked["file", "it has no checksum: a version before checksums wrote it, or it was changed"] += 1
        yield store, file, row
    found.missing += len(slots.keys() - there)


def _columns(part: Part, found: Verified) -> None:
    """Hold the columns of a part against the rows that it holds."""
    for group in range(len(part.ends)):
        told = compaction.group(part, group)
        rows: list[tuple[Row, bytes]] = []
        for key, text in zip(told.column(KEY).to_pylist(), told.column(TEXT).to_pylist(), strict=True):
            try:
                rows.append((row_of(text, key), text))
            except (TypeError, ValueError):  # which is told of the row itself
                rows.append(({"key": key}, b""))
        made = compaction.table(rows).select([name for name in told.schema.names if name != TEXT])
        found.checked["columns"] += len(rows)
        for name in made.schema.names:
            stored, right = told.column(name), made.column(name)
            if stored.type == right.type and stored.equals(right):
                continue
            pairs = zip(rows, stored.to_pylist(), right.to_pylist(), strict=True)
            for (row, text), one, other in pairs:
                if one != other and text:
                    found.failing.append(Failing(part.path, row["slot"], "columns", Wrong(name, one, other)))
            if stored.type != right.type:
                found.failing.append(Failing(part.path, "", "columns", Wrong(name, str(stored.type), str(right.type))))


class _Truths:
    """Certify rays, and hold the newest answers, since all variants of a view are judged by the same."""

    def __init__(self) -> None:
        self._held: OrderedDict[str, Truth] = OrderedDict()

    def certified(self, surface: Surface, rays: Rays) -> Truth:
        name = cache.truth_path(Path(), surface, rays).name
        if name not in self._held:
            self._held[name] = first_hits(surface, rays)
            if len(self._held) > MOST_TRUTHS:
                self._held.popitem(last=False)
        self._held.move_to_end(name)
        return self._held[name]


@dataclass
class _Row:
    """Check one row, and add what is found."""

    store: Store
    file: Path
    row: Row
    found: Verified
    truths: _Truths
    _arrays: answers.Arrays | None = None

    def check(self, anew: bool) -> None:
        self._one("stated", lambda: stated.stated(self.row))
        self._one("times", lambda: times.times(self.row))
        if self.row.get("family") is not None:
            if anew:
                self._one("truth", lambda: rungs.rungs(self.row, self.truths.certified))
            return
        self._one("answers", self._answers)
        if self._arrays is not None:
            self._one("truth" if anew else "stored truth", lambda: self._truth(anew))

    def _one(self, name: str, check: Callable[[], Iterable[Wrong]]) -> None:
        """Make one check. A row that it cannot make anything of is damaged, which is no fault of the check."""
        wrong: list[Wrong] = []
        try:
            wrong.extend(check())
            self.found.checked[name] += 1
        except CannotTell as reason:
            self.found.not_checked[name, str(reason)] += 1
        except OSError as error:
            wrong.append(Wrong("the row", f"cannot read {error.filename}: {error.strerror}", "what can be checked"))
        except FirsthitError as error:
            wrong.append(Wrong("the row", str(error), "what can be checked"))
        except DAMAGED as error:
            wrong.append(Wrong("the row", f"{type(error).__name__}: {error}", "values of a row"))
        self.found.failing += [Failing(self.file, self.row["slot"], name, one) for one in wrong]

    def _answers(self) -> Iterable[Wrong]:
        self._arrays = answers.arrays_of(self.store.folder, self.row)
        return answers.answers(self.row, self._arrays)

    def _truth(self, anew: bool) -> Iterable[Wrong]:
        surface, rays = truths.rays_for(self.row)
        stored = cache.load(cache.truth_path(self.store.truth, surface, rays), len(rays))
        if not anew and stored is None:
            raise CannotTell("its truth is kept by no file here, and its row is not in the sample")
        assert self._arrays is not None
        found = self.truths.certified(surface, rays) if anew else stored
        assert found is not None
        return truths.truth(self.row, self._arrays, surface, rays, found)
