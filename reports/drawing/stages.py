"""Draw which stage of a frame of tiles answered each pixel."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import matplotlib
import numpy as np
from numpy.typing import NDArray

from reports import wording
from reports.analysis.scene_names import picture_size
from reports.content import Panel, Picture
from reports.drawing import images
from reports.reading.arrays import Arrays

COLORS = "viridis"


def stage_map(stage: NDArray[np.uint8], stages: int) -> NDArray[np.float64]:
    """Paint each pixel dark to bright by the number of its stage [h, w], of `stages`: float64[h, w, 3] in 0…1."""
    return np.asarray(matplotlib.colormaps[COLORS](stage / max(1, stages - 1))[..., :3])


def panel(row: Any, arrays: Arrays, stages: Sequence[str]) -> Panel:
    """Show the stages of a row whose arrays hold `stage`; `stages` names them in their order."""
    assert arrays.stage is not None
    name = f"{row.surface_title}, {picture_size(row)}"
    image = images.png(stage_map(arrays.stage, len(stages)))
    last = f"{wording.share(float(np.mean(arrays.stage >= len(stages) - 2)))} cast in packets or alone"
    return Panel(name, (Picture(f"{row.key}-stage", image, f"Stages of {name}"),), last)
