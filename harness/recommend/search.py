"""Search for the fastest variant within an error, and narrow the candidates down step by step.

All candidates are checked on one view, and those within bounds on the next. Only what is left is timed, in interleaved
rounds. The fastest are checked once more on held-out views, by which they were not chosen.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Annotated, Literal

from harness.accuracy.judge import NAMES
from harness.contract import (
    CellStatus,
    DeviceInfo,
    Precision,
    Surface,
    Variant,
    View,
    digest,
)
from harness.devices.executor import LocalExecutor
from harness.experiment import plan
from harness.experiment.config import AccuracyChoice, BudgetChoice, Config, Experiment, MethodChoice
from harness.limits import PIXELS, RAYS, SECONDS, SEED, Within, hold
from harness.plugins import Catalog
from harness.recommend.candidates import variants, views
from harness.results.row import Accuracy
from harness.results.store import Row
from harness.running import batch
from harness.running.environment import probed
from harness.running.run import Watcher
from harness.running.trace import usable_device

Quantile = Literal["max", "p999", "p99"]
QUANTILES: tuple[Quantile, ...] = ("max", "p999", "p99")
HEADROOM = 2.0  # of the bound on the largest error: rays that were not sampled may be worse than those that were
CONTENDERS = 6  # timed on every view and checked on held-out ones
HOPELESS = 2.0  # times the fastest in a first, short timing of a small picture: not timed further
STEP_SECONDS = 60.0  # for one step of a candidate; then it falls
ERROR = Within(1e-30, 1e30)  # scene units; no variant keeps an error of 0
FPS = Within(0.0, 1e6)
VIEWS = Within(1, 1000)
SMALL = 128  # pixels per side of that picture, at most


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

    Raises FirsthitError for a value that is no number or outside its limits, and for an unknown quantile or precision.
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

    def __post_init__(self) -> None:
        hold(self)

    @property
    def held_out_views(self) -> int:
        """Return how many views the chosen variants are checked on, by which they were not chosen."""
        return max(2, self.views // 2)

    @property
    def target(self) -> float:
        """Return the error, scene units, that the sampled rays must keep."""
        return self.error / HEADROOM if self.quantile == "max" else self.error


@dataclass(frozen=True)
class Fallen:
    """Names a variant that was not chosen, and says why."""

    variant: Variant
    precision: Precision
    why: str


@dataclass(frozen=True)
class Contender:
    """Describes a variant that is within bounds on every view.

    ms: the time of a frame, the mean over the tuning views
    error: the largest error on any view, scene units
    evaluations: the largest mean number of evaluations of f per ray on any view
    """

    variant: Variant
    precision: Precision
    ms: float
    error: float
    evaluations: float


@dataclass
class Recommendation:
    """Holds what a search found on a device.

    contenders: the variants within bounds, the fastest first; none where no variant holds
    fallen: all others
    held_out: how many rays were judged on the held-out views
    decided, undecided: how many hits the oracle decided and left undecided, on all views
    extent: a sentence where the domain cuts the surface, so that another surface was searched for than may be meant
    """

    device: DeviceInfo
    contenders: list[Contender] = field(default_factory=list)
    fallen: list[Fallen] = field(default_factory=list)
    held_out: int = 0
    decided: int = 0
    undecided: int = 0
    extent: str | None = None


def recommend(wish: Wish, catalog: Catalog, device: str | None, runs: Path, watcher: Watcher) -> Recommendation:
    """Search among all methods for the fastest variant that keeps the wish, on a device or the first usable one.

    Rows go below `runs`, where a later search finds them again; `watcher` is told of each step and cell. Raises
    FirsthitError where `device` is no text and, with exit code 3, where there is no such device or a row cannot be
    stored.
    """
    from surfaces.extent import remark

    if told := remark(wish.surface):
        watcher.warned(told)
    folder = runs / f"recommend-{wish.surface.name}-{digest(wish.surface.identity)[:8]}"
    executor = LocalExecutor(STEP_SECONDS)
    try:
        info, _ = probed(executor, usable_device(device), folder / "probes")
        return replace(Search(wish, catalog, info, executor, folder, watcher).run(), extent=told)
    finally:
        executor.close()


class Search:
    """Searches on one device; `watcher` is told of each step and cell. Rows are stored in `folder`."""

    def __init__(
        self,
        wish: Wish,
        catalog: Catalog,
        device: DeviceInfo,
        executor: LocalExecutor,
        folder: Path,
        watcher: Watcher,
    ) -> None:
        self._wish, self._catalog, self._device = wish, catalog, device
        self._executor, self._folder, self._watcher = executor, folder, watcher
        sampled = views(wish.views + wish.held_out_views, wish.seed)
        self._truth: dict[str, tuple[int, int, int]] = {}  # judged rays, decided and undecided hits, by view
        self._tuning, self._held_out = sampled[: wish.views], sampled[wish.views :]

    def run(self) -> Recommendation:
        """Search in the wished precision or, without one, in float32 and then, where no variant holds, in float64."""
        found = Recommendation(self._device)
        precisions: tuple[Precision, ...] = (self._wish.precision,) if self._wish.precision else ("float32", "float64")
        for precision in precisions:
            self._narrow(precision, found)
            if found.contenders:
                break
        return found

    def _narrow(self, precision: Precision, found: Recommendation) -> None:
        """Search in one precision, and put into `found` what holds and what fell."""
        alive = list(variants(self._catalog))
        worst: dict[Variant, tuple[float, float]] = {}
        alive = self._check(alive, precision, self._tuning, found, worst, "")
        timed = self._race(alive, precision, found)
        kept = self._check(list(timed), precision, self._held_out, found, worst, " (held-out)")
        made = [Contender(variant, precision, timed[variant], *worst[variant]) for variant in kept]
        found.contenders = sorted(made, key=lambda c: c.ms)
        found.held_out = sum(self._truth[view.name][0] for view in self._held_out) if kept else 0
        found.decided, found.undecided = (sum(counts[k] for counts in self._truth.values()) for k in (1, 2))

    def _check(
        self,
        alive: list[Variant],
        precision: Precision,
        on: Sequence[View],
        found: Recommendation,
        worst: dict[Variant, tuple[float, float]],
        where: str,
    ) -> list[Variant]:
        """Check variants on one view after the other, and return those within bounds on every view.

        `worst` is updated with the largest error and mean evaluations of each. A view on which the oracle proves that
        every ray misses bounds no error; a variant that was checked on such views only falls.
        """
        measured: set[Variant] = set()
        for view in on:
            if not alive:
                break
            self._watcher.told(f"{precision}: {len(alive)} variants on view {view.name}{where}")
            rows = self._rows(alive, precision, view, self._wish.size)
            for variant in list(alive):
                row = rows[variant]
                if reason := self._reason(row):
                    found.fallen.append(Fallen(variant, precision, reason + where))
                    alive.remove(variant)
                    continue
                accuracy = row["accuracy"]
                self._truth[view.name] = accuracy["judged"], accuracy["truth_hits"], accuracy["undecided"]
                error, evaluations = worst.get(variant, (0.0, 0.0))
                now = certified_error(accuracy, self._wish.quantile)
                if now is not None:
                    measured.add(variant)
                worst[variant] = max(error, now or 0.0), max(evaluations, accuracy["evaluations_mean"])
        nothing = f"no hit to measure an error of: the oracle decides none on a clear ray{where}"
        found.fallen += [Fallen(variant, precision, nothing) for variant in alive if variant not in measured]
        return [variant for variant in alive if variant in measured]

    def _reason(self, row: Row) -> str | None:
        """Say with figures why a row's variant falls; None where it holds."""
        if row["status"] != CellStatus.OK:
            return f"{row['status']}: {' '.join(str(row['reason']).split())}"
        accuracy = row["accuracy"]
        counts = {name: accuracy[name] for name in (*NAMES.values(), "grazing_invalid", "drowned_invalid")}
        if any(not count <= 0 for count in counts.values()):
            wrong = [f"{count} {name.replace('_', ' ')}" for name, count in counts.items() if count]
            return f"{', '.join(wrong)} of {accuracy['judged']} rays, view {row['view']}"
        error, wish = certified_error(accuracy, self._wish.quantile), self._wish
        if error is None or error <= wish.target:
            return None
        over = f"over {wish.error:.2g}" if error > wish.error else f"under {wish.error:.2g}, but over {wish.target:.2g}"
        return f"{wish.quantile} error {error:.2g}, {over}, view {row['view']}"

    def _race(self, alive: list[Variant], precision: Precision, found: Recommendation) -> dict[Variant, float]:
        """Time variants, and return those of the fastest that keep the wished frame rate, with their times.

        A time is in milliseconds for one frame, the mean over the tuning views of the median on each.
        """
        if not alive:
            return {}
        self._watcher.told(f"{precision}: timing {len(alive)} variants shortly")
        small = min(SMALL, self._wish.size)
        short = self._medians(alive, precision, self._tuning[0], small, self._wish.seconds / 4.0)
        order = sorted(short, key=lambda variant: short[variant])
        for place, variant in enumerate(order):
            if short[variant] > HOPELESS * short[order[0]] or place >= CONTENDERS:
                times = short[variant] / short[order[0]]
                why = f"{times:.3g} times the time of {named(order[0])}, {short[variant]:.3g} ms at {small}x{small}"
                found.fallen.append(Fallen(variant, precision, why))
        chosen = [v for v in order[:CONTENDERS] if short[v] <= HOPELESS * short[order[0]]]
        self._watcher.told(f"{precision}: timing {len(chosen)} variants on {len(self._tuning)} views")
        by_view = [self._medians(chosen, precision, view, self._wish.size, self._wish.seconds) for view in self._tuning]
        means = {v: sum(times[v] for times in by_view) / len(by_view) for v in chosen if all(v in t for t in by_view)}
        for variant, ms in list(means.items()):
            if self._wish.fps and 1e3 / ms < self._wish.fps:
                size = self._wish.size
                why = f"{1e3 / ms:.3g} frames/s at {size}x{size}, not {self._wish.fps:g}"
                found.fallen.append(Fallen(variant, precision, why))
                del means[variant]
        return means

    def _medians(
        self, of: list[Variant], precision: Precision, view: View, size: int, seconds: float
    ) -> dict[Variant, float]:
        """Return the median time of a frame in ms of each variant that could be timed on this view."""
        rows = self._rows(of, precision, view, size, seconds)
        return {variant: row["time"]["median_ms"] for variant, row in rows.items() if row["time"]}

    def _rows(
        self, of: list[Variant], precision: Precision, view: View, size: int, seconds: float | None = None
    ) -> dict[Variant, Row]:
        """Return each variant's row on this view, run where it is not stored; it is timed where `seconds` are given."""
        wish = self._wish
        config = Config(
            title=f"Recommendation for {wish.surface.title}",
            method=[MethodChoice(variant.method) for variant in of],
            surfaces=[wish.surface.name],
            view=[view],
            sizes=[size],
            precisions=[precision],
            devices=[self._device.name],
            seed=wish.seed,
            accuracy=AccuracyChoice(size=wish.rays, max_wrong_share=0.0),
            budget=BudgetChoice(seconds=seconds or 0.0),
        )
        named = Experiment(
            self._folder.name, self._folder, "", config, tuple(of), (wish.surface,), (precision,), ("compute",)
        )
        planned = plan.plan(named, self._catalog, [self._device], timed=seconds is not None)
        rows, _ = batch.rows_of(planned, named, self._catalog, self._folder, self._executor, self._watcher)
        return {p.cell.variant: rows[p.key] for p in planned}


def certified_error(accuracy: Accuracy, quantile: Quantile) -> float | None:
    """Return an upper bound of a quantile of |t - t*|, scene units; None where no hit was measured.

    Errors are measured to the certified interval that encloses t*, so that the largest interval's width is added.
    """
    measured = accuracy["error"][quantile]
    return None if measured is None else float(measured + accuracy["certified_width"])


def named(variant: Variant) -> str:
    """Return the variant's label, behind the method's name where the label does not begin with it."""
    label = str(variant)
    return label if label.startswith(variant.method) else f"{variant.method} “{label}”"
