"""Every method that casts rays takes distance functions, angles, real powers and piecewise formulas, or says why not.

The right answers come from numpy functions of the tests' own, sampled densely along each ray. A change of sign counts
as a root where halving it makes both values small; where they stay apart, f jumps.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

import surfaces
from harness.accuracy.answers import validated
from harness.contract import RayStatus, Surface, View
from harness.devices.interface import hits_from, launch_rays
from harness.kernels.assemble import method_program
from harness.kernels.functions import unsupported
from harness.plugins import find_methods
from harness.scenes.camera import camera_for, rays_of
from tests.conftest import opened, rotation, usable_devices

Array = NDArray[np.float64]
Field = Callable[[Array, Array, Array], Array]
SAMPLES = 3000
NEAR = 1e-3  # scene units: rays whose |f| falls below it without a root are left out


def folded(x: Array) -> Array:
    return (x + 0.25) % 0.5 - 0.25


def box(x: Array, y: Array, z: Array) -> Array:
    q = np.stack([np.abs(x) - 0.5, np.abs(y) - 0.4, np.abs(z) - 0.3])
    return np.linalg.norm(np.maximum(q, 0), axis=0) + np.minimum(q.max(axis=0), 0) - 0.05


BOX = (
    "sqrt(max(abs(x)-0.5,0)^2 + max(abs(y)-0.4,0)^2 + max(abs(z)-0.3,0)^2)"
    "+ min(max(abs(x)-0.5, abs(y)-0.4, abs(z)-0.3), 0) - 0.05"
)
CASES: dict[str, tuple[str, Field]] = {
    "sphere": ("sqrt(x^2 + y^2 + z^2) - 1", lambda x, y, z: np.sqrt(x**2 + y**2 + z**2) - 1),
    "box": (BOX, box),
    "torus": ("sqrt((sqrt(x^2+y^2)-0.8)^2 + z^2) - 0.3", lambda x, y, z: np.hypot(np.hypot(x, y) - 0.8, z) - 0.3),
    "smooth": (
        "-log(exp(-8*(length(x, y, z) - 0.7)) + exp(-8*(length(x - 0.6, y, z) - 0.5)))/8",
        lambda x, y, z: (
            -np.logaddexp(-8 * (np.sqrt(x**2 + y**2 + z**2) - 0.7), -8 * (np.sqrt((x - 0.6) ** 2 + y**2 + z**2) - 0.5))
            / 8
        ),
    ),
    "twist": (
        "length(sqrt(x^2 + y^2) - 0.8, z) - 0.3 + 0.05*sin(3*atan2(y, x))",
        lambda x, y, z: np.hypot(np.hypot(x, y) - 0.8, z) - 0.3 + 0.05 * np.sin(3 * np.arctan2(y, x)),
    ),
    "lattice": (
        "length(mod(x + 0.25, 0.5) - 0.25, mod(y + 0.25, 0.5) - 0.25, mod(z + 0.25, 0.5) - 0.25) - 0.15",
        lambda x, y, z: np.sqrt(folded(x) ** 2 + folded(y) ** 2 + folded(z) ** 2) - 0.15,
    ),
    "halves": (
        "if(x > 0, x^2 + y^2 + z^2 - 1, x^2 + y^2 + z^2 - 0.5)",
        lambda x, y, z: x**2 + y**2 + z**2 - np.where(x > 0, 1.0, 0.5),
    ),
    "powers": (
        "abs(x)^2.5 + abs(y)^2.3 + abs(z)^1.2 - 1",
        lambda x, y, z: np.abs(x) ** 2.5 + np.abs(y) ** 2.3 + np.abs(z) ** 1.2 - 1,
    ),
    "sinh": ("sinh(x)^2 + y^2 + z^2 = 1", lambda x, y, z: np.sinh(x) ** 2 + y**2 + z**2 - 1),
}
RAY_METHODS = sorted(p.method.name for p in find_methods().plugins.values() if p.method.casts == "rays")
TAKING = ("newton", "ray_march", "interval_march", "sphere_tracing_lipschitz")
JUMPING = ("twist", "lattice", "halves")
WRONG = {  # most wrong answers of 100; ray_march and newton may take a jump for a root, or step over a root
    "newton": 8,
    "ray_march": 6,
    "interval_march": 4,
    "sphere_tracing_lipschitz": 2,
}


@cache
def surface_of(name: str) -> Surface:
    return surfaces.from_formula(CASES[name][0], "sphere:1.5", name)


@cache
def rays_at(name: str) -> NDArray[np.float32]:
    views = (View("a", azimuth=30, elevation=35), 13), (View("b", azimuth=0, elevation=0), 7)
    return np.vstack([rays_of(camera_for(view, surface_of(name)), size) for view, size in views])


@cache
def sampled(name: str) -> tuple[Array, Array]:
    """Return the first root along each ray, NaN where there is none, and the least |f|, inf outside the domain."""
    rays, field = rays_at(name).astype(np.float64), CASES[name][1]
    o, d = rays[:, :3], rays[:, 3:]
    along = (o * d).sum(axis=1)
    half = np.sqrt(np.maximum(along**2 - (o**2).sum(axis=1) + 1.5**2, 0.0))
    roots, least = np.full(len(rays), np.nan), np.full(len(rays), np.inf)
    for i in np.flatnonzero(half > 0):
        t = np.linspace(max(-along[i] - half[i], 0.0), -along[i] + half[i], SAMPLES)

        def f(t: Array, i: int = int(i)) -> Array:
            return field(*(o[i][:, None] + d[i][:, None] * np.atleast_1d(t)))

        values = f(t)
        least[i] = np.abs(values).min()
        for k in np.flatnonzero((values[:-1] < 0) != (values[1:] < 0)):
            a, b = t[k], t[k + 1]
            for _ in range(50):
                m = 0.5 * (a + b)
                a, b = (m, b) if (f(m)[0] < 0) == (values[k] < 0) else (a, m)
            if abs(f(a)[0]) < 1e-9 and abs(f(b)[0]) < 1e-9:
                roots[i] = a
                break
    return roots, least


def test_all_other_methods_say_why_they_refuse_what_is_no_polynomial() -> None:
    for name in RAY_METHODS:
        reason = find_methods().get(name).method.accepts(surface_of("powers"))
        if name in (*TAKING, "null"):
            assert reason is None
        else:
            assert reason and "\n" not in reason and not reason.endswith(".")
    reason = find_methods().get("sphere_tracing_lipschitz").method.accepts(surface_of("lattice"))
    assert reason == "f may jump (floor), and a bound of its gradient says nothing of jumps"


PAIRS = [(method, name) for method in TAKING for name in CASES if not (name in JUMPING and "lipschitz" in method)]
PLACES = [(info.name, precision) for info in usable_devices() for precision in ("float32", "float64")]


@pytest.mark.one_in(3)
@pytest.mark.parametrize(("pair", "place"), rotation(PAIRS, PLACES), ids=str)
def test_a_method_finds_the_first_root(pair: tuple[str, str], place: tuple[str, str]) -> None:
    (method, name), (device_name, precision) = pair, place
    surface, rays, plugin, device = surface_of(name), rays_at(name), find_methods().get(method), opened(device_name)
    if unsupported(surface, precision, device.language):  # type: ignore[arg-type]
        precision = "float32"
    stated = plugin.method, plugin.folder, plugin.variant({}), surface, precision, device.language
    program = method_program(*stated, "rays")  # type: ignore[arg-type]
    launch = launch_rays(device, program, device.build(program), rays)
    launch.run()
    hits = validated(hits_from(launch.read()), surface.domain, rays)
    launch.release()
    roots, least = sampled(name)
    there = ~np.isnan(roots)
    assert there.sum() > 20
    hit, missed = hits.status == RayStatus.HIT, hits.status == RayStatus.MISS
    assert not (hits.status == RayStatus.INVALID).any()
    if "no_missed_root" in plugin.method.claims:
        assert not (there & (missed | (hit & (hits.t > roots + 1e-4)))).any()
    wrong = np.where(there, ~hit | (np.abs(hits.t - roots) > 1e-3), ~missed & (least > NEAR))
    assert wrong.sum() <= len(rays) * WRONG[method] / 100, f"{wrong.sum()} of {len(rays)}, first {wrong.argmax()}"
