"""Define what a config may say. Each field states its own limits, to which harness.experiment.reading holds it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import inf
from pathlib import Path
from typing import Annotated

from harness import memory
from harness.contract import (
    BASELINE,
    Normal,
    Origin,
    Precision,
    Prepass,
    Proxy,
    Stage,
    Surface,
    Variant,
    View,
)
from harness.limits import (
    PIXELS,
    RAYS,
    SECONDS,
    SEED,
    SHARE,
    TIMEOUT,
    AtMost,
    Distinct,
    FilePath,
    Known,
    Line,
    Name,
    Offered,
    OneOf,
    Within,
)
from harness.scenes.choice import SceneChoice
from harness.scenes.model import Scene
from harness.scenes.views import AngleChoice, DirectionChoice, PathChoice

MEMORY = Within(0.01, 1.0)  # share of the machine's memory
NOT_NEGATIVE = Within(0.0, inf, "a tolerance is not negative")
DEVICE = Line(200)  # a device's name, which its driver makes
PATH = FilePath()
# Keys of older configs, and what to do instead
GONE: dict[tuple[str | int, ...], str] = {
    ("gate", "same"): "is gone: devices are compared by how they compute, and rows of devices whose last bits differ "
    "are held with more tolerance; remove the key, and state that tolerance in [gate.last_bits] if the default is "
    "not yours",
}


BESIDE_INCLUDE = ("title", "include", "focus")  # all that a config may hold that includes others
FASTEST = "fastest"  # stands for a device, until harness.running.fastest has found which
DRAWN = ("surfaces", "scene", "families")  # each of them needs methods
ASKED = (*DRAWN, "studies")  # of which a config names one at least


# Annotated types name these functions. A lambda in an annotation would not find the names of this module


def _figures() -> Iterable[str]:
    from harness.results.figures import KNOWN

    return KNOWN


def _rows_figures() -> Iterable[str]:
    from harness.results.figures import GATED

    return GATED


def _studies() -> Iterable[str]:
    from harness import studies

    return studies.NAMES


def _families() -> Iterable[str]:
    from harness import hardcases

    return hardcases.names()


def _methods() -> Iterable[str]:
    from harness import plugins

    return plugins.built_in()


def _surfaces() -> Iterable[str]:
    import surfaces

    return (*surfaces.names(), *surfaces.names(surfaces.GALLERY))


def _surfaces_and_groups() -> Iterable[str]:
    import surfaces

    return ("all", surfaces.GALLERY, *surfaces.groups(), *_surfaces())


def _devices() -> Iterable[str]:
    return ["all", "any", FASTEST]


def _paths(names: list[str]) -> list[str]:
    return [str(Path(name)) for name in names]


def _names(views: list[View]) -> list[str]:
    return [view.name for view in views]


def _angles(angles: AngleChoice | None) -> list[str]:
    """Return the angles as they appear in their views' names."""
    return [f"{angle:g}" for angle in angles.values] if angles else []


@dataclass(frozen=True)
class MethodChoice:
    """Choose a method, and one value or several for each of its knobs; every combination of the values is a variant.

    name: of the method, as `firsthit list methods` prints it
    parameters: values of its knobs, by the knobs' names
    settings: the papers' own settings, by the names that the method gives them
    stages: of this method, if they are not the experiment's
    devices: that this method runs on, if they are not the experiment's
    deviations: add the default, and each knob that we changed at the value that the method's source prints
    """

    name: Annotated[str, Name(), Offered(_methods)]
    parameters: Annotated[dict[str, Annotated[list[float], Distinct()]], Name()] = field(default_factory=dict)
    settings: Annotated[list[Annotated[str, Name()]], Distinct()] = field(default_factory=list)
    stages: Annotated[list[Stage], Distinct()] = field(default_factory=list)
    devices: Annotated[list[Annotated[str, DEVICE]], Offered(_devices), Distinct()] = field(default_factory=list)
    deviations: bool = False


@dataclass(frozen=True)
class SurfaceChoice:
    """Define a surface of the config's own; without a formula or a file, change the catalog's of that name.

    formula: f(x, y, z), which is 0 on the surface
    file: a file that `firsthit import` reads, from the config's folder; FILE#NAME is one of several surfaces in it
    domain: if none is given, the catalog's, the file's, or sphere:1.5 for a formula; auto finds a box
    parameters: values of the names that the formula uses, or of the catalog's or the file's parameters
    distance: a formula of f's sign, nowhere larger than the distance to the surface; it is tested. Without it, f is the
        distance where that can be proved
    """

    formula: str = ""
    file: Annotated[str, PATH] = ""
    domain: Annotated[str, Line()] = ""
    parameters: Annotated[dict[str, float | Annotated[str, Line()]], Name()] = field(default_factory=dict)
    distance: str = ""


@dataclass(frozen=True)
class AccuracyChoice:
    """Say how accuracy is checked.

    size: each view is sampled by `size` × `size` rays
    grazing_margin: rays nearer than this to another answer, in scene radii, are a class of their own
    max_wrong_share: a variant that is wrong on a larger share of the other rays is not timed
    undecided: the share of hits, of decided and undecided ones together, that the oracle may leave undecided; above it
        a row has no accuracy, and fails
    """

    size: Annotated[int, RAYS] = 128
    grazing_margin: Annotated[float, SHARE] = 1e-3
    max_wrong_share: Annotated[float, SHARE] = 0.5
    undecided: Annotated[float, SHARE] = 0.01


@dataclass(frozen=True)
class BudgetChoice:
    """Say what one cell may cost.

    seconds: a cell is timed for so long, or until the median is known well enough; with 0 it is checked only
    interval: the median is known well enough if its 95 % interval is within this share of it
    rounds: a slow cell is timed in at least so many rounds, though they take up to 16 times `seconds`, since fewer
        cannot tell two variants apart (8 at the level of reports.analysis.ties)
    repetitions: no cell is timed in more rounds
    timeout: seconds for one step (build, check, one repetition), after which the worker is killed
    triangles: a frame of more triangles is skipped
    memory: share of the machine's memory, or of its container's, that a device's worker may hold, after which it is
        killed; it decides no row, so changing it runs no cell again
    """

    seconds: Annotated[float, SECONDS] = 2.0
    interval: Annotated[float, SHARE] = 0.02
    rounds: Annotated[int, Within(1, 1e6)] = 8
    repetitions: Annotated[int, Within(1, 1e6)] = 200
    timeout: Annotated[float, TIMEOUT] = 60.0
    triangles: Annotated[int, Within(1, 1e12)] = 1_000_000_000
    memory: Annotated[float, MEMORY] = memory.SHARE


@dataclass(frozen=True)
class ToleranceChoice:
    """Say how much worse a gated figure may get: `absolute` + `relative` × the baseline.

    absolute: in the figure's unit
    relative: a share of the baseline's value
    better: "lower" or "higher", if it is not as usual
    gated: False leaves the figure alone
    """

    absolute: Annotated[float, NOT_NEGATIVE] = 0.0
    relative: Annotated[float, NOT_NEGATIVE] = 0.0
    better: Annotated[str, OneOf(("", "lower", "higher"), "{value!r} is not lower or higher")] = ""
    gated: bool = True


@dataclass(frozen=True)
class SlackChoice:
    """Say by how much more a gated figure may get worse on other arithmetic: `absolute` + `relative` × the baseline.

    absolute: in the figure's unit
    relative: a share of the baseline's value
    """

    absolute: Annotated[float, NOT_NEGATIVE] = 0.0
    relative: Annotated[float, NOT_NEGATIVE] = 0.0


@dataclass(frozen=True)
class GateChoice:
    """Say how rows are held against a baseline; harness.results.figures has what is not stated here.

    figures: figures with tolerances of their own
    last_bits: figures with slack of their own, which is added to the tolerance where the baseline's device computes
        with other last bits
    """

    figures: Annotated[dict[str, ToleranceChoice], Known(_figures)] = field(default_factory=dict)
    last_bits: Annotated[dict[str, SlackChoice], Known(_rows_figures)] = field(default_factory=dict)


@dataclass(frozen=True)
class Config:
    """State an experiment. Its cells are all combinations, in two grids:

    - methods × prepass × origins × surfaces × views × sizes × samples × stages × precisions × devices, and
    - methods × families of hard rays × precisions × devices, which are checked and not timed.

    title: what reports are headed with
    include: config files; with it, a config holds nothing else but a title. Each is run into its own folder, and one
        report collects them
    baseline: the method, or the variant by its label, that reports give speed-ups over
    focus: the method, or the variant by its label, that reports are about: its wins and losses come first
    studies: computations of harness.studies
    method: the methods that are compared, each with its knobs
    surfaces, families: names, or ["all"]; of surfaces that is the catalog, and "gallery" and its groups are names too
    view: the views that are named one by one and, once names are resolved, those of `angles`, `directions` and `path`;
        without any, one default view
    angles: a set of views by projection angle
    directions: a set of views spread over the sphere
    path: the path of a moving camera, whose frames are a set of views
    sizes: pixels per side
    samples_per_pixel: rays through a pixel, in a regular pattern
    precisions: of the numbers that kernels compute with
    stages: compute: rays of a camera's image; rays: the same rays, listed; raster: fragments, or triangles of a mesh
    prepass: beams: beams of tiles narrow the rays to where they cannot exclude the surface
    origins: of rays; beams have none
    proxies, tolerances, normals: of stage raster
    devices: names of `firsthit devices`, "all", "any" for the first that works, or "fastest" for the one with the
        highest measured peak rate, a GPU if one is here
    seed: of the order in which cells are timed
    accuracy: how answers are checked
    budget: what one cell may cost
    surface: surfaces of the config's own, and changes to those of the catalog, by name
    scene: drawn by stage raster, from its own view
    gate: how `firsthit gate` holds rows against a baseline
    """

    title: Annotated[str, Line()]
    include: Annotated[list[Annotated[str, PATH]], Distinct(_paths), AtMost(1000)] = field(default_factory=list)
    baseline: Annotated[str, Line()] = BASELINE
    focus: Annotated[str, Line()] = ""
    studies: Annotated[list[str], Known(_studies), Distinct()] = field(default_factory=list)
    method: list[MethodChoice] = field(default_factory=list)
    surfaces: Annotated[list[Annotated[str, Name()]], Offered(_surfaces_and_groups), Distinct()] = field(
        default_factory=list
    )
    families: Annotated[list[str], Known(_families, or_all=True), Distinct()] = field(default_factory=list)
    view: Annotated[list[View], Distinct(_names)] = field(default_factory=list)
    angles: Annotated[AngleChoice | None, Distinct(_angles)] = None
    directions: DirectionChoice | None = None
    path: PathChoice | None = None
    sizes: Annotated[list[Annotated[int, PIXELS]], Distinct()] = field(default_factory=lambda: [256])
    samples_per_pixel: Annotated[list[int], OneOf((1, 4, 9, 16)), Distinct()] = field(default_factory=lambda: [1])
    precisions: Annotated[list[Precision], Distinct()] = field(default_factory=lambda: ["float32"])
    stages: Annotated[list[Stage], Distinct()] = field(default_factory=lambda: ["compute"])
    prepass: Annotated[list[Prepass], Distinct()] = field(default_factory=lambda: ["none"])
    origins: Annotated[list[Origin], Distinct()] = field(default_factory=lambda: ["nearest"])
    proxies: Annotated[list[Proxy], Distinct()] = field(default_factory=lambda: ["box"])
    tolerances: Annotated[list[Annotated[float, Within(0.0, 1e3)]], Distinct()] = field(default_factory=lambda: [0.0])
    normals: Annotated[list[Normal], Distinct()] = field(default_factory=lambda: ["distance"])
    devices: Annotated[list[Annotated[str, DEVICE]], Offered(_devices), Distinct()] = field(
        default_factory=lambda: ["all"]
    )
    seed: Annotated[int, SEED] = 1
    accuracy: AccuracyChoice = field(default_factory=AccuracyChoice)
    budget: BudgetChoice = field(default_factory=BudgetChoice)
    surface: Annotated[dict[str, SurfaceChoice], Name()] = field(default_factory=dict)
    scene: Annotated[dict[str, SceneChoice], Name()] = field(default_factory=dict)
    gate: GateChoice = field(default_factory=GateChoice)


@dataclass(frozen=True)
class Experiment:
    """Hold a config with every name in it resolved. One that includes others has nothing but `included`.

    own_stages: the stages of variants whose stages are not `stages`
    own_devices: the devices, by the words of the config, of variants whose devices are not the config's
    peaks: in Gflop/s, by the names of the devices that "fastest" was chosen from, the chosen one first; empty where the
        config does not say fastest
    left_out: a sentence for each thing that a surface's file has and that is not carried over
    """

    name: str
    path: Path
    text: str
    config: Config
    variants: tuple[Variant, ...]
    surfaces: tuple[Surface, ...]
    precisions: tuple[Precision, ...]
    stages: tuple[Stage, ...]
    included: tuple[Path, ...] = ()
    prepasses: tuple[Prepass, ...] = ("none",)
    origins: tuple[Origin, ...] = ("nearest",)
    proxies: tuple[Proxy, ...] = ("box",)
    normals: tuple[Normal, ...] = ("distance",)
    scenes: tuple[Scene, ...] = ()
    own_stages: Mapping[Variant, tuple[Stage, ...]] = field(default_factory=dict)
    own_devices: Mapping[Variant, tuple[str, ...]] = field(default_factory=dict)
    peaks: Mapping[str, float] = field(default_factory=dict)
    left_out: tuple[str, ...] = ()

    def stages_of(self, variant: Variant) -> tuple[Stage, ...]:
        """Return the stages that a variant is cast in."""
        return self.own_stages.get(variant, self.stages)

    def devices_of(self, variant: Variant) -> tuple[str, ...]:
        """Return the devices that a variant is cast on, by the words of the config."""
        return self.own_devices.get(variant, tuple(self.config.devices))

    def wanted_devices(self) -> list[str]:
        """List every word by which the config names devices that its cells run on."""
        own = (name for variant in self.variants for name in self.devices_of(variant))
        return list(dict.fromkeys(own)) if self.variants else self.config.devices

    def on(self, devices: Sequence[str]) -> Experiment:
        """Return the same experiment with all methods on `devices`; the config's own where these are none."""
        if not devices:
            return self
        return replace(self, config=replace(self.config, devices=list(devices)), own_devices={})


def views_of(scene: Scene, config: Config) -> list[View]:
    """Return the views of a scene: its own, and those of the config's sets of views."""
    return [scene.view, *(view for view in config.view if view.set)]
