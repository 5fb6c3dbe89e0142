"""Put the error maps of all methods on one surface beside each other, on one colour scale, the fastest first."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from harness.results.schema import KINDS
from reports import wording
from reports.analysis.choices import ERRORS
from reports.content import Gallery, Panel, Picture
from reports.drawing import images, insets, plots, style
from reports.reading.arrays import Arrays

ROOM = 230.0  # mm of a page for a hero and the strip below it
HERO = 84.0  # mm: the width of a hero
WIDTH, GAP, LINE, LETTER = 178.0, 4.0, 3.4, 1.25  # mm: of the page, between maps, of a line of text and of a letter
_PLURAL = {"miss": "misses", "false hit": "false hits", "wrong root": "wrong roots"}


def strip(hero: Panel | None, cells: Sequence[tuple[Any, Arrays]], scale: tuple[int, int]) -> Gallery:
    """Make a gallery of the error maps of these rows, in their order, below the panel `hero` if there is one."""
    several = len({row.precision for row, _ in cells}) > 1
    shape = cells[0][1].truth.shape
    if all(arrays.truth.shape == shape for _, arrays in cells):
        kept = images.outline([arrays for _, arrays in cells])
        cells = [(row, arrays.cropped(*kept)) for row, arrays in cells]
    panels = [_panel(row, arrays, scale, several) for row, arrays in cells]
    down, along = cells[0][1].truth.shape
    across = _across(panels, down / along)
    first = [] if hero is None else [hero]
    return Gallery(tuple(first + panels), caption(cells), plots.error_legend(*scale), across, hero is not None)


def _across(maps: Sequence[Panel], aspect: float) -> int:
    """Return how many maps, of this height over their width, stand in a line: as few as the page has room for."""
    room = ROOM - HERO * aspect
    for across in range(3, 8):
        wide = (WIDTH - GAP * (across - 1)) / across
        lines = [maps[i : i + across] for i in range(0, len(maps), across)]
        if sum(aspect * wide + max(_texts(one, wide) for one in line) for line in lines) <= room:
            return across
    return 8


def _texts(panel: Panel, wide: float) -> float:
    """Return about how high a map's title, note and key are where the map is so wide, in mm."""
    lines = [-(-len(text) * LETTER // wide) for text in (panel.title, panel.note)]
    keyed = -(-sum(4 + len(text) for text in panel.key.values()) * LETTER // wide) if panel.key else 0.0
    return LINE * (sum(lines) + keyed) + 5.0


def caption(cells: Sequence[tuple[Any, Arrays]]) -> str:
    """Say what a strip shows, and what to look for in it."""
    row = cells[0][0]
    timed = not wording.absent(row.median_ms)
    rays = wording.count(row.accuracy_rays)
    framed = sum(_window(row, arrays) is not None for row, arrays in cells)
    broken = " A frame shows, enlarged, where a method breaks." if framed else ""
    zero = wording.zeros([row.error_max for row, _ in cells])
    return (
        f"Equal errors have equal colours: |t − t*| in scene units on {rays} rays, {row.device}, view {row.view}"
        f"{', the fastest method first' if timed else ''}; max is the largest away from silhouettes.{broken} Wrong "
        f"rays that graze the surface, or on which f drowns in its own rounding, are paler and counted apart.{zero}"
    )


def _window(row: Any, arrays: Arrays) -> insets.Window | None:
    """Return where a row breaks: at its wrong rays, else at an error above the looser of ERRORS."""
    return insets.worst_window(arrays, ERRORS[0] * row.scene_radius)


def _panel(row: Any, arrays: Arrays, scale: tuple[int, int], several: bool) -> Panel:
    """Show the errors of one row; its precision is named where there are `several`."""
    title = f"{row.label}, {row.precision}" if several else str(row.label)
    window = _window(row, arrays)
    image = images.error_map(arrays, scale)
    if window is not None:
        image = insets.framed(image, arrays, window)
    picture = Picture(f"{row.key}-error", images.png(image), f"Errors of {title} on {row.surface_title}")
    time = [] if wording.absent(row.median_ms) else [f"{wording.number(row.median_ms)} ms"]
    told = [*time, f"max {wording.error(row.error_max)}"]
    apart = [(row.grazing_wrong_rays, "grazing"), (row.drowned_wrong_rays, "drowned")]
    told += [f"{wording.count(n)} {name} wrong" for n, name in apart if not wording.absent(n) and n > 0]
    return Panel(title, (picture,), " · ".join(told), key=wrong_key(row))


def wrong_key(row: Any) -> dict[str, str]:
    """Return how many rays of each kind a row answers wrongly, by the kind's colour."""
    counts = zip((getattr(row, kind) for kind in KINDS), style.WRONG, strict=True)
    return {kind.color: _counted(int(n), kind.title) for n, kind in counts if not wording.absent(n) and n > 0}


def _counted(n: int, title: str) -> str:
    """Write a count of wrong rays of one kind: 1 miss, 3 false hits, 80 exhausted."""
    return f"{n:,} {title if n == 1 else _PLURAL.get(title, title)}"
