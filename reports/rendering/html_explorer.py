"""Render the explorer: the controls by which a reader chooses axes and rows, and the data that the script draws."""

from __future__ import annotations

from harness.escaping import data
from harness.escaping import html as escaped
from reports.content import Explorer
from reports.drawing import charts

TITLE = "Explore speed against error"
_SPEEDS = {
    "ms": "time a frame, ms",
    "rate": "Mrays/s",
    "frames": "frames/s",
    "evaluations": "evaluations a ray",
}
_ERRORS = {"max": "largest", "p999": "99.9th percentile", "p99": "99th percentile"}
_UNITS = {"scene": "scene units", "radius": "over the scene's radius", "pixels": "pixels"}
_ROWS = {
    "device": "device",
    "precision": "precision",
    "setting": "size and stage",
    "surface": "surface",
    "view": "view",
}


def explorer(of: Explorer) -> str:
    """Write the explorer as a section; without scripts it says that it needs them."""
    told = (
        "Each point is a timed variant, hollow where some ray is answered wrongly. The line is the front: no variant "
        "with all rays right is both faster and more exact. Point at a mark, or tap it, for its numbers. The buttons "
        "above choose methods."
    )
    moved = "Drag to move, hold Ctrl and turn the wheel to zoom, double-click to see all again."
    chosen = "".join(
        [
            _select("speed", "speed", _SPEEDS),
            _select("error", "error", _ERRORS),
            _select("unit", "error in", _UNITS),
            *(_select(name, title, {}) for name, title in _ROWS.items()),
        ]
    )
    buttons = "".join(
        f'<button type="button" data-zoom="{factor}" aria-label="{name}">{sign}</button>'
        for factor, name, sign in ((0.6, "zoom in", "+"), (1 / 0.6, "zoom out", "−"), (0, "show all", "all"))
    )
    note = f"<p>{escaped(of.note)}</p>" if of.note else ""
    return (
        f'<h2>{TITLE}</h2><p>{told}</p>{note}<div id="explorer" hidden><div class="choices">{chosen}'
        f'<span class="zoom" role="group" aria-label="zoom">{buttons}</span></div>'
        '<p class="said" role="status"></p><div class="charts"></div>'
        f'<p class="hint">{moved}</p>'
        '<details class="numbers"><summary>The numbers of these points as a table</summary></details>'
        f"</div><noscript><p>The explorer needs JavaScript.</p></noscript>"
        f"{data('explorer-rows', charts.coded(of.columns))}{data('explorer-chart', of.chart)}"
    )


def _select(name: str, title: str, options: dict[str, str]) -> str:
    """Write one choice; the script fills one without options."""
    listed = "".join(f'<option value="{value}">{escaped(told)}</option>' for value, told in options.items())
    return f'<label>{title} <select name="{name}">{listed}</select></label>'
