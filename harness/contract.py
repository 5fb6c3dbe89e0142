"""Define the words that all other parts use: what a method, a view, a program, an answer and the truth are.

It imports nothing of ours but harness.limits, and surfaces.model and surfaces.words, whose names can be imported from
here too. Lengths are in scene units (a surface's own coordinates), times in seconds unless a name ends in `_ms`. `t` is
a distance along a ray.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import IntEnum, StrEnum
from functools import cached_property
from typing import TYPE_CHECKING, Annotated, Any, Literal

from harness.limits import AZIMUTH, DISTANCE, ELEVATION, FIELD_OF_VIEW, POSITION, Name, hold
from surfaces.model import Box as Box
from surfaces.model import Domain as Domain
from surfaces.model import FirsthitError as FirsthitError
from surfaces.model import Sphere as Sphere
from surfaces.model import Surface as Surface
from surfaces.model import as_float32 as as_float32
from surfaces.visible import joined, shown
from surfaces.words import plural as plural
from surfaces.words import suggestion as suggestion

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


Precision = Literal["float32", "float64"]
Stage = Literal["compute", "rays", "raster"]
Language = Literal["glsl", "cl"]
Casts = Literal["rays", "beams", "quadtree", "tiles", "mesh"]
Proxy = Literal["box", "sphere", "tetrahedron"]
Normal = Literal["distance", "gradient", "core_circle"]
Prepass = Literal["none", "beams"]
Origin = Literal["nearest", "entry", "eye"]
Coordinate = Annotated[float, POSITION]
Point = tuple[Coordinate, Coordinate, Coordinate]
ORIGINS: tuple[Origin, ...] = ("nearest", "entry", "eye")
PROXIES: tuple[Proxy, ...] = ("box", "sphere", "tetrahedron")
NORMALS: tuple[Normal, ...] = ("distance", "gradient", "core_circle")
PRECISIONS: tuple[Precision, ...] = ("float32", "float64")
UNIT_ROUNDOFF: dict[Precision, float] = {"float32": 2.0**-24, "float64": 2.0**-53}
DEVICE_TEXT = 500  # letters of what a driver says of a device
BASELINE = "ray_march"  # the method that speed-ups are over where a config names nothing else


class RayStatus(IntEnum):
    """Name a method's answers for one ray.

    EXHAUSTED: the method gave up when its budget was spent; this is never reported as a miss
    INVALID: the answer is impossible (harness.accuracy.answers); a kernel never gives this status itself
    """

    MISS = 0
    HIT = 1
    EXHAUSTED = 2
    INVALID = 3


class TruthStatus(IntEnum):
    """Name the oracle's answers for one ray.

    CROSSING, TOUCH: at the first root f changes its sign, or touches zero without a change
    UNDECIDED: the oracle could prove neither of the others
    """

    MISS = 0
    CROSSING = 1
    TOUCH = 2
    UNDECIDED = 3


class CellStatus(StrEnum):
    """Name how a cell ended: measured, refused before it ran, or ended by an error, its time limit or a crash."""

    OK = "ok"
    SKIPPED = "skipped"
    FAILED = "failed"
    TIMEOUT = "timeout"
    CRASHED = "crashed"


@dataclass(frozen=True)
class Parameter:
    """Describe a method's knob. Kernels see it as a compile-time constant of this name.

    name: in capitals
    default: its value where none is given; an int makes the knob a whole number
    meaning: one phrase with its unit
    finer: the way to turn it that makes the error smaller; tested, as claims are
    sweep: further values that trade speed for error, which `recommend` tries
    per: the length that a tolerance is a share of or, with finer "up", that is halved so many times; as kernels write
        it. Such a knob may be loosened to an error that a pixel does not show (Cell.tolerance)
    printed: the value that the method's source prints, where the default is another and ours
    """

    name: str
    default: float | int
    meaning: str
    finer: Literal["up", "down"] | None = None
    sweep: tuple[float | int, ...] = ()
    per: str | None = None
    printed: float | int | None = None


CLAIMS: dict[str, str] = {
    "no_missed_root": "a ray that meets the surface is never answered as a miss or by a later root; near tangency too",
    "finds_touch": "where a ray touches the surface without crossing it, that is a hit",
    "no_false_hit": "if f does not jump, no hit where the oracle proves that there is none, on rays that are neither"
    " grazing nor drowned",
    "error_below_tolerance": "if f does not jump, a right hit is off its root by at most Method.tolerance and what"
    " rounding must add",
    "conservative_bound": "no step is longer than a proved bound allows: no root of a ray that is neither grazing nor"
    " drowned is passed",
}

# The generated functions that a method may need, and those that each one calls: harness/kernels/functions.py
GENERATED: dict[str, tuple[str, ...]] = {
    "constants": (),
    "surface_value": (),
    "surface_gradient": (),
    "surface_hessian_product": (),
    "surface_normal": ("surface_gradient",),
    "surface_distance": (),
    "surface_distance_normal": (),
    "surface_range": (),
    "surface_range_along": ("surface_range",),
    "surface_gradient_range": ("surface_range",),
    "surface_coefficients_along": (),
    "surface_polynomial_along": (),
    "surface_along": (),
    "surface_value_along": ("surface_along",),
    "surface_dual_along": ("surface_along",),
}

Tables = Callable[[Surface, Mapping[str, float | int], Precision], Mapping[str, Sequence[float]]]


@dataclass(frozen=True)
class Method:
    """Describe a way to find a ray's first hit; the algorithm itself is `kernel.glsl` in the method's folder.

    source: the paper or book that publishes it
    label: how people write its name in plots and tables, as in "EFT Yuksel"; "" makes it from the name
    needs: generated functions that the kernel calls (harness.kernels.functions.FUNCTIONS)
    libraries: files of harness/kernels/glsl/lib that the kernel includes, without their ending
    settings: the paper's own settings, by name: values of knobs
    claims: names of CLAIMS; each is tested, so claim only what is proved
    tolerance: the largest error without rounding, scene units, from surface and knobs; for error_below_tolerance
    accepts: returns None for a surface that the method can be used on, else the reason why not
    tables: constant arrays of reals that the kernel reads, by name, from surface, knobs and precision
    answers: False for a method that finds nothing and measures what the harness itself costs
    casts: what the kernel defines. "rays": `Hit first_hit(Ray, real t0, real t1)`. "beams" and "quadtree":
        `void cast_cell(Work, Cell)`, called for every pixel or, level by level, for a quadtree's cells. "tiles":
        `void isolate_tiles(Work, Frame)`, `void finish_tiles(Work, Frame)` and `void cast_packets(Work, Frame)`, the
        stages of a frame, each of which takes tiles of pixels until there are none (harness.kernels.tiles). A stage may
        have files of its own behind kernel.glsl, see harness.kernels.sections.STAGE_FILES: one that is named as it is,
        and those that it shares with other stages. rest.glsl defines `Cast cast_alone(Ray, real lower)`. "mesh":
        `vec3 mesh_normal(vec3)`, for triangles that are rasterised in place of rays
    rest: of a method that casts tiles, the method of this project whose kernel casts the rays that no tile decides; it
        is given this method's own knobs and tables
    mesh: how a method that casts a mesh tessellates a surface, from surface and knobs
    """

    name: str
    source: str
    label: str = ""
    needs: tuple[str, ...] = ()
    libraries: tuple[str, ...] = ()
    parameters: tuple[Parameter, ...] = ()
    settings: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    claims: frozenset[str] = frozenset()
    tolerance: Callable[[Surface, Mapping[str, float | int]], float] | None = None
    accepts: Callable[[Surface], str | None] = lambda _: None
    tables: Tables | None = None
    answers: bool = True
    precisions: tuple[Precision, ...] = PRECISIONS
    casts: Casts = "rays"
    rest: str = ""
    mesh: Callable[[Surface, Mapping[str, float | int]], MeshRecipe] | None = None

    @property
    def printed(self) -> dict[str, float | int]:
        """Return the values that the method's source prints, by knob, for knobs whose default is another."""
        return {p.name: p.printed for p in self.parameters if p.printed is not None}


@dataclass(frozen=True)
class MeshRecipe:
    """State how a surface is tessellated: from its parametric form at N × N points, or as its contour on a grid."""

    kind: Literal["parametric", "contour"]
    resolution: int  # N, or the grid's cells along its longest side


@dataclass(frozen=True)
class Variant:
    """State a method with a value for each of its parameters; `parameters` holds all of them, sorted by name."""

    method: str
    parameters: tuple[tuple[str, float | int], ...] = ()
    label: str = ""  # what tables print: `newton[EPSILON=0.001]`

    def __str__(self) -> str:
        return self.label or self.method


@dataclass(frozen=True)
class View:
    """State a perspective camera.

    name: what commands and rows call it
    azimuth, elevation: direction from the target to the eye, degrees; elevation 90 looks down the z axis
    fov: the full vertical angle of view, degrees
    distance: from the eye to the target, scene units; None: the domain's bounding sphere just fits the field of view
    target: the point in the middle of the image, scene units; None: the domain's centre
    set: views of one set are compared with each other: "angles", "directions" or a name of your own; None: no set

    Raises FirsthitError for a value that is no number, or outside the limits that harness/limits.py states.
    """

    name: Annotated[str, Name()]
    azimuth: Annotated[float, AZIMUTH] = 30.0
    elevation: Annotated[float, ELEVATION] = 30.0
    fov: Annotated[float, FIELD_OF_VIEW] = 30.0
    distance: Annotated[float, DISTANCE] | None = None
    target: Point | None = None
    set: Annotated[str, Name()] | None = None

    def __post_init__(self) -> None:
        hold(self)


@dataclass(frozen=True)
class Section:
    """Hold a piece of program text; `origin` says where it is from: a path below the project, or `generated: …`."""

    origin: str
    text: str

    @cached_property
    def hash(self) -> str:
        """Return a hash of the text; the origin is no part of it."""
        return digest(self.text)


def source(sections: Sequence[Section]) -> str:
    """Return the text of the sections in order, each under a line that names its origin."""
    return "".join(f"// ==== {s.origin} ====\n{s.text.rstrip()}\n" for s in sections)


@dataclass(frozen=True)
class Program:
    """Hold one program text for one compiler and precision.

    entry: what it is started as: "rays", "camera", "beams", a stage of tiles, "map", "raster", "mesh", "fill" or "draw"
    sections: its text in order; for "raster" and "mesh" that of the fragments
    vertex: for "raster" and "mesh" the text of the vertices, else nothing
    optimised: False: built without optimisation, to compare its answers with the other's; OpenCL compilers only
    """

    language: Language
    precision: Precision
    entry: str
    sections: tuple[Section, ...]
    vertex: tuple[Section, ...] = ()
    optimised: bool = True

    @property
    def text(self) -> str:
        """Return the text that the compiler is given, without that of the vertices."""
        return source(self.sections)

    @cached_property
    def hash(self) -> str:
        """Return a hash of language, precision, entry and all texts, those of the vertices included."""
        texts = [*(s.text for s in self.sections), *(["vertex"] if self.vertex else []), *(s.text for s in self.vertex)]
        return digest(self.language, self.precision, self.entry, *texts, *([] if self.optimised else ["unoptimised"]))

    def locate(self, line: int) -> tuple[str, int]:
        """Return the origin of the section that holds line `line` of `text` (from 1), and the line's number in it."""
        first = 1
        for section in self.sections:
            count = len(section.text.rstrip().split("\n")) + 1
            if line < first + count:
                return section.origin, line - first
            first += count
        return "end of program", 0


@dataclass(frozen=True)
class DeviceInfo:
    """Describe a device as its driver names it.

    name: what commands and rows call it, for example "opencl:intel"
    title: the hardware's own name
    clock: the one to be trusted there, the device's own or the host's
    versions: name and version of the Python packages that it is reached by
    problem: why it cannot run kernels; None where it can
    resident: work items that fill one compute unit; None where one work group fills it
    """

    name: str
    title: str
    driver: str
    compiler: str
    compute_units: int | None
    float64: bool
    clock: Literal["device", "wall"]
    versions: tuple[tuple[str, str], ...]
    problem: str | None = None
    resident: int | None = None

    def __post_init__(self) -> None:
        """Show in each text what cannot be seen: a driver may say anything."""
        for name in ("name", "title", "driver", "compiler"):
            object.__setattr__(self, name, shown(joined(getattr(self, name)))[:DEVICE_TEXT])


@dataclass(frozen=True)
class LostDevice(DeviceInfo):
    """Describe a device whose worker died, hung or grew too large while it was looked for or tried.

    `problem` says what happened. Where it was looked for, the name is the backend's with UNFOUND.
    """


UNFOUND = ":none"  # how the name of a stand-in ends, for devices of a backend that could not be looked at


@dataclass(frozen=True, eq=False)
class Hits:
    """Hold what a method answered for n rays."""

    t: NDArray[np.float64]  # [n] along the ray as given, scene units; NaN where status is not HIT
    status: NDArray[np.uint8]  # [n] RayStatus
    evaluations: NDArray[np.int32]  # [n] evaluations of f, with its derivative or without; 0 where INVALID

    @property
    def spent(self) -> tuple[float | None, int]:
        """Return mean and maximum of the evaluations over rays whose status is not INVALID; None and 0 without any."""
        spent = self.evaluations[self.status != RayStatus.INVALID]
        return (float(spent.mean()), int(spent.max())) if len(spent) else (None, 0)


@dataclass(frozen=True, eq=False)
class Truth:
    """Hold the oracle's certified answers for n rays, and what sorts the rays into classes.

    `lower`, `upper` and `status` are proved. The others are float64 estimates. They sort rays into classes, and never
    decide by themselves whether an answer is right.

    condition: condition number of the first root: change of t over the domain's radius, for a relative change of f's
        terms. It is the sum of |terms of f| / (|df/dt| * radius)
    margin: how far the ray is from another answer, scene units: the least of |f| / |grad f| at near touches before the
        first hit, of the depth of the first root's dip, and of the roots' distances to the ends of the ray's interval
    contrast: how far f stays clear of its own rounding: the least |f| at such places, and anywhere before the first
        root, over the bound, in unit roundoffs, of a kernel's error in f there (oracle.noise). Below a precision's
        unit roundoff the sign of f is in doubt
    """

    lower: NDArray[np.float64]  # [n] certified: lower <= t* <= upper; NaN where status is not CROSSING or TOUCH
    upper: NDArray[np.float64]  # [n]
    status: NDArray[np.uint8]  # [n] TruthStatus
    following: NDArray[np.float64]  # [n] t of the next root in the domain; inf where there is none
    condition: NDArray[np.float64]  # [n] NaN without a hit
    margin: NDArray[np.float64]  # [n] inf where nothing is near
    contrast: NDArray[np.float64]  # [n] inf where there is no such place; 0 for TOUCH and UNDECIDED


FROM_ORIGIN: Mapping[Origin, str] = {"nearest": "", "entry": " from the entry", "eye": " from the eye"}


def digest(*parts: Any) -> str:
    """Return a stable hash of JSON-able parts: 16 hexadecimal digits."""
    text = json.dumps(parts, sort_keys=True, separators=(",", ":"), ensure_ascii=False)
    return hashlib.sha256(text.encode()).hexdigest()[:16]
