"""Make the cases that methods are checked on, and define what runs kernels and what one check found."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from harness.accuracy.answers import validated
from harness.accuracy.judge import Verdicts, judge, judged
from harness.contract import Box, CellStatus, Hits, Precision, Program, Surface, Truth, TruthStatus, View
from harness.devices.messages import Check
from harness.experiment.kinds import MethodKind, of_method
from harness.kernels.assemble import Language, method_program
from harness.kernels.sections import Lanes
from harness.oracle import first_hits
from harness.plugins import Plugin
from harness.scenes.camera import camera_for, rays_of, scene_radius

GRAZING = 1e-3  # scene radii: rays that are nearer to another answer are grazing
TYPICAL = ("sphere", "torus", "barth_sextic")  # ball and box, coefficients along a ray and none
OUTSIDE = "oblique"
INSIDE = "inside"  # the view whose eye is in the domain
VIEWS: dict[str, tuple[View, int]] = {  # with rays per side
    # 33 is odd, so that a row and a column of rays lie in planes of symmetry: users try such rays first
    OUTSIDE: (View("oblique", azimuth=30, elevation=35), 48),
    "axis": (View("axis", azimuth=0, elevation=0), 33),
    "pole": (View("pole", azimuth=0, elevation=90), 33),
    "below": (View("below", azimuth=-107, elevation=-12), 32),
    INSIDE: (View("inside", azimuth=200, elevation=25, fov=90), 32),
}
FRAME = 1024  # least pixels a side of a view that is cast as a frame: in smaller ones tiles are wide, and decide little
INSIDE_SHARE = 0.7  # of the way from the domain's centre to its boundary: how far the eye of INSIDE is from the centre

Rays = NDArray[np.float32]
T = TypeVar("T", Truth, Hits)


@dataclass(frozen=True, eq=False)
class Case:
    """Hold a surface, rays float32[n, 6] at it, and their certified answers.

    `views` holds name and count of each part of the rays, in their order; it is empty where they are of no view.
    """

    surface: Surface
    rays: Rays
    truth: Truth
    views: tuple[tuple[str, int], ...] = ()

    @property
    def radius(self) -> float:
        """Return the scene radius, in scene units."""
        return scene_radius(self.surface)

    @property
    def there(self) -> NDArray[np.bool_]:
        """Return bool[n]: true where the oracle proves a first hit."""
        return np.asarray(np.isin(self.truth.status, (TruthStatus.CROSSING, TruthStatus.TOUCH)))

    def judged(self, hits: Hits, precision: Precision) -> Verdicts:
        """Hold the answers to all n rays against the oracle's."""
        return judge(hits, self.truth, self.radius, GRAZING, precision)

    def clear(self, verdicts: Verdicts) -> NDArray[np.bool_]:
        """Return bool[n]: true for rays that a method must answer rightly.

        These are the rays that the oracle decides and that are neither grazing nor drowned.
        """
        return judged(self.truth, verdicts)

    def parts(self, hits: Hits) -> Iterator[tuple[str, Case, Hits]]:
        """Yield for each view its name, its rays as a case, and the answers to them."""
        start = 0
        for name, count in self.views or (("", len(self.rays)),):
            part = slice(start, start + count)
            yield name, Case(self.surface, self.rays[part], some(self.truth, part), ((name, count),)), some(hits, part)
            start += count


@dataclass(frozen=True, eq=False)
class Bench:
    """Run kernels on one device: `run` builds the programs of a check, runs it and returns its answer.

    lanes: how lanes of tiles lie on the device's work items, as lanes_on chooses; None: as on a processor's
    """

    device: str
    language: Language
    float64: bool
    run: Callable[[Check[Any]], Any]
    lanes: Lanes | None = None

    def cast(self, plugin: Plugin, case: Case, precision: Precision, **knobs: float) -> Hits:
        """Return the hits [n] of a case's rays by a method with some of its knobs turned; impossible ones are INVALID.

        Raises FirsthitError for a knob that the method does not have, and what `run` raises.
        """
        kind = of_method(plugin.method)
        stated = plugin.method, plugin.folder, plugin.variant(knobs), case.surface, precision, self.language
        programs = tuple(method_program(*stated, entry, lanes=self.lanes) for entry in kind.hard_entries)
        answered = [self.run(check) for check in _checks(kind, programs, case)]
        hits = Hits(**{name: np.concatenate([vars(part)[name] for part in answered]) for name in vars(answered[0])})
        return validated(hits, case.surface.domain, case.rays)


def _checks(kind: MethodKind, programs: tuple[Program, ...], case: Case) -> Iterator[Check[Hits]]:
    """Yield the checks that together cast a case's rays in their order.

    A method that cannot cast listed rays casts each view as a frame of FRAME pixels a side or more, in which the view's
    rays are middles of pixels, and rays of no view as its kind casts hard rays.
    """
    if not kind.unlisted or not case.views:
        yield kind.hard_check(programs, case.surface, case.rays)
        return
    start = 0
    for name, count in case.views:
        yield kind.view_check(
            programs, case.surface, view_camera(case.surface, name), case.rays[start : start + count], FRAME
        )
        start += count


@dataclass(frozen=True)
class Finding:
    """Hold one check's outcome.

    The check holds where `value <= limit`, and so never where the value is NaN, of which nothing is known.

    value, limit: what was measured, in the words of `rule`, and the largest value that holds
    rule: what is measured, and why it is limited
    detail: what else was seen: counts, and the worst ray
    advice: what to do where the check does not hold
    unchecked: why nothing could be measured, which is not a pass; None where something was
    ended: how the program ended where it did not run to its end, for the reason that `detail` gives; None where it did
    """

    check: str
    value: float
    limit: float
    rule: str
    detail: str = ""
    advice: str = ""
    unchecked: str | None = None
    ended: CellStatus | None = None

    @property
    def holds(self) -> bool:
        """Tell whether the check holds; false where nothing was measured."""
        return self.unchecked is None and self.value <= self.limit

    @property
    def fails(self) -> bool:
        """Tell whether the check does not hold; false where nothing was measured."""
        return self.unchecked is None and not self.holds


def not_checked(check: str, reason: str) -> Finding:
    """Make the finding of a check for which nothing could be measured."""
    return Finding(check, np.nan, np.nan, "", unchecked=reason)


def some(whole: T, part: slice | NDArray[np.bool_]) -> T:
    """Return the truth or the hits of those rays that `part` selects."""
    return type(whole)(**{name: values[part] for name, values in vars(whole).items()})


@cache
def view_case(surface: Surface, name: str = OUTSIDE) -> Case:
    """Make the case of one of VIEWS of a surface. Raises KeyError for a name that is not one of these."""
    rays = rays_of(view_camera(surface, name), VIEWS[name][1])
    return Case(surface, rays, first_hits(surface, rays), ((name, len(rays)),))


def view_camera(surface: Surface, name: str) -> NDArray[np.float32]:
    """Return the camera float32[12] of one of VIEWS of a surface. Raises KeyError for a name that is none of these."""
    view, _ = VIEWS[name]
    if name == INSIDE:
        view = dataclasses.replace(view, distance=INSIDE_SHARE * _way_out(surface, view))
    return camera_for(view, surface)


def _way_out(surface: Surface, view: View) -> float:
    """Measure the way from the domain's centre to its boundary, towards the view's eye, in scene units."""
    if not isinstance(surface.domain, Box):
        return surface.domain.radius
    backward = -camera_for(view, surface)[3:6].astype(np.float64)
    half = 0.5 * np.subtract(surface.domain.upper, surface.domain.lower)
    return float((half / np.maximum(np.abs(backward), np.finfo(float).tiny)).min())


@cache
def views_case(surface: Surface) -> Case:
    """Make one case of all VIEWS of a surface, so that a program casts them in one launch."""
    return joined([view_case(surface, name) for name in VIEWS])


def joined(cases: list[Case]) -> Case:
    """Join cases of one surface to one case."""
    truths: list[Mapping[str, NDArray[Any]]] = [vars(case.truth) for case in cases]
    truth = Truth(**{name: np.concatenate([truth[name] for truth in truths]) for name in truths[0]})
    views = tuple(view for case in cases for view in case.views)
    return Case(cases[0].surface, np.concatenate([case.rays for case in cases]), truth, views)


@cache
def touch_cases() -> tuple[Case, ...]:
    """Make cases of rays that touch a surface without crossing it, as the oracle proves.

    They touch a sphere and a torus from outside, exactly, and meet a squared plane at 45° to 60°.
    """
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
    """Say why the method is not to be checked here; None where it is."""
    from harness.kernels.functions import too_long, unsupported

    if precision not in plugin.method.precisions:
        return f"the method has no {precision} form"
    if precision == "float64" and not bench.float64:
        return "the device has no float64"
    kind = of_method(plugin.method)
    if not kind.hard_entries:
        return f"it {kind.unlisted}"
    return (
        plugin.method.accepts(surface)
        or unsupported(surface, precision, bench.language)
        or too_long(surface, plugin.method.needs, precision, bench.language)
    )
