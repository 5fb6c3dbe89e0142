"""Search for the fastest variant within an error, and narrow the candidates down step by step.

All candidates are checked on one view, and those within bounds on the next. Only what is left is timed, in interleaved
rounds. The fastest are checked once more on held-out views, by which they were not chosen.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from harness.accuracy.judge import NAMES
from harness.contract import CellStatus, DeviceInfo, FirsthitError, Precision, Variant, View, digest, plural
from harness.devices.executor import LocalExecutor
from harness.experiment import plan
from harness.experiment.config import AccuracyChoice, BudgetChoice, Config, Experiment, MethodChoice
from harness.experiment.size import asked
from harness.plugins import Catalog
from harness.recommend.candidates import count, variants, views
from harness.recommend.model import Cause, Contender, Fallen, Quantile, Recommendation, Wish, named
from harness.results import ranks
from harness.results.figures import disproved
from harness.results.lock import Lock
from harness.results.row import Accuracy
from harness.results.store import Row, Store
from harness.results.timings import Ratio, paired_ratio
from harness.running import batch
from harness.running.environment import probed
from harness.running.run import Watcher
from harness.running.trace import usable_device

LEVEL = 0.01  # the largest chance that is evidence of a difference of times, as in reports
CONTENDERS = 6  # timed on every view and checked on held-out ones
HOPELESS = 2.0  # times the fastest, as a first, short timing of a small picture proves: not timed further
STEP_SECONDS = 60.0  # for one step of a candidate; then it falls
SMALL = 128  # pixels per side of that picture, at most
FRONT = View("picture")  # of the picture of what is recommended
ENDED = {CellStatus.FAILED: "failed", CellStatus.TIMEOUT: "took too long", CellStatus.CRASHED: "crashed"}
PICTURE_RAYS = 192  # per side of that picture, each of them checked


def recommend(
    wish: Wish,
    catalog: Catalog,
    device: str | None,
    runs: Path,
    watcher: Watcher,
    pictured: bool = False,
    *,
    command: str,
    wait: bool = False,
    yes: bool = False,
) -> Recommendation:
    """Search among all methods for the fastest variant that keeps the wish, on a device or the first usable one.

    If `pictured`, the variant that is recommended is checked on one more view, FRONT, on PICTURE_RAYS² rays, whose
    answers are kept as a picture; one that does not hold there falls as well. Rows go below `runs`, where a later
    search finds them again; `watcher` is told of each step and cell. Where another process searches there, `wait` waits
    until it has ended; `command` tells others what is going on.

    Raises FirsthitError where `device` is no text, where there is more to check than is done without `yes`
    (harness.experiment.size) and, with exit code 3, where there is no such device, the folder is another's or a row
    cannot be stored.
    """
    from surfaces.proofs.extent import remark

    checks = count(catalog) * wish.views
    if told := asked(f"{checks:,} checks of variants on {wish.views:,} views", checks, yes):
        watcher.warned(told)

    if told := remark(wish.surface):
        watcher.warned(told)
    folder = runs / f"recommend-{wish.surface.name}-{digest(wish.surface.identity)[:8]}"
    executor = LocalExecutor(STEP_SECONDS)
    try:
        info, _ = probed(executor, usable_device(device), folder / "probes")
        if info.problem:
            raise FirsthitError(f"{info.name}: {info.problem}", exit_code=3)
        with Lock(folder, command, wait=wait, doing=watcher.doing) as lock:
            return replace(Search(wish, catalog, info, executor, lock, watcher).run(pictured), extent=told)
    finally:
        executor.close()


class Search:
    """Searches on one device; `watcher` is told of each step and cell. Rows are stored in the folder of `lock`."""

    def __init__(
        self,
        wish: Wish,
        catalog: Catalog,
        device: DeviceInfo,
        executor: LocalExecutor,
        lock: Lock,
        watcher: Watcher,
    ) -> None:
        self._wish, self._catalog, self._device = wish, catalog, device
        self._executor, self._folder, self._watcher, self._lock = executor, lock.folder, watcher, lock
        sampled = views(wish.views + wish.held_out_views, wish.seed)
        self._truth: dict[str, tuple[int, int, int]] = {}  # judged rays, decided and undecided hits, by view
        self._disproved: dict[Variant, set[str]] = {}  # claims that rows contradict
        self._times: list[dict[Variant, Mapping[str, Any]]] = []  # of the last race, by view
        self._tuning, self._held_out = sampled[: wish.views], sampled[wish.views :]

    def run(self, pictured: bool = False) -> Recommendation:
        """Search in the wished precision or, without one, in float32 and then, where no variant holds, in float64.

        `pictured` is as for `recommend`.
        """
        found = Recommendation(self._device, folder=self._folder)
        precisions: tuple[Precision, ...] = (self._wish.precision,) if self._wish.precision else ("float32", "float64")
        for precision in precisions:
            self._narrow(precision, found, pictured)
            if found.contenders:
                break
        return found

    def _narrow(self, precision: Precision, found: Recommendation, pictured: bool) -> None:
        """Search in one precision, and put into `found` what holds and what fell.

        Where none of the fastest variants holds on the views held out, the next fastest have their turn.
        """
        alive = self._claiming(list(variants(self._catalog)), precision, found)
        worst: dict[Variant, tuple[float, float]] = {}
        self._disproved.clear()
        methods = {variant.method for variant in alive}
        of, on = plural(len(methods), "method"), plural(len(self._tuning), "view")
        many = f"{plural(len(alive), 'variant')} of {of} on {on}"
        self._watcher.told(f"{precision}: step 1 of 3 checks {many}; one that is wrong or over the error falls")
        alive = self._check(alive, precision, self._tuning, found, worst)
        slow: list[Fallen] = []
        while alive and not found.contenders:
            timed, slow = self._race(alive, precision, found, worst)
            if not timed:
                break
            self._hold_out(timed, precision, found, worst)
            if pictured:
                self._draw(found)
            if not found.contenders:
                alive, slow = [fallen.variant for fallen in slow], []
        found.alike = [c.variant for c in found.contenders[1:] if self._alike(c.variant, found.contenders[0].variant)]
        found.fallen += slow
        found.decided, found.undecided = (sum(counts[k] for counts in self._truth.values()) for k in (1, 2))

    def _alike(self, variant: Variant, first: Variant) -> bool:
        """Tell whether the rounds of all views, which timed both in turns, do not tell that a variant is the slower."""
        ratios = []
        for times in self._times:
            ours, others = (
                dict(zip(times[v]["rounds"], times[v]["samples_ms"], strict=True)) for v in (variant, first)
            )
            ratios += [math.log(ours[at] / others[at]) for at in ours.keys() & others.keys()]
        return ranks.signed_rank(ratios) > LEVEL or float(np.median(ratios)) <= 0.0

    def _hold_out(
        self,
        timed: Mapping[Variant, float],
        precision: Precision,
        found: Recommendation,
        worst: dict[Variant, tuple[float, float]],
    ) -> None:
        """Check the variants that were timed on the views held out, and make contenders of those that hold."""
        held_out = f"{plural(len(timed), 'variant')} on {plural(len(self._held_out), 'view')} held out"
        self._watcher.told(f"{precision}: step 3 of 3 checks {held_out}")
        kept = self._check(list(timed), precision, self._held_out, found, worst)
        made = [self._contender(variant, precision, timed[variant], *worst[variant]) for variant in kept]
        found.contenders = sorted(made, key=lambda c: c.ms)
        found.held_out = sum(self._truth[view.name][0] for view in self._held_out) if kept else 0

    def _contender(
        self, variant: Variant, precision: Precision, ms: float, error: float, evaluations: float
    ) -> Contender:
        claims = tuple(sorted(self._catalog.get(variant.method).method.claims))
        broken = tuple(sorted(self._disproved.get(variant, ())))
        return Contender(variant, precision, ms, error, evaluations, claims, broken)

    def _claiming(self, of: list[Variant], precision: Precision, found: Recommendation) -> list[Variant]:
        """Return the variants whose methods make all claims that are asked for."""
        alive = []
        for variant in of:
            claims = self._catalog.get(variant.method).method.claims
            if lacking := [claim for claim in self._wish.require if claim not in claims]:
                why = f"does not claim {' or '.join(lacking)}"
                found.fallen.append(Fallen(variant, precision, Cause.CLAIM, why))
            else:
                alive.append(variant)
        return alive

    def _check(
        self,
        alive: list[Variant],
        precision: Precision,
        on: Sequence[View],
        found: Recommendation,
        worst: dict[Variant, tuple[float, float]],
    ) -> list[Variant]:
        """Check variants on one view after the other, and return those within bounds on every view.

        `worst` is updated with the largest error and mean evaluations of each. A view on which the oracle proves that
        every ray misses bounds no error; a variant that was checked on such views only falls.
        """
        measured: set[Variant] = set()
        for view in on:
            if not alive:
                break
            rows = self._rows(alive, precision, view, self._wish.size)
            for variant in list(alive):
                row = rows[variant]
                if reason := self._reason(variant, precision, row):
                    found.fallen.append(reason)
                    alive.remove(variant)
                    continue
                accuracy = row["accuracy"]
                self._truth[view.name] = accuracy["judged"], accuracy["truth_hits"], accuracy["undecided"]
                error, evaluations = worst.get(variant, (0.0, 0.0))
                now = certified_error(accuracy, self._wish.quantile)
                if now is not None:
                    measured.add(variant)
                worst[variant] = max(error, now or 0.0), max(evaluations, accuracy["evaluations_mean"])
        nothing = "has no hit to measure an error of: the oracle decides none on a clear ray"
        fell = [Fallen(variant, precision, Cause.UNMEASURED, nothing) for variant in alive if variant not in measured]
        found.fallen += fell
        return [variant for variant in alive if variant in measured]

    def _reason(self, variant: Variant, precision: Precision, row: Row) -> Fallen | None:
        """Say with figures why a row's variant falls; None where it holds."""
        if row["status"] != CellStatus.OK:
            told = " ".join(str(row["reason"]).split())
            if row["status"] == CellStatus.SKIPPED:
                return Fallen(variant, precision, Cause.REFUSED, f"cannot draw the surface here: {told}")
            return Fallen(variant, precision, Cause.FAILED, f"{ENDED[row['status']]}: {told}")
        accuracy, where = row["accuracy"], f"on view {row['view']}"
        counts = {name: accuracy[name] for name in (*NAMES.values(), "grazing_invalid", "drowned_invalid")}
        if any(not count <= 0 for count in counts.values()):
            wrong = ", ".join(f"{count} {name.replace('_', ' ')}" for name, count in counts.items() if count)
            why = f"answers rays wrongly {where}: {wrong} of {plural(accuracy['judged'], 'ray')}"
            return Fallen(variant, precision, Cause.WRONG, why)
        broken = {claim for claim in self._catalog.get(variant.method).method.claims if disproved(claim, row)}
        self._disproved.setdefault(variant, set()).update(broken)
        if asked := sorted(broken.intersection(self._wish.require)):
            why = f"claims {asked[0]}, which its answers {where} disprove"
            return Fallen(variant, precision, Cause.CLAIM, why)
        error, wish = certified_error(accuracy, self._wish.quantile), self._wish
        if error is None or error <= wish.target:
            return None
        over = f"over the {wish.error:.2g} asked for"
        if error <= wish.error:
            over = f"within the {wish.error:.2g} asked for, but over the {wish.target:.2g} that sampled rays must keep"
        why = f"has a {wish.quantile} error of {error:.2g} {where}, {over}"
        return Fallen(variant, precision, Cause.ERROR, why, error)

    def _draw(self, found: Recommendation) -> None:
        """Check the first contender on FRONT and keep its row as the picture; let it fall where it does not hold."""
        while found.contenders:
            best = found.contenders[0]
            self._watcher.told(f"{best.precision}: draws {named(best.variant)}, and checks every pixel of the picture")
            row = self._rows([best.variant], best.precision, FRONT, PICTURE_RAYS, rays=PICTURE_RAYS)[best.variant]
            if (fell := self._reason(best.variant, best.precision, row)) is None:
                error = certified_error(row["accuracy"], self._wish.quantile) or 0.0
                stated = best.variant, best.precision, best.ms, max(best.error, error), best.evaluations
                found.contenders[0] = self._contender(*stated)
                found.picture = Store(self._folder).read(row["key"])  # as stored, it names the file of its arrays
                return
            found.fallen.append(fell)
            del found.contenders[0]

    def _race(
        self,
        alive: list[Variant],
        precision: Precision,
        found: Recommendation,
        worst: Mapping[Variant, tuple[float, float]],
    ) -> tuple[dict[Variant, float], list[Fallen]]:
        """Time variants; return the fastest that keep the wished frame rate, with their times, and the slow ones.

        A time is in milliseconds for one frame, the mean over the tuning views of the median on each. `worst` has the
        largest error of each variant so far.
        """
        small = min(SMALL, self._wish.size)
        many = f"{plural(len(alive), 'variant')} shortly, at {small}x{small}"
        told = f"one that surely takes over {HOPELESS:g} times as long as the fastest falls"
        self._watcher.told(f"{precision}: step 2 of 3 times {many}; {told}")
        timed = self._timed(alive, precision, self._tuning[0], small, self._wish.seconds / 4.0, found)
        if not timed:
            return {}, []
        first, over = _over_fastest(timed)
        order = sorted(over, key=lambda variant: over[variant].median)
        chosen = [v for v in order if over[v].lower <= HOPELESS][:CONTENDERS]
        slow = []
        for variant in (v for v in order if v not in chosen):
            times, ms = over[variant].median, timed[variant]["median_ms"]
            told = f"{times:.3g} times as long as {named(first)}: {ms:.3g} ms at {small}x{small}"
            why = f"keeps the error, but takes {told}"
            slow.append(Fallen(variant, precision, Cause.SLOW, why, worst[variant][0], times))
        many = f"{plural(len(chosen), 'variant')} in turns on {plural(len(self._tuning), 'view')}"
        self._watcher.told(f"{precision}: step 2 of 3 times the fastest: {many}")
        wish = self._wish
        self._times.clear()
        for view in self._tuning:
            self._times.append(self._timed(chosen, precision, view, wish.size, wish.seconds, found))
            chosen = list(self._times[-1])
        means = {v: sum(times[v]["median_ms"] for times in self._times) / len(self._times) for v in chosen}
        fastest = min(means.values(), default=0.0)
        for variant, ms in list(means.items()):
            if self._wish.fps and 1e3 / ms < self._wish.fps:
                size = self._wish.size
                why = f"draws {1e3 / ms:.3g} frames/s at {size}x{size}, not the {self._wish.fps:g} asked for"
                times = ms / fastest
                found.fallen.append(Fallen(variant, precision, Cause.FRAMES, why, worst[variant][0], times))
                del means[variant]
        return means, slow

    def _timed(
        self,
        of: list[Variant],
        precision: Precision,
        view: View,
        size: int,
        seconds: float,
        found: Recommendation,
    ) -> dict[Variant, Mapping[str, Any]]:
        """Return what a row says of the time of each variant; those that could not be timed on this view fall."""
        rows = self._rows(of, precision, view, size, seconds)
        for variant, row in rows.items():
            if not row["time"]:
                why = (
                    f"could not be timed on view {view.name} ({row['status']}): {' '.join(str(row['reason']).split())}"
                )
                found.fallen.append(Fallen(variant, precision, Cause.FAILED, why))
        return {variant: row["time"] for variant, row in rows.items() if row["time"]}

    def _rows(
        self,
        of: list[Variant],
        precision: Precision,
        view: View,
        size: int,
        seconds: float | None = None,
        rays: int | None = None,
    ) -> dict[Variant, Row]:
        """Return each variant's row on this view, run where it is not stored; it is timed where `seconds` are given.

        `rays` is how many are checked per side, those of the wish where it is None. Times that are returned together
        were taken in turns: where some are of an earlier search and others are new, all are taken again.
        """
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
            accuracy=AccuracyChoice(size=rays or wish.rays, max_wrong_share=0.0),
            budget=BudgetChoice(seconds=seconds or 0.0),
        )
        named = Experiment(
            self._folder.name, self._folder, "", config, tuple(of), (wish.surface,), (precision,), ("compute",)
        )
        planned = plan.plan(named, self._catalog, [self._device], timed=seconds is not None)
        stated = planned, config, self._catalog, Store(self._folder), self._executor, self._watcher
        rows, _ = batch.rows_of(*stated, self._lock)
        if len({rows[p.key]["time"]["session"] for p in planned if rows[p.key]["time"]}) > 1:
            many = plural(len(of), "variant")
            self._watcher.told(f"{precision}: times of an earlier search are not compared with new ones: {many} again")
            rows, _ = batch.rows_of(*stated, self._lock, force=True)
        return {p.cell.variant: rows[p.key] for p in planned}


def _over_fastest(timed: Mapping[Variant, Mapping[str, Any]]) -> tuple[Variant, dict[Variant, Ratio]]:
    """Return the variant of the least median, and the time of each over its, round by round; there is at least one.

    What slows the machine for a while slows both times of a round, or widens the interval. Where no round timed both,
    the interval says nothing.
    """
    first = min(timed, key=lambda variant: timed[variant]["median_ms"])
    least = timed[first]["samples_ms"], timed[first]["rounds"]
    ratios = {}
    for variant, time in timed.items():
        unpaired = Ratio(time["median_ms"] / timed[first]["median_ms"], 0.0, math.inf, False, 1.0, 0)
        ratios[variant] = paired_ratio(time["samples_ms"], time["rounds"], *least) or unpaired
    return first, ratios


def certified_error(accuracy: Accuracy, quantile: Quantile) -> float | None:
    """Return an upper bound of a quantile of |t - t*|, scene units; None where no hit was measured.

    Errors are measured to the certified interval that encloses t*, so that the largest interval's width is added.
    """
    measured = accuracy["error"][quantile]
    return None if measured is None else float(measured + accuracy["certified_width"])
