import re
from pathlib import Path

import pytest

import surfaces
from harness.cli import main
from harness.contract import FirsthitError
from harness.plugins import find_methods

from .conftest import usable_devices

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
        ("casts='foo'", "casts: there is no way of casting 'foo'; known: rays, beams, quadtree, tiles, mesh"),
        (
            "casts='tiles', rest='bernsteen'",
            "rest: there is no method of this project 'bernsteen'; did you mean 'bernstein'?",
        ),
        ("rest=3", "rest is 3; write a text"),
        ("precisions=('half',)", "precisions: there is no precision 'half'; known: float32, float64"),
        (
            "parameters=(Parameter('N', 1, 'n'), Parameter('N', 2, 'n'))",
            "the knob 'N' is named twice; keep one of the two",
        ),
        ("parameters=Parameter('N', 1, 'n')", "write parameters=(Parameter(...),), with the comma"),
        ("parameters=('N',)", "parameters: it holds 'N'; give it Parameter(...)"),
        ("claims='no_missed_root'", "claims is 'no_missed_root'; write claims=frozenset({"),
        ("settings=dict(fine=dict(M=1))", "has no parameter 'M'"),
        ("parameters=(Parameter('N', 1, 'n', finer='less'),)", "is finer 'less'; write up, down or None"),
        ("parameters=(Parameter('n', 1, 'n'),)", "the knob 'n' must be capitals"),
        ("parameters=(Parameter('N M', 1, 'n'),)", "the knob 'N M' must be capitals"),
        ("parameters=(Parameter('N', float('nan'), 'n'),)", "the knob N has the value nan; give it a finite number"),
        ("parameters=(Parameter('N', True, 'n'),)", "the knob N has the value True"),
        ("parameters=(Parameter('N', 1.0, 'n', sweep=(0.5, float('inf'))),)", "the knob N has the value inf"),
        ("parameters=(Parameter('N', 1.0, 'n', printed='2'),)", "the knob N has the value '2'"),
        ("needs=('surface_value')", "needs is 'surface_value', which is no tuple; write needs=('surface_value',)"),
        ("needs=('surface_valu',)", "there is no generated function 'surface_valu'; did you mean 'surface_value'?"),
        ("needs=(3,)", "needs holds 3; write texts"),
        ("libraries=('intervall',)", "there is no kernel library 'intervall'; did you mean 'interval'?"),
        ("precisions='float32'", "precisions is 'float32', which is no tuple; write precisions=('float32',)"),
        ("precisions=()", "precisions is empty"),
        ("accepts=None", "accepts is None; give it a function"),
        ("tables=3", "tables is 3; give it a function"),
        ("answers='yes'", "answers is 'yes'; write True or False"),
        ("parameters=(Parameter('N', 1.0, 'n', sweep=0.5),)", "has sweep=0.5; write a tuple"),
        ("parameters=(Parameter('N', 1, 'n', sweep=(0.5,)),)", "the knob N is a whole number"),
        ("parameters=(Parameter('N', 1, 2),)", "the knob N has meaning=2; write a text"),
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


def test_none_takes_the_place_of_a_method_of_ours_and_the_answer_says_what_to_rename(tmp_path):
    _plugin(tmp_path / "newton", "newton")
    with pytest.raises(FirsthitError, match=r"two methods are called 'newton'.* rename the folder, and name='newton'"):
        find_methods(tmp_path)


def _install_one(folder, name, monkeypatch):
    _plugin(folder / name, name)
    info = folder / f"{name}-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text(f"[firsthit.methods]\n{name} = {name}\n")
    monkeypatch.syspath_prepend(str(folder))


def test_a_folder_takes_the_place_of_an_installed_method_and_says_so_once(tmp_path, monkeypatch, capsys):
    _install_one(tmp_path / "site", "twice_here", monkeypatch)
    _plugin(tmp_path / "own" / "twice_here", "twice_here")
    catalog = find_methods(tmp_path / "own")
    assert catalog.get("twice_here").folder == tmp_path / "own" / "twice_here"
    assert main(["list", "methods", "--plugins", str(tmp_path / "own")]) == 0
    err = capsys.readouterr().err
    assert err.count("firsthit: method 'twice_here'") == 1 and str(tmp_path / "site") in err


def test_a_broken_folder_does_not_let_the_installed_method_stand_in(tmp_path, monkeypatch):
    _install_one(tmp_path / "site", "twice_here", monkeypatch)
    _plugin(tmp_path / "own" / "twice_here", text="METHOD = 3\n")
    catalog = find_methods(tmp_path / "own")
    assert "twice_here" in catalog.broken and "twice_here" not in catalog.plugins


def test_the_folder_of_one_method_is_enough(tmp_path, monkeypatch):
    _plugin(tmp_path / "mine")
    assert find_methods(tmp_path / "mine").get("mine").folder == tmp_path / "mine"
    monkeypatch.chdir(tmp_path / "mine")
    assert find_methods(Path()).get("mine").folder.samefile(tmp_path / "mine")


@pytest.mark.parametrize("missing", ["method.py", "kernel.glsl"])
def test_half_a_method_says_which_file_is_missing(tmp_path, missing):
    _plugin(tmp_path / "mine")
    (tmp_path / "mine" / missing).unlink()
    for given in (tmp_path, tmp_path / "mine"):
        assert f"but no {missing}" in find_methods(given).broken["mine"]


def test_where_no_method_is_in_the_folder_it_says_so_and_names_the_one_that_holds_some(tmp_path):
    with pytest.raises(FirsthitError, match="there is no method in it; a method is a folder with"):
        find_methods(tmp_path)
    _plugin(tmp_path / "deep" / "mine")
    with pytest.raises(FirsthitError, match=rf"there is no method in it.* give --plugins {tmp_path / 'deep'}"):
        find_methods(tmp_path)
    with pytest.raises(FirsthitError, match="it is a file"):
        find_methods(tmp_path / "deep" / "mine" / "method.py")


def test_who_forgets_plugins_is_told_of_it_and_of_the_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(FirsthitError) as caught:
        find_methods().get("illinois")
    assert "there is no method 'illinois' here; is it in a folder for --plugins?" in str(caught.value)
    with pytest.raises(FirsthitError, match=r"is it in a folder for --plugins\? did you mean 'newton'\?"):
        find_methods().get("newtn")
    _plugin(tmp_path / "own" / "illinois", "illinois")
    with pytest.raises(FirsthitError, match=r"it is in the folder own/illinois: give --plugins own$"):
        find_methods().get("illinois")
    monkeypatch.chdir(tmp_path / "own" / "illinois")
    with pytest.raises(FirsthitError, match=rf"it is in the folder \.: give --plugins {tmp_path / 'own'}$"):
        find_methods().get("illinois")


def test_a_config_beside_the_folder_names_it_with_its_line(tmp_path, capsys):
    _plugin(tmp_path / "illinois", "illinois")
    config = tmp_path / "mine.toml"
    config.write_text('title = "t"\nsurfaces = ["torus"]\nsizes = [16]\n[[method]]\nname = "illinois"\n')
    assert main(["plan", str(config)]) == 2
    assert f"mine.toml:5: there is no method 'illinois' here; it is in the folder {tmp_path}" in capsys.readouterr().err


@pytest.mark.parametrize("ends", ["sys.exit(0)", "raise KeyboardInterrupt", "raise SystemExit", "raise GeneratorExit"])
def test_a_method_py_that_ends_the_program_costs_itself_only(tmp_path, ends):
    _plugin(tmp_path / "mine", text=f"import sys\n{ends}\n")
    catalog = find_methods(tmp_path)
    assert f"{tmp_path / 'mine/method.py'}:2: " in catalog.broken["mine"]
    assert "newton" in catalog.plugins


def test_ctrl_c_while_a_method_py_is_run_ends_the_command(tmp_path):
    text = "import os, signal, time\nos.kill(os.getppid(), signal.SIGINT)\ntime.sleep(60)\n"
    _plugin(tmp_path / "mine", text=text)
    with pytest.raises(KeyboardInterrupt):
        find_methods(tmp_path)


@pytest.mark.parametrize(
    ("stated", "words"),
    [
        ("accepts=lambda _: True", "accepts returned True; return None for a surface that it can be used on"),
        ("accepts=lambda _: 1 / 0", "ZeroDivisionError: division by zero, in accepts=..."),
        ("accepts=lambda _: exit(0)", "SystemExit: 0, in accepts=...; a method.py states METHOD"),
    ],
)
def test_a_function_of_method_py_that_goes_wrong_is_answered_with_its_line(tmp_path, stated, words):
    _plugin(tmp_path / "mine", text=STATED.format(stated))
    with pytest.raises(FirsthitError, match=re.escape(f"method.py:2: {words}")):
        find_methods(tmp_path).get("mine").method.accepts(surfaces.get("torus"))


@pytest.mark.parametrize(
    ("answer", "words"),
    [
        ("dict(A=[])", "a table A that is empty"),
        ("dict(A=3)", "a table A that is empty or no list: 3"),
        ("dict(A='x')", "a table A that holds what is no finite number"),
        ("dict([('a b', [1.0])])", "a table 'a b'; name it by letters"),
        ("dict([(3, [1.0])])", "a table 3; name it by letters"),
    ],
)
def test_a_table_that_can_be_none_is_answered_with_its_line(tmp_path, answer, words):
    _plugin(tmp_path / "mine", text=STATED.format(f"tables=lambda *_: {answer}"))
    with pytest.raises(FirsthitError, match=rf"method\.py:2: tables returned {words}"):
        find_methods(tmp_path).get("mine").method.tables(surfaces.get("torus"), {}, "float32")


@pytest.mark.usefixtures("devices_found_once")
@pytest.mark.skipif(not usable_devices(), reason="no device")
def test_tables_that_cannot_be_made_are_a_failure_and_not_a_refusal(tmp_path, capsys):
    _plugin(tmp_path / "mine", text=STATED.format("tables=lambda *_: 1 / 0"))
    (tmp_path / "one.toml").write_text('title = "t"\nsurfaces = ["torus"]\nsizes = [16]\n[[method]]\nname = "mine"\n')
    assert main(["plan", str(tmp_path / "one.toml"), "--plugins", str(tmp_path)]) == 3
    assert "method.py:2: ZeroDivisionError: division by zero, in tables=..." in capsys.readouterr().err


def test_what_a_method_py_prints_is_no_output_of_the_command(tmp_path, capsys):
    _plugin(tmp_path / "mine", text="print('hello')\n" + METHOD)
    find_methods(tmp_path).get("mine")
    out, err = capsys.readouterr()
    assert (out, err) == ("", "hello\n")


def test_a_method_py_in_another_encoding_is_answered_with_its_line_too(tmp_path):
    _plugin(tmp_path / "mine", text="")
    text = "# -*- coding: latin-1 -*-\n# \xfc\nfrom firsthit import Method\nMETHOD = Method('mine', 't', casts='foo')\n"
    (tmp_path / "mine" / "method.py").write_bytes(text.encode("latin-1"))
    assert "method.py:4: casts: there is no way" in find_methods(tmp_path).broken["mine"]


@pytest.mark.parametrize(
    ("kernel", "words"),
    [
        (b"// a\n// \xfc\n", ":2: it is not written in UTF-8"),
        (b'\n#include "x.glsl"\n', ":2: a kernel is one file"),
        (None, ": Is a directory"),
    ],
)
def test_a_kernel_that_cannot_be_read_or_is_not_all_of_it_is_listed_with_the_reason(tmp_path, kernel, words):
    _plugin(tmp_path / "mine")
    path = tmp_path / "mine" / "kernel.glsl"
    path.unlink()
    if kernel is None:
        path.mkdir()
    else:
        path.write_bytes(kernel)
    assert f"{path}{words}" in find_methods(tmp_path).broken["mine"]


def test_a_plugin_folder_that_is_not_there_is_one_line(tmp_path):
    with pytest.raises(FirsthitError, match="no such folder"):
        find_methods(tmp_path / "none")
