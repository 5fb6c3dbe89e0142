"""Which formulas are proved to be distance bounds, and that a wrong distance is found before a program uses it."""

from __future__ import annotations

import dataclasses
import random
import re

import numpy as np
import pytest

import surfaces
from harness.accuracy.judge import judge, judged
from harness.cli import main
from harness.contract import FirsthitError, View
from harness.kernels.assemble import method_program
from harness.oracle import first_hits
from harness.oracle.stated_distance import refutation
from harness.plugins import find_methods
from harness.running.trace import Caster, cast
from harness.scenes.camera import camera_for, rays_of
from surfaces import formula
from surfaces.evaluation import evaluate_tape
from surfaces.model import Box, Sphere
from surfaces.proofs.lipschitz import is_distance_bound

from .conftest import usable_devices
from .distance_functions import random_shape

SPHERE = "(sqrt(x^2 + y^2 + z^2) - 1)"
OTHER = "(sqrt((x - 0.5)^2 + y^2 + z^2) - 0.4)"
TORUS = "(sqrt((sqrt(x^2 + y^2) - 0.8)^2 + z^2) - 0.3)"
BOX = (
    "(length(max(abs(x) - 0.5, 0), max(abs(y) - 0.4, 0), max(abs(z) - 0.3, 0))"
    " + min(max(abs(x) - 0.5, abs(y) - 0.4, abs(z) - 0.3), 0) - 0.05)"
)
CAPSULE = "(length(x, y, max(abs(z) - 0.5, 0)) - 0.2)"
CONE = "max(0.8*length(x, y) + 0.6*z, -z - 0.5)"
SMOOTH = f"let a = {SPHERE}; let b = {OTHER}; let k = 0.3; "

BOUNDS = {  # each with what makes it one
    "coordinates": "0.6*x + 0.8*z - 0.1",
    "parts of disjoint coordinates": "0.8*length(x, y) + 0.6*z - 0.2",
    "irrational factors": "(x + y + z)/sqrt3",
    "slopes of a quadric in the domain": "(x^2 + y^2 + z^2 - 1)/4",
    "a norm of fourth powers": "(x^4 + y^4 + z^4)^(1/4) - 1",
    "waves": "sin(x)/2 + cos(y)/2",
    "sphere": SPHERE,
    "torus": TORUS,
    "box": BOX,
    "capsule": CAPSULE,
    "cone": CONE,
    "union, intersection, difference": f"max(min({TORUS}, {BOX}, {CAPSULE}), -({OTHER}), {CONE})",
    "hollow and grown": f"|{TORUS} - 0.1| - 0.05",
    "exponential smooth minimum": f"-log(exp(-8*{SPHERE}) + exp(-8*{TORUS}) + exp(-8*{BOX}))/8",
    "quadratic smooth minimum": SMOOTH + "min(a, b) - max(k - |a - b|, 0)^2/(4*k)",
    "cubic smooth minimum": SMOOTH + "min(a, b) - max(k - |a - b|, 0)^3/(6*k^2)",
    "mixed smooth minimum": SMOOTH + "let h = clamp(0.5 + 0.5*(b - a)/k, 0, 1); mix(b, a, h) - k*h*(1 - h)",
    "smooth maximum": SMOOTH + "max(a, b) + max(k - |a - b|, 0)^2/(4*k)",
    "gradients on boxes": "(x^3 + y^3 + z^3 - 3*x*y*z)/20",
}
NO_BOUNDS = {
    "a stretched sphere": "sqrt(2*x^2 + y^2) - 1",
    "a quadric": "x^2 + y^2 + z^2 - 1",
    "a hundredth too much": f"1.01*{SPHERE}",
    "a slope along the radius": f"{SPHERE} + 0.1*x",
    "a sum of distances": f"{SPHERE} + {TORUS}",
    "parts that share coordinates": "length(x, y) + |z| - 1",
    "a box of sums": "max(|x| - 0.5, 0) + max(|y| - 0.5, 0)",
    "a difference of exponentials": "log(exp(4*x) - exp(-9*y)/9 + 40)",
    "too smooth a minimum": SMOOTH + "min(a, b) - max(k - |a - b|, 0)^2*4",
    "a mix of another width": SMOOTH + "let h = clamp(0.5 + 0.5*(b - a)/k, 0, 1); mix(b, a, h) - 4*k*h*(1 - h)",
    "a jump": "if(x > 0, x - 0.5, x - 0.6)",
    "a step": "floor(x)",
}


@pytest.mark.parametrize("text", BOUNDS.values(), ids=BOUNDS.keys())
def test_distance_bounds_are_proved(text: str) -> None:
    assert is_distance_bound(formula.parse(text), Sphere(1.5))


@pytest.mark.parametrize("text", NO_BOUNDS.values(), ids=NO_BOUNDS.keys())
def test_what_is_no_distance_bound_is_not_proved(text: str) -> None:
    assert not is_distance_bound(formula.parse(text), Sphere(1.5))


def test_a_bound_holds_in_the_domain_that_it_was_proved_for() -> None:
    tape = formula.parse("(x^2 + y^2 + z^2 - 1)/4")  # its slope is r/2
    assert is_distance_bound(tape, Sphere(1.8)) and not is_distance_bound(tape, Sphere(2.01))


def test_random_distance_functions_are_proved_and_steeper_ones_are_not() -> None:
    """Trees of primitives, smooth unions, differences, hollow and grown ones; numpy knows nothing of the proof."""
    rng = np.random.default_rng(4)
    for seed in range(60):
        pick = random.Random(seed)
        shape = random_shape(pick, pick.randint(1, 6))
        assert is_distance_bound(formula.parse(shape.text), Sphere(1.5)), shape.text
        p, q = rng.uniform(-1.5, 1.5, (2, 500, 3))
        steepness = float((np.abs(shape.field(p) - shape.field(q)) / np.linalg.norm(p - q, axis=1)).max())
        assert steepness <= 1.0 + 1e-12
        steeper = f"{1.05 / max(steepness, 0.5)!r}*({shape.text})"
        assert not is_distance_bound(formula.parse(steeper), Sphere(2.7)), steeper


def test_random_formulas_that_are_proved_are_bounds() -> None:
    pick, rng, proved = random.Random(5), np.random.default_rng(5), 0

    def tree(depth: int) -> str:
        if not depth:
            return pick.choice(["x", "y", "z", "0.3", "(x - 0.5)", "(0.6*x + 0.8*y)"])
        a, b = tree(depth - 1), tree(depth - 1)
        return pick.choice(
            [f"(0.5*{a} + 0.5*{b})", f"(0.6*{a} - 0.8*{b})", f"min({a}, {b})", f"max({a}, 0)", f"|{a}|", f"sin({a})",
             f"sqrt({a}^2 + {b}^2 + 0.01)", f"0.3*{a}^2", f"length({a}, {b})", f"{a}*{b}/3", f"exp({a})/4",
             f"log({a}^2 + 1)", f"(min({a}, {b}) - max(0.2 - |{a} - {b}|, 0)^2)", f"{a}/(2 + {b}^2)"]
        )  # fmt: skip

    for _ in range(120):
        text = tree(3)
        tape = formula.parse(text)
        if tape.constants()[tape.outputs[0]] or not is_distance_bound(tape, Box((-1, -1, -1), (1, 1, 1))):
            continue
        proved += 1
        p = rng.uniform(-1, 1, (800, 3))
        q = np.clip(p + rng.normal(size=(800, 3)) * rng.choice([1.0, 1e-2, 1e-4], (800, 1)), -1, 1)
        value = evaluate_tape(tape, np.vstack([p, q]))[:, 0]
        gap = np.abs(value[:800] - value[800:]) - np.linalg.norm(p - q, axis=1)
        assert (gap <= 1e-9).all(), text
    assert proved > 20


def test_a_formula_that_is_its_own_distance_says_so_and_a_flat_one_does_not() -> None:
    assert surfaces.from_formula(SPHERE).distance == SPHERE
    assert surfaces.from_formula("x^2 + y^2 + z^2 - 1").distance is None
    assert surfaces.from_formula(f"0.001*{SPHERE}").distance is None  # |f| is small far from the surface too


WRONG = {  # f, a distance of it, and what is said
    "too long by a hundredth": ("x^2 + y^2 + z^2 - 1", "1.01*(length(x, y, z) - 1)", "where the surface is"),
    "too long at one end": ("x^2 + y^2 + z^2 - 1", "length(x, y, z) - 1 + max(x - 0.9, 0)/100", "where the surface is"),
    "no distance": ("x^2 + y^2 + z^2 - 1", "x^2 + y^2 + z^2 - 1", "where the surface is"),
    "f of an ellipsoid": ("4*x^2 + y^2 + z^2 - 1", "sqrt(4*x^2 + y^2 + z^2) - 1", "where the surface is"),
    "another sign": ("x^2 + y^2 + z^2 - 1", "1 - length(x, y, z)", "its sign must be f's"),
}
RIGHT = [
    ("x^2 + y^2 + z^2 - 1", "length(x, y, z) - 1"),
    ("x^2 + y^2 + z^2 - 1", "(x^2 + y^2 + z^2 - 1)/4"),
    ("4*x^2 + y^2 + z^2 - 1", "(sqrt(4*x^2 + y^2 + z^2) - 1)/2"),
    ("|x| + |y| + |z| - 1", "(|x| + |y| + |z| - 1)/sqrt(3)"),
]


@pytest.mark.parametrize(("text", "distance", "message"), WRONG.values(), ids=WRONG.keys())
def test_a_wrong_distance_is_refuted_with_a_point(text: str, distance: str, message: str) -> None:
    surface = surfaces.from_formula(text, distance=distance)
    told = refutation(surface)
    assert told and message in told
    stated, x, y, z = map(float, re.search(r" is (\S+) at \((\S+), (\S+), (\S+)\)", told).groups())
    field = formula.parse(distance)
    assert abs(evaluate_tape(field, np.array([[x, y, z]]))[0, 0]) == pytest.approx(abs(stated), 1e-3)
    if message == "where the surface is" and text.startswith("x^2"):
        assert abs(stated) > abs(np.linalg.norm([x, y, z]) - 1.0)  # by the sphere's own distance
    method = find_methods().get("sphere_tracing")
    with pytest.raises(FirsthitError, match="distance stated"):
        method_program(method.method, method.folder, method.variant({}), surface, "float32", "cl", "rays")


@pytest.mark.parametrize(("text", "distance"), RIGHT)
def test_a_right_distance_is_accepted(text: str, distance: str) -> None:
    assert refutation(surfaces.from_formula(text, distance=distance)) is None


def test_a_distance_goes_with_a_formula_and_must_have_values(capsys) -> None:
    with pytest.raises(FirsthitError, match="distance: sqrt needs"):
        surfaces.from_formula("x^2 + y^2 - 1", distance="sqrt(x) - 1")
    command = ["--method", "sphere_tracing", "-o", "a.png", "--distance", "x"]
    assert main(["show", "--surface", "torus", *command]) == 2
    assert "--distance goes with --formula" in capsys.readouterr().err


@pytest.mark.usefixtures("devices_found_once")
def test_show_names_the_point_where_a_stated_distance_is_wrong(tmp_path, capsys) -> None:
    device = usable_devices()[0].name
    options = ["--method", "sphere_tracing", "--device", device, "--size", "16", "-o", str(tmp_path / "a.png")]
    wrong = ["show", "--formula", "x^2 + y^2 + z^2 - 1", "--distance", "1.5*(length(x, y, z) - 1)", *options]
    assert main(wrong) == 2
    assert re.search(r"the distance stated of formula is \S+ at \(", capsys.readouterr().err)
    assert main([w.replace("1.5*", "0.9*") for w in wrong]) == 0


def _wrong(surface, method: str, **knobs: float) -> int:
    """How many clear rays of two views, the second from within the domain, a method answers wrongly."""
    device, found = usable_devices()[0].name, find_methods().get(method)
    views = View("far", azimuth=20, elevation=25), View("near", azimuth=5, elevation=-5, distance=0.4)
    rays = np.concatenate([rays_of(camera_for(view, surface), 32) for view in views])
    truth = first_hits(surface, rays)
    verdicts = judge(cast(Caster(found, found.variant(knobs), device), surface, rays), truth, 1.0, 1e-3, "float32")
    assert (truth.status != 4).all() and judged(truth, verdicts).sum() > 1000
    return int((verdicts.wrong[judged(truth, verdicts)] != 0).sum())


THREE = "min(length(x - 0.8, y, z) - 0.2, length(x, y - 0.1, z) - 0.2, length(x + 0.8, y - 0.2, z) - 0.2)"


@pytest.mark.parametrize(
    ("text", "domain"),
    [
        (THREE, "sphere:1.3"),  # three minima along a line: two starts would pass the third
        (TORUS, "sphere:0.5,0.3,0:0.9"),  # t_M is nearest to the torus's centre, not to the domain's
        (BOUNDS["mixed smooth minimum"], "sphere:0.2,0,0:1.4"),
        (f"min({BOX}, {CAPSULE}, {CONE})", "box:0.9,0.9,0.9"),
    ],
)
def test_distance_functions_are_drawn_by_sphere_tracing(text: str, domain: str) -> None:
    surface = surfaces.from_formula(text, domain)
    assert surface.distance
    for starts in (1, 2):
        assert _wrong(surface, "sphere_tracing", RAYS=starts) == 0


def test_two_starts_are_for_spheres_and_tori_about_the_origin() -> None:
    tables = find_methods().get("sphere_tracing").method.tables

    def starts(surface) -> float:
        return tables(surface, {}, "float32")["STARTS"][0]

    assert starts(surfaces.get("torus")) == starts(surfaces.get("horn_torus")) == starts(surfaces.get("sphere")) == 2.0
    assert starts(surfaces.from_formula("sqrt((sqrt(x^2+y^2)-0.5)^2+z^2)-0.2")) == 2.0
    assert starts(surfaces.from_formula(OTHER)) == starts(surfaces.from_formula(THREE)) == 1.0


def test_meshes_are_measured_by_distances_that_are_exact_only() -> None:
    pytest.importorskip("pyvista")
    from harness.scenes.meshes import _parametric, geometric_error

    torus = surfaces.get("torus")
    half = dataclasses.replace(torus, distance=f"({torus.distance})/2")
    made = _parametric(torus, 32)
    assert geometric_error(half, made)[0] > 0.9 * geometric_error(torus, made)[0]
