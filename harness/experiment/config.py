"""What a config may say. Each field states its own limits, which harness.experiment.reading holds it against."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from math import inf
from pathlib import Path
from typing import Annotated

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
from harness.limits import SEED, SHARE, Distinct, Known, OneOf, Within
from harness.results.facts import FACTS
from harness.scenes.choice import SceneChoice
from harness.scenes.model import Scene
from harness.scenes.views import AngleChoice, DirectionChoice

NOT_NEGATIVE = Within(0.0, inf, "a tolerance is not negative")


# Annotated types call these by name: a lambda among them would not find this module's names


def _facts() -> Iterable[str]:
    return FACTS


def _figures() -> Iterable[str]:
    from harness.results.figures import KNOWN

    return KNOWN


def _studies() -> Iterable[str]:
    from harness import studies

    return studies.NAMES


def _families() -> Iterable[str]:
    from harness import hardcases

    return hardcases.names()


def _paths(names: list[str]) -> list[Path]:
    return [Path(name) for name in names]


def _names(views: list[View]) -> list[str]:
    return [view.name for view in views]


def _angles(angles: AngleChoice | None) -> list[str]:
    """Return the angles as their views are named by them."""
    return [f"{angle:g}" for angle in angles.values] if angles else []


@dataclass(frozen=True)
class MethodChoice:
    """A method, and one value or several for each knob; the values of several knobs multiply.

    `settings` are the papers' own, by the names that the method gives them. `stages` are this method's, where they are
    not the experiment's. `deviations` adds the default, and each knob that we changed at the value that the method's
    source prints.
    """

    name: str
    parameters: dict[str, list[float]] = field(default_factory=dict)
    settings: list[str] = field(default_factory=list)
    stages: Annotated[list[Stage], Distinct()] = field(default_factory=list)
    deviations: bool = False


@dataclass(frozen=True)
class SurfaceChoice:
    """A surface of the config's own; without a formula, the catalog's of that name.

    Without a domain it is in the catalog's, or in sphere:1.5.
    """

    formula: str = ""
    domain: str = ""
    parameters: dict[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class AccuracyChoice:
    """Accuracy is checked on each view sampled `size` × `size`.

    Rays nearer than `grazing_margin` scene radii to another answer are a class of their own; a variant that is wrong
    on more than `max_wrong_share` of the others is not timed. Where the oracle leaves more than a share of `undecided`
    hits, of those and the decided ones together, a row has no accuracy, and fails.
    """

    size: Annotated[int, Within(1, 4096)] = 128
    grazing_margin: Annotated[float, SHARE] = 1e-3
    max_wrong_share: Annotated[float, SHARE] = 0.5
    undecided: Annotated[float, SHARE] = 0.01


@dataclass(frozen=True)
class BudgetChoice:
    """What one cell may cost.

    It is timed for `seconds`, or until the 95 % interval of the median is within `interval` of it. A slow cell is timed
    in at least so many `rounds`, though they take up to 16 times `seconds`: fewer cannot tell two variants apart (8 at
    the level of reports.analysis.ties). `repetitions` are the most that any cell is timed in.

    After `timeout` seconds for any one step (build, check, one repetition) the worker is killed. A frame of more than
    so many `triangles` is skipped.
    """

    seconds: Annotated[float, Within(0.0, 1e5)] = 2.0
    interval: Annotated[float, SHARE] = 0.02
    rounds: Annotated[int, Within(1, 1e6)] = 8
    repetitions: Annotated[int, Within(1, 1e6)] = 200
    timeout: Annotated[float, Within(1e-3, 1e6)] = 60.0
    triangles: Annotated[int, Within(1, 1e12)] = 1_000_000_000


@dataclass(frozen=True)
class ToleranceChoice:
    """How much worse a gated figure may get: `absolute` + `relative` × the baseline.

    `better` is "lower" or "higher" where it is not as usual. `gated` = false leaves the figure alone.
    """

    absolute: Annotated[float, NOT_NEGATIVE] = 0.0
    relative: Annotated[float, NOT_NEGATIVE] = 0.0
    better: Annotated[str, OneOf(("", "lower", "higher"), "{value!r} is not lower or higher")] = ""
    gated: bool = True


@dataclass(frozen=True)
class GateChoice:
    """Figures with tolerances of their own, and the device facts that must be the `same` for rows to be compared.

    harness.results.figures has the tolerances of all other figures.
    """

    same: Annotated[list[str], Known(_facts), Distinct()] = field(default_factory=lambda: list(FACTS))
    figures: Annotated[dict[str, ToleranceChoice], Known(_figures)] = field(default_factory=dict)


@dataclass(frozen=True)
class Config:
    """An experiment: methods × prepass × origins × surfaces × views × sizes × samples × stages × precisions × devices,
    and, untimed, methods × families of hard rays × precisions × devices. `surfaces` and `families` may be ["all"].

    `view` holds the views that are named one by one, and, once names are resolved, those of `angles` and `directions`;
    without any, one default view. A `scene` is drawn by stage raster, from its own view.
    `baseline` is the method, or the variant by its label, that reports give speed-ups over.
    `studies` are computations of harness.studies. With `include`, a list of config files, it holds nothing else:
    each of them is run into its own folder, and one report collects them.
    """

    title: str
    include: Annotated[list[str], Distinct(_paths)] = field(default_factory=list)
    baseline: str = BASELINE
    studies: Annotated[list[str], Known(_studies), Distinct()] = field(default_factory=list)
    method: list[MethodChoice] = field(default_factory=list)
    surfaces: Annotated[list[str], Distinct()] = field(default_factory=list)
    families: Annotated[list[str], Known(_families, or_all=True), Distinct()] = field(default_factory=list)
    view: Annotated[list[View], Distinct(_names)] = field(default_factory=list)
    angles: Annotated[AngleChoice | None, Distinct(_angles)] = None
    directions: DirectionChoice | None = None
    sizes: Annotated[list[Annotated[int, Within(1, 16384)]], Distinct()] = field(default_factory=lambda: [256])
    samples_per_pixel: Annotated[list[int], OneOf((1, 4, 9, 16)), Distinct()] = field(default_factory=lambda: [1])
    precisions: Annotated[list[Precision], Distinct()] = field(default_factory=lambda: ["float32"])
    stages: Annotated[list[Stage], Distinct()] = field(default_factory=lambda: ["compute"])
    prepass: Annotated[list[Prepass], Distinct()] = field(default_factory=lambda: ["none"])
    origins: Annotated[list[Origin], Distinct()] = field(default_factory=lambda: ["nearest"])  # beams have none
    proxies: Annotated[list[Proxy], Distinct()] = field(default_factory=lambda: ["box"])  # of stage raster
    tolerances: Annotated[list[Annotated[float, Within(0.0, 1e3)]], Distinct()] = field(default_factory=lambda: [0.0])
    normals: Annotated[list[Normal], Distinct()] = field(default_factory=lambda: ["distance"])  # of stage raster
    devices: Annotated[list[str], Distinct()] = field(default_factory=lambda: ["all"])
    seed: Annotated[int, SEED] = 1
    accuracy: AccuracyChoice = field(default_factory=AccuracyChoice)
    budget: BudgetChoice = field(default_factory=BudgetChoice)
    surface: dict[str, SurfaceChoice] = field(default_factory=dict)
    scene: dict[str, SceneChoice] = field(default_factory=dict)
    gate: GateChoice = field(default_factory=GateChoice)


@dataclass(frozen=True)
class Experiment:
    """A config with every name in it resolved. One that includes others has nothing but `included`."""

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
    own_stages: Mapping[Variant, tuple[Stage, ...]] = field(default_factory=dict)  # where they are not `stages`

    def stages_of(self, variant: Variant) -> tuple[Stage, ...]:
        """Return the stages that a variant is cast in."""
        return self.own_stages.get(variant, self.stages)
