"""Find a stored row by its key, and the results of the same cell before and after it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from harness.contract import FirsthitError
from harness.results.store import Row, Store


@dataclass(frozen=True, eq=False)
class Past:
    """Hold a row, and the rows of the same slot that were run last before it and first after it; None without one."""

    row: Row
    before: Row | None
    after: Row | None


def past_of(key: str, runs: Path) -> Past:
    """Find the row whose key begins with `key` in the run folders below `runs`.

    Raises FirsthitError where there is none or more than one, or it is damaged.
    """
    matches = [(store, one) for store, one in keys_below(runs) if one.startswith(key)]
    if len({whole for _, whole in matches}) != 1:
        what = "several cells start" if matches else "no cell starts"
        raise FirsthitError(f"{what} with {key!r} below {runs}; see `firsthit plan CONFIG` for keys")
    store, whole = matches[0]
    row = store.read(whole, older=True)
    if row is None:
        raise FirsthitError(f"{store.unreadable[whole]}; `firsthit run` makes it again")
    same = [other for other in store.rows() if other["slot"] == row["slot"]]
    same.sort(key=lambda other: str(other["environment"]["started"]))
    at = next(i for i, other in enumerate(same) if other["key"] == row["key"])
    return Past(row, same[at - 1] if at else None, same[at + 1] if at + 1 < len(same) else None)


def keys_below(runs: Path) -> Iterator[tuple[Store, str]]:
    """Yield the key of every row in the run folders below `runs`, with its store."""
    try:
        folders = sorted(path for path in runs.iterdir() if path.is_dir())
    except OSError:
        return
    for store in map(Store, folders):
        every = store.keys()
        yield from ((store, key) for key in every)
