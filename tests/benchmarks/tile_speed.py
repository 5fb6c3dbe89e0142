"""Tell how many times as fast as other methods one that casts tiles is: `python -m tests.benchmarks.tile_speed RUN`.

RUN is the folder of a run of configs/tiles.toml or configs/tiles-1024.toml. One of configs/tiles-any.toml is told by

    python -m tests.benchmarks.tile_speed runs/tiles-any --method tiles_interval \\
        --over interval_march interval_adaptive sphere_tracing ray_march

For each device and size there is a table with a row for each surface: the median time of a frame of each method in ms,
the times of the others over that of the method, and its largest error over that of the first of the others. Times are
divided round by round, so that a frame that gets faster once the others have ended gains nothing. The line below has
the geometric means. A second table has the largest error of each method over the scene's radius, and the line
below it how many clear rays each method answered wrongly. In the end stands how cost grows: time as a power of the
pixels, fitted.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pandas as pd

import firsthit
from reports.analysis import rounds

METHOD = "tiles"
OTHERS = ("bernstein", "eft_yuksel", "newton")
WRONG = ["misses", "false_hits", "exhausted", "wrong_root", "invalid"]


def mean(ratios: pd.Series) -> float:
    """Return the geometric mean of what is not missing."""
    return float(np.exp(np.log(ratios.dropna()).mean()))


def table_of(rows: pd.DataFrame, method: str, others: Sequence[str]) -> pd.DataFrame:
    """Return a table of the rows of one device and size: a line for each surface that the method has a time of.

    Errors are over those of the first of the others. Ratios of times are medians over the rounds that timed both.
    """
    times = rows.pivot(index="surface", columns="method", values="median_ms")
    errors = rows.pivot(index="surface", columns="method", values="relative_error_max")
    table = times.reindex(columns=[method, *others]).dropna(subset=[method])
    each = {(row.surface, row.method): row for row in rows.itertuples()}
    for other in others:
        pairs = ((each.get((surface, other)), each[surface, method]) for surface in table.index)
        table[f"/ {other}"] = [math.nan if slow is None else rounds.times_over(slow, fast) for slow, fast in pairs]
    return table.assign(largest=errors[method] / errors[others[0]])


def errors_of(rows: pd.DataFrame, methods: Sequence[str]) -> pd.DataFrame:
    """Return the largest error of each method on each surface, over the scene's radius."""
    errors = rows.pivot(index="surface", columns="method", values="relative_error_max")
    return errors.reindex(columns=list(methods))


def wrong_of(rows: pd.DataFrame, methods: Sequence[str]) -> pd.DataFrame:
    """Return how many clear rays each method answered wrongly on each surface; NaN where it has no row."""
    counted = rows.assign(wrong=rows[WRONG].sum(axis=1))
    return counted.pivot(index="surface", columns="method", values="wrong").reindex(columns=list(methods))


def exponents(rows: pd.DataFrame) -> pd.Series:
    """Return for each surface the power of the pixels with which one method's time grows, fitted to its logarithms."""
    fitted = {}
    for surface, own in rows.groupby("surface"):
        if own["size"].nunique() > 1:
            fitted[surface] = np.polyfit(2 * np.log(own["size"]), np.log(own["median_ms"]), 1)[0]
    return pd.Series(fitted, dtype=float)


def main(words: Sequence[str]) -> None:
    """Print the tables of a run."""
    parser = argparse.ArgumentParser(description="Tell how many times as fast as other methods one of tiles is.")
    parser.add_argument("run", type=Path, metavar="RUN")
    parser.add_argument("--method", default=METHOD, metavar="NAME")
    parser.add_argument(
        "--over", nargs="+", default=OTHERS, metavar="NAME", help="the other methods; errors are over the first's"
    )
    asked = parser.parse_args(words)
    method, others = asked.method, tuple(asked.over)
    methods = (method, *others)
    table = firsthit.load(asked.run)
    timed = table[table["median_ms"].notna() & (table["prepass"] == "none")]
    if missing := [name for name in methods if name not in set(timed["method"])]:
        parser.error(f"{asked.run} has no times of {', '.join(missing)}; name the methods with --method and --over")
    for (device, size), rows in timed.groupby(["device", "size"]):
        print(f"\n{device}, {size} x {size} pixels, ms a frame and ratios")
        told = table_of(rows, method, others)
        print(told.to_string(float_format=lambda number: f"{number:.3g}"))
        ratios = [f"{mean(told[f'/ {other}']):.2f} over {other}" for other in others]
        least = told[f"/ {others[0]}"].min()
        print(f"geometric means: {', '.join(ratios)}; least over {others[0]} {least:.2f}")
        print("largest errors, over the scene's radius")
        print(errors_of(rows, methods).to_string(float_format=lambda number: f"{number:.1e}"))
        wrong = wrong_of(rows, methods)
        told_wrong = [f"{name} {wrong[name].sum():.0f}{_spread(wrong[name])}" for name in methods]
        print("clear rays answered wrongly:", ", ".join(told_wrong))
    for (device, name), rows in timed[timed["method"].isin(methods)].groupby(["device", "method"]):
        if len(fitted := exponents(rows)):
            told = ", ".join(f"{surface} {power:.2f}" for surface, power in fitted.items())
            print(f"\n{device}: time of {name} grows as pixels to the power {fitted.mean():.3f} in the mean ({told})")


def _spread(wrong: pd.Series) -> str:
    """Tell the least and the largest number on one surface, where any ray is wrong."""
    return f" ({wrong.min():.0f} to {wrong.max():.0f} a surface)" if wrong.sum() else ""


if __name__ == "__main__":
    main(sys.argv[1:])
