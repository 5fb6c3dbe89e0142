from pathlib import Path

import pytest

from harness.contract import FirsthitError
from harness.plugins import find_methods

METHOD = 'from harness.contract import Method\nMETHOD = Method(name="{name}", source="test")\n'


def _plugin(folder, name="mine", text=METHOD):
    folder.mkdir(parents=True)
    (folder / "__init__.py").write_text("")
    (folder / "method.py").write_text(text.format(name=name))
    (folder / "kernel.glsl").write_text("Hit first_hit(Ray ray, real t0, real t1) { return no_hit(t1); }\n")


def test_a_folder_outside_the_project_is_found(tmp_path):
    _plugin(tmp_path / "mine")
    assert find_methods(tmp_path).get("mine").folder == tmp_path / "mine"


def _installed(folder, monkeypatch, *points):
    """Make as if a package with these entry points were installed, whose modules are in `folder`."""
    info = folder / "somebodys_caster-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: somebodys-caster\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text("\n".join(["[firsthit.methods]", *points, ""]))
    monkeypatch.syspath_prepend(str(folder))


def test_an_installed_package_is_found_by_its_entry_point(tmp_path, monkeypatch):
    _plugin(tmp_path / "somebodys_caster", "somebodys_caster")
    assert "somebodys_caster" not in find_methods().plugins
    _installed(tmp_path, monkeypatch, "caster = somebodys_caster")
    assert find_methods().get("somebodys_caster").folder == tmp_path / "somebodys_caster"


def test_an_installed_package_holds_one_method_under_any_name(tmp_path, monkeypatch):
    _plugin(tmp_path / "their_package", "mine")
    _installed(tmp_path, monkeypatch, "anything = their_package")
    catalog = find_methods()
    assert catalog.get("mine").folder == tmp_path / "their_package"
    assert "their_package" not in catalog.plugins and not catalog.broken


def test_an_installed_package_holds_several_methods_in_folders(tmp_path, monkeypatch):
    for name in ("one", "two"):
        _plugin(tmp_path / "their_package" / "casters" / name, name)
    (tmp_path / "their_package" / "__init__.py").write_text("")
    _installed(tmp_path, monkeypatch, "anything = their_package.casters", "twice = their_package.casters")
    catalog = find_methods()
    assert {"one", "two"} <= catalog.plugins.keys() and not catalog.broken


def test_a_folder_that_is_installed_and_given_too_is_one_method(tmp_path, monkeypatch):
    _plugin(tmp_path / "their_package" / "mine", "mine")
    _installed(tmp_path, monkeypatch, "anything = their_package")
    monkeypatch.chdir(tmp_path)
    assert find_methods(Path("their_package")).get("mine").folder.resolve() == tmp_path / "their_package" / "mine"


def test_an_entry_point_without_a_method_is_listed_with_its_reason(tmp_path, monkeypatch):
    (tmp_path / "empty_package").mkdir()
    (tmp_path / "raising.py").write_text("raise SystemError('no')\n")
    points = ("empty = empty_package", "absent = no_such_package", "raising = raising.inside")
    _installed(tmp_path, monkeypatch, *points)
    broken = find_methods().broken
    assert broken["empty"] == "its entry point names empty_package, which is no package that holds a method.py"
    assert "no_such_package, which is no package" in broken["absent"]
    assert "SystemError: no" in broken["raising"]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("import nonesuch\n", "No module named 'nonesuch'"),
        ("METHOD = 3\n", "does not define METHOD"),
        ('from harness.contract import Method\nMETHOD = Method(name="other", source="t")\n', "they must agree"),
        ("METHOD = (\n", "SyntaxError"),
        ("raise SystemError('no')\n", "SystemError: no"),
    ],
)
def test_a_broken_plugin_is_listed_with_its_reason_and_harms_no_other(tmp_path, text, words):
    _plugin(tmp_path / "mine", text=text)
    catalog = find_methods(tmp_path)
    assert words in catalog.broken["mine"]
    assert "newton" in catalog.plugins
    with pytest.raises(FirsthitError, match="cannot be loaded"):
        catalog.get("mine")


STATED = "from firsthit import Method, Parameter\nMETHOD = Method('mine', 't', {})\n"


@pytest.mark.parametrize(
    ("stated", "words"),
    [
        ("casts='foo'", "casts: unknown 'foo'; known: rays, beams, quadtree, mesh"),
        ("precisions=('half',)", "precisions: unknown 'half'; known: float32, float64"),
        (
            "parameters=(Parameter('N', 1, 'n'), Parameter('N', 2, 'n'))",
            "the knob 'N' is named twice; keep one of the two",
        ),
        ("parameters=Parameter('N', 1, 'n')", "; see class Method in harness/contract.py"),
        ("parameters=('N',)", "parameters has 'N'; give it Parameter(...)"),
        ("claims='no_missed_root'", "claims is 'no_missed_root'; see class Method"),
        ("settings=dict(fine=dict(M=1))", "has no parameter 'M'"),
        ("parameters=(Parameter('N', 1, 'n', finer='less'),)", "is finer 'less'; write up, down or None"),
        ("parameters=(Parameter('n', 1, 'n'),)", "the knob 'n' must be capitals"),
        ("parameters=(Parameter('N M', 1, 'n'),)", "the knob 'N M' must be capitals"),
        ("parameters=(Parameter('N', float('nan'), 'n'),)", "the knob N has the value nan; give it a finite number"),
        ("parameters=(Parameter('N', True, 'n'),)", "the knob N has the value True"),
        ("parameters=(Parameter('N', 1.0, 'n', sweep=(0.5, float('inf'))),)", "the knob N has the value inf"),
        ("parameters=(Parameter('N', 1.0, 'n', printed='2'),)", "the knob N has the value '2'"),
    ],
)
def test_a_method_that_states_what_cannot_be_is_listed_with_the_reason(tmp_path, stated, words):
    _plugin(tmp_path / "mine", text=STATED.format(stated))
    broken = find_methods(tmp_path).broken["mine"]
    assert broken.startswith(str(tmp_path / "mine/method.py")) and broken.count(words) == 1


def test_a_name_that_is_no_word_is_refused(tmp_path):
    _plugin(tmp_path / "bad name!", "bad name!")
    assert "'bad name!' must be letters, digits and _" in find_methods(tmp_path).broken["bad name!"]


def test_a_folder_without_a_kernel_says_so(tmp_path):
    _plugin(tmp_path / "mine")
    (tmp_path / "mine" / "kernel.glsl").unlink()
    assert "no kernel.glsl" in find_methods(tmp_path).broken["mine"]


def test_two_methods_of_one_name_are_refused(tmp_path):
    _plugin(tmp_path / "newton", "newton")
    with pytest.raises(FirsthitError, match="two methods are called 'newton'"):
        find_methods(tmp_path)


def test_a_plugin_folder_that_is_not_there_is_one_line(tmp_path):
    with pytest.raises(FirsthitError, match="no such folder"):
        find_methods(tmp_path / "none")
