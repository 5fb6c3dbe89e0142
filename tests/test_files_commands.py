"""Files stand wherever --surface does, and in configs; import and export write files, and never over one unasked."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest

import surfaces
from harness.cli import main
from harness.contract import FirsthitError, Sphere
from harness.experiment.reading import load as load_config
from harness.plugins import find_methods
from surfaces import files
from surfaces.files import meshes

from .conftest import usable_devices

JSURF = "surface_equation=x^2+y^2+a*z^2-1\nsurface_parameter_a=2\nscale_factor=0.2\nbackground_color=1 1 1\n"
MESHES = {
    "a.stl": b"solid part\n facet normal 0 0 1\n  outer loop\n",
    "b.stl": b"\0" * 80 + (2).to_bytes(4, "little") + b"\0" * 100,
    "c.obj": b"# made by a program\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    "d.ply": b"ply\nformat ascii 1.0\nelement vertex 3\n",
    "e.off": b"OFF\n3 1 0\n0 0 0\n",
    "f.gltf": b'{"asset": {"version": "2.0"}, "meshes": [{"primitives": []}]}',
    "g.glb": b"glTF\x02\0\0\0",
    "h.3mf": b"PK\x03\x04....",
    "k.txt": b"solid part\n facet normal 0 0 1\n",
}


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "egg.jsurf").write_text(JSURF, encoding="utf-8")
    return tmp_path


@pytest.mark.usefixtures("here")
def test_import_writes_a_file_that_has_the_same_surface(capsys):
    assert main(["import", "egg.jsurf", "-o", "egg.toml"]) == 0
    out = capsys.readouterr().out
    assert "x^2 + y^2 + a*z^2 - 1" in out
    assert "left out: background_color" in out
    one, other = files.load("egg.jsurf").surface, files.load("egg.toml").surface
    assert one.identity == other.identity
    assert one == other
    assert main(["import", "egg.jsurf", "-o", "egg.toml"]) == 2
    assert "egg.toml is there already; --force replaces it" in capsys.readouterr().err
    assert main(["import", "egg.jsurf", "--domain", "sphere:1.25", "-o", "egg.toml", "--force"]) == 0
    assert files.load("egg.toml").surface.domain == Sphere(1.25)


@pytest.mark.parametrize("domain", ["sphere:0.3", "box:0.1,0.2,0.3", "box:-1,-2,-3:0.7,5,6"])
def test_a_domain_is_the_same_when_it_is_read_again(here, domain):
    given = files.load("egg.jsurf", domain).surface
    (here / "a.toml").write_text(files.own.text_of(given), encoding="utf-8")
    assert files.load("a.toml").surface.domain == given.domain


def test_a_formula_of_several_lines_is_kept(here):
    surface = surfaces.from_formula('let d = x^2; # a "comment" \\ \nd + y^2 - z', "sphere:2", "lines")
    (here / "a.toml").write_text(files.own.text_of(surface), encoding="utf-8")
    back = files.load("a.toml").surface
    assert back.formula.strip() == surface.formula
    assert surfaces.tape_of(back) == surfaces.tape_of(surface)


@pytest.mark.usefixtures("devices_found_once", "here")
def test_a_file_stands_where_surface_does(capsys):
    device = usable_devices()[0].name
    given = ["--method", "interval_march", "--device", device, "--size", "16", "-o", "egg.png"]
    assert main(["show", "--surface", "egg.jsurf", "--parameter", "a=3", *given]) == 0
    assert "firsthit: egg.jsurf: left out: background_color (what concerns the picture)" in capsys.readouterr().err
    rays = np.array([[0, 0, -3, 0, 0, 1]], np.float32)
    np.save("rays.npy", rays)
    assert main(["oracle", "--surface", "egg.jsurf", "--rays", "rays.npy", "-o", "truth.npz"]) == 0
    truth = np.load("truth.npz")
    assert truth["lower"][0] <= 3 - 0.5**0.5 <= truth["upper"][0]


@pytest.mark.usefixtures("here")
def test_export_takes_files_formulas_and_the_catalog(capsys):
    assert main(["export", "--surface", "egg.jsurf", "--as", "vm", "-o", "egg.vm"]) == 0
    assert files.load("egg.vm").surface.formula == "x^2 + y^2 + 2*z^2 - 1"
    assert main(["export", "--surface", "torus", "--as", "pov"]) == 0
    assert "poly {\n  4," in capsys.readouterr().out
    assert main(["export", "--formula", "min(x, y)", "--as", "jsurf"]) == 2
    assert "cannot be written as jsurf: jsurf draws polynomials" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("toruss", "there is no surface 'toruss'; did you mean torus"),
        ("nothing.jsurf", "cannot read nothing.jsurf: No such file"),
        ("egg.jsurf#2", "egg.jsurf: there is no parameter"),
        ("egg.txt", "egg.txt is no file that is read; read are .jsurf"),
    ],
)
def test_an_unknown_name_keeps_its_hint(here, capsys, name, said):
    (here / "egg.txt").write_text("hello", encoding="utf-8")
    assert main(["export", "--surface", name, "--as", "vm", "--parameter", "q=1"]) == 2
    err = capsys.readouterr().err
    assert said in err
    assert "Traceback" not in err


def test_a_catalog_name_means_the_surface_whatever_lies_in_the_folder(here):
    (here / "torus").write_text("surface_equation=x", encoding="utf-8")
    (here / "plain").write_text(JSURF, encoding="utf-8")
    assert not files.is_file("torus")
    assert files.is_file("plain")
    assert files.load("plain").form == "a .jsurf file"


@pytest.mark.parametrize("name", MESHES)
def test_a_mesh_is_refused_in_a_sentence(here, name):
    (here / name).write_bytes(MESHES[name])
    with pytest.raises(FirsthitError, match=f"{name} is a.* [A-Za-z0-9]+; a mesh is no implicit surface"):
        files.load(name)
    assert "\n" not in meshes.WHAT_TO_DO


def test_a_step_file_is_not_called_a_mesh(here):
    (here / "i.step").write_bytes(b"ISO-10303-21;")
    with pytest.raises(FirsthitError, match=r"i.step is a STEP; its patches are given by parameters") as caught:
        files.load("i.step")
    assert "mesh" not in str(caught.value) and "\n" not in str(caught.value)


CONFIG = """title = "An egg"
surfaces = ["egg", "torus"]
sizes = [16]
[surface.egg]
file = "files/egg.jsurf"
parameters = {{ a = 3 }}
{more}
[[method]]
name = "newton"
"""


def test_a_config_takes_a_file_from_its_own_folder(here, tmp_path_factory, monkeypatch):
    (here / "files").mkdir()
    (here / "egg.jsurf").rename(here / "files" / "egg.jsurf")
    path = here / "mine.toml"
    path.write_text(CONFIG.format(more=""), encoding="utf-8")
    monkeypatch.chdir(tmp_path_factory.mktemp("elsewhere"))
    egg, torus = load_config(path, find_methods()).surfaces
    assert egg.name == "egg"
    assert dict(egg.parameters) == {"a": "3"}
    assert egg.domain == Sphere(10**0.2)
    assert torus == surfaces.get("torus")
    path.write_text(CONFIG.format(more='domain = "sphere:1.25"'), encoding="utf-8")
    assert load_config(path, find_methods()).surfaces[0].domain == Sphere(1.25)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("files/egg.jsurf", "files/eg.jsurf", r"mine\.toml:5: .*cannot read .*eg\.jsurf"),
        ("a = 3", "b = 3", r"there is no parameter 'b'; it has a"),
        ("{more}", 'formula = "x"', "has a formula and a file; give one of them"),
    ],
)
def test_a_mistake_with_a_file_is_answered_with_the_configs_line(here, old, new, said):
    (here / "files").mkdir()
    (here / "egg.jsurf").rename(here / "files" / "egg.jsurf")
    (here / "mine.toml").write_text(CONFIG.replace(old, new).format(more=""), encoding="utf-8")
    with pytest.raises(FirsthitError, match=said):
        load_config(here / "mine.toml", find_methods())


@pytest.mark.parametrize("name", ["x" * 5000, "a\0b", "/dev/null/x", "."])
def test_what_can_be_no_file_is_answered(name):
    with pytest.raises(FirsthitError, match="cannot read"):
        files.load(name)


def test_a_script_reaches_files_without_an_import():
    command = "import surfaces; print(surfaces.files.load.__module__)"
    done = subprocess.run([sys.executable, "-c", command], capture_output=True, text=True, check=True)
    assert done.stdout == "surfaces.files\n"


@pytest.mark.usefixtures("here")
def test_import_says_where_the_domain_cuts_the_surface(capsys):
    assert main(["import", "egg.jsurf", "--domain", "sphere:0.9"]) == 0
    assert "egg: its domain sphere:0.9 cuts the surface" in capsys.readouterr().out
