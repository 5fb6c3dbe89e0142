"""Draw time, error and wrong rays over the projection angle, and maps of them over the sphere of directions."""

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
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator
from numpy.typing import NDArray

from reports import wording
from reports.analysis.scene_names import rays_checked
from reports.analysis.viewstats import ViewSet
from reports.content import Figure
from reports.drawing import style
from reports.drawing.canvas import LINE, NARROW, RC, WIDE, ErrorAxis, Key, label_decades, line_of, svg
from reports.drawing.style import Mark

DODGE = 0.3  # the share of the step between angles over which marks of one angle are spread, so that all are seen
ACROSS, DOWN = 4, 4  # variants in one figure of maps
MAP_PIXELS = (90, 180)  # height and width of a map; each pixel shows the nearest direction
TIME_MAP = "viridis"
Limits = tuple[float, float]  # the ends of a colour scale, as decimal exponents


def over_angle(of: ViewSet, marks: Mapping[str, Mark], name: str) -> Figure:
    """Draw time per ray, largest error and wrong rays against the projection angle, a line for each variant."""
    variants = dict(of.variants())
    angles = sorted(of.rows["angle"].unique())
    step = min(np.diff(angles), default=1.0)
    key = Key([line_of(marks[v]) for v in variants], list(variants), NARROW)
    above = key.height + 0.2
    height = above + 0.36 + 2.4
    axis = ErrorAxis.of(of.rows["error_max"].dropna())
    with matplotlib.rc_context(RC):
        drawing = Drawing(figsize=(NARROW, height))
        times, errors, wrongs = drawing.subplots(1, 3, sharex=True)
        drawing.subplots_adjust(0.48 / NARROW, 0.36 / height, 1 - 0.06 / NARROW, 1 - above / height, 0.24)
        axis.dress(errors, "y")
        for i, (variant, rows) in enumerate(variants.items()):
            rows, mark = rows.sort_values("angle"), marks[variant]
            x = rows["angle"] + DODGE * step * ((i + 0.5) / len(variants) - 0.5)
            look: dict[str, Any] = {"color": mark.color, "marker": mark.marker, "ls": mark.line, **LINE}
            times.plot(rows["angle"], 1e3 * rows["us_per_ray"], **look)
            known = rows["error_max"].notna()
            errors.plot(x[known], axis.position(rows["error_max"][known]), **look)
            if rows["answers"].iloc[0]:
                wrongs.plot(x, rows["wrong_rays"].fillna(0).astype(float), **look)
        times.set_yscale("log")
        label_decades(times.yaxis)
        wrongs.set_yscale("symlog", linthresh=1.0)
        most = float(of.rows["wrong_rays"].fillna(0).max())
        top = max(12.0, 2 * most)
        wrongs.set_ylim(-0.15, top)
        wrongs.yaxis.set_major_locator(FixedLocator([0, *(10.0**e for e in range(int(math.log10(top)) + 1))]))
        wrongs.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,.0f}"))
        wrongs.yaxis.set_minor_locator(NullLocator())
        for axes, title in zip(
            (times, errors, wrongs),
            ("ns per ray in the domain", "largest |t − t*|, scene units", "wrong rays"),
            strict=True,
        ):
            axes.set_title(title, color=style.INK)
            axes.set_xticks(angles)
            axes.xaxis.set_major_formatter(FuncFormatter(lambda angle, _: f"{angle:g}°"))
        drawing.supxlabel("projection angle: 0° looks down the z axis", y=0.08 / height, va="center", fontsize=6.5)
        key.draw(drawing)
        drawn = svg(drawing)
    return Figure(
        name,
        drawn,
        f"Time, error and wrong rays of {wording.listed(list(variants))} against the projection angle.",
        f"{of.place}.",
        "A level line does not depend on the view. On the right, marks of one angle stand side by side; counts are of "
        f"the {rays_checked(of.rows)} rays of each angle's check." + wording.zeros(of.rows["error_max"]),
    )


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
    ratios = {variant: _over_mean(rows) for variant, rows in variants.items()}
    lines = -(-len(variants) // ACROSS)
    line, below, above = 1.12, 0.5, 0.05
    height = above + line * lines + below
    with matplotlib.rc_context(RC):
        drawing = Drawing(figsize=(WIDE, height))
        times, errors = scales.times, scales.errors
        cell = WIDE / ACROSS
        for i, (variant, rows) in enumerate(variants.items()):
            left, top = cell * (i % ACROSS), height - above - line * (i // ACROSS)
            drawing.text((left + 0.06) / WIDE, (top - 0.12) / height, _name(variant), weight="bold", fontsize=6.5)
            sphere = Sphere.of(rows["azimuth"].to_numpy(float), rows["elevation"].to_numpy(float))
            error = rows["error_max"].to_numpy(float)
            exponents = np.where(error > 0, np.log10(np.where(error > 0, error, 1.0)), -np.inf)
            exponents[np.isnan(error)] = np.nan
            wrong = rows["wrong_rays"].fillna(0).to_numpy(float)
            wide, high = (cell - 0.14) / 2, (cell - 0.14) / 4
            for j, (values, scale, cmap) in enumerate(
                ((np.log10(ratios[variant]), times, TIME_MAP), (exponents, errors, style.ERROR_MAP))
            ):
                box = (
                    (left + 0.05 + j * (wide + 0.04)) / WIDE,
                    (top - 0.2 - high) / height,
                    wide / WIDE,
                    high / height,
                )
                _map(drawing.add_axes(box), sphere, values, scale, cmap, wrong)
                told = _told_times(rows, ratios[variant]) if j == 0 else _told_errors(rows, wrong)
                drawing.text(box[0], (top - 0.25 - high) / height, told, fontsize=5.6, va="top", color=style.INK)
        _scales(drawing, times, errors, height)
        drawn = svg(drawing)
    return Figure(
        name,
        drawn,
        f"Maps over the sphere of directions of time and error of {wording.listed(list(variants))}.",
        f"{of.place}, {len(of.views)} directions.",
        "Mollweide's equal-area projection: the z axis is up, azimuth 0 in the middle; a place has the colour of the "
        "nearest direction, a dot. Left, the time per ray in the domain over the variant's own mean, on one scale "
        "for all maps of this report: an even map does not depend on the view. Right, the largest error, in "
        f"the colours of all pictures of this report; pale is an error of 0. {wording.ZERO} Red crosses are directions "
        f"with wrong rays, larger where there are more; the count adds them up, of {rays_checked(of.rows)} rays of "
        "each direction's check.",
    )


def _name(variant: str) -> str:
    """Shorten a name that is too long for the title of a map."""
    return variant if len(variant) <= 42 else f"{variant[:40]} …"


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


def _told_times(rows: pd.DataFrame, ratio: NDArray[np.float64]) -> str:
    """Write the mean time per ray; of `ratio` [n], the rows' times over that mean, write the least and the largest."""
    return f"mean {wording.number(1e3 * rows['us_per_ray'].mean())} ns, {ratio.min():.2f} to {ratio.max():.2f}"


def _told_errors(rows: pd.DataFrame, wrong: NDArray[np.float64]) -> str:
    """Write the least and the largest of the rows' largest errors, and the sum of `wrong` [n], the rows' wrong rays."""
    if not rows["answers"].iloc[0]:
        return "finds nothing"
    error = rows["error_max"].astype("float64")
    told = f"{wording.error(error.min())} to {wording.error(error.max())}"
    return f"{told}, {wording.count(wrong.sum())} wrong" if wrong.any() else told


def _scales(drawing: Drawing, times: Limits, errors: Limits, height: float) -> None:
    """Draw the two colour bars below the maps, and what a cross means."""
    reach = 10.0 ** times[1]
    levels = (0.7, 0.8, 0.9, 1.0, 1.1, 1.25, 1.4) if reach < 1.6 else (0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.4, 2.0, 3.0, 5.0)
    ratios = [level for level in levels if 1 / reach <= level <= reach]
    steps = range(int(errors[0]), int(errors[1]) + 1, max(1, round((errors[1] - errors[0]) / 6)))
    for left, limits, cmap, title, ticks in (
        (0.1, times, TIME_MAP, "time per ray in the domain over its mean", [(math.log10(r), f"{r:g}") for r in ratios]),
        (3.7, errors, style.ERROR_MAP, "largest |t − t*|, scene units", [(e, wording.power_of_ten(e)) for e in steps]),
    ):
        axes = drawing.add_axes((left / WIDE, 0.2 / height, 3.0 / WIDE, 0.09 / height))
        axes.imshow(np.linspace(0, 1, 256)[None], aspect="auto", cmap=cmap, extent=(*limits, 0, 1))
        axes.grid(visible=False)
        axes.set_yticks([])
        axes.set_xticks(*zip(*ticks, strict=True))
        axes.tick_params(length=2, pad=1)
        axes.set_title(title, fontsize=6, weight="normal", pad=2, color=style.INK)
    cross = Line2D([], [], color=style.WRONG[0].color, marker="x", ms=4, lw=0)
    drawing.legend([cross], ["wrong rays"], loc="center left", bbox_to_anchor=(7.1 / WIDE, 0.3 / height))
