"""What follows from the rows: rates, wrong rays, speed-ups, the harness's floor, Pareto fronts.

Rows are compared only with rows of the same surface, view, size, samples per pixel, stage, device and precision:
a GROUP.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import pandas as pd

from harness.contract import BASELINE, FROM_ORIGIN, CellStatus
from harness.results.schema import KINDS, SCHEMA
from reports.analysis import rounds

GROUP = ["comparison", "device", "precision"]
_ACCURACY = [field.name for field in SCHEMA if field.path[0] == "accuracy"]
_DROWNED = [name for name in _ACCURACY if name.startswith("drowned")]
FLOOR_FACTOR = 2.0  # a time under this many times the null method's says more about the harness than about the method


def derive(frame: pd.DataFrame, peaks: Mapping[str, float] | None = None) -> pd.DataFrame:
    """`frame` with the columns of DERIVED added, and without the accuracy of methods that answer nothing.

    peaks: by device, its measured peak rate of float32 multiply-adds, in 1e9 operations per second, where known.
    Nothing is told of an overhead over a clock that is not believed, of a speed-up unless both rows answer every ray
    away from silhouettes rightly, nor of a share of a peak that a row exceeds: then `peak_too_low`.
    """
    answers = frame["answers"].astype(bool)
    frame = frame.assign(**{name: frame[name].where(answers) for name in _ACCURACY})
    for name in _DROWNED:  # in older runs these rays are in the other counts
        frame[name] = frame[name].mask(frame[name].isna() & frame["misses"].notna(), 0)
    seconds = frame["median_ms"] / 1e3
    rays = (frame["size"] ** 2 * frame["samples_per_pixel"]).astype("float64")
    frame = frame.assign(mrays_per_s=rays / seconds / 1e6, frames_per_s=1.0 / seconds)
    believed = (frame["clock"] == "device") & (frame["overhead_share"] >= 0.0)
    frame["overhead_share"] = frame["overhead_share"].where(believed)
    frame["baseline"] = frame["baseline"].fillna(BASELINE)
    known = [kind for kind in KINDS if kind != "invalid"]  # older rows know no invalid answers
    for prefix in ("", "grazing_", "drowned_"):
        total = frame[[prefix + name for name in known]].sum(axis=1, min_count=len(known)).astype("Int64")
        total += frame[f"{prefix}invalid"].fillna(0).astype("Int64")
        frame[f"{prefix}wrong_rays"] = total
    timed = frame[(frame["status"] == CellStatus.OK) & frame["median_ms"].notna()]
    frame = frame.join(_baseline_ms(timed), on=GROUP)
    frame["speedup"] = rounds.over_first(frame, baseline_rows(timed), GROUP).where(frame["answers"] & all_right(frame))
    frame["floor_ms"] = _floor_ms(frame, timed)
    frame["floor_bound"] = frame["answers"] & (frame["median_ms"] < FLOOR_FACTOR * frame["floor_ms"])
    share = _peak_share(frame, peaks or {})
    frame["peak_too_low"] = (share > 1.0).astype("boolean")
    frame["peak_share"] = share.where(share <= 1.0)
    frame["front"] = _front(frame)
    return frame.copy()  # columns added one by one lie scattered


def kinds(rows: pd.DataFrame) -> tuple[str, ...]:
    """The kinds of wrong rays that a table of `rows` has columns for: invalid answers only where there are any."""
    return KINDS if rows["invalid"].fillna(0).sum() > 0 else tuple(kind for kind in KINDS if kind != "invalid")


def contenders(frame: pd.DataFrame) -> pd.DataFrame:
    """The rows that were timed and answer, fastest first within their group."""
    rows = frame[(frame["status"] == CellStatus.OK) & frame["answers"] & frame["median_ms"].notna()]
    return rows.sort_values([*GROUP, "median_ms"], kind="stable")


def drawn(rows: pd.DataFrame, per_method: int = 1) -> pd.DataFrame:
    """The rows of one surface to show ray by ray: on the device with most results, some of each method and precision.

    Of several scenes the fullest. The variants are the first of their method in the plan's order, for every precision
    the same where it can be.
    """
    rows = rows[(rows["status"] == CellStatus.OK) & rows["answers"] & rows["arrays"].notna()]
    if rows.empty:
        return rows
    first = rows[rows["comparison"] == fullest(rows)]
    kept = first[first["device"] == first["device"].value_counts(sort=False).idxmax()]
    kept = kept[kept.groupby(["method", "precision"]).cumcount() < per_method]
    return kept.sort_values(["method", "precision"], kind="stable")


def fullest(rows: pd.DataFrame) -> str:
    """The scene of one surface's rows with most methods, among equals with most variants, wherever their rays begin,
    then the first."""
    counted = rows.assign(variant=casters(rows)).groupby("comparison", sort=False)[["method", "variant"]].nunique()
    return str(counted.sort_values(["method", "variant"], ascending=False, kind="stable").index[0])


def all_right(frame: pd.DataFrame) -> pd.Series:
    """Which rows answered every ray that is neither grazing nor drowned rightly."""
    return (frame["wrong_rays"] == 0).fillna(False).astype(bool)


def baseline_rows(timed: pd.DataFrame) -> pd.DataFrame:
    """Select each group's row that speed-ups are over, where it answers every ray away from silhouettes rightly.

    Where a method is named that has several variants, the one without bound parameters in its name, if any.
    """
    named = casters(timed) == timed["baseline"]
    rows = timed[named | (timed["method"] == timed["baseline"])]
    rows = rows.assign(swept=~named[rows.index]).sort_values("swept", kind="stable").drop_duplicates(GROUP)
    return rows[all_right(rows)]


def casters(rows: pd.DataFrame) -> pd.Series:
    """The variants without where their rays begin."""
    named = zip(rows["variant"], rows["origin"].fillna("nearest"), strict=True)
    return pd.Series([str(v).removesuffix(FROM_ORIGIN[o]) for v, o in named], rows.index, dtype=object)


def _baseline_ms(timed: pd.DataFrame) -> pd.Series:
    return baseline_rows(timed).set_index(GROUP)["median_ms"].rename("baseline_ms")


def baseline_of(frame: pd.DataFrame) -> str:
    """Say in words what the speed-ups of these rows are over."""
    return " or ".join(dict.fromkeys(map(str, frame["baseline"]))) or BASELINE


def floor_rows(timed: pd.DataFrame, keys: Sequence[str] = GROUP) -> pd.DataFrame:
    """Select in each group by `keys` the slowest row of a method that answers nothing, if any: the harness's floor."""
    floor = ~timed["answers"].astype(bool) & (timed["prepass"] != "beams")  # behind a prepass it measures that too
    return timed[floor].sort_values("median_ms", ascending=False, kind="stable").drop_duplicates(list(keys))


def _floor_ms(frame: pd.DataFrame, timed: pd.DataFrame) -> pd.Series:
    """Look up each row's null method: its time with rays of the same origin, where it was timed so, else of any."""
    own, other = (
        frame.join(floor_rows(timed, keys).set_index(keys)["median_ms"].rename("null_ms"), on=keys)["null_ms"]
        for keys in ([*GROUP, "origin"], GROUP)
    )
    return own.fillna(other)


def _peak_share(frame: pd.DataFrame, peaks: Mapping[str, float]) -> pd.Series:
    """The operations of a frame's evaluations per second, over the device's peak; the peak is known in float32 only."""
    peak = frame["device"].map(peaks).astype("float64").where(frame["precision"] == "float32") * 1e9
    operations = frame["evaluation_operations"].astype("float64") * frame["evaluations_mean"]
    return operations * frame["mrays_per_s"] * 1e6 / peak


def _front(frame: pd.DataFrame) -> pd.Series:
    """Which rows no other row of their group beats in both time and largest error, among those with all rays right."""
    rows = contenders(frame)
    rows = rows[all_right(rows) & rows["error_max"].notna()].sort_values([*GROUP, "median_ms", "error_max"])
    smallest_so_far = rows.groupby(GROUP)["error_max"].cummin()
    before = smallest_so_far.groupby([rows[name] for name in GROUP]).shift(fill_value=float("inf"))
    return (rows["error_max"] < before).reindex(frame.index, fill_value=False).astype("boolean")
