"""Give the rows of a frame as named tuples."""

from __future__ import annotations

from collections import namedtuple
from collections.abc import Iterator
from functools import lru_cache
from typing import Any

import pandas as pd


def tuples(rows: pd.DataFrame) -> Iterator[Any]:
    """Yield rows as DataFrame.itertuples does, which makes a class anew for each frame: most of the time of few rows.

    No two columns have one name.
    """
    if rows.empty:
        return iter(())
    names = rows.columns.tolist()
    return map(_kind(tuple(names))._make, zip(rows.index, *(rows[name] for name in names), strict=True))


@lru_cache(maxsize=256)
def _kind(names: tuple[str, ...]) -> Any:
    """Return the class of the rows of frames with these columns."""
    return namedtuple("Row", ("Index", *names), rename=True)
