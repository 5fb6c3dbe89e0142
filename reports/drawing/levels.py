"""Draw the level of the quadtree at which each pixel's box was eliminated, as beamcasting's Fig. 1 does."""

from __future__ import annotations

from typing import Any

import matplotlib
import numpy as np
from matplotlib.colors import to_rgb
from numpy.typing import NDArray

from harness.contract import RayStatus
from reports import wording
from reports.analysis.scene_names import picture_size
from reports.content import Panel, Picture
from reports.drawing import images, style
from reports.reading.arrays import Arrays

COLORS = "plasma"
EXPLANATION = (
    "The level at which a box was eliminated, as beamcasting's Fig. 1 shows for the Octdong: dark, large boxes thrown "
    "away early; bright, at the pixels' own level; white, the surface. Look for wide bright borders: there boxes hold "
    "no surface and their ranges cannot tell."
)


def level_map(level: NDArray[np.uint8], hit: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Paint each pixel dark to bright by the level [h, w] of its box, and white where `hit` [h, w] says it is hit.

    Returns float64[h, w, 3] in 0…1.
    """
    last = max(int(level.max()), 1)
    first = int(level.min())
    image = matplotlib.colormaps[COLORS](0.05 + 0.85 * (level - first) / max(last - first, 1))[..., :3]
    image[hit] = to_rgb(style.PAPER)
    return np.asarray(image)


def panel(row: Any, arrays: Arrays, prefix: str = "") -> Panel:
    """Show the levels of a row whose arrays hold `level` and `status`.

    `prefix` begins the picture's name, so that it differs from other pictures of the row.
    """
    assert arrays.level is not None and arrays.status is not None
    level, hit = arrays.level, arrays.status == RayStatus.HIT
    name = f"{row.surface_title}, {picture_size(row)}"
    picture = Picture(f"{prefix}{row.key}-level", images.png(level_map(level, hit)), f"Levels of elimination of {name}")
    last = int(level.max())
    early = float(np.mean(~hit & (level < last)))
    late = float(np.mean(~hit & (level == last)))
    share = f"{wording.share(early)} eliminated early, {wording.share(late)} at the last"
    note = f"levels {int(level.min())} to {last}: {share}"
    return Panel(name, (picture,), note)
