"""Hostile configs end in one line with file and line; what is the same under two names is refused."""

import functools
import itertools
import os

import pytest

import firsthit
from harness.cli import main
from harness.contract import DeviceInfo, FirsthitError, View
from harness.experiment import plan, reading, shipped, size, toml_file
from harness.experiment.lines import lines_of
from harness.limits import Distinct, Within
from harness.plugins import find_methods
from harness.recommend import search
from harness.recommend.model import Wish
from harness.running import run

START = """title = "t"
surfaces = ["sphere"]
[[method]]
name = "newton"
"""
SPHERE = '[surface.mine]\nformula = "x^2 + y^2 + z^2 - 1"\n'
DEVICES = [DeviceInfo(name, "made up", "1", "1", 1, True, "wall", ()) for name in ("opencl:pocl", "opengl:llvmpipe")]


@functools.cache
def methods():
    return find_methods()


def refused(tmp_path, text, name="c.toml"):
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    with pytest.raises(FirsthitError) as caught:
        reading.load_all(path, methods())
    assert caught.value.exit_code == 2
    told = str(caught.value)
    assert "\n" not in told and told.isprintable()
    return told.partition(".toml:")[2]


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (f"{START}parameters = {{ MAX_EVALUATIONS = 0x1{'0' * 5000} }}", "5: a number of more than 1000 digits"),
        (f"seed = 1{'0' * 5000}\n{START}", "1: a number of more than 1000 digits"),
        (
            f"{START}parameters = {{ MAX_EVALUATIONS = {2**31} }}",
            "5: newton: MAX_EVALUATIONS is a whole number of 32 bits",
        ),
        (f"{START}parameters = {{ MAX_EVALUATIONS = 1.5 }}", "5: newton: MAX_EVALUATIONS is a whole number, not 1.5"),
        (f"sizes = {'[' * 2000}{']' * 2000}\n{START}", "1: a value that is nested more than 50 deep"),
        (f"x = {'{a = ' * 2000}1{'}' * 2000}\n{START}", "1: a value that is nested more than 50 deep"),
        (f"{START}parameters{'.a' * 2000} = 1", "5: a value that is nested more than 50 deep"),
        (f"{START}[a{'.a' * 2000}]", "5: a value that is nested more than 50 deep"),
        (f'title = "t"\ninclude = "{"a" * 301}"', "2: include.0: no file can have such a name"),
        (f"{START}x = \n", "5: not valid TOML, column 5: "),
        (f'{START}x = """', "5: not valid TOML"),
    ],
)
def test_what_python_or_tomllib_cannot_read_is_one_line(tmp_path, text, told):
    assert refused(tmp_path, text).startswith(told)


@pytest.mark.parametrize("bad", ["\\n", "\\u202e", "\\u200b", "\\u0000", "\\u001b[31m", "x/y", "x" * 101])
@pytest.mark.parametrize(
    ("text", "line"),
    [
        ('[[view]]\nname = "a@b"', 6),
        ('[[view]]\nname = "a"\nset = "a@b"', 7),
        ('settings = ["a@b"]', 5),
        ('[surface."a@b"]\nformula = "x"', 5),
        ('[scene."a@b"]\ngenerate = "lattice"', 5),
        ('[[scene.one.placed]]\nsurface = "a@b"', 6),
        ('[[method]]\nname = "a@b"', 6),
    ],
)
def test_names_hold_no_more_than_can_be_seen(tmp_path, text, line, bad):
    assert refused(tmp_path, START + text.replace("a@b", f"a{bad}b")).startswith(f"{line}: ")


@pytest.mark.parametrize("bad", ["\\n::error file=x::", "\\u202e", "x" * 10_000])
@pytest.mark.parametrize("field", ["title", "focus", "baseline", "devices"])
def test_texts_are_one_line_that_can_be_seen(tmp_path, field, bad):
    text = START.removeprefix('title = "t"\n') if field == "title" else START
    assert refused(tmp_path, f'{field} = "a{bad}b"\n{text}').startswith("1: ")


def test_the_files_name_is_a_name_too(tmp_path):
    assert "a name holds no" in refused(tmp_path, START, "a\nb.toml")


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("parameters = { EPSILON = [1, 1.0] }", "5: EPSILON: 1.0 is named twice"),
        (
            "parameters = { EPSILON = [0.001, 0.0010000001] }",
            "3: two variants would both be called newton[EPSILON=0.001]",
        ),
        ('[[view]]\nname = "a"\n[[view]]\nname = "b"', "7: view: 'a' and 'b' are the same but for the name"),
        ('[[view]]\nname = "a"\nazimuth = 0\n[[view]]\nname = "b"\nazimuth = 360', "8: view: 'a' and 'b' are the same"),
        (
            '[scene.a]\ngenerate = "lattice"\n[scene.b]\ngenerate = "lattice"\nseed = 2',
            "5: scene: 'lattice 100' is named twice",
        ),
        ('[scene.a]\ngenerate = "lattice"\ncounts = [999999, 1000000, 999998]', "5: scene: 2,999,997 parts"),
    ],
)
def test_what_would_be_one_thing_twice_is_refused(tmp_path, text, told):
    assert refused(tmp_path, START + text).startswith(told)


def test_a_surface_under_two_names_is_refused(tmp_path):
    text = START.replace('["sphere"]', '["mine", "other"]') + SPHERE + SPHERE.replace("mine", "other")
    assert refused(tmp_path, text).startswith("2: surfaces: 'mine' and 'other' are the same but for the name")


def test_more_values_than_a_plan_can_hold_are_counted_and_not_made(tmp_path):
    values = ", ".join(f"{i}e-9" for i in range(1, 1000))
    text = f"{START}parameters = {{ EPSILON = [{values}], STEP_BOUND = [{values}] }}"
    assert "998,001 variants; 100,000 at most" in refused(tmp_path, text)


def test_configs_that_are_included_have_folders_of_their_own(tmp_path):
    (tmp_path / "sub").mkdir()
    for name in ("a.toml", "sub/a.toml", "sub/c.toml"):
        (tmp_path / name).write_text(START)
    for names in ('"a.toml", "sub/a.toml"', '"a.toml", "sub/../a.toml"', '"sub/c.toml"', '"c.toml"'):
        assert "would be run into the folder of" in refused(tmp_path, f'title = "t"\ninclude = [{names}]')
    (tmp_path / "b.toml").write_text('title = "t"\ninclude = ["a.toml"]')
    assert refused(tmp_path, 'title = "t"\ninclude = [\n"a.toml",\n"b.toml"]').startswith("4: include: ")
    for name in ("..", "", "fifo"):
        assert refused(tmp_path, f'title = "t"\ninclude = ["{name}"]').startswith("2: include: there is no config")


def test_pipes_devices_folders_and_huge_files_are_told(tmp_path):
    os.mkfifo(tmp_path / "fifo")
    (tmp_path / "huge.toml").touch()
    os.truncate(tmp_path / "huge.toml", 10**9)
    cases = (
        ("fifo", "no regular file"),
        ("huge.toml", "2,000,000 bytes at most"),
        (".", "Is a directory"),
        ("\0", "no such"),
    )
    for name, told in cases:
        with pytest.raises(FirsthitError, match=told):
            toml_file.read(tmp_path / name)
    with pytest.raises(FirsthitError, match="no regular file"):
        toml_file.read(shipped.Path("/dev/zero"))


def test_lines_are_those_of_the_values_themselves():
    text = """a = 1.5 # [
"b.c"."d\\u0041" = "x = ['"
e = \"\"\"[
""\"\"\"\"
f = [1.5, {x = 1, y.z = [1,
2]}, 1979-05-27 07:32:00,
 'a,b']
[[ m . list ]]
r = 1
[m.list.sub]
[[m.list]]
'' = {}
"""
    found = lines_of(text)
    assert found["a",] == 1 and found["b.c", "dA"] == 2 and found["e",] == 3
    assert found["f", 1, "y", "z", 1] == 6 and found["f", 2] == 6 and found["f", 3] == 7
    assert found["m", "list", 0, "r"] == 9 and found["m", "list", 0, "sub"] == 10
    assert found["m", "list", 1, ""] == 12 and ("m", "list", 2) not in found


def test_a_long_config_is_read_once_for_all_its_mistakes(tmp_path, monkeypatch):
    reads = []
    loads = toml_file.tomllib.loads
    monkeypatch.setattr(toml_file.tomllib, "loads", lambda text: reads.append(len(text)) or loads(text))
    text = START + "".join(f'[[view]]\nname = "{i}"\nazimuth = 999\n' for i in range(2000))
    path = tmp_path / "c.toml"
    path.write_text(text)
    with pytest.raises(FirsthitError) as caught:
        reading.load(path, methods())
    told = str(caught.value).splitlines()
    assert len(told) == 2000 and "c.toml:6004: " in told[-1] and reads == [len(text)]


def test_nothing_that_is_not_finite_lies_within_a_limit():
    assert all(Within(0.0, float("inf")).broken(value) for value in (float("nan"), float("inf"), 10**400))
    assert Within(1, 9).broken(10**5000) == "inf is outside [1, 9]"
    assert Distinct().broken([1, 1.0]) and not Distinct().broken(list(range(100_000)))


def large(tmp_path):
    (tmp_path / "large.toml").write_text(
        'title = "t"\nsurfaces = ["all", "gallery"]\nsizes = [16, 17, 18, 19, 20, 21, 22, 23, 24, 25]\n'
        'samples_per_pixel = [1, 4, 9, 16]\ndevices = ["any"]\ndirections = { count = 10000 }\n'
        '[[method]]\nname = "newton"\n'
        "parameters = { EPSILON = [0.1, 0.2, 0.3, 0.4, 0.5], MAX_EVALUATIONS = [1, 2, 3] }\n"
    )
    return tmp_path / "large.toml"


@pytest.mark.one_in(2)
@pytest.mark.parametrize("words", [["run"], ["plan"], ["bless", "--reason", "r"], ["gate", "--baseline", "FILE"]])
def test_a_large_plan_says_its_size_at_once_and_asks(tmp_path, monkeypatch, capsys, words):
    for room in (run, firsthit, __import__("harness.gate.checked", fromlist=["checked"])):
        monkeypatch.setattr(room, "discover_devices", None, raising=False)  # nothing is looked for
    (tmp_path / "b.toml").write_text("format = 2\n")
    told = [str(tmp_path / "b.toml") if word == "FILE" else word for word in words]
    assert main([told[0], str(large(tmp_path)), *told[1:]]) == 2
    assert "at least 1,230,000,000 cells; more than 20,000 are run with --yes only" in capsys.readouterr().err


def test_python_asks_too_and_yes_answers(tmp_path):
    with pytest.raises(FirsthitError, match="1,230,000,000 cells"):
        firsthit.run(large(tmp_path), runs=tmp_path)
    experiment = reading.load(large(tmp_path), methods())
    assert "1,230,000,000 cells" in size.check_size(experiment, methods(), yes=True)
    assert len([*itertools.islice(plan.grid(experiment, methods(), DEVICES), 3)]) == 3  # none is made ahead
    with pytest.raises(FirsthitError, match="checks of variants on 1,000 views; more than 20,000"):
        search.recommend(
            Wish(experiment.surfaces[0], 1e-3, views=1000), methods(), "no", tmp_path, run.Watcher(), command=""
        )


@pytest.mark.parametrize("name", ["front", "gallery", "methods", "toledo-fig6", "stability", "toledo-lod", "pipes"])
def test_the_size_is_that_of_the_grid(name):
    experiment = reading.load(shipped.located(name), methods())
    experiment = experiment.on(["all"]) if "fastest" in experiment.wanted_devices() else experiment
    assert size.cells_of(experiment, methods(), DEVICES) == len([*plan.grid(experiment, methods(), DEVICES)])


def test_python_callers_are_held_to_the_same_names_and_numbers():
    huge = 10**5000
    cases = (
        lambda: View("a\nb"),
        lambda: View("a", set=""),
        lambda: View("a", azimuth=float("nan")),
        lambda: methods().get("newton").variant({"EPSILON": huge}),
        lambda: firsthit.surfaces.get("torus", R=huge),
        lambda: firsthit.surfaces.from_formula("x", name="a/b"),
        lambda: firsthit.Sphere(huge),
        lambda: firsthit.run("x" * 10_000),
        lambda: firsthit.load("x" * 10_000),
        lambda: methods().get("x" * 10_000),
    )
    for case in cases:
        with pytest.raises(FirsthitError):
            case()
