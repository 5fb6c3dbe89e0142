"""State what `firsthit list` and `firsthit devices` answer with --json."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

from harness.contract import Box, Casts, DeviceInfo, Domain, Precision

Point = tuple[float, float, float]


@dataclass(frozen=True)
class DomainFacts:
    """Say where a surface is looked at; lengths are in scene units.

    shape: sphere or box
    center: the middle
    radius: of the sphere, or of the sphere about the box
    lower, upper: two corners of the box, or of the box about the sphere
    """

    shape: Literal["sphere", "box"]
    center: Point
    radius: float
    lower: Point
    upper: Point


def domain_facts(domain: Domain) -> DomainFacts:
    """Return what is said of a domain."""
    x, y, z = domain.center
    radius = domain.radius
    if isinstance(domain, Box):
        return DomainFacts("box", (x, y, z), radius, domain.lower, domain.upper)
    lower, upper = ((x - radius, y - radius, z - radius), (x + radius, y + radius, z + radius))
    return DomainFacts("sphere", (x, y, z), radius, lower, upper)


@dataclass(frozen=True)
class SurfaceFacts:
    """Say what a surface is.

    name: what `--surface` and configs call it
    group: its group, a key of `groups` beside `surfaces`
    form_of: the surface that this is another form of, with the same values; null for the form of the source
    title: for people
    source: where it is published
    formula: f(x, y, z), in the formula language
    degree: total degree in x, y, z; null where f is not a polynomial
    domain: where it is looked at
    parameters: values of the formula's names, as exact decimals
    operations: of f, as it is written, by their kinds
    distance: a formula of a distance bound; null where none is known
    bounding_radius: of a sphere about the domain's centre that holds the surface; null where none is known
    feature_radius: the length to which papers relate errors; null where there is none
    facts: what the tests recompute, by name, such as singular_points and symmetries
    """

    name: str
    group: str
    form_of: str | None
    title: str
    source: str
    formula: str
    degree: int | None
    domain: DomainFacts
    parameters: Mapping[str, str]
    operations: Mapping[str, int]
    distance: str | None
    bounding_radius: float | None
    feature_radius: float | None
    facts: Mapping[str, Any]


@dataclass(frozen=True)
class KnobFacts:
    """Say what a method's knob is.

    name: in capitals
    whole: whether its values are whole numbers
    default: its value where none is given
    meaning: one phrase with its unit
    finer: the way to turn it that makes the error smaller; null where neither does
    sweep: further values that `firsthit recommend` tries
    per: the length that a tolerance is a share of; null where it is no such share
    printed: the value that the method's source prints, where the default is another; else null
    """

    name: str
    whole: bool
    default: float
    meaning: str
    finer: Literal["up", "down"] | None
    sweep: Sequence[float]
    per: str | None
    printed: float | None


@dataclass(frozen=True)
class MethodFacts:
    """Say what a method is.

    name: what `--method` and configs call it
    source: the paper or book that publishes it
    folder: where its method.py and kernel.glsl are
    casts: what its kernel casts
    rest: of a method that casts tiles, the method whose kernel casts the rays that no tile decides; else an empty text
    answers: false for a method that finds nothing and measures what the harness itself costs
    precisions: of the numbers that it can compute with
    knobs: its parameters
    settings: the papers' own settings: values of knobs by the setting's name
    claims: what it claims, each a key of `claims` beside `methods`
    needs: generated functions that its kernel calls
    libraries: files of harness/kernels/glsl/lib that its kernel includes
    refuses: surfaces of `firsthit list surfaces` that it cannot be used on, with its reason
    """

    name: str
    source: str
    folder: str
    casts: Casts
    rest: str
    answers: bool
    precisions: Sequence[Precision]
    knobs: Sequence[KnobFacts]
    settings: Mapping[str, Mapping[str, float]]
    claims: Sequence[str]
    needs: Sequence[str]
    libraries: Sequence[str]
    refuses: Mapping[str, str]


@dataclass(frozen=True)
class ConfigFacts:
    """Name a config that firsthit ships.

    name: what commands call it
    title: for people
    path: its file
    """

    name: str
    title: str
    path: str


@dataclass(frozen=True)
class ProbeFacts:
    """Say what was found of a device by trying; shares are of random pairs of float32 numbers.

    two_sum: the share on which two_sum is exact
    two_prod_split: the share on which two_prod by Dekker's splitting is exact
    two_prod_fma: the share on which a * b and fma(a, b, -a * b) add up to the product
    round_to_nearest: the share of sums and products that are rounded to nearest
    division: the share of quotients that are rounded to nearest
    peak_gflops: the best rate of multiply-adds, two operations each, in 10^9 operations a second
    peak_median_gflops: the rate of the median launch of the same program
    peak_shape: that program, in words
    clock_ratio: the device's clock over the host's, the median over the launches that measured the peak; null where the
        device has none
    """

    two_sum: float
    two_prod_split: float
    two_prod_fma: float
    round_to_nearest: float
    division: float
    peak_gflops: float
    peak_median_gflops: float
    peak_shape: str
    clock_ratio: float | None


@dataclass(frozen=True)
class DeviceFacts:
    """Say what a device is, as its driver names it.

    name: what `--device` and configs call it
    title: the hardware's own name
    driver, compiler: the name that the driver, and the compiler, gives itself
    compute_units: how many; null where the driver does not say
    float64: whether it computes in float64
    clock: the one that is trusted there, the device's own or the host's; before its probes ran, what is assumed
    versions: of the Python packages that it is reached by
    problem: why it cannot run kernels; null where it can
    """

    name: str
    title: str
    driver: str
    compiler: str
    compute_units: int | None
    float64: bool
    clock: Literal["device", "wall"]
    versions: Mapping[str, str]
    problem: str | None


def device(info: DeviceInfo) -> DeviceFacts:
    """Return what is said of a device."""
    return DeviceFacts(
        info.name,
        info.title,
        info.driver,
        info.compiler,
        info.compute_units,
        info.float64,
        info.clock,
        dict(info.versions),
        info.problem,
    )


@dataclass(frozen=True)
class MeasuredDevice(DeviceFacts):
    """Say what a device is, and what its arithmetic and its clock are worth.

    probes: what was found by trying; null where it was not tried
    fingerprint: by float32, float64, raster and host, a hash of the bits of each part of its arithmetic; devices with
        equal fingerprints are taken to compute the same
    digests: one short hash for each of these
    alike: for each of these, the first device of the list that has the same digest, which may be this one
    """

    probes: ProbeFacts | None
    fingerprint: Mapping[str, Mapping[str, str]]
    digests: Mapping[str, str]
    alike: Mapping[str, str]


@dataclass(frozen=True)
class ListedSurfaces:
    """List what `--surface` takes.

    surfaces: each surface, followed by its other forms; group by group
    groups: what the surfaces of each group have in common
    """

    surfaces: Sequence[SurfaceFacts]
    groups: Mapping[str, str]


@dataclass(frozen=True)
class ListedMethods:
    """List what `--method` takes.

    methods: by their names
    claims: what each claim means
    broken: methods that cannot be loaded, with the reason
    """

    methods: Sequence[MethodFacts]
    claims: Mapping[str, str]
    broken: Mapping[str, str]


@dataclass(frozen=True)
class ListedConfigs:
    """List the configs that firsthit ships.

    configs: by their names
    """

    configs: Sequence[ConfigFacts]


@dataclass(frozen=True)
class ListedDevices:
    """List the devices of this machine, usable or not. Nothing is measured, and an earlier look may answer.

    devices: in the order in which `"any"` tries them
    """

    devices: Sequence[DeviceFacts]


@dataclass(frozen=True)
class Devices:
    """Say what the devices of this machine are worth. Exit code 3 where none is usable.

    devices: usable or not
    since: when the oldest of this was found, in UTC (ISO 8601); null where all of it is new
    """

    devices: Sequence[MeasuredDevice]
    since: str | None
