"""Tell whether a program's first answers are its kernel's, or a mistake of the compiler that built it.

First f itself is evaluated, in float64 on the host, along SAMPLE of the rays. It contradicts three kinds of answers: a
miss on a ray where it changes its sign, a hit near which it neither changes its sign nor comes near zero, and a hit
behind such a change. A weak method earns contradictions too: newton ends where f is small, ray_march passes pairs of
roots. So if more than DOUBTFUL of the rays are contradicted, the same kernel is built once more, without optimisation,
and casts the sample again: what a method does wrong it does wrong in both builds. The compiler is at fault if the
second build's answers differ and f agrees with them, on more than DOUBTFUL of the rays and OUTWEIGHS times as often as
the other way round.

**Where there is a second build** OpenCL compilers can be told not to optimise. OpenGL's cannot: its programs are held
against the first usable OpenCL device, which compiles the same kernel text by another compiler. If there is none, or if
the second build fails or takes too long, doubts are told and nothing is decided.

A kernel that reads a variable that it never set answers differently in both builds too, and the message names that
cause as well.

**What this cannot see** It does not see mistakes on fewer than DOUBTFUL of the rays, mistakes that both builds make,
errors in t under FAR scene radii, wrong counts of evaluations, rays that are given up (these are no wrong answers),
pairs of roots within one of STEPS steps, and what rasterised programs answer. The oracle's verdicts see these, where it
is asked. The answers are of the program of listed rays; the timed one differs in where its rays come from.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from harness.accuracy.judge import FAR
from harness.contract import Domain, Hits, Precision, Program, RayStatus, Surface
from harness.devices.discovery import discover_devices
from harness.devices.executor import CellError
from harness.devices.interface import LANGUAGES
from harness.devices.messages import ListedCheck
from harness.devices.steps import Executor
from harness.kernels.assemble import Language
from harness.oracle.clip import clip_many
from harness.scenes.camera import scene_radius

SAMPLE = 512  # rays
STEPS = 64  # of the part of a ray that is in the domain
DOUBTFUL = 0.02  # share of the sample
OUTWEIGHS = 4.0
NEAR_ZERO = 0.05  # of f's largest magnitude within FAR scene radii: near a touch f is as small
NOISE = 1e-6  # of f's largest magnitude along the ray: the sign of smaller values is not used

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]
Index = NDArray[np.intp]
Run = Callable[[str, tuple[Program, ...], Index], Hits]


@dataclass(frozen=True)
class Doubts:
    """Hold how many of the `rays` in the sample f contradicts, and the compiler's `fault`, if one was found."""

    contradicted: int
    rays: int
    fault: str | None = None

    @property
    def note(self) -> str:
        """Return one sentence to tell; it is empty if few answers are contradicted."""
        if self.contradicted <= DOUBTFUL * self.rays:
            return ""
        return f"f, evaluated on the host, contradicts {self.contradicted} of {self.rays} sampled rays' answers"


@dataclass(frozen=True, eq=False)
class SecondBuild:
    """State how the same kernel is compiled in another way, and cast.

    programs: makes the programs in a language
    run: casts rays, by their places int[k], with programs on a device, and returns hits [k]; it may raise CellError
    """

    device: str
    precision: Precision
    programs: Callable[[Language], tuple[Program, ...]]
    run: Run

    def answers(self, index: Index) -> tuple[str, Hits] | None:
        """Build and cast; return how it was built, and the hits [k]. None if there is no other way, or if it fails."""
        there = self.device if LANGUAGES[self.device.partition(":")[0]] == "cl" else _stand_in(self.precision)
        if there is None:
            return None
        told = "without optimisation" + ("" if there == self.device else f" by {there}")
        programs = tuple(dataclasses.replace(program, optimised=False) for program in self.programs("cl"))
        try:
            return told, self.run(there, programs, index)
        except CellError:
            return None


def with_listed_rays(executor: Executor, rays: NDArray[np.float32]) -> Run:
    """Return how the second build of a program of listed rays, float32[n, 6], is run."""
    return lambda device, programs, index: executor.check(device, ListedCheck(programs[0], rays[index])).answer


@cache
def _stand_in(precision: Precision) -> str | None:
    """Find the first usable OpenCL device that has the precision; None if there is none."""
    found = discover_devices(("opencl:",))
    usable = (info.name for info in found if not info.problem and (precision == "float32" or info.float64))
    return next(usable, None)


def doubts_about(
    surface: Surface, rays: NDArray[np.float32], hits: Hits, second: SecondBuild, t_min: float = 0.0
) -> Doubts:
    """Hold a program's answers for rays float32[n, 6] against f and, if f contradicts them, against a second build.

    The rays begin at `t_min`.
    """
    index = _sample(surface.domain, rays, t_min)
    first = _some(hits, index)
    against_first = contradicted(surface, rays[index], first, t_min)
    told = Doubts(int(against_first.sum()), len(index))
    if not told.note:
        return told
    other = second.answers(index)
    if other is None:
        return told
    how, again = other
    better, worse = compared(surface, rays[index], first, against_first, again, t_min)
    if better <= max(DOUBTFUL * len(index), OUTWEIGHS * worse):
        return told
    fault = (
        "this device's compiler is at fault, or the kernel uses what it never set: f, evaluated on the host, "
        f"contradicts {told.contradicted} of "
        f"{len(index)} sampled rays' answers, and agrees on {better} of these with the same kernel built {how}"
    )
    return dataclasses.replace(told, fault=fault)


def compared(
    surface: Surface, rays: NDArray[np.float32], first: Hits, against_first: Mask, again: Hits, t_min: float
) -> tuple[int, int]:
    """Count answers of another build that differ, in two ways: f contradicts the first only, or the other only."""
    against_again = contradicted(surface, rays, again, t_min)
    with np.errstate(invalid="ignore"):
        apart = ~(np.abs(first.t - again.t) <= FAR * scene_radius(surface))
    differs = (first.status != again.status) | ((first.status == RayStatus.HIT) & apart)
    gave_up = (first.status == RayStatus.EXHAUSTED) | (again.status == RayStatus.EXHAUSTED)
    differs &= ~gave_up
    return int((differs & against_first & ~against_again).sum()), int((differs & ~against_first & against_again).sum())


def contradicted(surface: Surface, rays: NDArray[np.float32], hits: Hits, t_min: float = 0.0) -> Mask:
    """Return bool[n]: f's signs along the rays float32[n, 6] contradict the answer.

    A ray that was given up is never contradicted.
    """
    reach = FAR * scene_radius(surface)
    enter, leave = _stay(surface.domain, rays, t_min)
    t = enter[:, None] + (leave - enter)[:, None] * np.linspace(0.0, 1.0, STEPS + 1)
    values = _along(surface, rays, t)
    with np.errstate(invalid="ignore"):
        largest = np.nanmax(np.where(np.isfinite(values), np.abs(values), 0.0), axis=1, keepdims=True)
        signs = np.where(np.abs(values) > NOISE * largest, np.sign(values), 0.0)
        changes = signs[:, 1:] * signs[:, :-1] < 0.0
        near = np.clip(hits.t[:, None] + reach * np.linspace(-1.0, 1.0, 9), enter[:, None], leave[:, None])
        about = _along(surface, rays, near)
        at_hit = np.abs(_along(surface, rays, hits.t[:, None])[:, 0])
        one_sign = (about > NOISE * largest).all(axis=1) | (about < -NOISE * largest).all(axis=1)
        no_root = one_sign & (at_hit > NEAR_ZERO * np.abs(about).max(axis=1))
        passed = (changes & (t[:, 1:] < hits.t[:, None] - reach)).any(axis=1)
        inside = (hits.t >= enter - reach) & (hits.t <= leave + reach)
    wrong_hit = no_root | passed | ~inside
    return np.asarray(
        np.where(hits.status == RayStatus.HIT, wrong_hit, (hits.status == RayStatus.MISS) & changes.any(axis=1))
    )


def _along(surface: Surface, rays: NDArray[np.float32], t: Floats) -> Floats:
    """Evaluate f at parameters float64[n, k] of rays float32[n, 6]: float64[n, k]."""
    import surfaces

    origins, directions = np.split(rays.astype(np.float64), 2, axis=1)
    points = origins[:, None] + t[..., None] * directions[:, None]
    return surfaces.evaluate(surface, points.reshape(-1, 3)).reshape(t.shape)


def _sample(domain: Domain, rays: NDArray[np.float32], t_min: float) -> Index:
    """Return the places of at most SAMPLE rays that run through the domain, evenly over all."""
    enter, leave = _stay(domain, rays, t_min)
    with np.errstate(invalid="ignore"):
        through = np.flatnonzero(leave > enter)
    if len(through) <= SAMPLE:
        return through
    return through[np.linspace(0, len(through) - 1, SAMPLE).astype(np.intp)]


def _stay(domain: Domain, rays: NDArray[np.float32], t_min: float) -> tuple[Floats, Floats]:
    """Return where rays enter and leave the domain, from t_min on, float64[n] each; NaN if they pass it by."""
    clip = clip_many(domain, rays.astype(np.float64), t_min)
    return np.where(clip.missed, np.nan, clip.enter_lower), np.where(clip.missed, np.nan, clip.leave_upper)


def _some(hits: Hits, index: Index) -> Hits:
    """Return the hits [k] of the rays at the places `index`, int[k]."""
    return Hits(hits.t[index], hits.status[index], hits.evaluations[index])
