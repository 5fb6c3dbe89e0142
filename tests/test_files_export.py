"""Surfaces are written in other programs' languages: read again, or run, they have the same values."""

from __future__ import annotations

import numpy as np
import pytest
import sympy

import surfaces
from harness.contract import Box, FirsthitError, Sphere, Surface
from surfaces import files, formula
from surfaces.files.povray_writing import coefficients
from surfaces.tape import Tape

from .conftest import usable_devices

LLVMPIPE = "opengl:llvmpipe"
HEAD = """#version 430
layout(local_size_x = 1) in;
layout(std430, binding = 0) buffer Points { float points[]; };
layout(std430, binding = 1) buffer Values { float values[]; };
"""
MAIN = """void main() {
    uint i = gl_GlobalInvocationID.x;
    values[i] = f(vec3(points[3u*i], points[3u*i + 1u], points[3u*i + 2u]));
}
"""
POLYNOMIAL = ("cayley", "barth_sextic", "endrass_octic", "chmutov", "torus", "kummer", "plane_squared", "sixteen_ball")
KINKS = (
    "sqrt(max(abs(x) - 0.5, 0)^2 + max(abs(y) - 0.4, 0)^2 + max(abs(z) - 0.3, 0)^2) - 0.1",
    "let d = sqrt(x^2 + y^2 + 0.1); let a = atan2(y, x); (d - 0.7)^2 + (z - sin(3*a)/9)^2*d - 0.09*exp(-d) + d^3*a",
    "if(x > 0.1 and y < z, x^3 - 0.5, floor(3*y) + x) + (x*x + 1)^2.5 + log(z^2 + 1)*tan(x/4) - pi/9 + e/7 + x/3",
    "min(x^2 + y^2 - 1, max(z, cos(5*x)), y) + 1/(x^2 + y^2 + 1)^3",
)
WRITTEN = {name: surfaces.get(name) for name in POLYNOMIAL}
WRITTEN |= {
    f"kinks{i}": surfaces.from_formula(text, Sphere(2.0, (1, 0, 0)), f"kinks{i}") for i, text in enumerate(KINKS)
}


def points_in(surface: Surface, count: int = 300) -> np.ndarray:
    rng = np.random.default_rng(5)
    return np.array(surface.domain.center) + rng.uniform(-1, 1, (count, 3)) * 0.7 * surface.domain.radius


def close(found, expected, tolerance=1e-11) -> None:
    scale = np.abs(expected).max()
    assert np.allclose(found, expected, rtol=tolerance, atol=tolerance * max(1.0, scale))


def graph(tape: Tape) -> set[tuple]:
    """The tape's operations as trees of their own, so that the order of independent ones does not matter."""
    names: list[int] = []
    known: dict[tuple, int] = {}
    for op in tape.ops:
        inputs = tuple(names[i] for i in op.inputs)
        if op.name in ("add", "mul", "min", "max"):
            inputs = tuple(sorted(inputs))
        key = (op.name, inputs, op.args[len(op.inputs) :])
        names.append(known.setdefault(key, hash(key)))
    return {names[i] for i in tape.outputs} | set(names)


def again(surface: Surface, form: str, tmp_path, **given) -> Surface:
    """Write a surface, and read it."""
    path = tmp_path / f"{surface.name}.{form}"
    path.write_text(files.export(surface, form), encoding="utf-8")
    return files.load(path, **given).surface


@pytest.mark.parametrize("name", WRITTEN)
@pytest.mark.parametrize("form", ["jsurf", "pov", "vm"])
def test_what_is_written_has_the_same_values_when_read(name, form, tmp_path):
    surface = WRITTEN[name]
    if form == "jsurf" and surface.degree is None:
        with pytest.raises(FirsthitError, match=f"{name} cannot be written as jsurf: jsurf draws polynomials"):
            files.export(surface, form)
        return
    back = again(surface, form, tmp_path, domain=surface.domain if form == "vm" else None)
    points = points_in(surface)
    close(surfaces.evaluate(back, points), surfaces.evaluate(surface, points))
    assert back.degree == surface.degree or form == "vm"
    if form == "pov":
        assert back.domain == surface.domain
    if form == "jsurf":
        assert isinstance(back.domain, Sphere)
        assert np.isclose(back.domain.radius, surface.domain.radius, rtol=1e-6)


@pytest.mark.parametrize(
    ("form", "text"),
    [
        ("jsurf", "(x^2 + 0.25*y^3)^4 - 2*sqrt(5)*z + 1/3 - (x - y)*z"),
        ("jsurf", "-(x + y)^2 + cos(2)*z^7 - x"),
        ("vm", "let d = sqrt(x^2 + y^2); min(d, 0.5*z) - max(atan2(y, x), -abs(x)) + sin(d)*exp(floor(z)) - 2/7"),
        ("vm", "x^2 + y^2 - 1e-3*z"),
    ],
)
def test_the_same_graph_is_read_again_where_the_language_is_exact(form, text, tmp_path):
    surface = surfaces.from_formula(text, "box:1,1,1", "exact")
    back = again(surface, form, tmp_path)
    assert graph(formula.parse(back.formula, dict(back.parameters))) == graph(formula.parse(text))


def test_a_jsurf_file_keeps_an_off_centre_sphere_and_encloses_a_box(tmp_path):
    sphere = surfaces.from_formula("x^2 + y^2 - z", Sphere(2.0, (1, -2, 0.5)), "a")
    assert again(sphere, "jsurf", tmp_path).domain == sphere.domain
    box = surfaces.from_formula("x^2 + y^2 - z", Box((-1, -1, 0), (1, 1, 4)), "a")
    around = again(box, "jsurf", tmp_path).domain
    assert around.center == (0, 0, 2)
    assert np.isclose(around.radius, 6**0.5)


def test_the_coefficients_of_a_poly_are_the_doubles_next_to_the_exact_ones():
    surface = surfaces.get("barth_sextic")
    found = coefficients(surfaces.tape_of(surface))
    exact = sympy.Poly(sympy.expand(surfaces.expression(surface)), *(sympy.Symbol(a, real=True) for a in "xyz"))
    expected = dict(exact.terms())
    assert found.keys() == expected.keys()
    for powers, value in found.items():
        assert value.numerator / value.denominator == float(expected[powers].evalf(40))


def test_a_polynomial_past_povrays_order_is_an_isosurface(tmp_path):
    surface = surfaces.from_formula("x^40 + y^40 + z^40 - 1", "sphere:2", "super")
    text = files.export(surface, "pov")
    assert "isosurface" in text
    points = points_in(surface) / 2
    close(surfaces.evaluate(again(surface, "pov", tmp_path), points), surfaces.evaluate(surface, points))
    assert "poly {\n  35," in files.export(surfaces.from_formula("x^35 + y - z", "sphere:2", "s"), "pov")


def test_a_tape_has_no_cube_root():
    surface = surfaces.from_formula("abs(x)^(1/3) + y", "sphere:2", "root")
    with pytest.raises(FirsthitError, match="root cannot be written as vm: a tape has no power 1/3"):
        files.export(surface, "vm")


def test_an_equation_that_would_grow_too_long_is_refused():
    steps = "; ".join(f"a{i} = a{i - 1} + y*a{i - 1}*0.5" for i in range(1, 18))
    surface = surfaces.from_formula(f"a0 = x; {steps}; a17", "sphere:1", "grown")
    with pytest.raises(FirsthitError, match="jsurf has no named parts"):
        files.export(surface, "jsurf")
    assert len(files.export(surface, "sympy")) < 4000


@pytest.mark.parametrize("name", [*POLYNOMIAL[:3], "kinks0", "kinks1", "kinks2", "kinks3"])
def test_the_sympy_text_makes_the_expression(name):
    surface = WRITTEN[name]
    made: dict[str, object] = {}
    exec(files.export(surface, "sympy"), made)
    assert made["f"] == surfaces.expression(surface)


@pytest.mark.skipif(LLVMPIPE not in [info.name for info in usable_devices()], reason="no llvmpipe")
def test_the_glsl_function_has_the_surfaces_values():
    moderngl = pytest.importorskip("moderngl")
    context = moderngl.create_standalone_context(backend="egl", require=430)
    for surface in WRITTEN.values():
        points = points_in(surface, 64).astype(np.float32)
        shader = context.compute_shader(HEAD + files.export(surface, "glsl") + MAIN)
        source, target = context.buffer(points.tobytes()), context.buffer(reserve=4 * len(points))
        source.bind_to_storage_buffer(0)
        target.bind_to_storage_buffer(1)
        shader.run(len(points))
        context.finish()
        found = np.frombuffer(target.read(), np.float32)
        expected = surfaces.evaluate(surface, points.astype(np.float64))
        terms = np.abs(expected).max() + np.abs(surfaces.gradient(surface, points.astype(np.float64))).max()
        near = np.abs(found - expected) < 3e-4 * terms
        assert near.mean() > 0.95, surface.name  # a rounded input may be across a jump


def test_an_unknown_form_is_refused():
    with pytest.raises(FirsthitError, match="not written as 'stl'; known: jsurf, pov, vm, sympy, glsl"):
        files.export(surfaces.get("torus"), "stl")


def test_names_and_titles_cannot_leave_their_comments():
    text = "x^2 +\n/* a comment */ y^2 - 1 // the end"
    surface = surfaces.from_formula(text, "sphere:1.5", "a")
    for form in files.FORMS:
        first = files.export(surface, form).splitlines()[0]
        assert first.startswith(("# a: ", "// a: "))
