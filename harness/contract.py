"""The vocabulary every other part speaks in; imports nothing of ours but surfaces.model, whose names it hands on.

Lengths are in scene units (the surface's own coordinates), times in seconds unless a name says `_ms`.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import IntEnum, StrEnum
from typing import TYPE_CHECKING, Any, Literal

from surfaces.model import Box as Box
from surfaces.model import Domain as Domain
from surfaces.model import FirsthitError as FirsthitError
from surfaces.model import Sphere as Sphere
from surfaces.model import Surface as Surface
from surfaces.model import as_float32 as as_float32

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

Precision = Literal["float32", "float64"]
Stage = Literal["compute", "rays", "raster"]
Casts = Literal["rays", "beams", "quadtree", "mesh"]
Proxy = Literal["box", "sphere", "tetrahedron"]
Normal = Literal["distance", "gradient", "core_circle"]
Prepass = Literal["none", "beams"]
Origin = Literal["nearest", "entry", "eye"]
PREPASSES: tuple[Prepass, ...] = ("none", "beams")
ORIGINS: tuple[Origin, ...] = ("nearest", "entry", "eye")
PROXIES: tuple[Proxy, ...] = ("box", "sphere", "tetrahedron")
NORMALS: tuple[Normal, ...] = ("distance", "gradient", "core_circle")
PRECISIONS: tuple[Precision, ...] = ("float32", "float64")
UNIT_ROUNDOFF: dict[Precision, float] = {"float32": 2.0**-24, "float64": 2.0**-53}
STAGES: tuple[Stage, ...] = ("compute", "rays", "raster")
BASELINE = "ray_march"  # the method that speed-ups are over where a config names nothing else


class RayStatus(IntEnum):
    """A method's answer for one ray; `EXHAUSTED` gave up inside its budget and is never reported as a miss.

    `INVALID` is no kernel's to give: it says that what was read back is no answer (harness.accuracy.answers).
    """

    MISS = 0
    HIT = 1
    EXHAUSTED = 2
    INVALID = 3


class TruthStatus(IntEnum):
    """The oracle's answer for one ray."""

    MISS = 0
    CROSSING = 1
    TOUCH = 2
    UNDECIDED = 3


class CellStatus(StrEnum):
    OK = "ok"
    SKIPPED = "skipped"
    FAILED = "failed"
    TIMEOUT = "timeout"
    CRASHED = "crashed"


@dataclass(frozen=True)
class Parameter:
    """A method's knob: bound as a compile-time constant of this name, in capitals."""

    name: str
    default: float | int
    meaning: str  # one phrase with its unit
    finer: Literal["up", "down"] | None = None  # which way the error falls; tested, as claims are
    sweep: tuple[float | int, ...] = ()  # values beside the default that trade speed for error, for `recommend` to try
    per: str | None = (
        None  # the length, as kernels write it, that a tolerance is a share of, or that is halved so often
    )
    #   where more is finer: such a knob may be loosened to what a pixel shows
    printed: float | int | None = None  # the source's own value, where the default is ours and another


CLAIMS: dict[str, str] = {
    "no_missed_root": "a ray that meets the surface is never answered as a miss or by a later root; near tangency too",
    "finds_touch": "where a ray touches the surface without crossing it, that is a hit",
    "no_false_hit": "no hit where the oracle proves that there is none, on rays that are neither grazing nor drowned",
    "error_below_tolerance": "a right hit is within Method.tolerance of its root, and what rounding must add",
    "conservative_bound": "no step is longer than a proved bound allows: no root of a ray that is neither grazing nor"
    " drowned is passed",
}

Tables = Callable[[Surface, Mapping[str, float | int], Precision], Mapping[str, Sequence[float]]]


@dataclass(frozen=True)
class Method:
    """One published way to find a ray's first hit; the algorithm itself is `kernel.glsl` beside the description."""

    name: str
    source: str
    needs: tuple[str, ...] = ()  # generated functions the kernel calls, see harness.kernels.functions.FUNCTIONS
    libraries: tuple[str, ...] = ()  # files of harness/kernels/glsl/lib the kernel includes, without their ending
    parameters: tuple[Parameter, ...] = ()
    settings: Mapping[str, Mapping[str, float]] = field(default_factory=dict)  # the papers' own settings, by name
    claims: frozenset[str] = frozenset()  # of CLAIMS; each is tested, so what is not proved is not claimed
    tolerance: Callable[[Surface, Mapping[str, float | int]], float] | None = (
        None  # largest error, scene units, without
    )
    #   rounding: what error_below_tolerance is about
    accepts: Callable[[Surface], str | None] = lambda _: None  # None, or the reason it refuses
    tables: Tables | None = None  # constant arrays of reals that the kernel reads, from surface, knobs and precision
    answers: bool = True  # False: measures the harness's floor and finds nothing
    precisions: tuple[Precision, ...] = PRECISIONS
    casts: Casts = "rays"  # what the kernel defines: rays, `Hit first_hit(Ray, real t0, real t1)`; beams and quadtree,
    #   `void cast_cell(Work, Cell)`, for every pixel, or for the quadtree's cells level by level; mesh,
    #   `vec3 mesh_normal(vec3)`, of triangles that are rasterised in place of rays
    mesh: Callable[[Surface, Mapping[str, float | int]], MeshRecipe] | None = None  # of a method that casts a mesh

    @property
    def printed(self) -> dict[str, float | int]:
        """The knobs whose default is ours, with the values that the method's source prints."""
        return {p.name: p.printed for p in self.parameters if p.printed is not None}


@dataclass(frozen=True)
class MeshRecipe:
    """How a surface is tessellated: its parametric form over N × N, or its contour on a grid of N cells a side."""

    kind: Literal["parametric", "contour"]
    resolution: int


@dataclass(frozen=True)
class Variant:
    """A method with its parameters bound; `parameters` holds every parameter, sorted by name."""

    method: str
    parameters: tuple[tuple[str, float | int], ...] = ()
    label: str = ""  # what tables print: `newton[EPSILON=0.001]`

    def __str__(self) -> str:
        return self.label or self.method


@dataclass(frozen=True)
class View:
    """A camera. Angles in degrees; `elevation` 90 looks down the z axis.

    `distance` is from the target, in scene units; None puts the camera where the domain's bounding sphere just fits
    the field of view. `fov` is the full vertical angle of a perspective camera.
    """

    name: str
    azimuth: float = 30.0
    elevation: float = 30.0
    fov: float = 30.0
    distance: float | None = None
    target: tuple[float, float, float] | None = None  # None: the domain's centre
    set: str | None = None  # views of one set are compared with each other: "angles", "directions" or a name of yours


@dataclass(frozen=True)
class Section:
    """A piece of program text and where it is from: a path below the project, or `generated: …`."""

    origin: str
    text: str

    @property
    def hash(self) -> str:
        return digest(self.text)


def source(sections: Sequence[Section]) -> str:
    """The text of sections in order, each under a line that names it."""
    return "".join(f"// ==== {s.origin} ====\n{s.text.rstrip()}\n" for s in sections)


@dataclass(frozen=True)
class Program:
    """One program text made of ordered sections, for one compiler and precision; of rasterisation, the fragment's, with
    the vertices' own sections in `vertex`."""

    language: Literal["glsl", "cl"]
    precision: Precision
    entry: str  # "rays", "camera", "beams", "map", "raster", "mesh" or "fill"
    sections: tuple[Section, ...]
    vertex: tuple[Section, ...] = ()
    optimised: bool = True  # False: built without optimisation, to hold against the other; only OpenCL compilers can

    @property
    def text(self) -> str:
        return source(self.sections)

    @property
    def hash(self) -> str:
        texts = [*(s.text for s in self.sections), *(["vertex"] if self.vertex else []), *(s.text for s in self.vertex)]
        return digest(self.language, self.precision, self.entry, *texts, *([] if self.optimised else ["unoptimised"]))

    def locate(self, line: int) -> tuple[str, int]:
        """Section origin and line within it for a 1-based line of `text`."""
        first = 1
        for section in self.sections:
            count = len(section.text.rstrip().split("\n")) + 1
            if line < first + count:
                return section.origin, line - first
            first += count
        return "end of program", 0


@dataclass(frozen=True)
class DeviceInfo:
    """A device as its driver names it."""

    name: str  # "opencl:intel"
    title: str  # the hardware's own name
    driver: str
    compiler: str
    compute_units: int | None
    float64: bool
    clock: Literal["device", "wall"]  # which clock is to be believed
    versions: tuple[tuple[str, str], ...]  # the bindings' package versions
    problem: str | None = None  # why it cannot run kernels, where it cannot
    resident: int | None = None  # work items that fill one of its compute units; None: a work group does


@dataclass(frozen=True, eq=False)
class Hits:
    """What a method answered for n rays."""

    t: NDArray[np.float64]  # [n] along the ray as given, scene units; NaN where status is not HIT
    status: NDArray[np.uint8]  # [n] RayStatus
    evaluations: NDArray[np.int32]  # [n] evaluations of f (value or value with derivative) spent; 0 where INVALID

    @property
    def spent(self) -> tuple[float | None, int]:
        """Evaluations over the rays that were answered, mean and largest; None and 0 where none was."""
        spent = self.evaluations[self.status != RayStatus.INVALID]
        return (float(spent.mean()), int(spent.max())) if len(spent) else (None, 0)


@dataclass(frozen=True, eq=False)
class Truth:
    """The oracle's certified answers for n rays, and what classifies them.

    `lower`, `upper` and `status` are proved. `following`, `condition`, `margin` and `contrast` are float64 estimates
    that sort rays into classes and never decide right or wrong by themselves.
    """

    lower: NDArray[np.float64]  # [n] certified: lower <= t* <= upper; NaN where status is not CROSSING or TOUCH
    upper: NDArray[np.float64]
    status: NDArray[np.uint8]  # [n] TruthStatus
    following: NDArray[np.float64]  # [n] the next root after the first inside the domain; inf where there is none
    condition: NDArray[np.float64]  # [n] condition number of the first root: d t / (relative change of f's terms), over
    #   the domain's radius: sum of |terms of f| / (|df/dt| * radius); NaN without a hit
    margin: NDArray[np.float64]  # [n] how far, in scene units, the ray is from another answer: the smallest estimate
    #   |f| / |grad f| over near touches before the first hit, the depth of the first root's dip, and the distance of
    #   roots to the ends of the clip interval; inf where nothing is near
    contrast: NDArray[np.float64]  # [n] how far f stays clear of its own rounding: the smallest |f| at such places, and
    #   anywhere before the first root, over what kernels may be off in f's value there (oracle.noise), in unit
    #   roundoffs; inf without any; 0 for TOUCH and UNDECIDED. Below an arithmetic's unit roundoff f's sign is in doubt


FROM_ORIGIN: Mapping[Origin, str] = {"nearest": "", "entry": " from the entry", "eye": " from the eye"}


@dataclass(frozen=True)
class Cell:
    """One point of the experiment grid: a view, or a family of hard rays, which is checked but not timed."""

    variant: Variant
    surface: Surface
    view: View
    size: int  # pixels per side
    samples_per_pixel: int
    precision: Precision
    stage: Stage
    device: str
    family: str | None = None  # of harness.hardcases; then its rungs' rays take the place of surface and view
    prepass: Prepass = "none"  # beams: the rays are narrowed to where tiles' beams cannot exclude the surface
    proxy: Proxy = "box"  # of stage raster: the geometry whose fragments cast rays
    tolerance: float = 0.0  # of stage raster: pixel footprints that a method's own tolerance may grow to
    scene: Any = None  # a harness.scenes.Scene of several instances, of which `surface` then is the stand-in
    origin: Origin = "nearest"  # where a method sees its ray begin: at the point nearest the domain's centre, where the
    #   ray enters the domain, or at the eye, as the ray was given; t is told along the ray as given all the same
    normal: Normal = "distance"  # of stage raster: what hits are shaded by, see assemble.raster_program

    @property
    def caster(self) -> str:
        """The variant, with the prepass that it works behind, its tolerance in pixels, a proxy that is no box, an
        origin that is not the nearest point, and normals that are not of the distance."""
        behind = "" if self.prepass == "none" else f"+{self.prepass}"
        loose = f" to {self.tolerance:g} pixels" if self.tolerance else ""
        proxy = "" if self.proxy == "box" else f" in a {self.proxy}"
        shaded = "" if self.normal == "distance" else f" shaded by {self.normal}"
        return f"{self.variant}{behind}{loose}{proxy}{FROM_ORIGIN[self.origin]}{shaded}"

    @property
    def slot(self) -> str:
        """The cell's place in the grid, for people."""
        if self.family:
            return f"{self.caster} family {self.family} {self.precision} {self.device}"
        sampling = f"{self.size}x{self.size}x{self.samples_per_pixel}"
        where = f"{self.surface.name} {self.view.name} {sampling}"
        return f"{self.caster} {where} {self.precision} {self.stage} {self.device}"

    @property
    def comparison(self) -> str:
        """Cells that share this are compared with each other: they differ in variant, device and precision alone."""
        if self.family:
            return f"family {self.family}"
        return f"{self.surface.name} {self.view.name} {self.size}x{self.size}x{self.samples_per_pixel} {self.stage}"

    @property
    def together(self) -> str:
        """Cells that share this are timed in one interleaved run: a comparison, those of all views of a set, and those
        of all forms of a surface."""
        if self.family:
            return self.comparison
        views = self.view.name if self.view.set is None else self.view.set
        return f"{self.surface.base} {views} {self.size}x{self.size}x{self.samples_per_pixel} {self.stage}"


def digest(*parts: Any) -> str:
    """A stable 16-digit hash of JSON-able parts."""
    text = json.dumps(parts, sort_keys=True, separators=(",", ":"), ensure_ascii=False)
    return hashlib.sha256(text.encode()).hexdigest()[:16]
