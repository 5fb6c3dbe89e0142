"""Draw time and error over the projection angle or a path's frames, and maps of them over the sphere of directions."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import matplotlib
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure as Drawing
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter
from numpy.typing import NDArray

from reports import wording
from reports.analysis.scene_names import rays_checked
from reports.analysis.viewstats import ViewSet
from reports.content import Figure
from reports.drawing import line_labels, style
from reports.drawing.canvas import LINE, NARROW, RC, ErrorAxis, label_decades, series, svg
from reports.drawing.style import Mark

DODGE = 0.3  # the share of the step between angles over which marks of one angle are spread, so that all are seen
ACROSS, DOWN = 3, 8  # variants in one figure of maps
SIZES = {"font.size": 7.0}
ANGLE_TITLES = ("time per ray in the domain, ns", "largest |t − t*|, scene units; red cross: some rays are wrong")
MAP_PIXELS = (90, 180)  # height and width of a map; each pixel shows the nearest direction
TIME_MAP = "viridis"
Limits = tuple[float, float]  # the ends of a colour scale, as decimal exponents


def over_angle(of: ViewSet, marks: Mapping[str, Mark], name: str) -> Figure:
    """Draw time per ray and largest error against the projection angle, a line for each variant, named at its end.

    A red cross marks an angle with wrong rays.
    """
    variants = dict(of.variants())
    angles = sorted(of.rows["angle"].unique())
    step = min(np.diff(angles), default=1.0)
    axis = ErrorAxis.of(of.rows["error_max"].dropna())
    panel = max(1.55, 0.1 + len(variants) * line_labels.STEP / 72)
    height = 2 * panel + 0.8
    names = line_labels.width([str(rows["label"].iloc[0]) for rows in variants.values()])
    ends: tuple[list[Any], list[Any]] = ([], [])
    with matplotlib.rc_context(RC | SIZES):
        drawing = Drawing(figsize=(NARROW, height))
        times, errors = drawing.subplots(2, 1, sharex=True)
        drawing.subplots_adjust(0.5 / NARROW, 0.36 / height, 1 - names / NARROW, 1 - 0.2 / height, hspace=0.26 / panel)
        axis.dress(errors, "y")
        for i, (variant, rows) in enumerate(variants.items()):
            rows, mark, label = rows.sort_values("angle"), marks[variant], rows["label"].iloc[0]
            look: dict[str, Any] = {"color": mark.color, "marker": mark.marker, "ls": mark.line, **LINE}
            look["gid"] = series(str(rows["method"].iloc[0]), variant)
            times.plot(rows["angle"], 1e3 * rows["us_per_ray"], **look)
            ends[0].append((angles[-1], 1e3 * rows["us_per_ray"].iloc[-1], label, mark.color))
            known = rows[rows["error_max"].notna()]
            if known.empty:
                continue
            x, y = known["angle"] + DODGE * step * ((i + 0.5) / len(variants) - 0.5), axis.position(known["error_max"])
            errors.plot(x, y, **look)
            wrong = (known["wrong_rays"].fillna(0) > 0).to_numpy(bool)
            errors.plot(x[wrong], y[wrong], ls="none", marker="x", color=style.WRONG[0].color, ms=7, mew=1.4, zorder=4)
            ends[1].append((x.iloc[-1], y[-1], label, mark.color))
        times.set_yscale("log")
        label_decades(times.yaxis)
        for axes, title, own in zip((times, errors), ANGLE_TITLES, ends, strict=True):
            axes.set_title(title, color=style.INK, loc="left")
            axes.set_xticks(angles)
            axes.xaxis.set_major_formatter(FuncFormatter(lambda angle, _: f"{angle:g}°"))
            line_labels.write(axes, own)
        drawing.text(0.5 / NARROW, 0.04 / height, "projection angle: 0° looks down the z axis", fontsize=7)
        drawn = svg(drawing)
    return Figure(
        name,
        drawn,
        f"Time and error of {wording.listed([end[2] for end in ends[0]])} against the projection angle.",
        f"{of.place}.",
        f"Of the {rays_checked(of.rows)} rays of each angle's check.{wording.zeros(of.rows['error_max'])}",
    )


def over_frames(of: ViewSet, marks: Mapping[str, Mark], name: str) -> Figure:
    """Draw each frame's time along a camera's path, a line for each variant, named at its end.

    A red cross marks a frame with wrong rays.
    """
    variants = dict(of.variants())
    numbers = {view: i + 1 for i, view in enumerate(of.views)}
    height = max(2.2, 0.1 + len(variants) * line_labels.STEP / 72) + 0.6
    names = line_labels.width([str(rows["label"].iloc[0]) for rows in variants.values()])
    ends: list[Any] = []
    with matplotlib.rc_context(RC | SIZES):
        drawing = Drawing(figsize=(NARROW, height))
        times = drawing.subplots()
        drawing.subplots_adjust(0.5 / NARROW, 0.4 / height, 1 - names / NARROW, 1 - 0.2 / height)
        for variant, rows in variants.items():
            mark, label, x = marks[variant], rows["label"].iloc[0], rows["view"].map(numbers)
            look: dict[str, Any] = {"color": mark.color, "ls": mark.line, "lw": 1.2}
            look["gid"] = series(str(rows["method"].iloc[0]), variant)
            times.plot(x, rows["median_ms"], **look)
            wrong = (rows["wrong_rays"].fillna(0) > 0).to_numpy(bool)
            cross: dict[str, Any] = {"ls": "none", "marker": "x", "ms": 5, "mew": 1.2, "zorder": 4}
            times.plot(x[wrong], rows["median_ms"][wrong], color=style.WRONG[0].color, **cross)
            ends.append((x.iloc[-1], rows["median_ms"].iloc[-1], label, mark.color))
        times.set_yscale("log")
        label_decades(times.yaxis)
        times.set_title("time of a frame, ms; red cross: some rays are wrong", color=style.INK, loc="left")
        times.set_xlabel("frame")
        times.set_xlim(1, len(numbers))
        line_labels.write(times, ends)
        drawn = svg(drawing)
    told = f"Time of each frame of {wording.listed([end[2] for end in ends])} along the camera's path."
    return Figure(name, drawn, told, f"{of.place}.", f"Of the {rays_checked(of.rows)} rays of each frame's check.")


@dataclass(frozen=True, eq=False)
class Sphere:
    """Hold the map of n directions over their sphere, in Mollweide's equal-area projection.

    Each pixel of the map belongs to the nearest direction.
    """

    nearest: NDArray[np.intp]  # [h, w]: the index of the nearest direction; -1 outside the ellipse
    x: NDArray[np.float64]  # [n]: where each direction is on the map, in [-2, 2]
    y: NDArray[np.float64]  # [n]: the same, in [-1, 1]

    @classmethod
    def of(cls, azimuth: NDArray[np.float64], elevation: NDArray[np.float64]) -> Sphere:
        """Project directions in degrees, float64[n] each; azimuth 0 is in the middle of the map, the z axis up."""
        height, width = MAP_PIXELS
        y = 1 - (2 * np.arange(height) + 1) / height
        x = (4 * np.arange(width) + 2) / width - 2
        theta = np.arcsin(y)[:, None]
        latitude = np.arcsin(np.clip((2 * theta + np.sin(2 * theta)) / np.pi, -1, 1))
        longitude = np.pi * x[None, :] / (2 * np.cos(theta))
        places = _unit(longitude, np.broadcast_to(latitude, longitude.shape))
        nearest = (places @ _unit(np.radians(azimuth), np.radians(elevation)).T).argmax(axis=-1)
        return cls(np.where(np.abs(longitude) <= np.pi, nearest, -1), *mollweide(azimuth, elevation))


def _unit(azimuth: NDArray[np.float64], elevation: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the unit vectors float64[..., 3] of directions in radians, [...] each."""
    return np.stack(
        [np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation)], axis=-1
    )


def mollweide(
    azimuth: NDArray[np.float64], elevation: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return x in [-2, 2] and y in [-1, 1], float64[n] each, of directions in degrees, float64[n] each.

    The projection is that of J. P. Snyder, Map Projections: A Working Manual, 1987, equations (31-1) to (31-3), divided
    by the square root of 2.
    """
    longitude, latitude = np.radians((azimuth + 180.0) % 360.0 - 180.0), np.radians(elevation)
    low, high = np.full(latitude.shape, -np.pi / 2), np.full(latitude.shape, np.pi / 2)
    for _ in range(60):  # bisection: the left side of 2θ + sin 2θ = π sin φ grows with θ
        theta = (low + high) / 2
        below = 2 * theta + np.sin(2 * theta) < np.pi * np.sin(latitude)
        low, high = np.where(below, theta, low), np.where(below, high, theta)
    return 2 / np.pi * longitude * np.cos(theta), np.sin(theta)


@dataclass(frozen=True)
class Scales:
    """Hold the ends of the two colour scales that all maps of a report share."""

    times: Limits  # of the time per ray over the variant's mean
    errors: Limits  # of the largest error in scene units

    @classmethod
    def of(cls, sets: Sequence[ViewSet], errors: tuple[int, int]) -> Scales:
        """Return the scales of all maps of these sets; `errors` is the report's own scale of errors."""
        every = np.concatenate([_over_mean(rows) for of in sets for _, rows in of.variants()] or [np.ones(1)])
        reach = math.log10(max(1.1, float(every.max()), float(1 / every.min())))
        return cls((-reach, reach), errors)


def _over_mean(rows: pd.DataFrame) -> NDArray[np.float64]:
    """Return each row's time per ray over the mean of all, float64[n]."""
    times = np.asarray(rows["us_per_ray"], np.float64)
    over: NDArray[np.float64] = times / times.mean()
    return over


def over_directions(of: ViewSet, scales: Scales, name: str) -> list[Figure]:
    """Draw two maps for each variant: its time per ray over its mean, and its largest error.

    Both mark the directions with wrong rays. A figure holds at most ACROSS × DOWN variants.
    """
    variants = dict(of.variants())
    names = list(variants)
    batches = [names[i : i + ACROSS * DOWN] for i in range(0, len(names), ACROSS * DOWN)]
    return [_maps(of, {v: variants[v] for v in batch}, scales, f"{name}-{i}") for i, batch in enumerate(batches)]


def _maps(of: ViewSet, variants: Mapping[str, pd.DataFrame], scales: Scales, name: str) -> Figure:
    """Draw the maps of at most ACROSS × DOWN variants."""
    labels = [str(rows["label"].iloc[0]) for rows in variants.values()]
    lines = -(-len(variants) // ACROSS)
    cell = NARROW / ACROSS
    wide, high = (cell - 0.2) / 2, (cell - 0.2) / 4
    line, below = high + 0.42, 0.48
    height = line * lines + below
    with matplotlib.rc_context(RC | SIZES):
        drawing = Drawing(figsize=(NARROW, height))
        for i, (label, rows) in enumerate(zip(labels, variants.values(), strict=True)):
            left, top = cell * (i % ACROSS), height - line * (i // ACROSS)
            drawing.text((left + 0.03) / NARROW, (top - 0.13) / height, _name(label), weight="bold", fontsize=7)
            sphere = Sphere.of(rows["azimuth"].to_numpy(float), rows["elevation"].to_numpy(float))
            wrong, ratio = rows["wrong_rays"].fillna(0).to_numpy(float), _over_mean(rows)
            told = (_told_times(ratio), _told_errors(rows, wrong))
            drawn = ((np.log10(ratio), scales.times, TIME_MAP), (_exponents(rows), scales.errors, style.ERROR_MAP))
            for j, (values, scale, cmap) in enumerate(drawn):
                x, y = left + 0.02 + j * (wide + 0.05), top - 0.19 - high
                _map(drawing.add_axes((x / NARROW, y / height, wide / NARROW, high / height)), sphere, values, scale,
                     cmap, wrong)  # fmt: skip
                middle = (x + wide / 2) / NARROW
                drawing.text(middle, (y - 0.03) / height, told[j], fontsize=7, va="top", ha="center", color=style.INK)
        _scales(drawing, scales, height)
        made = svg(drawing)
    return Figure(
        name,
        made,
        f"Maps over the sphere of directions of time and error of {wording.listed(labels)}.",
        f"{of.place}, {wording.plural(len(of.views), 'direction')}.",
        "Each pair: left the time per ray over the variant's own mean, right the largest error. All directions lie in "
        "an ellipse (Mollweide's equal-area map), the z axis up; a dot is a direction, and its colour fills the places "
        "nearest to it. Red crosses are directions with wrong rays, larger where there are more, of "
        f"{rays_checked(of.rows)} rays each; pale is an error of 0.{wording.zeros(of.rows['error_max'])}",
    )


def _exponents(rows: pd.DataFrame) -> NDArray[np.float64]:
    """Return the decimal exponents of the rows' largest errors, float64[n]: -inf for 0, NaN where none is known."""
    error = rows["error_max"].to_numpy(float)
    exponents = np.where(error > 0, np.log10(np.where(error > 0, error, 1.0)), -np.inf)
    exponents[np.isnan(error)] = np.nan
    return exponents


def _name(label: str) -> str:
    """Shorten a name that is too long for the title of a map."""
    return label if len(label) <= 38 else f"{label[:36]} …"


def _map(
    axes: Axes,
    sphere: Sphere,
    values: NDArray[np.float64],
    limits: Limits,
    cmap: str,
    wrong: NDArray[np.float64],
) -> None:
    """Draw one map: `values` [n] of the directions, as decimal exponents, by colour between `limits`.

    A value of -inf is an error of exactly zero, NaN one that is not known. Crosses mark the directions where `wrong`
    [n] is positive.
    """
    level = (np.where(np.isfinite(values), values, limits[0]) - limits[0]) / (limits[1] - limits[0])
    colors = matplotlib.colormaps[cmap](np.clip(level, 0.0, 1.0))
    colors[np.isneginf(values)] = matplotlib.colors.to_rgba(style.EXACT)
    colors[np.isnan(values)] = matplotlib.colors.to_rgba(style.HAIRLINE)
    image = np.where((sphere.nearest >= 0)[..., None], colors[sphere.nearest], 0.0)
    axes.imshow(np.round(255 * image).astype(np.uint8), extent=(-2, 2, -1, 1), interpolation="nearest", aspect="auto")
    around = np.linspace(0, 2 * np.pi, 120)
    axes.plot(2 * np.cos(around), np.sin(around), color=style.FAINT, lw=0.5)
    axes.plot(sphere.x, sphere.y, ls="none", marker=".", ms=1.6, mew=0, color=style.PAPER, alpha=0.8)
    some = wrong > 0
    if some.any():
        for width, color in ((2.2, style.PAPER), (1.1, style.WRONG[0].color)):
            sizes = 12 + 14 * np.log10(wrong[some])
            axes.scatter(sphere.x[some], sphere.y[some], sizes, color, marker="x", linewidths=width, zorder=3)
    axes.set_xlim(-2.02, 2.02)
    axes.set_ylim(-1.02, 1.02)
    axes.axis("off")


def _told_times(ratio: NDArray[np.float64]) -> str:
    """Write the least and the largest of `ratio` [n], times per ray over their mean."""
    return f"{ratio.min():.2f} to {ratio.max():.2f}×"


def _told_errors(rows: pd.DataFrame, wrong: NDArray[np.float64]) -> str:
    """Write the largest of the rows' largest errors, and the sum of `wrong` [n], the rows' wrong rays."""
    if not rows["answers"].iloc[0]:
        return "finds nothing"
    told = f"to {wording.error(rows['error_max'].astype('float64').max())}"
    return f"{told}, {wording.count(wrong.sum())} wrong" if wrong.any() else told


def _scales(drawing: Drawing, scales: Scales, height: float) -> None:
    """Draw the two colour bars below the maps, and what a cross means."""
    times, errors = scales.times, scales.errors
    reach = 10.0 ** times[1]
    levels = (0.7, 0.8, 0.9, 1.0, 1.1, 1.25, 1.4) if reach < 1.6 else (0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.4, 2.0, 3.0, 5.0)
    ratios = [level for level in levels if 1 / reach <= level <= reach]
    steps = range(int(errors[0]), int(errors[1]) + 1, max(1, round((errors[1] - errors[0]) / 6)))
    for left, limits, cmap, title, ticks in (
        (0.1, times, TIME_MAP, "time per ray over its mean", [(math.log10(r), f"{r:g}") for r in ratios]),
        (3.1, errors, style.ERROR_MAP, "largest |t − t*|, scene units", [(e, wording.power_of_ten(e)) for e in steps]),
    ):
        axes = drawing.add_axes((left / NARROW, 0.18 / height, 2.6 / NARROW, 0.09 / height))
        axes.imshow(np.linspace(0, 1, 256)[None], aspect="auto", cmap=cmap, extent=(*limits, 0, 1))
        axes.grid(visible=False)
        axes.set_yticks([])
        axes.set_xticks(*zip(*ticks, strict=True))
        axes.tick_params(length=2, pad=1)
        axes.set_title(title, fontsize=7, weight="normal", pad=2, color=style.INK)
    cross = Line2D([], [], color=style.WRONG[0].color, marker="x", ms=4, lw=0)
    drawing.legend([cross], ["wrong rays"], loc="center left", bbox_to_anchor=(5.95 / NARROW, 0.25 / height))
