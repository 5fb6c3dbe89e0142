"""What methods are checked on: rays with certified answers, where kernels run, and what one check found."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness.accuracy.answers import validated
from harness.accuracy.judge import Verdicts, judge, judged
from harness.contract import Box, Hits, Precision, Program, Surface, Truth, TruthStatus, View
from harness.experiment.kinds import of_method
from harness.kernels.assemble import Language, method_program
from harness.oracle import first_hits
from harness.plugins import Plugin
from harness.scenes.camera import camera_for, rays_of, scene_radius

GRAZING = 1e-3
TYPICAL = ("sphere", "torus", "barth_sextic")  # ball and box, coefficients along a ray and none
OUTSIDE = "oblique"
INSIDE = "inside"  # the view whose eye is in the domain
VIEWS: dict[str, tuple[View, int]] = {  # with rays per side
    OUTSIDE: (View("oblique", azimuth=30, elevation=35), 48),
    "axis": (View("axis", azimuth=0, elevation=0), 33),  # odd, so that a row and a column lie in planes of symmetry:
    "pole": (View("pole", azimuth=0, elevation=90), 33),  # users try such rays first
    "below": (View("below", azimuth=-107, elevation=-12), 32),
    INSIDE: (View("inside", azimuth=200, elevation=25, fov=90), 32),
}
INSIDE_SHARE = 0.7  # of the way from the domain's centre to its boundary: where the eye inside it is

Rays = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Case:
    """A surface, rays and their certified answers; `views` names the rays' parts in their order, with their counts."""

    surface: Surface
    rays: Rays
    truth: Truth
    views: tuple[tuple[str, int], ...] = ()

    @property
    def radius(self) -> float:
        return scene_radius(self.surface)

    @property
    def there(self) -> NDArray[np.bool_]:
        """bool[n]: the oracle proves a first hit."""
        return np.asarray(np.isin(self.truth.status, (TruthStatus.CROSSING, TruthStatus.TOUCH)))

    def judged(self, hits: Hits, precision: Precision) -> Verdicts:
        return judge(hits, self.truth, self.radius, GRAZING, precision)

    def clear(self, verdicts: Verdicts) -> NDArray[np.bool_]:
        """bool[n]: rays that a method must answer rightly: decided by the oracle, and neither grazing nor drowned."""
        return judged(self.truth, verdicts)

    def parts(self, hits: Hits) -> Iterator[tuple[str, Case, Hits]]:
        """Each view by itself: its name, its rays as a case, and what `hits` say of them."""
        start = 0
        for name, count in self.views or (("", len(self.rays)),):
            part = slice(start, start + count)
            yield name, Case(self.surface, self.rays[part], some(self.truth, part), ((name, count),)), some(hits, part)
            start += count


@dataclass(frozen=True, eq=False)
class Bench:
    """Where kernels run: `run` builds a program of listed rays and casts float32[n, 6]."""

    device: str
    language: Language
    float64: bool
    run: Callable[[Program, Rays], Hits]

    def cast(self, plugin: Plugin, case: Case, precision: Precision, **knobs: float) -> Hits:
        variant = plugin.variant(knobs)
        program = method_program(plugin.method, plugin.folder, variant, case.surface, precision, self.language, "rays")
        return validated(self.run(program, case.rays), case.surface.domain, case.rays)


@dataclass(frozen=True)
class Finding:
    """One check's outcome. It holds where `value <= limit`, so that NaN, of which nothing is known, never holds."""

    check: str
    value: float  # what was measured, in the words of `rule`
    limit: float  # the largest value that holds
    rule: str  # what is measured and why it is bounded
    detail: str = ""  # what else was seen: counts, the worst ray
    advice: str = ""  # what to do where it does not hold
    unchecked: str | None = None  # why nothing could be measured; then it is no pass

    @property
    def holds(self) -> bool:
        """False where nothing was measured."""
        return self.unchecked is None and self.value <= self.limit

    @property
    def fails(self) -> bool:
        return self.unchecked is None and not self.holds


def not_checked(check: str, reason: str) -> Finding:
    return Finding(check, np.nan, np.nan, "", unchecked=reason)


def some(whole: Any, part: slice | NDArray[Any]) -> Any:
    """The rays of `part` of a Truth or of Hits."""
    return type(whole)(**{name: values[part] for name, values in vars(whole).items()})


@cache
def view_case(surface: Surface, name: str = OUTSIDE) -> Case:
    """One of VIEWS of a surface."""
    view, size = VIEWS[name]
    if name == INSIDE:
        view = dataclasses.replace(view, distance=INSIDE_SHARE * _way_out(surface, view))
    rays = rays_of(camera_for(view, surface), size)
    return Case(surface, rays, first_hits(surface, rays), ((name, len(rays)),))


def _way_out(surface: Surface, view: View) -> float:
    """Measure the way from the domain's centre to its boundary, towards the view's eye, in scene units."""
    if not isinstance(surface.domain, Box):
        return surface.domain.radius
    backward = -camera_for(view, surface)[3:6].astype(np.float64)
    half = 0.5 * np.subtract(surface.domain.upper, surface.domain.lower)
    return float((half / np.maximum(np.abs(backward), np.finfo(float).tiny)).min())


@cache
def views_case(surface: Surface) -> Case:
    """All VIEWS of a surface in one list of rays, so that they cost a program no more than one."""
    return joined([view_case(surface, name) for name in VIEWS])


def joined(cases: list[Case]) -> Case:
    """Cases of one surface as one."""
    truths: list[Mapping[str, NDArray[Any]]] = [vars(case.truth) for case in cases]
    truth = Truth(**{name: np.concatenate([truth[name] for truth in truths]) for name in truths[0]})
    views = tuple(view for case in cases for view in case.views)
    return Case(cases[0].surface, np.concatenate([case.rays for case in cases]), truth, views)


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
    cases = []
    for surface, rays in listed:
        truth = first_hits(surface, rays)
        touches = truth.status == TruthStatus.TOUCH
        cases.append(Case(surface, rays[touches], some(truth, touches)))
    return tuple(cases)


def refusal(plugin: Plugin, surface: Surface, precision: Precision, bench: Bench) -> str | None:
    """Why the method is not to be checked here, or None."""
    from harness.kernels.functions import unsupported

    if precision not in plugin.method.precisions:
        return f"the method has no {precision} form"
    if precision == "float64" and not bench.float64:
        return "the device has no float64"
    if reason := of_method(plugin.method).unlisted:
        return f"it {reason}"
    return plugin.method.accepts(surface) or unsupported(surface, precision, bench.language)
