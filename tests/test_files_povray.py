"""POV-Ray scenes are read: their coefficients, moves and regions; what is no shape is named."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest

import surfaces
from harness.contract import Box, FirsthitError, Sphere
from surfaces.files.monomials import order_of

from .test_files import POINTS, X, Y, Z, load, same

__all__ = ["load"]
CLIP = "clipped_by { sphere { <0, 0, 0>, 2 } }"
# the manual's torus (section "Poly, Cubic and Quartic"): major radius sqrt(40), minor radius sqrt(12), about y
TORUS = "1,0,0,0,2,0,0,2,0,-104,0,0,0,0,0,0,0,0,0,0,1,0,0,2,0,56,0,0,0,0,1,0,-104,0,784"


def torus(x, y, z):
    return (x**2 + y**2 + z**2 + 40 - 12) ** 2 - 4 * 40 * (x**2 + z**2)


@pytest.mark.parametrize(("degree", "count"), [(2, 10), (3, 20), (4, 35), (5, 56), (6, 84), (7, 120), (35, 8436)])
def test_the_number_of_coefficients_is_that_of_the_manual(degree, count):
    assert len(order_of(degree)) == count


def test_the_order_is_that_of_the_manual():
    # the columns of its table: A1, A2, … of the second, third and fifth order
    words = {2: "xx xy xz x yy yz y zz z 1", 3: "xxx xxy xxz xx xyy xyz xy xzz xz x yyy yyz yy yzz yz y zzz zz z 1"}
    for degree, text in words.items():
        assert order_of(degree) == [tuple(word.count(axis) for axis in "xyz") for word in text.split()]
    fifth = order_of(5)  # A41 is y^3, A46 y*z^4, A51 z^5
    assert [fifth[i - 1] for i in (41, 46, 51)] == [(0, 3, 0), (0, 1, 4), (0, 0, 5)]


def test_the_manuals_torus_is_read(load):
    imported = load("torus.pov", f"// a torus\nquartic {{ < {TORUS} > sturm {CLIP} }}")
    same(imported, torus(X, Y, Z))
    assert imported.surface.domain == Sphere(2.0)
    assert imported.remarks == ()
    polynomial = (
        "polynomial { 4, xyz(4,0,0):1, xyz(2,2,0):2, xyz(2,0,2):2, xyz(2,0,0):-104, xyz(0,4,0):1, xyz(0,2,2):2\n"
        "xyz(0,2,0):56, xyz(0,0,4):1, xyz(0,0,2):-104, xyz(0,0,0):784 sturm " + CLIP + " }"
    )
    same(load("a.pov", polynomial), torus(X, Y, Z))


@pytest.mark.parametrize(
    ("kind", "degree"), [("cubic {", 3), ("quartic {", 4), ("poly { 2,", 2), ("poly { 5,", 5), ("poly { 7,", 7)]
)
def test_all_coefficients_have_their_places(load, kind, degree):
    rng = np.random.default_rng(degree)
    values = rng.integers(-9, 10, len(order_of(degree)))
    powers = (p for p in product(range(degree + 1), repeat=3) if sum(p) <= degree)
    names = sorted(powers, reverse=True)  # x falls first, then y, then z
    expected = sum(c * X**i * Y**j * Z**k for c, (i, j, k) in zip(values, names, strict=True))
    imported = load("a.pov", f"{kind} <{', '.join(map(str, values))}> {CLIP} }}")
    assert np.allclose(surfaces.evaluate(imported.surface, POINTS), expected, rtol=1e-9, atol=1e-9 * 2.0**degree)


def test_a_quadric_is_read(load):
    same(load("a.pov", f"quadric {{ <1,2,3>, <4,5,6>, <7,8,9>, -10 {CLIP} }}"),
         X**2 + 2*Y**2 + 3*Z**2 + 4*X*Y + 5*X*Z + 6*Y*Z + 7*X + 8*Y + 9*Z - 10)  # fmt: skip


def turned(axis, degrees, x, y, z):
    """A point turned about an axis: by 90 degrees about z, x goes to y."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return {
        "x": (x, c * y - s * z, s * y + c * z),
        "y": (c * x + s * z, y, c * z - s * x),
        "z": (c * x - s * y, s * x + c * y, z),
    }[axis]


@pytest.mark.parametrize(
    ("moves", "place", "domain"),
    [
        ("translate <1, 2, -3>", lambda x, y, z: (x + 1, y + 2, z - 3), Sphere(2.0, (1, 2, -3))),
        ("scale 2 translate 0.5*z", lambda x, y, z: (2 * x, 2 * y, 2 * z + 0.5), Sphere(4.0, (0, 0, 0.5))),
        ("translate 1 scale <2, 2, 2>", lambda x, y, z: (2 * x + 2, 2 * y + 2, 2 * z + 2), Sphere(4.0, (2, 2, 2))),
        ("rotate <0, 0, 90>", lambda x, y, z: (-y, x, z), Sphere(2.0)),
        ("rotate 30*x", lambda x, y, z: turned("x", 30, x, y, z), Sphere(2.0)),
        ("rotate y*-45", lambda x, y, z: turned("y", -45, x, y, z), Sphere(2.0)),
        ("rotate <20, 0, 50>", lambda x, y, z: turned("z", 50, *turned("x", 20, x, y, z)), Sphere(2.0)),
        ("matrix <0,1,0,-1,0,0,0,0,2,1,2,3>", lambda x, y, z: (1 - y, x + 2, 2 * z + 3), Box((-1, 0, -1), (3, 4, 7))),
        ("scale <1, 2, 1>", lambda x, y, z: (x, 2 * y, z), Box((-2, -4, -2), (2, 4, 2))),
    ],
)  # fmt: skip
def test_moves_carry_the_surface_and_its_region(load, moves, place, domain):
    imported = load("a.pov", f"quartic {{ <{TORUS}> {CLIP} {moves} }}")
    points = np.stack(place(X, Y, Z), axis=1)
    assert np.allclose(surfaces.evaluate(imported.surface, points), torus(X, Y, Z), rtol=1e-9, atol=1e-7)
    assert type(imported.surface.domain) is type(domain)
    expected, found = (
        np.ravel([v for v in vars(d).values()] if isinstance(d, Box) else [d.radius, *d.center])
        for d in (domain, imported.surface.domain)
    )
    assert np.allclose(expected, found, atol=1e-6)
    assert bool(imported.remarks) == isinstance(domain, Box)
    assert imported.surface.degree == 4


def test_an_isosurface_has_its_function_threshold_and_container(load):
    text = """
    #version 3.7;
    #declare R = sqrt(2); #local Half = 1/2;
    #declare Ring = function(x, y, z, size) { pow(sqrt(x*x + y*y) - size, 2) + z*z }
    isosurface {
      function { Ring(x, y, z, R) - Half*select(x, 1, 2) + mod(y, 0.75) - max(x, y, z) + (x > 1 & !0 | y <= 0.5) }
      contained_by { box { <-1, -2, -3>, <3, 2, 1> } }
      threshold 0.25 accuracy 0.001 max_gradient 4 open
      pigment { rgb 1 } translate <1, 0, 0>
    }"""
    text = text.replace("& !0 ", "& z < 9 ")
    imported = load("iso.pov", text)
    x = X - 1
    values = (np.sqrt(x**2 + Y**2) - np.sqrt(2)) ** 2 + Z**2 - 0.5 * np.where(x < 0, 1, 2) + np.fmod(Y, 0.75)
    same(imported, values - np.maximum(np.maximum(x, Y), Z) + ((x > 1) | (Y <= 0.5)) - 0.25)
    assert imported.surface.domain == Box((0, -2, -3), (4, 2, 1))
    assert imported.remarks == ("left out: pigment (how it looks, and other shapes)",)


@pytest.mark.parametrize(
    ("regions", "domain"),
    [
        ("", Box((-1, -1, -1), (1, 1, 1))),
        ("threshold 1 open contained_by { sphere { 0, 3 } }", Sphere(3.0)),
        ("contained_by { box { <-1, 0, -2>*2, 3*y + 1 } }", Box((-2, 0, -4), (1, 4, 1))),
        ("contained_by { sphere { <0,0,0>, 3 } } bounded_by { box { -1, 2 } }", Sphere(3.0)),
        ("clipped_by { box { -1, 1 scale 2.5 translate x } }", Box((-1.5, -2.5, -2.5), (3.5, 2.5, 2.5))),
        ("bounded_by { sphere { <0,0,0>, 3 } } clipped_by { sphere { <0,0,1>, 2 } }", Sphere(2.0, (0, 0, 1))),
        ("clipped_by { sphere { <0,0,1>, 2 } } bounded_by { clipped_by }", Sphere(2.0, (0, 0, 1))),
    ],
)
def test_the_region_that_cuts_the_surface_is_its_domain(load, regions, domain):
    imported = load("a.pov", f"isosurface {{ function {{ x*x - y }} {regions} }}")
    assert imported.surface.domain == domain
    same(imported, X**2 - Y - ("threshold" in regions))


def test_csg_other_shapes_and_looks_are_named_once_each(load):
    text = f"""
    #include "colors.inc"
    camera {{ location <0, 0, -5> }} light_source {{ <1, 1, 1> rgb 1 }} light_source {{ <2, 1, 1> rgb 1 }}
    #declare Look = texture {{ pigment {{ rgb <1, 0, 0> }} }}
    #declare Hole = quadric {{ <1,1,1>, <0,0,0>, <0,0,0>, -1 {CLIP} }}
    difference {{
      quartic {{ <{TORUS}> {CLIP} texture {{ Look }} }}
      object {{ Hole scale 0.5 }}
      sphere {{ <0, 0, 0>, 1 }}
      translate <0, 0, 1>
    }}"""
    imported = load("scene.pov", text)
    same(imported, torus(X, Y, Z - 1))
    assert imported.remarks == (
        'left out: #include "colors.inc" (no other file is opened)',
        "the file has 3 shapes (quartic, Hole, Hole); the first is taken, and scene.pov#NAME or a number behind it"
        " takes another",
        "left out: difference (a shape is read alone, without what it is combined with)",
        "left out: camera, light_source, texture, sphere (how it looks, and other shapes)",
    )
    same(load("scene.pov", text, "2"), 4 * (X**2 + Y**2 + (Z - 1) ** 2) - 1)
    same(load("scene.pov", text, "3"), X**2 + Y**2 + Z**2 - 1)


def test_a_polynomial_without_a_region_says_which_domain_it_gets(load):
    imported = load("a.pov", "quadric { <1,-1,0>, <0,0,0>, <0,0,0>, 0 }")  # two planes, which no box holds
    assert imported.surface.domain == Sphere(1.5)
    assert "no box that holds the surface was found: sphere:1.5 is taken" in imported.remarks[0]
    assert load("a.pov", "quadric { <1,-1,0>, <0,0,0>, <0,0,0>, 0 }", domain="sphere:3").surface.domain == Sphere(3.0)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("sphere { 0, 1 }", r"has none of cubic, quartic.*\(it has sphere\)"),
        ("cubic { <1, 2> }", "line 1: a cubic of order 3 has 20 coefficients, not 2"),
        ("\npoly { 36, <1> }", "line 2: poly has a whole order from 2 to 35"),
        (f"cubic {{ <{','.join('0' * 20)}> }}", "all coefficients of this cubic are 0"),
        ("#while (1) #end", "line 1: #while is not run"),
        ("#macro M() #end", "#macro is not run"),
        ("isosurface { function { x^2 } }", r"line 1: '\^' is not read: .* write pow\(a, b\)"),
        ("isosurface { function { f_torus(x,y,z,1,2) } }", "f_torus is not read: give it as a formula"),
        ('isosurface { function { pigment { image_map { "a.png" } } } }', "unknown name 'pigment'"),
        (f"quartic {{ <{TORUS}> matrix <1,0,0,0,0,0,0,0,0,0,0,0> }}", "has no inverse"),
        (f"quartic {{ <{TORUS}> scale 0 }}", "scale by 0"),
        (f"quartic {{ <{TORUS}> ", "expected '}', found the end"),
        ("camera { ", "this '{' has no '}'"),
        ("/* ", "has no end"),
    ],
)
def test_what_a_scene_cannot_have_is_named(load, text, said):
    with pytest.raises(FirsthitError, match=said):
        load("a.pov", text)
