"""Define cells, the points of an experiment's grid, and the names by which people and results tell them apart."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from harness.contract import FROM_ORIGIN, Normal, Origin, Precision, Prepass, Proxy, Stage, Surface, Variant, View
from harness.scenes.model import Scene

BEHIND: Mapping[Prepass, str] = {"none": "", "beams": "+beams"}


@dataclass(frozen=True)
class Cell:
    """State one point of the experiment's grid: a surface or a scene from a view.

    size: pixels per side
    stage: "compute": rays or beams of a camera's image; "rays": the same rays, listed; "raster": fragments, or
        triangles of a mesh
    family: of a FamilyCell only
    prepass: "beams": beams of tiles narrow the rays to where they cannot exclude the surface
    proxy: of stage raster: the geometry whose fragments cast rays
    tolerance: of stage raster: pixel footprints that a method's own tolerance may grow to; 0: it does not grow
    scene: several instances; `surface` then stands for them. None: one instance of `surface`
    origin: where a method sees its ray begin: at the point nearest the domain's centre, where the ray enters the
        domain, or at the eye. An answer's t is along the ray as given in any case
    normal: of stage raster: what hits are shaded by, see harness.kernels.raster.raster_program
    """

    variant: Variant
    surface: Surface
    view: View
    size: int
    samples_per_pixel: int
    precision: Precision
    stage: Stage
    device: str
    family: str | None = None
    prepass: Prepass = "none"
    proxy: Proxy = "box"
    tolerance: float = 0.0
    scene: Scene | None = None
    origin: Origin = "nearest"
    normal: Normal = "distance"

    @property
    def caster(self) -> str:
        """Return the variant's label, followed by the settings of the cell that are not the defaults.

        These are prepass, tolerance, proxy, origin and normal.
        """
        loose = f" to {self.tolerance:g} pixels" if self.tolerance else ""
        proxy = "" if self.proxy == "box" else f" in a {self.proxy}"
        shaded = "" if self.normal == "distance" else f" shaded by {self.normal}"
        return f"{self.variant}{BEHIND[self.prepass]}{loose}{proxy}{FROM_ORIGIN[self.origin]}{shaded}"

    @property
    def slot(self) -> str:
        """Return the cell's place in the grid, for people to read."""
        sampling = f"{self.size}x{self.size}x{self.samples_per_pixel}"
        where = f"{self.surface.name} {self.view.name} {sampling}"
        return f"{self.caster} {where} {self.precision} {self.stage} {self.device}"

    @property
    def comparison(self) -> str:
        """Return the name that is one for all cells that are compared: it leaves out variant, device and precision."""
        return f"{self.surface.name} {self.view.name} {self.size}x{self.size}x{self.samples_per_pixel} {self.stage}"

    @property
    def together(self) -> str:
        """Return the name that is one for all cells that are timed in one interleaved run.

        Those are the cells of a comparison, of all views of a set, and of all forms of a surface.
        """
        views = self.view.name if self.view.set is None else self.view.set
        return f"{self.surface.base} {views} {self.size}x{self.size}x{self.samples_per_pixel} {self.stage}"


@dataclass(frozen=True)
class FamilyCell(Cell):
    """State one point of the experiment's grid that is checked and not timed: a family of hard rays.

    The rays of the family's rungs (harness.hardcases) replace surface and view.
    """

    @property
    def slot(self) -> str:
        return f"{self.caster} {self.comparison} {self.precision} {self.device}"

    @property
    def comparison(self) -> str:
        return f"family {self.family}"

    @property
    def together(self) -> str:
        return self.comparison
