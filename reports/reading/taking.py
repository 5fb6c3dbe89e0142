"""Take rows of a large frame without a copy where they lie together, as the rows of a surface do in most plans."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray


def taken(frame: pd.DataFrame, places: NDArray[Any], names: Sequence[str] | None = None) -> pd.DataFrame:
    """Return what `frame.take(places)` does, with the columns `names` if they are given.

    Only what lies between the first and the last of the places is looked at; pandas would look at all columns of all
    rows. The result shares the frame's memory where the places follow one another.
    """
    if not len(places):
        near = frame.head(0)
        return near if names is None else near[list(names)]
    low, high = int(places.min()), int(places.max()) + 1
    near = frame.iloc[low:high]
    near = near if names is None else near[list(names)]
    at = places - low
    return near if np.array_equal(at, np.arange(high - low)) else near.take(at)
