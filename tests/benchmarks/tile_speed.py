"""Tell how many times as fast as other methods `tiles` is: `python -m tests.benchmarks.tile_speed RUN`.

RUN is the folder of a run of configs/tiles.toml or configs/tiles-1024.toml. For each device and size there is a table
with a row for each surface: the median time of a frame of each method in ms, the times of the others over that of
`tiles`, and the largest error of `tiles` over that of `bernstein`. The line below has the geometric means, and how many
clear rays each method answered wrongly. In the end stands how cost grows: time as a power of the pixels, fitted.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pandas as pd

import firsthit

METHOD = "tiles"
OTHERS = ("bernstein", "eft_yuksel", "newton")
WRONG = ["misses", "false_hits", "exhausted", "wrong_root", "invalid"]


def mean(ratios: pd.Series) -> float:
    """Return the geometric mean of what is not missing."""
    return float(np.exp(np.log(ratios.dropna()).mean()))


def table_of(rows: pd.DataFrame) -> pd.DataFrame:
    """Return a table of the rows of one device and size: a line for each surface that tiles has a time of."""
    times = rows.pivot(index="surface", columns="method", values="median_ms")
    errors = rows.pivot(index="surface", columns="method", values="relative_error_max")
    table = times.reindex(columns=[METHOD, *OTHERS]).dropna(subset=[METHOD])
    for other in OTHERS:
        table[f"/ {other}"] = table[other] / table[METHOD]
    return table.assign(largest=errors[METHOD] / errors["bernstein"])


def exponents(rows: pd.DataFrame) -> pd.Series:
    """Return for each surface the power of the pixels with which one method's time grows, fitted to its logarithms."""
    fitted = {}
    for surface, own in rows.groupby("surface"):
        if own["size"].nunique() > 1:
            fitted[surface] = np.polyfit(2 * np.log(own["size"]), np.log(own["median_ms"]), 1)[0]
    return pd.Series(fitted, dtype=float)


def main(words: Sequence[str]) -> None:
    """Print the tables of a run."""
    parser = argparse.ArgumentParser(description="Tell how many times as fast as other methods tiles is.")
    parser.add_argument("run", type=Path, metavar="RUN")
    table = firsthit.load(parser.parse_args(words).run)
    timed = table[table["median_ms"].notna() & (table["prepass"] == "none")]
    for (device, size), rows in timed.groupby(["device", "size"]):
        print(f"\n{device}, {size} x {size} pixels, ms a frame and ratios")
        told = table_of(rows)
        print(told.to_string(float_format=lambda number: f"{number:.3g}"))
        ratios = [f"{mean(told[f'/ {other}']):.2f} over {other}" for other in OTHERS]
        print(f"geometric means: {', '.join(ratios)}; least over bernstein {told['/ bernstein'].min():.2f}")
        wrong = rows.assign(wrong=rows[WRONG].sum(axis=1)).groupby("method")["wrong"].sum()
        print("clear rays answered wrongly:", ", ".join(f"{m} {wrong.get(m, 0):.0f}" for m in (METHOD, *OTHERS)))
    for (device, method), rows in timed[timed["method"].isin((METHOD, *OTHERS))].groupby(["device", "method"]):
        if len(fitted := exponents(rows)):
            told = ", ".join(f"{surface} {power:.2f}" for surface, power in fitted.items())
            print(f"\n{device}: time of {method} grows as pixels to the power {fitted.mean():.3f} in the mean ({told})")


if __name__ == "__main__":
    main(sys.argv[1:])
