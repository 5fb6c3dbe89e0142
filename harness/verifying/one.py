"""Check rows one by one: first all that a row's own folder tells, then, of a sample, its truth, certified anew."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path

from harness.contract import FirsthitError, Surface, Truth
from harness.oracle import cache
from harness.results import sealed
from harness.results.parts import State
from harness.results.store import Row, Store
from harness.verifying import answers, rungs, stated, times
from harness.verifying import truth as truths
from harness.verifying.model import CannotTell, Wrong
from harness.verifying.truth import Rays

DAMAGED = (KeyError, TypeError, ValueError, AttributeError, IndexError, ArithmeticError, RecursionError, MemoryError)
FAMILY = "family "  # how the name begins of what families' rows share in place of a truth
NO_CHECKSUM = "it has no checksum: a version before checksums wrote it, or it was changed"


@dataclass(frozen=True)
class Place:
    """Tell where a row is: in which folder, and by which key. `parts` are the parts there (Parts.state)."""

    folder: Path
    parts: State
    key: str

    @property
    def store(self) -> Store:
        return _store(self.folder, self.parts)

    @property
    def file(self) -> Path:
        return self.store.place(self.key)


@dataclass(frozen=True)
class Rows:
    """Name rows of a folder by their keys, and the slots that its plan says of some. `parts` are as Place has them."""

    folder: Path
    parts: State
    keys: tuple[str, ...]
    slots: Mapping[str, str]


@dataclass(frozen=True)
class Sampled:
    """Name rows that share a truth, which was certified anew; None where none of them says its rays."""

    places: tuple[Place, ...]
    truth: Truth | None


@dataclass
class Held:
    """Hold what was found of one row.

    checked: the checks that were made
    not_checked: those that could not be, with the reason
    failing: what does not hold, by check
    certifiable: whether it is of rays whose truth can be asked for, or of a family
    truth: the same text in all rows that share their truth; "" where the row does not say its rays
    """

    place: Place
    slot: str
    checked: list[str] = field(default_factory=list)
    not_checked: list[tuple[str, str]] = field(default_factory=list)
    failing: list[tuple[str, Wrong]] = field(default_factory=list)
    certifiable: bool = False
    truth: str = ""

    def check(self, name: str, check: Callable[[], Iterable[Wrong]]) -> None:
        """Make one check. A row that it cannot make anything of is damaged, which is no fault of the check."""
        wrong: list[Wrong] = []
        try:
            wrong.extend(check())
            self.checked.append(name)
        except CannotTell as reason:
            self.not_checked.append((name, str(reason)))
        except OSError as error:
            wrong.append(Wrong("the row", f"cannot read {error.filename}: {error.strerror}", "what can be checked"))
        except FirsthitError as error:
            wrong.append(Wrong("the row", str(error), "what can be checked"))
        except DAMAGED as error:
            wrong.append(Wrong("the row", f"{type(error).__name__}: {error}", "values of a row"))
        self.failing += [(name, one) for one in wrong]

    def with_anew(self, anew: Held) -> Held:
        """Return this with what the truth certified anew told, in place of what the folder's truth did."""
        old = "stored truth"
        return replace(
            self,
            checked=[name for name in self.checked if name != old] + anew.checked,
            not_checked=[one for one in self.not_checked if one[0] != old] + anew.not_checked,
            failing=[one for one in self.failing if one[0] != old] + anew.failing,
        )


def _store(folder: Path, parts: State) -> Store:
    """Return the store of a folder; one with parts is opened once, since that takes as long as reading 1,000 rows."""
    return _with_parts(folder, parts) if parts else Store(folder)


@lru_cache(maxsize=4)
def _with_parts(folder: Path, parts: State) -> Store:
    del parts  # decides whether what was opened before is still right
    return Store(folder)


def checked(rows: Rows) -> list[Held]:
    """Read rows, and check all of them that needs no truth but what their folder keeps."""
    return [_checked(Place(rows.folder, rows.parts, key), rows.slots.get(key)) for key in rows.keys]


def _checked(place: Place, slot: str | None) -> Held:
    store, key = place.store, place.key
    file, row = store.place(key), store.read(key, older=True)
    if row is None:
        why = store.unreadable.get(key, "it is gone").removeprefix(f"{file} is ")
        return Held(place, slot or "", failing=[("file", Wrong("the file", why, "a row"))])
    held = Held(place, row["slot"], certifiable=bool(row.get("accuracy") or row.get("rungs")))
    if slot is not None and row["slot"] != slot:
        held.failing.append(("file", Wrong("slot", row["slot"], slot)))
    if sealed.has_seal(store.text(key)):
        held.checked.append("file")
    else:
        held.not_checked.append(("file", NO_CHECKSUM))
    held.check("stated", lambda: stated.stated(row))
    held.check("times", lambda: times.times(row))
    if row.get("family") is not None:
        held.truth = f"{FAMILY}{row['family']}"
        return held
    found: list[answers.Arrays] = []
    held.check("answers", lambda: _answers(store, row, found))
    held.check("stored truth", lambda: _by_folder(store, row, found, held))
    return held


def _answers(store: Store, row: Row, found: list[answers.Arrays]) -> Iterable[Wrong]:
    """Check a row's answers, and add its arrays to `found`."""
    found.append(answers.arrays_of(store.folder, row))
    return answers.answers(row, found[0])


def _by_folder(store: Store, row: Row, found: list[answers.Arrays], held: Held) -> Iterable[Wrong]:
    """Hold a row against the truth that its folder keeps, and note which it is."""
    surface, rays = truths.rays_for(row)
    path = cache.truth_path(store.truth, surface, rays)
    held.truth = path.name
    stored = cache.load(path, len(rays))
    if stored is None:
        raise CannotTell("its truth is kept by no file here, and its row is not in the sample")
    return truths.truth(row, found[0] if found else None, surface, rays, stored)


def row_of(place: Place) -> Row:
    """Read a row that could be read before. Raises FirsthitError where it is gone."""
    row = place.store.read(place.key, older=True)
    if row is None:
        raise FirsthitError(f"{place.file} was changed while it was checked")
    return row


def hold_anew(sampled: Sampled) -> list[Held]:
    """Hold rows against the truth that was certified anew for them."""
    return [_anew(place, sampled.truth) for place in sampled.places]


def _anew(place: Place, truth: Truth | None) -> Held:
    held = Held(place, "")

    def check() -> Iterable[Wrong]:
        row = row_of(place)
        surface, rays = truths.rays_for(row)
        assert truth is not None
        try:
            kept = answers.arrays_of(place.folder, row)
        except (CannotTell, OSError, ValueError):  # which the check of answers tells
            kept = None
        return truths.truth(row, kept, surface, rays, truth)

    held.check("truth", check)
    return held


def family_anew(place: Place, certify: Callable[[Surface, Rays], Truth]) -> Held:
    """Hold the row of a family against the truth of the family's rays."""
    held = Held(place, "")
    held.check("truth", lambda: rungs.rungs(row_of(place), certify))
    return held
