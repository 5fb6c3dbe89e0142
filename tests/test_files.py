"""Files of other programs are read as those programs read them; what cannot be carried over is named."""

from __future__ import annotations

import json

import numpy as np
import pytest

import surfaces
from harness.contract import Box, FirsthitError, Sphere
from surfaces import files

POINTS = np.random.default_rng(1).uniform(-2.0, 2.0, (200, 3))
X, Y, Z = POINTS.T


@pytest.fixture
def load(tmp_path):
    """Write a file and read it: load("a.vm", text) → Imported."""

    def read(name: str, text: str | bytes, part: str = "", **given):
        path = tmp_path / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return files.load(f"{path}{part and '#'}{part}", **given)

    return read


def same(imported, values) -> None:
    """The surface's values are these at POINTS."""
    assert np.allclose(surfaces.evaluate(imported.surface, POINTS), values, rtol=1e-12, atol=1e-11)


# .jsurf


def test_a_jsurf_file_has_its_equation_parameters_and_the_sphere_it_is_clipped_by(load):
    text = (
        "# by hand\nsurface_equation=x^2+y^2*a-(z-b)^3*2\nsurface_parameter_a=0.5\nsurface_parameter_b=-1e-1\n"
        "surface_parameter_unused=3\nscale_factor=0.3\ncamera_type=ORTHOGRAPHIC_CAMERA\nlight_status_0=ON\n"
    )
    imported = load("some surface.jsurf", text)
    same(imported, X**2 + Y**2 * 0.5 - (Z + 0.1) ** 3 * 2)
    assert imported.surface.name == "some_surface"
    assert imported.surface.domain == Sphere(10**0.3)  # jsurf: FileFormat scales by 10^scale_factor
    assert dict(imported.surface.parameters) == {"a": "0.5", "b": "-1e-1"}
    assert imported.remarks == (
        "left out: surface_parameter_unused (the equation does not name it)",
        "left out: camera_…, light_… (what concerns the picture)",
    )


def test_a_jsurf_parameter_may_have_any_name_and_be_replaced(load):
    values = "surface_parameter_e=2\nsurface_parameter_sqrt2=3\nsurface_parameter_pi=1"
    text = f"surface_equation=x^2+e*y^2+sqrt2*z-pi\n{values}"
    same(load("a.jsurf", text), X**2 + 2 * Y**2 + 3 * Z - 1)
    same(load("a.jsurf", text, parameters={"e": "5"}), X**2 + 5 * Y**2 + 3 * Z - 1)
    with pytest.raises(FirsthitError, match="there is no parameter 'q'"):
        load("a.jsurf", text, parameters={"q": 1})


def test_properties_are_read_as_java_reads_them(load):
    text = "! comment\n surface_equation : x^2 \\\n   + y^2 - z\nscale_factor 0\nsurface_parameter_a=0\\=1"
    with pytest.raises(FirsthitError, match=r"a\.jsurf, line 5: '0=1' is not a decimal number"):
        load("a.jsurf", text)
    same(load("a.jsurf", text.replace("0\\=1", "0")), X**2 + Y**2 - Z)


def test_a_jsurf_sphere_may_be_moved_and_stretched(load):
    moved = "surface_transform_matrix=0 2 0 1  -2 0 0 0  0 0 2 -1  0 0 0 1\nscale_factor=1\nsurface_equation=x"
    assert load("a.jsurf", moved).surface.domain == Sphere(20.0, (1.0, 0.0, -1.0))
    stretched = load("a.jsurf", moved.replace("0 2 0 1", "0 3 0 1"))
    assert stretched.surface.domain == Sphere(10 * 17**0.5, (1.0, 0.0, -1.0))
    assert "ellipsoid" in stretched.remarks[0]


# surf scripts


def test_a_surf_script_is_run_as_its_manual_says(load):
    text = """
    // two declarations
    int n = 3;  double Pi = 2*arccos(0);  poly f1 = x*y*z;
    poly f2;
    f2 = f1^2 - n/2*x;      /* a quotient of whole numbers is a fraction */
    f2 = f2 + deg(f1)*z - 7 % 4;
    width = 400; surface_red = 2*255; rot_x = Pi/2;
    loop:
    surface = -f2 + cos(Pi)*y;
    clear_screen;
    draw_surface;
    """
    imported = load("a.pic", text)
    same(imported, -((X * Y * Z) ** 2 - 1.5 * X + 3 * Z - 3) - Y)
    assert imported.surface.domain == Sphere(10.0)
    assert imported.remarks == ("left out: width, surface_red (what concerns the picture)",)


@pytest.mark.parametrize(
    ("clipping", "domain", "said"),
    [
        ("radius = 9; scale_x = 0.25; scale_y = 0.25; scale_z = 0.25;", Sphere(2.25), ""),
        ("clip = cube; radius = 7; center_x = -3; center_y = 2;", Box((-10, -5, -7), (4, 9, 7)), ""),
        ("center_z = 1; scale_z = 2;", Sphere(20.0, (0, 0, 2)), "ellipsoid"),
        ("clip = none; radius = 3;", Sphere(3.0), "clip = none"),
        ("clip = cube; rot_x = 1; radius = 2;", Sphere(2 * 3**0.5), "turned"),
        ("clip_front = 4; origin_x = 1;", Sphere(10.0), "clip_front"),
    ],
)
def test_a_surf_script_says_where_it_is_clipped(load, clipping, domain, said):
    imported = load("a.surf", f"surface = x^2 + y^2 + z^2 - 1; {clipping}")
    assert imported.surface.domain == domain
    assert said in "; ".join(imported.remarks)
    assert bool(said) == bool(imported.remarks)


def test_one_of_several_surfaces_is_chosen_by_name_or_number(load):
    text = "surface = x; surface2 = y; draw_surface; surface = z; draw_surface;"
    imported = load("a.pic", text)
    same(imported, X)
    assert imported.remarks[0].startswith(
        "the file has 2 surfaces (surface, surface2); the first is taken, and a.pic#NAME"
    )
    assert imported.remarks[1] == "the script draws 2 pictures; the first is taken"
    same(load("a.pic", text, "surface2"), Y)
    same(load("a.pic", text, "2"), Y)
    with pytest.raises(FirsthitError, match="there is no surface 'surface3'; did you mean"):
        load("a.pic", text, "surface3")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            "int i = 0;\nloop:\nsurface = x - i;\nif( i < 5 ) goto loop;",
            "line 4: 'if': conditions and loops are not run",
        ),
        ("curve = y^2 - x^3; draw_curve;", "draws a plane curve and no surface"),
        ("surface = rotate(x, 1.0, x);", "rotate takes xAxis, yAxis, zAxis, not 'x'"),
        ("surface = diff(x^2, x);", "line 1: diff is not read: write the derivative"),
        ("int n = 3.5; surface = x;", "int n is given 7/2"),
        ("poly f = x; poly f = y;", "'f' is declared twice"),
        ("surface = x^2 +;", r"line 1: expected a number, a name or '\('"),
        ("surface = x % 2;", "% is read between whole numbers only"),
        ("surface = x $ y;", r"'\$' \(U\+0024\) has no place here"),
    ],
)
def test_what_a_surf_script_cannot_have_is_named_with_its_line(load, text, said):
    with pytest.raises(FirsthitError, match=said):
        load("a.pic", text)


def test_a_polynomial_is_turned_with_the_parts_that_it_names(load):
    text = """
    double a = 0.5;  poly f = x + 2*a*z;  polyxyz g = f^2 - 3*y;
    poly h = rotate(g*x, 0.25, zAxis) + f;
    surface = rotate(h, -1, xAxis);
    surface = surface + rotate(f, a, yAxis);
    """

    def f(x, y, z):  # noqa: ARG001
        return x + z

    def h(x, y, z):
        turned = x * np.cos(0.25) + y * np.sin(0.25), y * np.cos(0.25) - x * np.sin(0.25)
        return (f(turned[0], 0, z) ** 2 - 3 * turned[1]) * turned[0] + f(x, y, z)

    y, z = Y * np.cos(-1) + Z * np.sin(-1), Z * np.cos(-1) - Y * np.sin(-1)
    x_, z_ = X * np.cos(0.5) + Z * np.sin(0.5), Z * np.cos(0.5) - X * np.sin(0.5)
    same(load("a.pic", text), h(X, y, z) + f(x_, Y, z_))


# tapes

TAPE = {
    "neg": -X, "abs": np.abs(X), "recip": 1 / X, "sqrt": None, "square": X**2, "floor": np.floor(X),
    "ceil": np.ceil(X), "round": np.copysign(np.floor(np.abs(X) + 0.5), X), "sin": np.sin(X), "cos": np.cos(X),
    "tan": None, "exp": np.exp(X), "atan": np.arctan(X), "not": np.zeros(200), "ln": None, "asin": None, "acos": None,
}  # fmt: skip


@pytest.mark.parametrize("word", [word for word, expected in TAPE.items() if expected is not None and word != "recip"])
def test_each_operation_of_one_value_is_read(load, word):
    same(load("a.vm", f"a var-x\nb {word} a\nc var-y\nd add b c\n"), TAPE[word] + Y)


@pytest.mark.parametrize(
    ("word", "function"), [("asin", np.arcsin), ("acos", np.arccos), ("ln", np.log), ("recip", np.reciprocal)]
)
def test_operations_that_need_an_interval_are_read(load, word, function):
    text = f"a var-x\ns square a\no const 1\nw const 2\np add s w\nq div o p\nb {word} q\nc var-y\nd add b c\n"
    same(load("a.vm", text), function(1 / (X**2 + 2)) + Y)


@pytest.mark.parametrize(
    ("word", "expected"),
    [
        ("add", X + Y), ("sub", X - Y), ("mul", X * Y), ("min", np.minimum(X, Y)), ("max", np.maximum(X, Y)),
        ("atan2", np.arctan2(X, Y)), ("compare", np.sign(X - Y)), ("and", Y), ("or", X),
    ],
)  # fmt: skip
def test_each_operation_of_two_values_is_read(load, word, expected):
    same(load("a.vm", f"a var-x\nb var-y\nc var-z\nd {word} a b\ne add d c\n"), expected + Z)


def test_the_remainder_of_a_tape_is_not_negative(load):
    same(load("a.vm", "a var-x\nb var-y\nm const -0.75\nd mod a m\ne add d b\n"), np.mod(X, 0.75) + Y)


def test_a_tape_without_z_is_a_prism_and_its_last_line_counts(load):
    imported = load(
        "a.vm", "# a comment\n\n0x1 var-x\n0x2 square 0x1\ny var-y\nr add 0x2 y\nf const -1e-1\nout sub r f\n"
    )
    same(imported, X**2 + Y + 0.1)
    assert imported.surface.domain == Box((-1, -1, -1), (1, 1, 1))
    assert "does not read z: the surface is a prism along it" in imported.remarks[1]


def test_a_long_tape_is_read(load):
    lines = ["_0 var-x", "_1 var-y"]
    for i in range(2, 10_002):
        word = ("add", "min", "sub", "max")[i % 4]
        lines.append(f"_{i} {word} _{i - 1} _{i // 3}")
    imported = load("a.vm", "\n".join(lines))
    x, y = X.copy(), Y.copy()
    values = [x, y]
    apply = (np.add, np.minimum, np.subtract, np.maximum)
    for i in range(2, 10_002):
        values.append(apply[i % 4](values[i - 1], values[i // 3]))
    assert np.allclose(surfaces.evaluate(imported.surface, POINTS), values[-1], rtol=1e-9)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("a var-x\nb sqare a\n", "line 2: 'sqare' is no operation of a tape; did you mean 'square'"),
        ("a var-x\nb add a\n", "line 2: add takes 2 words, not 1"),
        ("a var-x\nb add a c\n", "line 2: c has no value yet"),
        ("a var-x\na var-y\n", "line 2: a has a value already, since line 1"),
        ("a const inf\n", "line 1: 'inf' is not a decimal number"),
        ("a const 1\n", "reads no var-x"),
        ("# nothing\n", "has no operations"),
    ],
)
def test_a_bad_tape_is_refused_with_its_line(load, text, said):
    with pytest.raises(FirsthitError, match=said):
        load("a.vm", text)


# isosurface models

LIMITS = {f"{axis}{end}": [value] for axis in "XYZ" for end, value in (("min", "-2"), ("max", "2"))}


def test_a_model_has_constants_functions_and_limits(load):
    model = {
        "Name": ["Twisted"],
        "Component": ["One"],
        "Const": ["N=5", "A = N*pi/10", "R=0DOTSYMBOL5"],
        "Funct": ["Ball = (x*x + y*y + z*z - R)", "Ball = Ball(y, x, 2*z, t) + t"],
        "Fxyz": ["Ball(x,y,z,t)\n + cos(A)"],
        **LIMITS,
        "Xmax": ["A+4*sin(t*pi)+2"],
        "Grid": ["50"],
    }
    text = json.dumps({"MathModels": [{"Iso3D": model, "Texture": {}}]}).replace("\\n", "\n")
    imported = load("a.json", text)
    same(imported, X**2 + Y**2 + 4 * Z**2 - 0.5)
    assert imported.surface.domain == Box((-2, -2, -2), (np.pi / 2 + 2, 2, 2))
    assert imported.surface.name == "Twisted"
    moving = "t is time, and a parameter here: 0 unless another moment is given"
    assert imported.remarks == ("left out: Texture (how it looks and moves)", moving)
    same(load("a.json", text, parameters={"t": "0.25"}), X**2 + Y**2 + 4 * Z**2 - 0.25)
    model["Funct"][1] = "Ball = Ball(y, x, 2*z, t)"  # t is handed on, and changes nothing
    still = load("a.json", json.dumps({"Iso3D": model}))
    assert not still.remarks
    assert not still.surface.parameters


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("if(x > 0 & !(y < 1 | z = 3), x, y)", np.where((X > 0) & ~((Y < 1) | (Z == 3)), X, Y)),
        ("if(x, y, z)", np.where(np.abs(X) >= 0.5, Y, Z)),
        ("x % 0.75 + y", np.fmod(X, 0.75) + Y),
        ("int(x) + y", np.copysign(np.floor(np.abs(X) + 0.5), X) + Y),
        ("-2^-x^2 + y", -(2.0 ** -(X**2)) + Y),
        ("2*(x > y) + z", 2 * (X > Y) + Z),
        ("atan2(y, x) + hypot(x, y) - cbrt(z)", np.arctan2(Y, X) + np.hypot(X, Y) - np.cbrt(Z)),
        ("sinh(x)*cosh(y) - tanh(z)", np.sinh(X) * np.cosh(Y) - np.tanh(Z)),
        ("trunc(x) + ceil(y) - pow(z, 3)", np.trunc(X) + np.ceil(Y) - Z**3),
    ],
)
def test_expressions_mean_what_fparser_says(load, text, expected):
    same(load("a.json", json.dumps({"Iso3D": {"Fxyz": [text], **LIMITS}})), expected)


def test_a_component_is_chosen_and_its_condition_named(load):
    model = {"Name": ["M"], "Component": ["A", "B"], "Fxyz": ["x", "y"], "Cnd": ["z>0", ""]}
    model |= {key: [*value, "1" if "max" in key else "-1"] for key, value in LIMITS.items()}
    text = json.dumps({"Iso3D": model})
    imported = load("a.json", text)
    assert "the file has 2 surfaces (M/A, M/B)" in imported.remarks[0]
    assert imported.remarks[1] == "left out: Cnd 'z>0' (it cuts the surface)"
    other = load("a.json", text, "M/B")
    same(other, Y)
    assert other.surface.domain == Box((-1, -1, -1), (1, 1, 1))


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ('{"Iso3D": ', "line 1: this is no JSON"),
        ('{"Param3D": {"Fx": ["u"]}}', "parametric surfaces"),
        ('{"a": 1}', "it has no Iso3D"),
        ('{"Iso3D": {"Fxyz": ["x"]}}', "Xmin has no entry"),
        ('{"Iso3D": {"Fxyz": [["x"]]}}', "Fxyz of the model is a list of texts"),
        ('{"Iso3D": {"Fxyz": ["x + NoiseW(x,y,z,1,2,0)"]}}', "Fxyz of 1: NoiseW is not read: noise"),
        ('{"Iso3D": {"Funct": ["nothing"], "Fxyz": ["x"]}}', "Funct has NAME=VALUE"),
        ('{"Iso3D": {"Fxyz": ["x +* y"]}}', r"Fxyz of 1: expected a number"),
        ("[" * 100_000, "no JSON"),
    ],
)
def test_a_bad_model_is_refused(load, content, said):
    with pytest.raises(FirsthitError, match=said):
        load("a.json", content)
