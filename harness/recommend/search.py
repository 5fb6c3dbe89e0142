"""Successive narrowing: all candidates are checked on one view, those within bounds on the next; only what is left is
timed, interleaved; the fastest are checked once more on views they were not chosen by."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

from harness.accuracy.judge import NAMES
from harness.contract import (
    PRECISIONS,
    CellStatus,
    DeviceInfo,
    FirsthitError,
    Precision,
    Surface,
    Variant,
    View,
    digest,
)
from harness.devices.executor import LocalExecutor
from harness.experiment import plan
from harness.experiment.config import AccuracyChoice, BudgetChoice, Config, Experiment, MethodChoice
from harness.plugins import Catalog
from harness.recommend.candidates import variants, views
from harness.results.store import Row
from harness.running import batch
from harness.running.environment import probed
from harness.running.trace import usable_device

Quantile = Literal["max", "p999", "p99"]
QUANTILES: tuple[Quantile, ...] = ("max", "p999", "p99")
HEADROOM = 2.0  # of the bound on the largest error: rays that were not sampled may be worse than those that were
CONTENDERS = 6  # timed on every view and checked on held-out ones
HOPELESS = 2.0  # times the fastest in a first, short timing of a small picture: not timed further
STEP_SECONDS = 60.0  # for one step of a candidate; then it falls
SMALL = 128  # pixels per side of that picture, at most


@dataclass(frozen=True)
class Wish:
    """What is asked for. `error`: the largest |t - t*| allowed, scene units; `fps`: frames per second, or 0.

    Raises FirsthitError for a number that is out of range, and for a quantile or precision that there is not.
    """

    surface: Surface
    error: float
    quantile: Quantile = "max"
    fps: float = 0.0
    size: int = 512  # pixels per side of what is timed
    precision: Precision | None = None  # None: float32, and float64 only where no float32 variant holds
    tuning_views: int = 5
    held_out_views: int = 3
    accuracy_size: int = 64
    seed: int = 1
    seconds: float = 1.0  # of timing for each contender and view

    def __post_init__(self) -> None:
        limits = (
            ("error", self.error, 0.0, 1e30),
            ("fps", self.fps, 0.0, 1e6),
            ("size", self.size, 1, 16384),
            ("views", self.tuning_views, 1, 1000),
            ("rays", self.accuracy_size, 4, 4096),
            ("seconds", self.seconds, 0.0, 1e5),
        )
        for name, value, low, high in limits:
            if not low <= value <= high:
                raise FirsthitError(f"{name} {value:g} is outside [{low:g}, {high:g}]")
        for name, given, known in (("quantile", self.quantile, QUANTILES), ("precision", self.precision, PRECISIONS)):
            if given is not None and given not in known:
                raise FirsthitError(f"unknown {name} {given!r}; there are: {', '.join(known)}")

    @property
    def target(self) -> float:
        """What the sampled rays must keep."""
        return self.error / HEADROOM if self.quantile == "max" else self.error


@dataclass(frozen=True)
class Fallen:
    variant: Variant
    precision: Precision
    why: str


@dataclass(frozen=True)
class Contender:
    """A variant within bounds on every view: `ms` a frame, the mean over the tuning views; the worst error of any."""

    variant: Variant
    precision: Precision
    ms: float
    error: float
    evaluations: float


@dataclass
class Recommendation:
    """The variants within bounds on `device`, the fastest first, or none where nothing holds; and why the others fell.

    `held_out` counts the rays that were judged on held-out views, `decided` and `undecided` the oracle's hits on all.
    """

    device: DeviceInfo
    contenders: list[Contender] = field(default_factory=list)
    fallen: list[Fallen] = field(default_factory=list)
    held_out: int = 0
    decided: int = 0
    undecided: int = 0


def recommend(
    wish: Wish, catalog: Catalog, device: str | None, runs: Path, tell: Callable[[str], None]
) -> Recommendation:
    """Search among all methods for the fastest variant that keeps the wish, on a device or the first usable one.

    Rows go below `runs`, where a later search finds them again; `tell` is called with a line as the search goes on.
    Raises FirsthitError where there is no such device.
    """
    folder = runs / f"recommend-{wish.surface.name}-{digest(wish.surface.identity)[:8]}"
    executor = LocalExecutor(STEP_SECONDS)
    try:
        info, _ = probed(executor, usable_device(device), folder / "probes")
        return Search(wish, catalog, info, executor, folder, tell).run()
    finally:
        executor.close()


class Search:
    """`tell(line)` is called as the search goes on."""

    def __init__(
        self,
        wish: Wish,
        catalog: Catalog,
        device: DeviceInfo,
        executor: LocalExecutor,
        folder: Path,
        tell: Callable[[str], None],
    ) -> None:
        self._wish, self._catalog, self._device = wish, catalog, device
        self._executor, self._folder, self._tell = executor, folder, tell
        sampled = views(wish.tuning_views + wish.held_out_views, wish.seed)
        self._truth: dict[str, tuple[int, int, int]] = {}  # judged rays, decided and undecided hits, by view
        self._tuning, self._held_out = sampled[: wish.tuning_views], sampled[wish.tuning_views :]

    def run(self) -> Recommendation:
        found = Recommendation(self._device)
        precisions: tuple[Precision, ...] = (self._wish.precision,) if self._wish.precision else ("float32", "float64")
        for precision in precisions:
            self._narrow(precision, found)
            if found.contenders:
                break
        return found

    def _narrow(self, precision: Precision, found: Recommendation) -> None:
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
        """Those within bounds on every view, one view after the other; `worst` error and evaluations are kept.

        A view whose every ray is proved to miss bounds no error; where all of them are such, nothing holds.
        """
        measured: set[Variant] = set()
        for view in on:
            if not alive:
                break
            self._tell(f"{precision}: {len(alive)} variants on view {view.name}{where}")
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
        """Why a row's variant falls, with figures; None where it holds."""
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
        """Milliseconds a frame of the fastest, the mean of its medians over the tuning views."""
        if not alive:
            return {}
        self._tell(f"{precision}: timing {len(alive)} variants shortly")
        small = min(SMALL, self._wish.size)
        short = self._medians(alive, precision, self._tuning[0], small, self._wish.seconds / 4.0)
        order = sorted(short, key=lambda variant: short[variant])
        for place, variant in enumerate(order):
            if short[variant] > HOPELESS * short[order[0]] or place >= CONTENDERS:
                times = short[variant] / short[order[0]]
                why = f"{times:.3g} times the time of {named(order[0])}, {short[variant]:.3g} ms at {small}x{small}"
                found.fallen.append(Fallen(variant, precision, why))
        chosen = [v for v in order[:CONTENDERS] if short[v] <= HOPELESS * short[order[0]]]
        self._tell(f"{precision}: timing {len(chosen)} variants on {len(self._tuning)} views")
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
        rows = self._rows(of, precision, view, size, seconds)
        return {variant: row["time"]["median_ms"] for variant, row in rows.items() if row["time"]}

    def _rows(
        self, of: list[Variant], precision: Precision, view: View, size: int, seconds: float | None = None
    ) -> dict[Variant, Row]:
        """Each variant's row on this view, run where it is not stored; timed where `seconds` are given."""
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
            accuracy=AccuracyChoice(size=wish.accuracy_size, max_wrong_share=0.0),
            budget=BudgetChoice(seconds=seconds or 0.0),
        )
        named = Experiment(
            self._folder.name, self._folder, "", config, tuple(of), (wish.surface,), (precision,), ("compute",)
        )
        planned = plan.plan(named, self._catalog, [self._device], timed=seconds is not None)
        rows = batch.rows_of(planned, named, self._catalog, self._folder, self._executor)
        return {p.cell.variant: rows[p.key] for p in planned}


def certified_error(accuracy: dict[str, Any], quantile: Quantile) -> float | None:
    """At least the quantile's |t - t*|, scene units: what was measured is up to the certified interval only. None where
    no hit was measured."""
    measured = accuracy["error"][quantile]
    return None if measured is None else float(measured + accuracy["certified_width"])


def named(variant: Variant) -> str:
    """The label, with the method where a paper's name for a setting does not tell it."""
    label = str(variant)
    return label if label.startswith(variant.method) else f"{variant.method} “{label}”"
