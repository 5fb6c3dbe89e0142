"""Where a ray begins: t_min, and starts on the surface, for every method of rays;
cases take turns on devices and precisions."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import product
from typing import Any

import numpy as np
import pytest

import surfaces
from harness.cli import main
from harness.contract import PRECISIONS, FirsthitError, Hits, RayStatus, Surface
from harness.devices.interface import Device, hits_from, launch_rays
from harness.kernels.assemble import method_program
from harness.kernels.functions import unsupported
from harness.plugins import find_methods

from .conftest import opened, rotation, usable_devices

METHODS = sorted(
    name for name, plugin in find_methods().plugins.items() if plugin.method.casts == "rays" and name != "null"
)
SPHERE = surfaces.from_formula("x^2 + y^2 + z^2 - 1", "sphere:1.5")
SQUARES = surfaces.from_formula("x^4 + y^4 + z^4 - 1", "sphere:1.5")
KNOWN = surfaces.get("torus", R="0.5", r="0.25")  # numbers of float32, so that its points may be exact
STARTS: dict[str, tuple[Surface, Any]] = {  # surface, a start on it with f = 0 in floats too
    "sphere": (SPHERE, (1, 0, 0)),
    "quartic": (SQUARES, (0, 1, 0)),
    "torus": (KNOWN, (0.75, 0, 0)),
    "sextic": (surfaces.from_formula("x^6 + y^6 + z^6 - 1", "sphere:1.5"), (0, 0, -1)),
    "plane": (surfaces.from_formula("z", "sphere:1"), (0.25, 0.5, 0)),
    "domain's end": (surfaces.from_formula("x + y - 1", "sphere:1"), (1, 0, 0)),
}
WAYS = ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, 0, 1), (-0.6, 0.8, 0), (0.6, 0, -0.8))


def cast_from(
    device: Device, method: str, surface: Surface, rays: Any, precision: Any, t_min: float = 0.0
) -> Hits | None:
    """Hits from t_min on, or None where the method or the device refuses."""
    plugin = find_methods().get(method)
    if plugin.method.accepts(surface) or unsupported(surface, precision, device.language):
        return None
    if precision == "float64" and not device.info.float64:
        return None
    program = method_program(
        plugin.method, plugin.folder, plugin.variant({}), surface, precision, device.language, "rays", None, t_min
    )
    launch = launch_rays(device, program, device.build(program), rays)
    launch.run()
    hits = hits_from(launch.read())
    launch.release()
    return hits


def _rays(origin: Any, ways: Any) -> Any:
    return np.array([(*origin, *way) for way in ways], np.float32)


# t_min before, between, on and behind the roots of the unit sphere, for rays along x: the root that is right
AWAY, LEAVING, ENTERING = ((-3, 0, 0), (1, 0, 0)), ((1, 0, 0), (1, 0, 0)), ((1, 0, 0), (-1, 0, 0))
BEGINNINGS = [
    (AWAY, 0.0, 2.0),
    (AWAY, 1.5, 2.0),
    (AWAY, 2.0, 2.0),
    (AWAY, 2.5, 4.0),
    (AWAY, 4.0, 4.0),
    (AWAY, 4.25, None),
    (LEAVING, 0.25, None),
    (ENTERING, 0.25, 2.0),
    (ENTERING, 2.5, None),
]


def _in_turn(cases: Iterable[Any]) -> list[Any]:
    """Each case with each method, on one device in one precision."""
    places = [(info.name, precision) for info in usable_devices() for precision in PRECISIONS[: 1 + info.float64]]
    pairs = rotation(list(product(cases, METHODS)), places)
    return [pytest.param(*pair, *place, id=f"{i}-{pair[1]}") for i, (pair, place) in enumerate(pairs)]


@pytest.mark.one_in(6)
@pytest.mark.parametrize(("name", "method", "where", "precision"), _in_turn(STARTS))
def test_a_start_on_the_surface_is_a_hit_at_once_whichever_way_it_goes(name, method, where, precision):
    surface, start = STARTS[name]
    hits = cast_from(opened(where), method, surface, _rays(start, WAYS), precision)
    if hits is not None:
        assert (hits.status == RayStatus.HIT).all()
        assert (hits.t == 0.0).all()
        assert (hits.evaluations == 1).all()


@pytest.mark.one_in(6)
@pytest.mark.parametrize(("case", "method", "where", "precision"), _in_turn(BEGINNINGS))
def test_a_ray_begins_at_t_min(case, method, where, precision):
    (origin, way), t_min, right = case
    surface = SPHERE if method not in ("double_derivative_bisection", "sphere_tracing") else SQUARES
    surface = surfaces.get("sphere") if method == "sphere_tracing" else surface
    hits = cast_from(opened(where), method, surface, _rays(origin, [way]), precision, t_min)
    if hits is None:
        return
    assert hits.status[0] == (RayStatus.MISS if right is None else RayStatus.HIT)
    assert right is None or abs(hits.t[0] - right) < 2e-3
    if right == t_min:
        assert hits.t[0] == t_min


def test_a_start_off_the_surface_is_no_start_on_it(device):
    """f of a point one float32 off is not zero, so the method decides; a start outside the domain is on no surface."""
    near = np.nextafter(np.float32(1), np.float32(2))
    hits = cast_from(device, "bernstein", SPHERE, _rays((near, 0, 0), [(1, 0, 0)]), "float32")
    assert hits is not None
    assert hits.status[0] == RayStatus.MISS
    outside = surfaces.from_formula("x + y - 1", "sphere:0.5")
    hits = cast_from(device, "bernstein", outside, _rays((1, 0, 0), [(0, 0, 1)]), "float32")
    assert hits is not None
    assert hits.status[0] == RayStatus.MISS


@pytest.mark.parametrize("t_min", [-1.0, float("nan"), float("inf"), 1e39])
def test_what_is_no_distance_is_refused(t_min):
    plugin = find_methods().get("newton")
    with pytest.raises(FirsthitError, match=r"t_min is|past the range"):
        method_program(plugin.method, plugin.folder, plugin.variant({}), SPHERE, "float32", "cl", "rays", None, t_min)


def test_float32_takes_the_next_number_that_is_not_under_t_min():
    plugin = find_methods().get("newton")
    for t_min in (0.0, 0.1, 0.7, 1e-50, 3.0):
        program = method_program(
            plugin.method, plugin.folder, plugin.variant({}), SPHERE, "float32", "cl", "rays", None, t_min
        )
        text = program.text.split("#define T_MIN ")[1].split()[0]
        least = np.float32(text.rstrip("f"))
        assert float(least) >= t_min
        assert t_min == 0.0 or float(np.nextafter(least, np.float32(-1))) < t_min


@pytest.mark.usefixtures("devices_found_once")
def test_trace_begins_at_t_min(tmp_path):
    np.save(tmp_path / "rays.npy", _rays((-3, 0, 0), [(1, 0, 0)]))
    asked = ["trace", "--formula", "x^2 + y^2 + z^2 - 1", "--method", "newton", "--rays", str(tmp_path / "rays.npy")]
    for t_min, right in (("0", 2.0), ("3", 4.0)):
        assert main([*asked, "-o", str(tmp_path / "hits.npz"), "--t-min", t_min]) == 0
        assert abs(np.load(tmp_path / "hits.npz")["t"][0] - right) < 2e-3


@pytest.mark.parametrize("text", ["-1", "nan", "inf", "near"])
def test_trace_refuses_a_t_min_that_is_none(capsys, text):
    with pytest.raises(SystemExit):
        main(["trace", "--formula", "x", "--method", "newton", "--rays", "r.npy", "-o", "h.npz", f"--t-min={text}"])
    assert "argument --t-min" in capsys.readouterr().err
