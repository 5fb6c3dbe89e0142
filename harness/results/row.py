"""Declare every leaf of a stored row, cells/<key>.json: its place, type and meaning, and its column in a report.

This is the one declaration of a row. What writes a row is typed by it, harness/results/schema.py makes the columns of
reports from it, and docs/columns.md is printed from it. A new leaf is a new line here; tests/test_row.py then fails
until a cell writes it.

Leaves stand in the order of the columns. A leaf that is NotRequired is absent from rows it has no meaning for, and its
column is empty there. Lengths are in scene units, the surface's own coordinates, unless a leaf says otherwise; a clear
ray is one that is neither grazing nor drowned (harness/accuracy/judge.py).
"""

# Without `from __future__ import annotations`: on texts TypedDict does not see which leaves are NotRequired.

from dataclasses import dataclass
from typing import Annotated, Any, NotRequired, TypedDict

from harness.contract import Casts, CellStatus, Normal, Origin, Precision, Prepass, Proxy, Stage
from harness.limits import OneOf
from harness.results.declared import NOT_NEGATIVE, POSITIVE, SHARE

SAME_NAME = "the same name"
Times = list[Annotated[float, POSITIVE]]


@dataclass(frozen=True)
class Leaf:
    """State the meaning of a value, with what a text alone cannot state.

    `column` is its column's name, None where it has none. `always`: rows of every version have it, so that a row
    without it is damaged; any other leaf may be missing from a row that an older version wrote.
    """

    meaning: str
    column: str | None = SAME_NAME
    always: bool = False


@dataclass(frozen=True)
class Part:
    """State the meaning of an object. The columns of its leaves begin with `prefix`; `always` is a Leaf's."""

    meaning: str
    prefix: str
    always: bool = False


class Camera(TypedDict):
    """Hold the place from which a view is seen."""

    azimuth: Annotated[float, "degrees around the z axis"]
    elevation: Annotated[float, "degrees above the plane z = 0"]
    fov: Annotated[float, "full vertical angle of view, degrees"]
    distance: Annotated[float, "from the eye to the target, scene units"]


class Time(TypedDict):
    """Hold the timed repetitions of a cell, and what they say together."""

    clock: Annotated[str, "whose clock the times are by: device or wall, the host's"]
    median_ms: Annotated[float, Leaf("median of samples_ms: the time of one frame, ms", always=True), POSITIVE]
    lower_ms: Annotated[
        float, Leaf("lower end of the median's 95 % order-statistic interval, ms", always=True), POSITIVE
    ]
    upper_ms: Annotated[
        float, Leaf("upper end of the median's 95 % order-statistic interval, ms", always=True), POSITIVE
    ]
    overhead_share: Annotated[
        float | None,
        "what the host's clock tells beyond the device's, over the latter; null by the host's clock",
        NOT_NEGATIVE,
    ]
    bootstrap_lower_ms: Annotated[float, "lower end of the median's 95 % bootstrap interval, ms", POSITIVE]
    bootstrap_upper_ms: Annotated[float, "upper end of the median's 95 % bootstrap interval, ms", POSITIVE]
    drift_share: Annotated[float | None, "median of the second half of the samples over the first's, less 1"]
    drift_chance: Annotated[float | None, "how often chance alone parts the halves so (rank-sum test)", SHARE]
    spread_share: Annotated[float | None, "range of the middle half of the samples, over their median", NOT_NEGATIVE]
    outliers: Annotated[int, "samples more than 3 quartile ranges outside the quartiles; they are kept"]
    warnings: Annotated[list[str], "what is unsteady about the samples and what to do, a sentence each"]
    narrow: Annotated[bool, "whether the median's interval came within [budget] interval of it"]
    batch: Annotated[int, "frames drawn in a row for one sample, which is their mean"]
    samples_ms: Annotated[Times, Leaf("the time of one frame, each time it was taken, in that order, ms", always=True)]
    wall_samples_ms: Annotated[Times, Leaf("the same by the host's clock, ms", column=None)]
    rounds: Annotated[list[int], "the round in which each sample was taken; rounds of one session pair"]
    session: Annotated[str, "names the interleaved run in which the cell was timed"]
    sittings: Annotated[
        list[int],
        Leaf(
            "how many samples were taken until the run was stopped, and each time it was taken up again; one number "
            "where nothing stopped it",
            column=None,
        ),
    ]


class Build(TypedDict):
    """Hold what preparing a cell cost, apart from running it."""

    compile_ms: Annotated[
        float, "time to compile the timed frame, or the checked programs where none is timed, ms", NOT_NEGATIVE
    ]
    upload_ms: Annotated[
        float | None, "time to upload what the frame reads, ms; null where none is timed", NOT_NEGATIVE
    ]
    readback_ms: Annotated[
        float | None, "time to read the frame's answers back once, ms; null where none is timed", NOT_NEGATIVE
    ]
    bytes: Annotated[int | None, "bytes that the vertices and instances of a rasterised frame take on the device"]


class Quantiles(TypedDict):
    """Hold quantiles of a row's rays; each is null where no ray has a value."""

    max: Annotated[float | None, Leaf("the largest", always=True), NOT_NEGATIVE]
    p999: Annotated[float | None, Leaf("the 99.9th percentile", always=True), NOT_NEGATIVE]
    p99: Annotated[float | None, Leaf("the 99th percentile", always=True), NOT_NEGATIVE]
    p50: Annotated[float | None, Leaf("the median", always=True), NOT_NEGATIVE]


class Lane(TypedDict):
    """Hold what the work items of one level of beams spend, and how long their lanes wait."""

    level: Annotated[int, Leaf("of the quadtree; 0 is the whole picture", always=True)]
    items: Annotated[int, Leaf("work items of the level", always=True)]
    evaluations: Annotated[int, Leaf("evaluations of f that they spend together", always=True)]
    idle: Annotated[
        dict[str, Annotated[float, SHARE]],
        Leaf("by the width of a group of lanes: the share of its time for which lanes wait for others", always=True),
    ]


KINDS = ("misses", "false_hits", "exhausted", "wrong_root", "invalid")  # of wrong answers; older rows lack the last


class Accuracy(TypedDict):
    """Hold the accuracy of the answers of a cell that is cast from a view."""

    size: Annotated[int, Leaf("rays per side of the checked grid", column="accuracy_size", always=True)]
    rays: Annotated[int, Leaf("rays checked", column="accuracy_rays", always=True)]
    domain_rays: Annotated[int, "of these, rays that meet the domain"]
    fragments: NotRequired[Annotated[int, "fragments of the timed frame; of stage raster"]]
    fragments_discarded: NotRequired[Annotated[int, "of these, fragments that hit nothing"]]
    pixels_drawn: NotRequired[Annotated[int, "pixels of the timed frame that show something; of stage raster"]]
    other_instance: NotRequired[Annotated[int, "clear rays of a scene that show another instance than is first"]]
    truth_hits: Annotated[int, Leaf("rays that certainly hit", always=True)]
    truth_misses: Annotated[int, Leaf("rays that certainly miss", always=True)]
    undecided: Annotated[int, Leaf("rays that the oracle leaves undecided", always=True)]
    grazing: Annotated[int, Leaf("rays that a shift under grazing_margin would give another answer", always=True)]
    drowned: Annotated[int, "other rays on which rounding in the cell's precision can hide or feign a root"]
    judged: Annotated[int, "rays that are decided and clear: what shares of wrong rays are of"]
    grazing_margin: Annotated[float, "the shift that makes a ray grazing, over scene_radius", NOT_NEGATIVE]
    scene_radius: Annotated[
        float, Leaf("the radius of what is seen, which errors are told over", always=True), POSITIVE
    ]
    domain_radius: Annotated[float, "the radius of the surface's domain", POSITIVE]
    certified_width: Annotated[
        float,
        Leaf("the widest certified interval of a right hit; errors smaller than it may show as 0", column=None),
        NOT_NEGATIVE,
    ]
    misses: Annotated[int, Leaf("clear rays whose hit was missed", always=True)]
    false_hits: Annotated[int, Leaf("clear rays that hit nothing and were answered by a hit", always=True)]
    exhausted: Annotated[int, Leaf("clear rays that the method gave up", always=True)]
    wrong_root: Annotated[
        int, Leaf("clear rays that were answered by a later root, or by a place that is no root", always=True)
    ]
    invalid: Annotated[int, "clear rays whose answer is impossible, whatever the truth"]
    grazing_misses: Annotated[int, Leaf("grazing rays whose hit was missed", always=True)]
    grazing_false_hits: Annotated[int, Leaf("grazing rays that hit nothing and were answered by a hit", always=True)]
    grazing_exhausted: Annotated[int, Leaf("grazing rays that the method gave up", always=True)]
    grazing_wrong_root: Annotated[
        int, Leaf("grazing rays that were answered by a later root, or by no root", always=True)
    ]
    grazing_invalid: Annotated[int, "grazing rays whose answer is impossible"]
    drowned_misses: Annotated[int, "drowned rays whose hit was missed"]
    drowned_false_hits: Annotated[int, "drowned rays that hit nothing and were answered by a hit"]
    drowned_exhausted: Annotated[int, "drowned rays that the method gave up"]
    drowned_wrong_root: Annotated[int, "drowned rays that were answered by a later root, or by no root"]
    drowned_invalid: Annotated[int, "drowned rays whose answer is impossible"]
    error: Annotated[
        Quantiles, Part("the errors |t − t*| of clear rays that hit the right root", "error_", always=True)
    ]
    relative_error: Annotated[Quantiles, Part("the errors over scene_radius", "relative_error_", always=True)]
    feature_error: Annotated[
        Quantiles, Part("the errors over the feature radius, a torus's r, else over scene_radius", "feature_error_")
    ]
    pixel_error: Annotated[Quantiles, Part("the errors over a pixel's height at the hit", "pixel_error_")]
    ulp_error: Annotated[Quantiles, Part("the errors in units in the last place of t", "ulp_error_")]
    condition_ratio: Annotated[
        Quantiles,
        Part("the errors over max(condition, 1) × unit roundoff × domain_radius, which is allowed", "condition_ratio_"),
    ]
    normal_error_degrees: Annotated[
        Quantiles, Part("the angles between the normals at the hit and at the root, degrees", "normal_error_degrees_")
    ]
    residual: Annotated[
        Quantiles, Part("the ratios of |f| at the hit to the sum of |terms of f| at the root", "residual_")
    ]
    beam_only: NotRequired[Annotated[int, "rays whose beam sees a surface that the ray passes by; of beams"]]
    evaluations_mean: Annotated[float | None, "evaluations of f for a ray that was answered, in the mean", NOT_NEGATIVE]
    evaluations_max: Annotated[float, "evaluations of f for the ray that took most", NOT_NEGATIVE]
    prepass_evaluations_mean: NotRequired[
        Annotated[float, "of evaluations_mean, those that the prepass spent; behind a prepass", NOT_NEGATIVE]
    ]
    stages: NotRequired[
        Annotated[
            dict[str, Annotated[float, SHARE]],
            "of tiles: the share of the checked frame's pixels that each stage answers, by its name",
        ]
    ]
    lanes: NotRequired[
        Annotated[list[Lane] | None, "of beams: what the work items of each level spend, and how long they wait"]
    ]


class RungVerdict(TypedDict):
    """Hold the counts and errors of one rung of a family of hard rays; rays = decided + undecidable + undecided."""

    parameter: Annotated[float, Leaf("the family's parameter, which makes the rays harder", always=True)]
    rays: Annotated[int, Leaf("rays of the rung", always=True)]
    decided: Annotated[int, Leaf("rays that are judged", always=True)]
    right: Annotated[int, Leaf("decided rays that were answered rightly", always=True)]
    misses: Annotated[int, Leaf("decided rays whose hit was missed", always=True)]
    false_hits: Annotated[int, Leaf("decided rays that hit nothing and were answered by a hit", always=True)]
    exhausted: Annotated[int, Leaf("decided rays that the method gave up", always=True)]
    wrong_root: Annotated[int, Leaf("decided rays that were answered by a later root, or by no root", always=True)]
    invalid: Annotated[int, "decided rays whose answer is impossible, whatever the truth"]
    undecidable: Annotated[int, Leaf("rays that no arithmetic of the precision can decide", always=True)]
    undecidable_right: Annotated[int, Leaf("of these, rays answered as the oracle does", always=True)]
    undecided: Annotated[int, Leaf("rays that the oracle leaves undecided", always=True)]
    max_error: Annotated[float | None, "the largest |t − t*| of right hits, scene units", NOT_NEGATIVE]
    worst_ratio: Annotated[
        float | None, "the largest |t − t*| over what the problem allows, of right hits", NOT_NEGATIVE
    ]


class NamedProgram(TypedDict):
    """Name the program of a cell."""

    hash: Annotated[
        str,
        Leaf(
            "names the text of the timed program, or of the checked one where none is timed",
            column="program_hash",
            always=True,
        ),
    ]


class Environment(TypedDict):
    """State when and where a row was made, and by which version of the project."""

    started: Annotated[str, Leaf("when the row was written, ISO 8601", always=True)]
    commit: Annotated[str | None, "the project's commit; null without git"]
    dirty: Annotated[bool, Leaf("whether files that git knows were changed since", column=None)]
    machine: Annotated[str | None, "the name of the machine; null where nobody said it"]


class CellRow(TypedDict):
    """Hold what a cell left behind, as the runner builds it."""

    key: Annotated[str, Leaf("names the cell and all that decides its result; its file's name", always=True)]
    slot: Annotated[str, Leaf("the cell's place in the experiment, for people", always=True)]
    comparison: Annotated[str, Leaf("rows that share it are compared with each other", always=True)]
    method: Annotated[str, Leaf("the method's name", always=True)]
    variant: Annotated[str, Leaf("the method with the knobs and whatever else sets its rows apart", always=True)]
    parameters: Annotated[dict[str, float], "every knob of the method, by name"]
    surface: Annotated[str, Leaf("the surface's name; where the cell draws a scene, the scene's name", always=True)]
    surface_title: Annotated[str, Leaf("the surface's title", always=True)]
    surface_group: Annotated[
        str | None, "catalog, or its group of the gallery; null of a scene and of formulas of one's own"
    ]
    formula: Annotated[str, "f, whose zeros are the surface"]
    degree: Annotated[int | None, "of f in x, y, z together; null where f is no polynomial"]
    domain: Annotated[str | None, "the surface's domain, as configs write it; null of a scene and of a family"]
    extent: Annotated[
        str | None, "a sentence where the domain cuts the surface, or has nothing of it; null where it does not"
    ]
    view: Annotated[str, Leaf("the view's name", always=True)]
    view_set: Annotated[str | None, "the set of views that are compared with each other; null without one"]
    camera: Annotated[Camera | None, "where the view is from; null of a family"]
    size: Annotated[int, Leaf("pixels per side of the frame", always=True)]
    samples_per_pixel: Annotated[int, Leaf("rays per pixel of the frame", always=True)]
    precision: Annotated[Precision, Leaf("float32 or float64, of the kernel", always=True)]
    stage: Annotated[Stage, Leaf("where rays are cast from: compute, rays (listed ones) or raster", always=True)]
    device: Annotated[str, Leaf("the device's name", always=True)]
    status: Annotated[
        str, Leaf("how the cell ended: ok, skipped, failed, timeout or crashed", always=True), OneOf(tuple(CellStatus))
    ]
    reason: Annotated[str | None, "why it did not end well; null where it did"]
    answers: Annotated[bool, Leaf("false of a method that measures the harness and finds nothing", always=True)]
    casts: Annotated[Casts, "what the method casts: rays, beams, quadtree, tiles or mesh"]
    prepass: Annotated[Prepass, "what narrows the rays before the method: none or beams"]
    proxy: Annotated[Proxy | None, "the geometry whose fragments cast rays; of stage raster, else null"]
    normal: Annotated[Normal | None, "what hits are shaded by; of stage raster, else null"]
    scene: Annotated[str | None, "what a scene of several instances is; null of one surface"]
    origin: Annotated[Origin | None, "where a method sees its rays begin; null of beams, tiles and triangles"]
    pixel_tolerance: Annotated[
        float | None, "pixels that the method's own tolerance may grow to; of stage raster, else null"
    ]
    instances: Annotated[int | None, "of the scene; null of one surface"]
    time: Annotated[Time | None, "timed repetitions; null where none was timed to the end"]
    build: Annotated[Build | None, "what it took to be ready; null where nothing was tried"]
    accuracy: Annotated[Accuracy | None, "the checked rays; null where there is nothing to judge, and of a family"]
    family: Annotated[str | None, Leaf("the family of hard rays; null of a view", column=None)]
    rungs: Annotated[
        list[RungVerdict] | None,
        Leaf("of a family, its rungs going harder; null of a view and where there is no result", column=None),
    ]
    arrays: Annotated[str | None, "the file with the answers ray by ray, below the run's folder"]
    operations: Annotated[dict[str, int] | None, "operations of one evaluation of f, by name"]
    evaluation_operations: Annotated[
        int | None,
        "operations of one evaluation of what the method evaluates; null where it evaluates nothing, or counts"
        " evaluations alike that cost more and less",
    ]
    program: Annotated[NamedProgram | None, "null where there is none, since the cell was skipped"]
    environment: Annotated[Environment, "when and from what the row was made"]
    seconds: Annotated[float, Leaf("spent on checking, building and timing, s", column=None), NOT_NEGATIVE]
    identity: Annotated[dict[str, Any], "all that decides the row, which its key is the hash of"]


class StoredRow(CellRow):
    """Hold a row as its file does: with the version of this declaration."""

    format: Annotated[int, Leaf("the version of this declaration that the row was written by", column=None)]
