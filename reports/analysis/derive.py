"""Add to the rows what follows from them: rates, wrong rays, speed-ups, the harness's floor, Pareto fronts.

Rows are compared only within a GROUP: rows of the same surface, view, size, samples per pixel, stage, device and
precision.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd

from harness.contract import BASELINE, FROM_ORIGIN, CellStatus
from harness.results.schema import KINDS, SCHEMA
from reports.analysis import rounds

GROUP = ["comparison", "device", "precision"]
_ACCURACY = [field.name for field in SCHEMA if field.path[0] == "accuracy"]
_DROWNED = [name for name in _ACCURACY if name.startswith("drowned")]
TOO_WRONG = "wrong on "  # how the reason begins of a row that is not timed since too many of its judged rays are wrong
_UNCLEAR = ("undecided", "grazing", "drowned")
CLEAR_RAYS = ("judged", "accuracy_rays", *_UNCLEAR)  # columns that clear_rays reads
FLOOR_FACTOR = 2.0  # a time below this many times the null method's is more the harness's than the method's


def derive(frame: pd.DataFrame, peaks: Mapping[str, float] | None = None) -> pd.DataFrame:
    """Return `frame` with the columns of harness.results.schema.DERIVED, and without the accuracy of null methods.

    `peaks` has for each device, where it is known, the measured peak rate of float32 multiply-adds, in 1e9 operations
    per second. Four figures are left empty where they would mislead: an overhead, unless it is over the device's own
    clock and positive; a speed-up, unless both rows answer every ray away from silhouettes rightly; a share of a peak
    above 1, which sets `peak_too_low` instead; the ends of a median's interval, where it has too few samples for one.
    """
    given, answers = frame, frame["answers"].astype(bool)
    silent = np.flatnonzero(~answers)
    stated = [name for name in _ACCURACY if name in frame] if len(silent) else []
    changed = {name for name in stated if frame[name].iloc[silent].notna().any()}
    frame = frame.assign(**{name: frame[name].where(answers) for name in changed})
    for name in _DROWNED:  # older rows do not count these rays apart
        if (older := frame[name].isna() & frame["misses"].notna()).any():
            frame[name] = frame[name].mask(older, 0)
            changed.add(name)
    if (few := frame["median_ms"].notna() & ~rounds.proved(frame["samples_ms"])).any():
        frame = frame.assign(**{name: frame[name].mask(few) for name in ("lower_ms", "upper_ms")})
        changed |= {"lower_ms", "upper_ms"}
    seconds = frame["median_ms"] / 1e3
    rays = (frame["size"] ** 2 * frame["samples_per_pixel"]).astype("float64")
    frame = frame.assign(mrays_per_s=rays / seconds / 1e6, frames_per_s=1.0 / seconds)
    believed = (frame["clock"] == "device") & (frame["overhead_share"] >= 0.0)
    frame["overhead_share"] = frame["overhead_share"].where(believed)
    frame["baseline"] = frame["baseline"].fillna(BASELINE)
    known = [kind for kind in KINDS if kind != "invalid"]  # older rows do not count invalid answers
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
    changed |= {"overhead_share", "baseline"}
    made = [name for name in frame.columns if name in changed or name not in given.columns]
    own = frame[made].copy()  # in one block of memory, which columns added one by one are not
    return pd.concat([given.drop(columns=made, errors="ignore"), own], axis=1)  # shares the other columns' memory


def kinds(rows: pd.DataFrame) -> tuple[str, ...]:
    """Return the kinds of wrong rays that a table of `rows` shows: invalid answers only where there are any."""
    return KINDS if rows["invalid"].fillna(0).sum() > 0 else tuple(kind for kind in KINDS if kind != "invalid")


def is_contender(frame: pd.DataFrame) -> pd.Series:
    """Tell for each row whether it was timed and is of a method that answers.

    Returns bool with the index of `frame`.
    """
    return (frame["status"] == CellStatus.OK) & frame["answers"].astype(bool) & frame["median_ms"].notna()


def contenders(frame: pd.DataFrame, names: Sequence[str] | None = None) -> pd.DataFrame:
    """Select the timed rows of methods that answer, fastest first within their group.

    They have all columns or, where the frame is large and few are wanted, those of `names`.
    """
    there = is_contender(frame).to_numpy()
    order = frame.loc[there, [*GROUP, "median_ms"]].reset_index(drop=True)
    order = order.sort_values([*GROUP, "median_ms"], kind="stable")
    told = frame if names is None else frame[list(names)]
    return told.take(np.flatnonzero(there)[order.index.to_numpy()])


def is_judged(frame: pd.DataFrame) -> pd.Series:
    """Tell for each row whether its answers were judged: it ended well, or failed because too many of them are wrong.

    Returns bool with the index of `frame`.
    """
    too_wrong = (frame["status"] == CellStatus.FAILED) & frame["reason"].fillna("").str.startswith(TOO_WRONG)
    return ((frame["status"] == CellStatus.OK) | too_wrong) & frame["wrong_rays"].notna()


def all_right(frame: pd.DataFrame) -> pd.Series:
    """Tell for each row whether every ray that is neither grazing nor drowned is right.

    Returns bool with the index of `frame`.
    """
    return (frame["wrong_rays"] == 0).fillna(False).astype(bool)


def within(rows: pd.DataFrame, error: float) -> pd.DataFrame:
    """Select the rows with every such ray right and a largest error over the scene's radius of at most `error`.

    A row without an error is one whose rays all miss, as they should.
    """
    exact = (rows["relative_error_max"] <= error) | rows["error_max"].isna()
    return rows[all_right(rows) & exact]


def clear_rays(frame: pd.DataFrame) -> pd.Series:
    """Return how many rays were judged: decided, and neither grazing nor drowned. Wrong rays are counted of these.

    Older rows do not say it. There it is as many as are left if no undecided ray is in one of the classes, which are
    the fewest that there may be. Returns Int64 with the index of `frame`; absent where nothing was checked.
    """
    fewest = frame["accuracy_rays"].astype("Int64")
    for name in _UNCLEAR:
        fewest = fewest - frame[name].astype("Int64").fillna(0)
    return frame["judged"].astype("Int64").fillna(fewest.clip(lower=0))


def nearly_all_right(rows: pd.DataFrame) -> pd.Series:
    """Tell for each row whether at most 1 in 1,000 of its clear rays is wrong: false where nothing was checked.

    Returns bool with the index of `rows`.
    """
    return rows["wrong_rays"].astype("float64") <= 1e-3 * clear_rays(rows).astype("float64")


def on_first_device(rows: pd.DataFrame) -> pd.DataFrame:
    """Select the rows of the first row's device."""
    return rows[rows["device"] == rows["device"].iloc[0]] if len(rows) else rows


def on_fullest_device(rows: pd.DataFrame) -> pd.DataFrame:
    """Select the rows of the device that has most of them, the first of several; `rows` has at least one."""
    return rows[rows["device"] == rows["device"].value_counts(sort=False).idxmax()]


def baseline_rows(timed: pd.DataFrame) -> pd.DataFrame:
    """Select the row of each group that speed-ups are over, if it answers every ray away from silhouettes rightly.

    Where the baseline is a method with several variants, the one without bound parameters in its name is taken, if
    there is one.
    """
    named = casters(timed) == timed["baseline"]
    rows = timed[named | (timed["method"] == timed["baseline"])]
    rows = rows.assign(swept=~named[rows.index]).sort_values("swept", kind="stable").drop_duplicates(GROUP)
    return rows[all_right(rows)]


def casters(rows: pd.DataFrame) -> pd.Series:
    """Return the rows' variants without the words for where rays begin: texts, with the index of `rows`."""
    pairs = list(zip(rows["variant"], rows["origin"].fillna("nearest"), strict=True))
    named = {(variant, origin): str(variant).removesuffix(FROM_ORIGIN[origin]) for variant, origin in set(pairs)}
    return pd.Series([named[pair] for pair in pairs], rows.index, dtype=object)


def _baseline_ms(timed: pd.DataFrame) -> pd.Series:
    """Return the median time of each group's baseline in ms, indexed by GROUP.

    A group whose baseline is missing or not right is left out.
    """
    return baseline_rows(timed).set_index(GROUP)["median_ms"].rename("baseline_ms")


def baseline_of(frame: pd.DataFrame) -> str:
    """Name the method or variant that the speed-ups of these rows are over; several are joined by "or"."""
    return " or ".join(dict.fromkeys(map(str, frame["baseline"]))) or BASELINE


def floor_rows(timed: pd.DataFrame, keys: Sequence[str] = GROUP) -> pd.DataFrame:
    """Select in each group by `keys` the slowest row of a null method, which is the harness's floor.

    A null method behind a prepass of beams is no floor, since its time has the prepass in it.
    """
    floor = ~timed["answers"].astype(bool) & (timed["prepass"] != "beams")
    return timed[floor].sort_values("median_ms", ascending=False, kind="stable").drop_duplicates(list(keys))


def _floor_ms(frame: pd.DataFrame, timed: pd.DataFrame) -> pd.Series:
    """Return for each row the time in ms of its group's null method.

    The index is that of `frame`; NaN where no null method was timed. It is the null method with rays of the row's own
    origin where that was timed, else any null method of the group.
    """
    if floor_rows(timed).empty:
        return pd.Series(np.nan, frame.index, timed["median_ms"].dtype)
    own, other = (
        frame.join(floor_rows(timed, keys).set_index(keys)["median_ms"].rename("null_ms"), on=keys)["null_ms"]
        for keys in ([*GROUP, "origin"], GROUP)
    )
    return own.fillna(other)


def _peak_share(frame: pd.DataFrame, peaks: Mapping[str, float]) -> pd.Series:
    """Return for each row the operations per second of f's evaluations over the device's peak.

    NaN where the peak is not known, as in every precision but float32. The index is that of `frame`.
    """
    peak = frame["device"].map(peaks).astype("float64").where(frame["precision"] == "float32") * 1e9
    operations = frame["evaluation_operations"].astype("float64") * frame["evaluations_mean"]
    return operations * frame["mrays_per_s"] * 1e6 / peak


def _front(frame: pd.DataFrame) -> pd.Series:
    """Tell for each row with all rays right whether no other such row of its group is both faster and more exact.

    Returns boolean with the index of `frame`; False for the other rows.
    """
    rows = contenders(frame, [*GROUP, "median_ms", "error_max", "wrong_rays"])
    rows = rows[all_right(rows) & rows["error_max"].notna()].sort_values([*GROUP, "median_ms", "error_max"])
    smallest_so_far = rows.groupby(GROUP)["error_max"].cummin()
    before = smallest_so_far.groupby([rows[name] for name in GROUP]).shift(fill_value=float("inf"))
    return (rows["error_max"] < before).reindex(frame.index, fill_value=False).astype("boolean")
