"""Check rows one by one: first all that a row's own folder tells, then, of a sample, its truth, certified anew."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from harness.contract import FirsthitError, Surface, Truth
from harness.oracle import cache
from harness.results import sealed
from harness.results.store import Row, Store
from harness.verifying import answers, rungs, stated, times
from harness.verifying import truth as truths
from harness.verifying.model import CannotTell, Wrong
from harness.verifying.truth import Rays

DAMAGED = (KeyError, TypeError, ValueError, AttributeError, IndexError, ArithmeticError, RecursionError, MemoryError)
FAMILY = "family "  # how the name begins of what families' rows share in place of a truth
NO_CHECKSUM = "it has no checksum: a version before checksums wrote it, or it was changed"


@dataclass(frozen=True)
class Files:
    """Name files of rows in a folder by their keys, and the slots that its plan says of some."""

    folder: Path
    keys: tuple[str, ...]
    slots: Mapping[str, str]


@dataclass(frozen=True)
class Sampled:
    """Name rows that share a truth, which was certified anew; None where none of them says its rays."""

    files: tuple[Path, ...]
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

    file: Path
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


def checked(files: Files) -> list[Held]:
    """Read rows, and check all of them that needs no truth but what their folder keeps."""
    return [_checked(Store(files.folder), key, files.slots.get(key)) for key in files.keys]


def _checked(store: Store, key: str, slot: str | None) -> Held:
    file = store.folder / "cells" / f"{key}.json"
    row = store.read(key, older=True)
    if row is None:
        why = store.unreadable.get(key, "it is gone").removeprefix(f"{file} is ")
        return Held(file, slot or "", failing=[("file", Wrong("the file", why, "a row"))])
    held = Held(file, row["slot"], certifiable=bool(row.get("accuracy") or row.get("rungs")))
    if slot is not None and row["slot"] != slot:
        held.failing.append(("file", Wrong("slot", row["slot"], slot)))
    if sealed.is_sealed(file):
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


def row_of(file: Path) -> Row:
    """Read a row that could be read before. Raises FirsthitError where it is gone."""
    row = Store(file.parent.parent).read(file.stem, older=True)
    if row is None:
        raise FirsthitError(f"{file} was changed while it was checked")
    return row


def hold_anew(sampled: Sampled) -> list[Held]:
    """Hold rows against the truth that was certified anew for them."""
    return [_anew(file, sampled.truth) for file in sampled.files]


def _anew(file: Path, truth: Truth | None) -> Held:
    held = Held(file, "")

    def check() -> Iterable[Wrong]:
        row = row_of(file)
        surface, rays = truths.rays_for(row)
        assert truth is not None
        try:
            kept = answers.arrays_of(file.parent.parent, row)
        except (CannotTell, OSError, ValueError):  # which the check of answers tells
            kept = None
        return truths.truth(row, kept, surface, rays, truth)

    held.check("truth", check)
    return held


def family_anew(file: Path, certify: Callable[[Surface, Rays], Truth]) -> Held:
    """Hold the row of a family against the truth of the family's rays."""
    held = Held(file, "")
    held.check("truth", lambda: rungs.rungs(row_of(file), certify))
    return held
