"""Define what a search for the fastest variant is asked, and what it finds."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Literal

from harness.contract import (
    CLAIMS,
    DeviceInfo,
    FirsthitError,
    Precision,
    Surface,
    Variant,
    suggestion,
)
from harness.limits import PIXELS, RAYS, SEED, Within, hold
from harness.results.store import Row

Quantile = Literal["max", "p999", "p99"]
QUANTILES: tuple[Quantile, ...] = ("max", "p999", "p99")
HEADROOM = 2.0  # of the bound on the largest error: rays that were not sampled may be worse than those that were
ERROR = Within(1e-30, 1e30)  # scene units; no variant keeps an error of 0
FPS = Within(0.0, 1e6)
VIEWS = Within(1, 1000)
SECONDS = Within(1e-3, 1e5)  # of timing, which a search cannot do without


@dataclass(frozen=True)
class Wish:
    """Says what is asked for.

    error: the largest |t - t*| allowed, scene units
    quantile: of which errors `error` is the bound
    fps: frames per second at least; 0 for any
    size: pixels per side of the frames that are timed
    precision: None for float32, and float64 only where no float32 variant holds
    views: how many views variants are chosen by; on half as many others, two at least, the chosen are checked
    rays: per side of those that are checked on each view
    seed: of the views
    seconds: of timing for each contender and view
    require: claims that a method must make: names of harness.contract.CLAIMS

    Raises FirsthitError for a value that is no number or outside its limits, and for an unknown quantile, precision or
    claim.
    """

    surface: Surface
    error: Annotated[float, ERROR]
    quantile: Quantile = "max"
    fps: Annotated[float, FPS] = 0.0
    size: Annotated[int, PIXELS] = 512
    precision: Precision | None = None
    views: Annotated[int, VIEWS] = 5
    rays: Annotated[int, RAYS] = 64
    seed: Annotated[int, SEED] = 1
    seconds: Annotated[float, SECONDS] = 1.0
    require: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        hold(self)
        for claim in self.require:
            if claim not in CLAIMS:
                raise FirsthitError(f"there is no claim {claim!r}; {suggestion(claim, sorted(CLAIMS))}")

    @property
    def held_out_views(self) -> int:
        """Return how many views the chosen variants are checked on, by which they were not chosen."""
        return max(2, self.views // 2)

    @property
    def target(self) -> float:
        """Return the error, scene units, that the sampled rays must keep."""
        return self.error / HEADROOM if self.quantile == "max" else self.error


class Cause(StrEnum):
    """Name why a variant fell, in the order in which a search finds it.

    CLAIM: a claim that is asked for is not made, or is disproved here
    REFUSED: the method, the device or the language refuses the surface
    FAILED: a step failed, took too long or crashed
    WRONG: a ray outside the grazing and the drowned class is answered wrongly
    UNMEASURED: there is no certified hit to measure an error of
    ERROR: the error is over the one allowed
    SLOW: a first, short timing shows it far behind the fastest, or there are enough faster ones
    FRAMES: it keeps the error, but draws fewer frames a second than are asked for
    """

    CLAIM = "claim"
    REFUSED = "refused"
    FAILED = "failed"
    WRONG = "wrong"
    UNMEASURED = "unmeasured"
    ERROR = "error"
    SLOW = "slow"
    FRAMES = "frames"


@dataclass(frozen=True)
class Fallen:
    """Names a variant that was not chosen, and says why.

    why: a clause that continues a sentence which begins with the variant
    error: the largest certified error that was measured, scene units; None where none was
    times: its time over the fastest's in the same timing; None where it was not timed
    """

    variant: Variant
    precision: Precision
    cause: Cause
    why: str
    error: float | None = None
    times: float | None = None


@dataclass(frozen=True)
class Contender:
    """Describes a variant that is within bounds on every view.

    ms: the time of a frame, the mean over the tuning views
    error: the largest error on any view, scene units
    evaluations: the largest mean number of evaluations of f per ray on any view
    claims: what its method claims of its answers, sorted: names of harness.contract.CLAIMS
    disproved: those that a row of this search contradicts
    """

    variant: Variant
    precision: Precision
    ms: float
    error: float
    evaluations: float
    claims: tuple[str, ...] = ()
    disproved: tuple[str, ...] = ()


@dataclass
class Recommendation:
    """Holds what a search found on a device.

    contenders: the variants within bounds, the fastest first; none where no variant holds
    fallen: all others
    alike: the contenders whose times are not told apart from the first one's
    held_out: how many rays were judged on the held-out views
    decided, undecided: how many hits the oracle decided and left undecided, on all views
    extent: a sentence where the domain cuts the surface, so that another surface was searched for than may be meant
    folder: where the rows are
    picture: the row of the first contender on the view FRONT, where a picture was asked for and there is a contender
    """

    device: DeviceInfo
    contenders: list[Contender] = field(default_factory=list)
    fallen: list[Fallen] = field(default_factory=list)
    alike: list[Variant] = field(default_factory=list)
    held_out: int = 0
    decided: int = 0
    undecided: int = 0
    extent: str | None = None
    folder: Path | None = None
    picture: Row | None = None


def named(variant: Variant) -> str:
    """Return the variant's label, behind the method's name where the label does not begin with it."""
    label = str(variant)
    return label if label.startswith(variant.method) else f"{variant.method} “{label}”"
