"""State how a group of instances is to be drawn, which kinds of methods are asked for programs of."""

from __future__ import annotations

from dataclasses import dataclass

from harness.contract import Normal, Origin, Proxy, Variant
from harness.scenes.model import Group


@dataclass(frozen=True, eq=False)
class Drawing:
    """State how a group of instances is to be drawn.

    pixels: pixel footprints that the method's tolerance may grow to; see harness.kernels.raster.raster_program for
        this, `origin` and `normal`
    """

    group: Group
    variant: Variant
    proxy: Proxy
    pixels: float = 0.0
    origin: Origin = "nearest"
    normal: Normal = "distance"
