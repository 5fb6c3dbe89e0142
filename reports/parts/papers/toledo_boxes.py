"""toledo2007's Figures 1 and 5: tori in the boxes whose fragments cast their rays, and the views of Table 1."""

from __future__ import annotations

from typing import Any

import numpy as np
import pandas as pd
from matplotlib.colors import to_rgb
from numpy.typing import NDArray

from reports import wording
from reports.analysis import derive
from reports.claims import picks
from reports.claims.evidence import run_of
from reports.content import Gallery, Panel, Picture, Section, Text
from reports.drawing import images
from reports.material import Material
from reports.reading.arrays import Arrays

ORDER = 9
SCENES, VIEWS = "toledo-fig1.toml", "toledo-table1.toml"
BOX = "#cfe3f2"  # a fragment without a hit


def sections(material: Material) -> list[Section]:
    """Make the section, of scenes of tori and of Table 1's views; [] where the run has neither."""
    panels = tuple(_panels(material, SCENES) + _panels(material, VIEWS))
    if not panels:
        return []
    told = (
        "Tori and the faces of their boxes, which trigger the fragments that cast rays: scenes on a lattice, and the "
        "torus from Table 1's six angles. As many pixels as are blue or grey run the ray caster; those that are blue "
        "find nothing and are its waste."
    )
    return [Section("toledo2007, Figures 1 and 5", (Text(told), Gallery(panels, "", across=4)))]


def _panels(material: Material, config: str) -> list[Panel]:
    """Make a panel for each view or scene that Sturm drew by the fragments of boxes in the run of `config`."""
    rows = material.evidence.of(config).rows(picks.STURM)
    rows = rows[(rows["run"] == run_of(config)) & (rows["stage"] == "raster") & (rows["proxy"] == "box")]
    rows = derive.on_first_device(rows)
    drawn = material.shelf.together(rows)
    return [_panel(row, arrays) for row, arrays in drawn if arrays.evaluations is not None]


def _panel(row: Any, arrays: Arrays) -> Panel:
    """Show one row's picture, with its fragments of boxes."""
    tori = 1 if pd.isna(row.instances) else int(row.instances)
    title = row.view.replace("angle ", "tilted by ") + "°" if tori == 1 else f"{tori:,} tori"
    wasted = wording.share(row.fragments_discarded / row.fragments)
    told = f"{wording.count(row.fragments)} fragments,\n{wasted} wasted, at {wording.square(row.size)}"
    picture = Picture(f"boxes-{row.key}", images.png(boxed(arrays)), f"{title}, and the fragments of the box")
    return Panel(title, (picture,), told)


def boxed(arrays: Arrays) -> NDArray[np.float64]:
    """Paint hits lit from the camera, other pixels that evaluated f pale blue, and the rest white.

    Returns float64[h, w, 3] in 0…1.
    """
    assert arrays.evaluations is not None
    empty = np.isnan(arrays.shade) & (arrays.evaluations > 0)
    return np.where(empty[..., None], np.asarray(to_rgb(BOX)), images.shaded(arrays))
