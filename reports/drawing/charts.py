"""Specify charts of the HTML page: in Vega-Lite, which draws them in the reader's browser.

A specification is a plain dictionary. One that has a parameter `kept` is told which methods the reader has chosen, by
their names; it is empty for all. Charts are drawn as on white paper; the page turns their colours for a dark screen.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Mapping, Sequence
from typing import Any

import pandas as pd

from harness.results.schema import KINDS
from reports import wording
from reports.analysis import derive
from reports.analysis.scene_names import picture_size, scene_names
from reports.content import Explorer
from reports.drawing import style

POINTS = 5000  # that the explorer holds at most, so that the page stays small
DIGITS = 4  # that its numbers have
_NUMBERS = {  # columns of a row that the explorer has as numbers, by their names there
    "median_ms": "ms",
    "lower_ms": "low",
    "upper_ms": "high",
    "mrays_per_s": "rate",
    "evaluations_mean": "evaluations",
    "error_max": "max",
    "error_p999": "p999",
    "error_p99": "p99",
    "scene_radius": "radius",
    "pixel_error_max": "pixels_max",
    "pixel_error_p999": "pixels_p999",
    "pixel_error_p99": "pixels_p99",
    "wrong_rays": "wrong",
    "accuracy_rays": "rays",
}
CONFIG: dict[str, Any] = {  # how every chart looks
    "aria": False,  # a page says of the whole chart what it shows, and has the numbers in tables
    "background": style.PAPER,
    "font": f"system-ui, {style.FONT}, sans-serif",
    "view": {"stroke": style.FAINT},
    "axis": {
        "labelColor": style.INK,
        "titleColor": style.INK,
        "labelFontSize": 11,
        "titleFontSize": 11,
        "titleFontWeight": "normal",
        "gridColor": style.HAIRLINE,
        "tickColor": style.FAINT,
        "domain": False,
    },
    "text": {"color": style.INK, "fontSize": 11},
}


def explorer(rows: pd.DataFrame) -> Explorer | None:
    """Gather what a reader explores: the timed rows of `rows`, which are what analysis.derive.derive returns.

    Of more rows than POINTS whole comparisons are kept, in the run's order. Returns None for fewer than two rows.
    """
    there = derive.is_contender(rows) & rows["error_max"].notna()
    timed = rows.loc[there, ["comparison"]]
    if len(timed) < 2:
        return None
    order = list(dict.fromkeys(timed["comparison"]))
    counts = timed["comparison"].value_counts()[order].cumsum()
    kept = set(counts[counts <= POINTS].index) or {order[0]}
    shown = rows[there & rows["comparison"].isin(kept)]
    note = (
        ""
        if len(shown) == len(timed)
        else f"These are {len(shown):,} of {len(timed):,} rows, of the first {wording.plural(len(kept), 'scene')} of "
        f"{len(order):,}. results.parquet has all."
    )
    return Explorer(_columns(shown), scatter(), note)


def _columns(rows: pd.DataFrame) -> dict[str, Sequence[Any]]:
    """Return the explorer's columns by name: texts, and numbers of DIGITS digits, None where there is none."""
    several = rows["run"].nunique() > 1
    sizes = [
        f"{picture_size(row)}, {row.stage}{f', of {row.run}' if several else ''}"
        for row in rows.itertuples(index=False)
    ]
    names = scene_names(rows)
    texts: dict[str, Sequence[Any]] = {
        "method": rows["method"],
        "variant": rows["variant"],
        "label": rows["label"],
        "surface": rows["surface_title"],
        "view": rows["view"],
        "setting": sizes,
        "device": rows["device"],
        "precision": rows["precision"],
        "scene": [names[comparison] for comparison in rows["comparison"]],
        "kinds": _kinds(rows, ""),
        "grazing": [_of(*pair) for pair in zip(rows["grazing_wrong_rays"], rows["grazing"], strict=True)],
        "drowned": [_of(*pair) for pair in zip(rows["drowned_wrong_rays"], rows["drowned"], strict=True)],
        "bound": ["floor-bound" if bound else "" for bound in rows["floor_bound"].fillna(False)],
    }
    columns = {name: [wording.text(value) for value in values] for name, values in texts.items()}
    return columns | {name: [_short(value) for value in rows[column]] for column, name in _NUMBERS.items()}


def _kinds(rows: pd.DataFrame, prefix: str) -> list[str]:
    """Say of each row which kinds of wrong rays it has, and how many: `misses: 2, false hits: 1`."""
    told = []
    for row in rows[[prefix + kind for kind in KINDS]].itertuples(index=False, name=None):
        counts = [(kind, value) for kind, value in zip(KINDS, row, strict=True) if not wording.absent(value) and value]
        told.append(", ".join(f"{kind.replace('_', ' ')}: {wording.count(value)}" for kind, value in counts))
    return told


def _of(wrong: Any, total: Any) -> str:
    """Say how many of how many rays are wrong; "" where there are none of the kind."""
    return "" if wording.absent(total) or not total else f"{wording.count(wrong)} of {wording.count(total)}"


def _short(value: Any) -> float | int | None:
    """Return a number with DIGITS digits, as JSON writes it shortest; None where there is none that is finite."""
    if wording.absent(value) or not math.isfinite(value):
        return None
    short = float(f"{float(value):.{DIGITS}g}")
    return int(short) if short == int(short) and abs(short) < 2**53 else short


def coded(columns: Mapping[str, Sequence[Hashable]]) -> dict[str, Any]:
    """Return columns with each text once: a column of texts becomes `values` and, for every row, the place in them."""
    made: dict[str, Any] = {}
    for name, column in columns.items():
        if all(isinstance(value, str) for value in column):
            places = {value: i for i, value in enumerate(dict.fromkeys(column))}
            made[name] = {"values": list(places), "rows": [places[value] for value in column]}
        else:
            made[name] = list(column)
    return made


def scatter() -> dict[str, Any]:
    """Return the specification of one panel of speed against error, without its data.

    The page's script gives it three data sets, and the axes' titles and domains. `points` has x, y, low and high of y,
    method, color, shape, fill and row; `front` has x, y, label, align and dx; a point at x = zero, if that is positive,
    has no error at all. The functions ticks and tick are the script's too.
    """
    logarithmic = {"type": "quantitative", "scale": {"type": "log", "nice": False}}
    axes = {
        name: {
            "field": name,
            **logarithmic,
            "axis": {
                "values": {"expr": f"ticks(domain('{name}'), {zero})"},
                "labelExpr": f"tick(datum.value, {zero})",
                "labelOverlap": True,
            },
        }
        for name, zero in (("x", "zero"), ("y", "0"))
    }
    chosen = {
        "condition": {"test": "!length(kept) || indexof(kept, datum.method) >= 0", "value": 1},
        "value": 0.07,
    }
    as_told = {"type": "nominal", "scale": None}
    look = {name: {"field": name, **as_told} for name in ("shape", "fill")} | {"stroke": {"field": "color", **as_told}}
    points = {
        "data": {"name": "points"},
        "params": [
            {
                "name": "grid",
                "select": {"type": "interval", "zoom": "wheel![event.ctrlKey || event.metaKey]"},
                "bind": "scales",
            }
        ],
        "mark": {"type": "point", "size": 70, "strokeWidth": 1.6, "clip": True},
        "encoding": {**look, "opacity": chosen, "tooltip": {"field": "row"}},
    }
    bars = {
        "data": {"name": "points"},
        "mark": {"type": "rule", "clip": True},
        "encoding": {"y": {"field": "low", "type": "quantitative"}, "y2": {"field": "high"}}
        | {"stroke": look["stroke"], "opacity": chosen},
    }
    line = {"type": "line", "interpolate": "step-after", "color": style.INK, "strokeWidth": 1, "clip": True}
    front = {"data": {"name": "front"}, "mark": line, "encoding": {"order": {"field": "x"}}}
    texts = {
        "data": {"name": "front"},
        "transform": [{"filter": "datum.label != ''"}],
        "mark": {"type": "text", "align": {"expr": "datum.align"}, "dx": {"expr": "datum.dx"}, "dy": -9, "clip": True},
        "encoding": {"text": {"field": "label"}},
    }
    return {
        "$schema": "https://vega.github.io/schema/vega-lite/v6.json",
        "width": "container",
        "height": 230,
        "autosize": {"type": "fit", "contains": "padding"},
        "params": [{"name": "kept", "value": []}, {"name": "zero", "value": -1}],
        "encoding": axes,
        "layer": [front, bars, points, texts],
        "config": CONFIG,
    }
