"""Hold what the tables of several parts share: how long they are, headings, and sentences of captions."""

from __future__ import annotations

import pandas as pd

from reports import labels
from reports.analysis import derive

ROW_LIMIT = 1_500  # rows of the longest table; results.csv has all
WRONG = {  # headings of columns, by the kind of wrong rays
    "misses": "misses",
    "false_hits": "false\nhits",
    "exhausted": "exhaus-\nted",
    "wrong_root": "wrong\nroot",
    "invalid": "in-\nvalid",
}


def baseline(rows: pd.DataFrame) -> str:
    """Name what the speed-ups of these rows are over, as people write it; several are joined by "or"."""
    names = dict(zip(rows["variant"], rows["label"], strict=True))
    names = dict(zip(rows["method"], rows["method_label"], strict=True)) | names
    told = derive.baseline_of(rows)
    return " or ".join(
        str(names.get(name) or labels.label(name, name.partition("[")[0], {})) for name in told.split(" or ")
    )


def speedup(rows: pd.DataFrame) -> str:
    """Explain in a sentence, for captions, what the speed-ups of these rows are."""
    return (
        f"Speed-up is {baseline(rows)}'s time over this one's on the same device, in the same precision: the "
        "median of the ratios within the rounds that timed both, which need not be the ratio of the two medians; "
        "– where one of the two answers a ray away from silhouettes wrongly, was not timed or shares no round with the "
        "other."
    )


CHOSEN_BY = ("method", "variant", "baseline", "front", "answers")  # columns that `worth_printing` reads


def worth_printing(finished: pd.DataFrame) -> pd.DataFrame:
    """Return all `finished` rows if there are at most ROW_LIMIT of them.

    Else return those on a front, those of the baseline and those of null methods.
    """
    if len(finished) <= ROW_LIMIT:
        return finished
    is_baseline = (finished["method"] == finished["baseline"]) | (finished["variant"] == finished["baseline"])
    return finished[finished["front"] | is_baseline | ~finished["answers"]]
