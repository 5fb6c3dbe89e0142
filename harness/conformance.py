"""What every method is held to, the same for tests and `firsthit conform`: answers against the oracle, the claims it
states, knobs that move the error the way it says, and the same bits from run to run.

A check that says no names the worst ray or figure. Rays are those of one oblique view; rays nearer than GRAZING scene
radii to another answer count only where a claim says so.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness.accuracy import FAR, NAMES, Verdicts, Wrong, judge
from harness.assemble import Language, method_program
from harness.camera import camera_for, rays_of, scene_radius
from harness.contract import (
    CLAIMS,
    UNIT_ROUNDOFF,
    FirsthitError,
    Hits,
    Parameter,
    Precision,
    Program,
    RayStatus,
    Surface,
    Truth,
    TruthStatus,
    View,
)
from harness.oracle import first_hits
from harness.plugins import Plugin

VIEW = View("oblique", azimuth=30, elevation=35)
SIZE = 48
GRAZING = 1e-3
TYPICAL = ("sphere", "torus", "barth_sextic")  # ball and box, coefficients along a ray and none
SWEPT = ("torus", "barth_sextic", "sphere", "plane_squared")  # a knob is swept on the first that its method accepts
MOST_WRONG = 0.002  # of a typical surface's rays outside the grazing class
MOST_WRONG_ELSEWHERE = 0.1  # of any other surface's: beyond its paper's surfaces a method may be weak, never useless
MOST_EXHAUSTED_ELSEWHERE = 0.5  # of these: it may give up, as long as it says so and answers most rays
ROUNDINGS = 64.0  # of condition × roundoff × radius: what an error may have beside its tolerance
FLOOR = 4e-7  # of the scene radius: where float32 ends, and a finer knob changes nothing
COARSER = (4096.0, 64.0, 1.0)  # times the default of a knob that is finer downwards and names no sweep
FEWER = (64, 8, 4, 2, 1)  # parts of the default of a knob that is finer upwards and names no sweep

Rays = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Bench:
    """Where kernels run: `run` builds a program of listed rays anew and casts float32[n, 6]."""

    device: str
    language: Language
    float64: bool
    run: Callable[[Program, Rays], Hits]

    def cast(self, plugin: Plugin, case: Case, precision: Precision, **knobs: float) -> Hits:
        variant = plugin.variant(knobs)
        return self.run(
            method_program(plugin.method, plugin.folder, variant, case.surface, precision, self.language, "rays"),
            case.rays,
        )


@dataclass(frozen=True, eq=False)
class Case:
    """A surface, rays and their certified answers."""

    surface: Surface
    rays: Rays
    truth: Truth

    @property
    def radius(self) -> float:
        return scene_radius(self.surface)

    def judged(self, hits: Hits) -> Verdicts:
        return judge(hits, self.truth, self.radius, GRAZING)


@dataclass(frozen=True)
class Finding:
    """One check's outcome; `detail` is the figure it was decided by."""

    check: str
    holds: bool
    detail: str


@cache
def view_case(surface: Surface) -> Case:
    """The oblique view of a surface, SIZE × SIZE rays."""
    rays = rays_of(camera_for(VIEW, surface), SIZE)
    return Case(surface, rays, first_hits(surface, rays))


@cache
def touch_cases() -> tuple[Case, ...]:
    """Rays that touch without crossing: a sphere and a torus from outside, exactly; a squared plane at 45° to 60°."""
    import surfaces
    from harness import hardcases

    tangents = []
    for axis, along in ((0, 1), (0, 2), (1, 0), (1, 2)):
        for side in (1.0, -1.0):
            ray = np.zeros(6, np.float32)
            ray[axis], ray[along], ray[3 + along] = side, -3.0, 1.0
            tangents.append(ray)
    rung = hardcases.rungs("double_root")[0]
    listed = [(surfaces.get(name), np.stack(tangents)) for name in ("sphere", "torus")]
    listed.append((rung.surface, rung.rays))
    cases = [Case(surface, rays, first_hits(surface, rays)) for surface, rays in listed]
    return tuple(
        Case(
            case.surface,
            case.rays[case.truth.status == TruthStatus.TOUCH],
            _some(case.truth, case.truth.status == TruthStatus.TOUCH),
        )
        for case in cases
    )


def _some(truth: Truth, mask: NDArray[np.bool_]) -> Truth:
    return Truth(**{name: values[mask] for name, values in vars(truth).items()})


def refusal(plugin: Plugin, surface: Surface, precision: Precision, bench: Bench) -> str | None:
    """Why the method is not to be checked here, or None."""
    from surfaces.sections import unsupported

    if precision not in plugin.method.precisions:
        return f"the method has no {precision} form"
    if precision == "float64" and not bench.float64:
        return "the device has no float64"
    if plugin.method.casts == "mesh":
        return "it draws triangles, and listed rays meet none"
    if plugin.method.casts != "rays":
        return "it casts the beams of a camera's pixels, and listed rays have none"
    return plugin.method.accepts(surface) or unsupported(surface, precision, bench.language)


def examine(bench: Bench, plugin: Plugin, case: Case, precision: Precision) -> Iterator[Finding]:
    """Every check of one method's answers on one case, its claims among them."""
    hits, again = (bench.cast(plugin, case, precision) for _ in range(2))
    yield answers(hits, case)
    yield same_bits(hits, again)
    yield agreement(hits, case)
    for claim in sorted(plugin.method.claims & _CLAIM_CHECKS.keys()):
        yield _CLAIM_CHECKS[claim](plugin, hits, case, precision)


def examine_touches(bench: Bench, plugin: Plugin, precision: Precision) -> Iterator[Finding]:
    """The claim finds_touch, where it is stated."""
    if "finds_touch" not in plugin.method.claims:
        return
    for case in touch_cases():
        if refusal(plugin, case.surface, precision, bench) is None:
            yield finds_touch(bench.cast(plugin, case, precision), case)


def examine_knobs(bench: Bench, plugin: Plugin) -> Iterator[Finding]:
    """Each knob that says which way it is finer, in float32: the error never grows on the way there, and falls.

    Other such knobs stand at their coarsest, so that what one knob does is not hidden by what another mends.
    """
    import surfaces

    accepted = (surface for surface in map(surfaces.get, SWEPT) if not refusal(plugin, surface, "float32", bench))
    surface = next(accepted, None)
    knobs = [parameter for parameter in plugin.method.parameters if parameter.finer]
    for parameter in knobs if surface else ():
        others = {other.name: settings_of(other)[0] for other in knobs if other is not parameter}
        yield _swept(bench, plugin, view_case(surface), parameter, others)


# One check each


def answers(hits: Hits, case: Case) -> Finding:
    """A hit has a finite t inside the domain, nothing else has one, and evaluations are counted."""
    hit = hits.status == RayStatus.HIT
    points = case.rays[:, :3].astype(np.float64) + hits.t[:, None] * case.rays[:, 3:]
    away = np.linalg.norm(points - case.surface.domain.center, axis=1) / case.surface.domain.radius
    known = np.isin(hits.status, list(RayStatus)).all() and (hits.evaluations >= 0).all()
    inside = bool((away[hit] < 1.0 + 1e-4).all())
    holds = bool(known and inside and np.isfinite(hits.t[hit]).all())
    return Finding("answers", holds, f"{hit.sum()} hits, farthest {np.max(away[hit], initial=0.0):.4f} radii away")


def same_bits(hits: Hits, again: Hits) -> Finding:
    """Built and run twice, every answer is the same to the last bit."""
    differs = hits.t.view(np.uint64) != again.t.view(np.uint64)
    differs |= (hits.status != again.status) | (hits.evaluations != again.evaluations)
    return Finding("same from run to run", not differs.any(), f"{differs.sum()} of {len(differs)} rays differ")


def agreement(hits: Hits, case: Case) -> Finding:
    """Outside the grazing class nearly every answer is right, and right hits are near their roots."""
    verdicts = case.judged(hits)
    clear = ~verdicts.grazing
    wrong = verdicts.wrong[clear]
    counts = ", ".join(f"{(wrong == kind).sum()} {name}" for kind, name in NAMES.items() if (wrong == kind).any())
    errors = verdicts.error[clear & np.isfinite(verdicts.error)] / case.radius
    roots = clear & (case.truth.status == TruthStatus.CROSSING)
    most = MOST_WRONG if case.surface.name in TYPICAL else MOST_WRONG_ELSEWHERE
    told = f"{counts or 'none wrong'} of {clear.sum()}"
    gave_up = wrong == Wrong.EXHAUSTED
    if case.surface.name in TYPICAL:
        holds = bool(np.mean(wrong != Wrong.RIGHT) <= most)
    else:
        wrongly = (wrong != Wrong.RIGHT) & ~gave_up
        holds = bool(np.mean(wrongly) <= most and np.mean(gave_up) <= MOST_EXHAUSTED_ELSEWHERE)
    if not roots.any():  # a thin torus, whose every ray is near to missing it; a surface that is only touched
        return Finding("oracle", holds, f"{told}, no root outside the grazing class")
    p99 = float(np.quantile(errors, 0.99)) if len(errors) else np.inf
    return Finding("oracle", holds and p99 < 1e-3, f"{told}, 99 % within {p99:.1e} radii")


def no_missed_root(_plugin: Plugin, hits: Hits, case: Case, _precision: Precision) -> Finding:
    there = np.isin(case.truth.status, (TruthStatus.CROSSING, TruthStatus.TOUCH))
    with np.errstate(invalid="ignore"):
        later = hits.t > case.truth.upper + 0.5 * (case.truth.following - case.truth.upper)
        far = hits.t > case.truth.upper + FAR * case.radius
    lost = there & ((hits.status == RayStatus.MISS) | later | far)
    return Finding("no_missed_root", not lost.any(), f"{lost.sum()} of {there.sum()} roots passed")


def conservative_bound(_plugin: Plugin, hits: Hits, case: Case, _precision: Precision) -> Finding:
    verdicts = case.judged(hits)
    there = np.isin(case.truth.status, (TruthStatus.CROSSING, TruthStatus.TOUCH)) & ~verdicts.grazing
    lost = there & np.isin(verdicts.wrong, (Wrong.MISS, Wrong.WRONG_ROOT))
    return Finding("conservative_bound", not lost.any(), f"{lost.sum()} of {there.sum()} roots passed")


def no_false_hit(_plugin: Plugin, hits: Hits, case: Case, _precision: Precision) -> Finding:
    verdicts = case.judged(hits)
    false = (verdicts.wrong == Wrong.FALSE_HIT) & ~verdicts.grazing
    misses = (case.truth.status == TruthStatus.MISS) & ~verdicts.grazing
    return Finding("no_false_hit", not false.any(), f"{false.sum()} of {misses.sum()} misses hit")


def error_below_tolerance(plugin: Plugin, hits: Hits, case: Case, precision: Precision) -> Finding:
    assert plugin.method.tolerance
    defaults: Mapping[str, float | int] = dict(plugin.variant({}).parameters)
    tolerance = plugin.method.tolerance(case.surface, defaults)
    verdicts = case.judged(hits)
    measured = ~verdicts.grazing & np.isfinite(verdicts.error)
    excess = verdicts.error[measured] / (tolerance + rounding_adds(case, precision)[measured])
    return Finding(
        "error_below_tolerance",
        bool((excess <= 1.0).all()),
        f"largest error {np.max(excess, initial=0.0):.2g} of what tolerance {tolerance:.1e} and rounding allow",
    )


def rounding_adds(case: Case, precision: Precision) -> NDArray[np.float64]:
    """float64[n], scene units: what rounding may add to a right hit's error. ROUNDINGS of the root's condition, or, of
    a polynomial, what its own value may be off by there: with forty terms of degree 20 that is some 160 of them."""
    from harness.rounding import root_errors

    condition = np.fmax(case.truth.condition, 1.0)
    adds = np.asarray(ROUNDINGS * UNIT_ROUNDOFF[precision] * condition * case.surface.domain.radius)
    there = np.flatnonzero(np.isfinite(case.truth.lower))
    if case.surface.algebraic and len(there):
        own = root_errors(case.surface, case.rays[there], case.truth.lower[there], precision)
        adds[there] = np.fmax(adds[there], own)
    return adds


def finds_touch(hits: Hits, case: Case) -> Finding:
    near = np.abs(hits.t - case.truth.lower) < FAR * case.radius
    found = (hits.status == RayStatus.HIT) & near
    return Finding("finds_touch", bool(found.all()), f"{case.surface.name}: {found.sum()} of {len(found)} touches")


_CLAIM_CHECKS: dict[str, Callable[[Plugin, Hits, Case, Precision], Finding]] = {
    "no_missed_root": no_missed_root,
    "no_false_hit": no_false_hit,
    "error_below_tolerance": error_below_tolerance,
    "conservative_bound": conservative_bound,
}
assert {*_CLAIM_CHECKS, "finds_touch"} == CLAIMS.keys()


def settings_of(parameter: Parameter) -> list[float]:
    """A knob's values, coarse to fine, the default among them."""
    if parameter.sweep:
        return sorted({*parameter.sweep, parameter.default}, reverse=parameter.finer == "down")
    if parameter.finer == "down":
        return [parameter.default * factor for factor in COARSER]
    if isinstance(parameter.default, int):
        return list(dict.fromkeys(parameter.default // part for part in FEWER))
    return [parameter.default / part for part in FEWER]


def _swept(
    bench: Bench, plugin: Plugin, case: Case, parameter: Parameter, others: Mapping[str, float | int]
) -> Finding:
    """Errors are means over rays outside the grazing class that meet the surface, a wrong answer counting FAR."""
    values = settings_of(parameter)
    errors = []
    for value in values:
        verdicts = case.judged(bench.cast(plugin, case, "float32", **{**others, parameter.name: value}))
        there = np.isin(case.truth.status, (TruthStatus.CROSSING, TruthStatus.TOUCH)) & ~verdicts.grazing
        relative = np.where(np.isfinite(verdicts.error), verdicts.error / case.radius, FAR)
        errors.append(float(relative[there].mean()))
    grows = any(after > 1.1 * before + FLOOR for before, after in pairwise(errors))
    falls = errors[-1] < 0.75 * errors[0]
    told = ", ".join(f"{value:g}: {error:.1e}" for value, error in zip(values, errors, strict=True))
    return Finding(f"{parameter.name} finer {parameter.finer}", falls and not grows, f"{case.surface.name}: {told}")


def rotation(pairs: list[Any], places: list[Any]) -> list[tuple[Any, Any]]:
    """Each pair with one place, in turn, so that every place is used and the choice never changes by chance."""
    if not places:
        raise FirsthitError("no usable device; `firsthit devices` says why", exit_code=3)
    return [(pair, places[i % len(places)]) for i, pair in enumerate(pairs)]
