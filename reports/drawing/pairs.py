"""Draw a gated row before and now, side by side: which rays are wrong, and how far off the others are."""

from __future__ import annotations

import io
import math
import textwrap
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure as Drawing
from matplotlib.font_manager import FontProperties
from matplotlib.patches import Patch
from matplotlib.textpath import TextToPath
from matplotlib.ticker import FixedLocator, FuncFormatter, PercentFormatter
from numpy.typing import NDArray

from harness.results.row import RungVerdict
from reports import wording
from reports.drawing import images, style
from reports.drawing.canvas import RC, ErrorAxis
from reports.reading.arrays import Arrays

DPI = 100
PANEL = 384  # pixels: a panel's side, or the next multiple of the picture's
MARGIN, GAP = 24, 24  # pixels around and between panels
LINE = 17  # pixels of a line of text
HEADING = 9.5  # points
BAR = 12  # pixels: the height of a colour scale
RINGED = 60  # wrong rays that are ringed at most
USUAL = (
    0.995  # the quantile of evaluations that ends their colour scale, since a single ray may take a hundred times more
)
EVALUATIONS = "viridis"
SMALL = {**RC, "font.size": 8.5, "axes.titlesize": 9, "axes.titleweight": "normal"}
NOW, BEFORE = "#0072B2", "#777777"


class Side(Protocol):
    """State what is drawn of one program: of a view its arrays by name, of a family its rungs; else why neither."""

    @property
    def title(self) -> str: ...
    @property
    def arrays(self) -> Mapping[str, NDArray[Any]]: ...
    @property
    def rungs(self) -> Sequence[RungVerdict]: ...
    @property
    def told(self) -> str: ...


@dataclass(frozen=True, eq=False)
class _Half:
    """Hold one side of a view: its answers, or why there are none."""

    title: str
    arrays: Arrays | None
    told: str


def png(heading: Sequence[str], before: Side, now: Side, parameter: str = "", evaluations: bool = False) -> bytes:
    """Draw one row as the bytes of a PNG file.

    `parameter` is what a family's rungs are made harder by, "" of a view. With `evaluations` a view also shows how many
    each ray took. A side without answers says why in their place.
    """
    with matplotlib.rc_context(SMALL):
        if now.rungs:
            return _ladder(heading, before, now, parameter)
        return _view(heading, [_half(before), _half(now)], evaluations)


def _half(side: Side) -> _Half:
    """Take the answers of a side; where they are damaged it says so."""
    if side.told or not side.arrays:
        return _Half(side.title, None, side.told or "no answers ray by ray")
    return _Half(side.title, Arrays(**side.arrays), "")


@dataclass(frozen=True)
class _Line:
    """Hold one line of panels: how each is painted and what is told below it, and what explains the colours.

    `explain` draws on a sheet, from y on, within so many pixels; it takes `below` pixels of height.
    """

    title: str
    paint: Callable[[Arrays], NDArray[np.float64]]
    tell: Callable[[Arrays], str]
    explain: Callable[[_Sheet, int, int], None]
    below: int


class _Sheet:
    """Lay panels and text out in pixels from the top left corner."""

    def __init__(self, width: int, height: int) -> None:
        self.width, self.height = width, height
        self.drawing = Drawing(figsize=(width / DPI, height / DPI), dpi=DPI, facecolor=style.PAPER)
        FigureCanvasAgg(self.drawing)

    def axes(self, x: float, y: float, width: float, height: float) -> Axes:
        """Add axes at a place."""
        place = (x / self.width, 1 - (y + height) / self.height, width / self.width, height / self.height)
        return self.drawing.add_axes(place)

    def text(self, x: float, y: float, text: str, **look: Any) -> None:
        """Write a text whose first line's top is at a place."""
        told = {"va": "top", "color": style.INK} | look
        self.drawing.text(x / self.width, 1 - y / self.height, text, **told)

    def png(self) -> bytes:
        """Return the sheet as a PNG file."""
        buffer = io.BytesIO()
        self.drawing.savefig(buffer, format="png", dpi=DPI)
        return buffer.getvalue()


def _headed(heading: Sequence[str], width: int, below: int) -> tuple[_Sheet, int]:
    """Make a sheet with `below` pixels under its heading; return it, and where these begin."""
    looks = ["bold", *["normal"] * (len(heading) - 1)]
    wrapped = [_wrapped(text, width - 2 * MARGIN, look) for text, look in zip(heading, looks, strict=True)]
    lines = [(line, look) for own, look in zip(wrapped, looks, strict=True) for line in own]
    top = MARGIN + LINE * len(lines) + LINE
    sheet = _Sheet(width, top + below)
    for i, (line, look) in enumerate(lines):
        sheet.text(MARGIN, MARGIN + LINE * i, line, fontsize=HEADING, weight=look)
    return sheet, top


def _wrapped(text: str, width: int, weight: str) -> list[str]:
    """Break a text into lines that are `width` pixels wide at most, as a heading is written."""
    font = FontProperties(size=HEADING * DPI / 72, weight=weight)  # in pixels, since a measured width is in its unit
    for letters in range(min(len(text), width), 1, -1):
        lines = textwrap.wrap(text, letters)
        if all(TextToPath().get_text_width_height_descent(line, font, False)[0] <= width for line in lines):
            return lines
    return [text]


def _view(heading: Sequence[str], halves: list[_Half], evaluations: bool) -> bytes:
    """Draw the answers of both sides: pictures with the wrong rays, errors on one scale, and evaluations on one."""
    known = [half.arrays for half in halves if half.arrays]
    side = max((max(one.wrong.shape) for one in known), default=PANEL)
    panel = side * max(1, round(PANEL / side))
    wide, fresh = 2 * panel + GAP, _fresh([half.arrays for half in halves])
    ringed = 0 < len(fresh) <= RINGED
    shown = [_wrong(fresh if ringed else fresh[:0]), _errors(images.scale_of(known))]
    if evaluations and known and all(one.evaluations is not None for one in known):
        shown.append(_evaluations(known))
    below = sum(panel + 2 * LINE + line.below + GAP for line in shown) + MARGIN
    sheet, y = _headed(heading, wide + 2 * MARGIN, below)
    for i, line in enumerate(shown):
        for x, half in zip((MARGIN, MARGIN + panel + GAP), halves, strict=True):
            if half.arrays or i == 0:  # why there are no answers is said once
                _panel(sheet, x, y, panel, half, line, half.title if i == 0 else line.title)
        if i == 0 and ringed:  # around single rays, so that they are found
            look: dict[str, Any] = {"ms": 13, "mfc": "none", "mec": style.INK, "mew": 0.8, "clip_on": False}
            sheet.drawing.axes[-1].plot(fresh[:, 1], fresh[:, 0], "o", **look)
        y += panel + 2 * LINE
        line.explain(sheet, y, wide)
        y += line.below + GAP
    return sheet.png()


def _panel(sheet: _Sheet, x: int, y: int, panel: int, half: _Half, line: _Line, title: str) -> None:
    """Draw one side's picture under its title, and what is to be read from it below; or why there is none."""
    axes = sheet.axes(x, y + LINE, panel, panel)
    axes.set_xticks([])
    axes.set_yticks([])
    axes.grid(visible=False)
    sheet.text(x, y, title)
    if half.arrays is None:
        told = "\n".join(textwrap.wrap(half.told, int(panel / 8)))
        axes.text(0.5, 0.5, told, transform=axes.transAxes, ha="center", va="center", color=style.INK)
        return
    axes.imshow(line.paint(half.arrays), interpolation="nearest", aspect="auto")
    sheet.text(x, y + LINE + panel + 3, line.tell(half.arrays))


def _wrong(ringed: NDArray[np.intp]) -> _Line:
    """Show what was drawn in pale grey, and wrong rays in the colours of their kinds; `ringed` are places [n, 2]."""

    def paint(one: Arrays) -> NDArray[np.float64]:
        """Paint float64[h, w, 3] in 0…1."""
        grey = 0.45 + 0.5 * images.shaded(one).mean(axis=2, keepdims=True).repeat(3, axis=2)
        return _with_wrong(np.where(np.isnan(one.shade)[..., None], 1.0, grey), one)

    def tell(one: Arrays) -> str:
        """Count the wrong rays by kind."""
        counts = [(kind.title, int(((one.wrong == kind.code) & ~one.apart).sum())) for kind in style.WRONG]
        counts.append(("grazing or drowned", int(((one.wrong > 0) & one.apart).sum())))
        told = ", ".join(f"{title} {count:,}" for title, count in counts if count)
        return f"wrong: {told}" if told else f"no wrong ray of {one.wrong.size:,}"

    def explain(sheet: _Sheet, y: int, _: int) -> None:
        """Draw the colours of wrong rays."""
        colors = [*((kind.title, kind.color) for kind in style.WRONG), ("grazing or drowned, any kind", style.APART)]
        handles = [Patch(facecolor=color, edgecolor=style.FAINT, linewidth=0.3) for _, color in colors]
        place = (MARGIN / sheet.width, 1 - (y + 0.4 * LINE) / sheet.height)
        look: dict[str, Any] = {"handlelength": 1.1, "columnspacing": 1.2, "handletextpad": 0.5, "borderaxespad": 0.0}
        labels = [title for title, _ in colors]
        sheet.drawing.legend(handles, labels, loc="upper left", bbox_to_anchor=place, ncols=len(labels), **look)
        if len(ringed):
            sheet.text(MARGIN, y + 1.7 * LINE, "ringed: wrong now, and not known to be wrong before")

    return _Line("", paint, tell, explain, 2 * LINE + LINE * bool(len(ringed)))


def _errors(scale: tuple[int, int]) -> _Line:
    """Show errors by colour between two decades."""

    def tell(one: Arrays) -> str:
        """Say the largest error away from silhouettes, as the gate's error_max does."""
        error = one.error[~one.apart & np.isfinite(one.error)]
        return f"largest {wording.error(float(error.max()))}" if error.size else "no right hit"

    def explain(sheet: _Sheet, y: int, width: int) -> None:
        """Draw the scale."""
        axes = _bar(sheet, y, width, style.ERROR_MAP, scale, "scene units; pale grey: exactly 0")
        step = max(1, math.ceil((scale[1] - scale[0]) / 10))
        axes.xaxis.set_major_locator(FixedLocator(range(scale[0], scale[1] + 1, step)))
        axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: wording.power_of_ten(round(value))))

    return _Line(
        "error |t − t*|", lambda one: _with_wrong(images.error_map(one, scale), one), tell, explain, BAR + 2 * LINE
    )


def _evaluations(known: Sequence[Arrays]) -> _Line:
    """Show how many evaluations each ray took, up to what all but a few of the rays took."""
    spent = [one.evaluations for one in known if one.evaluations is not None]
    most = max(1, *(int(np.quantile(one, USUAL)) for one in spent))

    def paint(one: Arrays) -> NDArray[np.float64]:
        """Paint float64[h, w, 3] in 0…1."""
        assert one.evaluations is not None
        return np.asarray(matplotlib.colormaps[EVALUATIONS](one.evaluations / most))[..., :3]

    def tell(one: Arrays) -> str:
        """Say how many evaluations a ray took."""
        assert one.evaluations is not None
        return f"{wording.number(float(one.evaluations.mean()))} in the mean, at most {int(one.evaluations.max()):,}"

    def explain(sheet: _Sheet, y: int, width: int) -> None:
        """Draw the scale."""
        _bar(sheet, y, width, EVALUATIONS, (0, most), f"evaluations on a ray; the last colour: {most:,} and more")

    return _Line("evaluations of f", paint, tell, explain, BAR + 2 * LINE)


def _with_wrong(image: NDArray[np.float64], one: Arrays) -> NDArray[np.float64]:
    """Paint wrong rays over an image float64[h, w, 3], in the colours of their kinds."""
    painted = np.asarray(image).copy()
    for kind in style.WRONG:
        painted[(one.wrong == kind.code) & ~one.apart] = to_rgb(kind.color)
    painted[(one.wrong > 0) & one.apart] = to_rgb(style.APART)
    return painted


def _fresh(both: list[Arrays | None]) -> NDArray[np.intp]:
    """Return the places [n, 2] of rays that are wrong now and were not before; of all wrong ones without a before."""
    before, now = both
    if now is None:
        return np.zeros((0, 2), np.intp)
    wrong = now.wrong > 0
    if before is not None and before.wrong.shape == now.wrong.shape:
        wrong = wrong & (before.wrong == 0)
    return np.argwhere(wrong)


def _bar(sheet: _Sheet, y: int, width: int, colors: str, scale: tuple[int, int], title: str) -> Axes:
    """Draw a colour scale and what it is of; return its axes."""
    axes = sheet.axes(MARGIN, y + 6, width, BAR)
    axes.imshow(np.linspace(0, 1, 256)[None, :], aspect="auto", cmap=colors, extent=(*scale, 0, 1))
    axes.set_yticks([])
    axes.grid(visible=False)
    sheet.text(MARGIN + width, y + BAR + 1.6 * LINE, title, ha="right", color=style.FAINT)
    return axes


def _ladder(heading: Sequence[str], before: Side, now: Side, parameter: str) -> bytes:
    """Draw a family rung by rung: the share of rays answered rightly, and the worst error over what is allowed."""
    told = [f"before: {before.told}"] if before.told or not before.rungs else []
    notes = textwrap.wrap(across(parameter, now.rungs), int((2 * PANEL + GAP) / 6.2))
    label = 40  # pixels that the labels of a vertical axis take
    width = 2 * (label + PANEL) + GAP + 2 * MARGIN
    sheet, y = _headed([*heading, *told], width, PANEL + (3 + len(notes)) * LINE + 2 * MARGIN)
    sides = [(side, look) for side, look in ((before, (BEFORE, "s", "--")), (now, (NOW, "o", "-"))) if side.rungs]
    left, right = (sheet.axes(x, y + LINE, PANEL, PANEL) for x in (MARGIN + label, MARGIN + 2 * label + PANEL + GAP))
    ratios = [_ratios(side.rungs) for side, _ in sides]
    axis = ErrorAxis.of(np.concatenate(ratios))
    for (side, (color, marker, line)), ratio in zip(sides, ratios, strict=True):
        look: dict[str, Any] = {"color": color, "marker": marker, "ls": line, "lw": 1.2, "ms": 5, "mfc": "none"}
        steps = np.arange(len(side.rungs))
        left.plot(steps, [r["right"] / r["decided"] if r["decided"] else math.nan for r in side.rungs], **look)
        right.plot(steps, np.where(np.isnan(ratio), np.nan, axis.position(ratio)), label=side.title, **look)
    axis.dress(right, "y")
    left.set_ylim(-0.05, 1.05)
    left.yaxis.set_major_formatter(PercentFormatter(1.0))
    for axes, title in (
        (left, "share of decided rays answered rightly"),
        (right, "worst error over what the problem allows"),
    ):
        axes.set_title(title, loc="left", color=style.INK)
        axes.set_xlim(-0.5, len(now.rungs) - 0.5)
        names = [wording.level(rung["parameter"]) for rung in now.rungs]
        every = max(1, math.ceil(len(names) / 9))
        axes.set_xticks(range(0, len(names), every), names[::every])
    y += PANEL + 3 * LINE
    for i, note in enumerate(notes):
        sheet.text(MARGIN, y + LINE * i, note)
    place = (MARGIN / sheet.width, 1 - (y + LINE * (len(notes) + 0.4)) / sheet.height)
    sheet.drawing.legend(loc="upper left", bbox_to_anchor=place, ncols=2, borderaxespad=0.0)
    return sheet.png()


def across(parameter: str, rungs: Sequence[RungVerdict]) -> str:
    """Say what a family's rungs are made harder by, and why some have no mark."""
    told = f"Across: {parameter}."
    if any(not rung["decided"] for rung in rungs):
        told += " On the left, a place without a mark has no ray that can be decided."
    if any(rung["decided"] and rung["worst_ratio"] is None for rung in rungs):
        told += " On the right, a place without a mark has no hit that was answered rightly."
    return told


def _ratios(rungs: Sequence[RungVerdict]) -> NDArray[np.float64]:
    """Return each rung's worst error over what the problem allows, float64[n]; NaN where no right hit was measured."""
    return np.array([math.nan if r["worst_ratio"] is None else r["worst_ratio"] for r in rungs], np.float64)
