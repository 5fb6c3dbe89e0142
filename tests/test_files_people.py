"""Files are read as people's editors and programs leave them: encodings, escapes, comments, empty and single files."""

import json

import numpy as np
import pytest

import surfaces
from harness.cli import main
from harness.contract import Box, FirsthitError, Sphere
from surfaces import files
from surfaces.model import domain_text

from .test_files import LIMITS, X, Y, Z, load, same  # noqa: F401  (load is a fixture)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-be", "latin-1"])
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_a_file_may_have_any_encoding_and_line_ends(load, encoding, end):  # noqa: F811
    text = end.join(["# eine Fläche", "surface_equation=x^2+y^2-z", "scale_factor=0", ""])
    mark = b"\xfe\xff" if encoding == "utf-16-be" else b""
    same(load("a.jsurf", mark + text.encode(encoding)), X**2 + Y**2 - Z)


def test_escapes_are_those_of_javas_properties(load):  # noqa: F811
    """\\u005e is ^ and \\t is a tab, as Properties.store and .load write and read them."""
    same(load("a.jsurf", "surface_equation=x\\u005e2 +\\t y\\u005E2-z"), X**2 + Y**2 - Z)


@pytest.mark.parametrize(
    ("equation", "said"),
    [("x^2 - q", "line 1: unknown name 'q': the file has no surface_parameter_q=…"), ("X^2", "'X': write x")],
)
def test_a_letter_without_a_meaning_says_what_is_missing(load, equation, said):  # noqa: F811
    with pytest.raises(FirsthitError, match=said):
        load("a.jsurf", f"surface_equation={equation}")


@pytest.mark.parametrize("name", ["a.jsurf", "a.vm", "a.pov", "a.json", "a.toml", "a.pic", "a"])
def test_an_empty_file_is_called_empty(load, name):  # noqa: F811
    with pytest.raises(FirsthitError, match=f"{name} is empty$"):
        load(name, " \n\n")


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.jsurf", "surface_equation=x"),
        ("a.vm", "a var-x"),
        ("a.toml", 'formula = "x"'),
    ],
)
def test_a_part_of_a_file_with_one_surface_is_a_mistake(load, name, text):  # noqa: F811
    with pytest.raises(FirsthitError, match="it has one surface; leave out #2"):
        load(name, text, "2")


def test_a_comment_may_stand_behind_an_operation(load):  # noqa: F811
    same(load("a.vm", "_0 var-x # the first\n_1 square _0 #the last"), X**2)


@pytest.mark.parametrize("domain", ["sphere:5", "box:-1,0,1:2,3,4"])
def test_a_tape_of_ours_keeps_its_domain(tmp_path, domain):
    surface = surfaces.from_formula("x^2 + y*z - 1", domain)
    path = tmp_path / "mine.vm"
    path.write_text(files.export(surface, "vm"), encoding="utf-8")
    back = files.load(path)
    assert back.surface.domain == surface.domain
    assert not [remark for remark in back.remarks if "domain" in remark]
    path.write_text("# domain sphere:5\n_0 var-x\n", encoding="utf-8")  # somebody else's comment
    assert files.load(path).surface.domain == Box((-1, -1, -1), (1, 1, 1))


def test_a_model_without_a_name_is_called_as_its_file(load):  # noqa: F811
    imported = load("saddle.json", json.dumps({"Iso3D": {"Fxyz": ["x*y - z"], **LIMITS}}))
    assert imported.surface.name == "saddle"
    assert imported.surface.title == "x*y - z"


def test_an_error_of_a_domain_names_the_file(load):  # noqa: F811
    content = {"Iso3D": {"Fxyz": ["x"], **LIMITS, "Xmin": ["3"]}}
    with pytest.raises(FirsthitError, match=r"a\.json: a box domain needs"):
        load("a.json", json.dumps(content))


@pytest.mark.parametrize("name", ["a.wrl", "a.x3d", "a.msh", "a.blend", "a.3ds", "a.dxf"])
def test_other_meshes_are_told_as_meshes(load, name):  # noqa: F811
    with pytest.raises(FirsthitError, match="a mesh is no implicit surface"):
        load(name, "some text")


@pytest.mark.parametrize(("radius", "text"), [(10.0, "sphere:10"), (2500.0, "sphere:2500"), (0.001, "sphere:0.001")])
def test_a_domain_is_written_as_people_write_it(radius, text):
    assert domain_text(Sphere(radius)) == text


@pytest.mark.parametrize("formula", ["-x^2-y^2-z^2+1", "-x", "-(x+y)*z"])
def test_a_formula_may_begin_with_a_minus_sign(capsys, formula):
    assert main(["export", "--formula", formula, "--as", "sympy"]) == 0
    namespace: dict[str, object] = {}
    exec(capsys.readouterr().out, namespace)  # what `export` wrote
    at = dict(zip("xyz", (0.3, 0.5, -0.7), strict=True))
    found = namespace["f"].evalf(subs={namespace[name]: value for name, value in at.items()})  # type: ignore[attr-defined]
    assert np.isclose(float(found), eval(formula.replace("^", "**"), {}, at))


def test_a_file_may_begin_with_a_dash(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "-d.jsurf").write_text("surface_equation=x", encoding="utf-8")
    assert main(["export", "--surface", "-d.jsurf", "--as", "glsl"]) == 0
    with pytest.raises(SystemExit):
        main(["export", "--surface", "-o", "x", "--as", "glsl"])
    assert "argument --surface: expected one argument" in capsys.readouterr().err
