"""Name the scenes of rows the way people read them."""

from __future__ import annotations

from collections import Counter
from typing import Any

import pandas as pd

from reports import wording
from reports.reading.tuples import tuples


def scene_names(frame: pd.DataFrame) -> dict[str, str]:
    """Return the name of each comparison: its surface, and what differs among the scenes of that surface.

    That may be the view, the size and the stage. Two comparisons of the same name have their run's name behind it.
    """
    scenes = frame.drop_duplicates("comparison")
    counted = scenes.groupby("surface")[["view", "size", "samples_per_pixel", "stage"]].nunique() > 1
    differs = {surface: {name for name in counted if row[name]} for surface, row in counted.iterrows()}
    named = {}
    for row in tuples(scenes):
        several = differs[row.surface]
        parts = [row.surface_title]
        parts += [row.view] if "view" in several else []
        parts += [picture_size(row)] if several & {"size", "samples_per_pixel"} else []
        parts += [row.stage] if "stage" in several else []
        named[str(row.comparison)] = ", ".join(parts)
    runs = dict(zip(frame["comparison"], frame["run"], strict=True))
    shared = Counter(named.values())
    return {scene: f"{name} ({runs[scene]})" if shared[name] > 1 else name for scene, name in named.items()}


def picture_size(row: Any) -> str:
    """Write the size of a row's picture: 256 × 256, or 256 × 256 × 4 samples."""
    samples = "" if row.samples_per_pixel == 1 else f" × {row.samples_per_pixel} samples"
    return f"{row.size} × {row.size}{samples}"


def picture_sizes(rows: pd.DataFrame) -> set[str]:
    """Write the sizes of the rows' pictures."""
    return {picture_size(row) for row in tuples(rows[["size", "samples_per_pixel"]].drop_duplicates())}


def scene_title(rows: pd.DataFrame) -> str:
    """Write surface, view, size and stage of rows of one scene; `rows` has at least one."""
    first = next(tuples(rows[["surface_title", "view", "size", "samples_per_pixel", "stage"]].head(1)))
    return f"{first.surface_title}, view {first.view}, {picture_size(first)}, {first.stage}."


def rays_checked(rows: pd.DataFrame) -> str:
    """Write how many rays each row's check casts: one number, or the least and the most; "?" where no row tells."""
    known = rows["accuracy_rays"].dropna()
    if known.empty:
        return "?"
    return " to ".join(dict.fromkeys((wording.count(known.min()), wording.count(known.max()))))
