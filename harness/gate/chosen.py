"""Choose rows by what a person typed after --only."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, replace

from harness.contract import FirsthitError, plural, suggestion
from harness.gate.baseline import Baseline


@dataclass(frozen=True)
class Only:
    """Choose the rows that one of `texts` names; without texts all rows are chosen.

    The whole name of a row chooses that row alone. Any other text chooses every row whose name holds it, and a * in it
    stands for any characters. A name is a slot, as `entries.slot_of` returns it. `blessed` holds the slots of a
    baseline, some of whose rows may be gone, so that no config names them.
    """

    texts: tuple[str, ...] = ()
    blessed: frozenset[str] = frozenset()

    def slots(self, planned: Iterable[str]) -> set[str]:
        """Return the chosen ones of the slots `planned` and `blessed`.

        Raises FirsthitError for a text that chooses none.
        """
        names = self.blessed.union(planned)
        return set().union(*(_picked(text, names) for text in self.texts)) if self.texts else set(names)

    def narrowed(self, baseline: Baseline, planned: Iterable[str]) -> Baseline:
        """Return a baseline without the rows that are not chosen, so that none of these is reported as missing."""
        slots = self.slots(planned)
        rows = {
            key: {slot: entry for slot, entry in own.items() if slot in slots} for key, own in baseline.rows.items()
        }
        return replace(baseline, rows=rows)


ALL = Only()


def among(baseline: Baseline) -> frozenset[str]:
    """Return the slots of all rows of a baseline."""
    return frozenset(slot for rows in baseline.rows.values() for slot in rows)


def _picked(text: str, names: Iterable[str]) -> set[str]:
    """Return the names that a text chooses. Raises FirsthitError where it chooses none."""
    known = sorted(names)
    if text in known:
        return {text}
    pattern = re.compile(".*".join(map(re.escape, text.split("*"))), re.DOTALL)
    if found := {name for name in known if pattern.search(name)}:
        return found
    words = sorted({word for name in known for word in name.split()})
    some = f"the first of {plural(len(known), 'row')} is {known[0]!r}" if known else "there are no rows"
    raise FirsthitError(f"--only: no row's name holds {text!r}; {suggestion(text, words, otherwise=some)}")
