import textwrap
from pathlib import Path

import pytest

from harness.contract import DeviceInfo, FirsthitError, Sphere
from harness.experiment import config, plan, reading
from harness.gate import race
from harness.plugins import find_methods

GOOD = """title = "t"
surfaces = ["sphere"]
[[method]]
name = "newton"
parameters = { EPSILON = [0.1, 0.2], MAX_EVALUATIONS = 5 }
[[method]]
name = "null"
"""


def _load(tmp_path: Path, text: str) -> config.Experiment:
    path = tmp_path / "c.toml"
    path.write_text(text)
    return reading.load(path, find_methods())


def test_knobs_multiply_and_defaults_fill_in(tmp_path):
    experiment = _load(tmp_path, GOOD)
    labels = [str(v) for v in experiment.variants]
    assert labels == ["newton[EPSILON=0.1,MAX_EVALUATIONS=5]", "newton[EPSILON=0.2,MAX_EVALUATIONS=5]", "null"]
    assert dict(experiment.variants[0].parameters)["STEP_BOUND"] == 0.15
    assert experiment.config.budget.seconds == 2.0


@pytest.mark.parametrize(
    ("old", "new", "line", "words"),
    [
        ('surfaces = ["sphere"]', 'surface = ["sphere"]', 2, "surface is a table"),
        ('surfaces = ["sphere"]', 'surfcaes = ["sphere"]', 2, "did you mean 'surfaces'"),
        ('surfaces = ["sphere"]', 'surfaces = ["spere"]', 2, "did you mean sphere"),
        ('name = "null"', 'name = "nul"', 7, "did you mean 'null'"),
        ('name = "null"', 'nme = "null"', 7, "did you mean 'name'"),
        ("EPSILON = ", "EPSILN = ", 5, "did you mean 'EPSILON'"),
        ('title = "t"', 'title = "t"\nsizes = [0]', 2, "outside"),
        ('title = "t"', 'title = "t"\nsizes = ["big"]', 2, "a whole number"),
        ('title = "t"', 'title = "t"\nsizes = []', 2, "empty"),
        ('title = "t"', 'title = "t"\nprecisions = ["float16"]', 2, "did you mean 'float"),
        ('name = "null"', 'name = "null"\n[budget]\ntimeout = -1', 9, "outside"),
        ('name = "null"', 'name = "null"\n[budget]\nsecnds = 1', 9, "did you mean 'seconds'"),
        ('name = "null"', 'name = "null"\n[budget]\nrounds = 0', 9, "outside"),
        ('title = "t"', 'title = "t"\nbaseline = "newtn"', 2, "baseline: unknown 'newtn'; did you mean 'newton'"),
        ('title = "t"', 'title = "t"\nbaseline = "null"', 2, "baseline: unknown 'null'"),
        ('title = "t"', 'title = "t"\nbaseline = 3', 2, "baseline is a text"),
        ('title = "t"', 'title = "t"\nfocus = "newtn"', 2, "focus: unknown 'newtn'; did you mean 'newton'"),
        ('title = "t"', 'title = "t"\nfocus = "null"', 2, "focus: unknown 'null'"),
        ('title = "t"', 'title = "t"\nfocus = ""', 2, "focus: unknown ''"),
        ('name = "null"', 'name = "null"\n[[view]]\nname = "a"\n[[view]]\nname = "b"\nfov = 200', 12, "outside"),
    ],
)
def test_a_mistake_is_answered_with_file_line_and_remedy(tmp_path, old, new, line, words):
    with pytest.raises(FirsthitError) as caught:
        _load(tmp_path, GOOD.replace(old, new, 1))
    message = str(caught.value)
    assert words in message
    assert f"c.toml:{line}:" in message
    assert caught.value.exit_code == 2


def test_the_baseline_is_a_method_or_a_variant_of_the_config(tmp_path):
    assert _load(tmp_path, GOOD).config.baseline == "ray_march"
    for name in ("newton", "newton[EPSILON=0.2,MAX_EVALUATIONS=5]"):
        text = GOOD.replace('title = "t"', f'title = "t"\nbaseline = "{name}"', 1)
        assert _load(tmp_path, text).config.baseline == name


def test_the_focus_is_a_method_or_a_variant_of_the_config_or_stands_beside_include(tmp_path):
    assert _load(tmp_path, GOOD).config.focus == ""
    for name in ("newton", "newton[EPSILON=0.2,MAX_EVALUATIONS=5]"):
        text = GOOD.replace('title = "t"', f'title = "t"\nfocus = "{name}"', 1)
        assert _load(tmp_path, text).config.focus == name
    (tmp_path / "a.toml").write_text(GOOD)
    whole = _load(tmp_path, 'title = "all"\ninclude = ["a.toml"]\nfocus = "newton"\n')
    assert (whole.config.focus, whole.included) == ("newton", (tmp_path / "a.toml",))


def test_malformed_toml_names_its_place(tmp_path):
    with pytest.raises(FirsthitError, match=r"c\.toml:2: not valid TOML, column 13: Invalid value"):
        _load(tmp_path, 'title = "t"\nsurfaces = [}')


def test_a_missing_file_is_one_line(tmp_path):
    with pytest.raises(FirsthitError, match="cannot read"):
        reading.load(tmp_path / "none.toml", find_methods())


def test_a_surface_of_the_configs_own(tmp_path):
    text = (
        GOOD.replace('["sphere"]', '["mine"]') + '[surface.mine]\nformula = "x^2 + y^2 - a"\nparameters = { a = 0.5 }\n'
    )
    assert _load(tmp_path, text).surfaces[0].degree == 2
    constant = _load(tmp_path, text.replace("a = 0.5", 'a = "sqrt(2)/3"')).surfaces[0]
    assert constant.parameters == (("a", "sqrt(2)/3"),)
    with pytest.raises(FirsthitError, match=r"c\.toml:\d+: .*no 'b' occurs in the formula"):
        _load(tmp_path, text.replace("a = 0.5", "a = 0.5, b = 2"))
    with pytest.raises(FirsthitError, match=r"c\.toml:9: "):
        _load(tmp_path, text.replace("y^2 - a", "y^2 - b"))


def test_a_surface_of_the_catalog_in_another_domain(tmp_path):
    text = GOOD.replace('["sphere"]', '["torus"]') + '[surface.torus]\ndomain = "sphere:1"\nparameters = { r = 0.2 }\n'
    torus = _load(tmp_path, text).surfaces[0]
    assert (torus.title, torus.domain, dict(torus.parameters)["r"]) == ("Torus", Sphere(1.0), "0.2")
    with pytest.raises(FirsthitError, match=r"c\.toml:8: there is no surface 'tours'"):
        _load(tmp_path, text.replace('"torus"]', '"tours"]').replace("surface.torus", "surface.tours"))


def test_the_papers_own_settings_go_by_name(tmp_path):
    text = GOOD.replace("parameters = { EPSILON = [0.1, 0.2], MAX_EVALUATIONS = 5 }", 'settings = ["Newton 0.00003"]')
    variant = _load(tmp_path, text).variants[0]
    assert str(variant) == "Newton 0.00003"
    assert dict(variant.parameters)["EPSILON"] == 0.00003
    with pytest.raises(FirsthitError, match=r"c\.toml:5: method 'newton' has no setting 'Newton 0.0003'; did you mean"):
        _load(tmp_path, text.replace("0.00003", "0.0003"))


def test_one_variant_under_two_names_is_refused(tmp_path):
    text = GOOD.replace(
        "parameters = { EPSILON = [0.1, 0.2], MAX_EVALUATIONS = 5 }", "parameters = { EPSILON = [1, 1.0] }"
    )
    with pytest.raises(FirsthitError, match="is named twice"):
        _load(tmp_path, text)


@pytest.mark.parametrize(
    "path", sorted((Path(__file__).parent.parent / "configs").glob("*.toml")), ids=lambda p: p.stem
)
def test_our_own_configs_load(path):
    experiment = reading.load(path, find_methods())
    assert experiment.variants or experiment.config.studies or experiment.included


def test_a_config_may_include_others_and_nothing_else(tmp_path):
    (tmp_path / "a.toml").write_text(GOOD)
    experiment = _load(tmp_path, 'title = "all"\ninclude = ["a.toml"]\n')
    assert experiment.included == (tmp_path / "a.toml",)
    assert not experiment.variants
    for text, line, words in (
        ('title = "all"\ninclude = ["b.toml"]\n', 2, "there is no config"),
        ('title = "all"\ninclude = ["a.toml", "a.toml"]\n', 2, "named twice"),
        ('title = "all"\ninclude = ["a.toml"]\nsizes = [8]\n', 3, "cannot stand beside include"),
    ):
        with pytest.raises(FirsthitError, match=words) as caught:
            _load(tmp_path, text)
        assert f"c.toml:{line}:" in str(caught.value)


def test_studies_need_no_method(tmp_path):
    assert _load(tmp_path, 'title = "t"\nstudies = ["condition_numbers"]\n').config.studies == ["condition_numbers"]
    with pytest.raises(FirsthitError, match="did you mean 'condition_numbers'"):
        _load(tmp_path, 'title = "t"\nstudies = ["condition_number"]\n')
    with pytest.raises(FirsthitError, match="lacks 'method'"):
        _load(tmp_path, 'title = "t"\nsurfaces = ["sphere"]\n')


def test_a_method_may_have_stages_of_its_own(tmp_path):
    experiment = _load(tmp_path, GOOD.replace('name = "null"', 'name = "null"\nstages = ["rays"]'))
    assert [experiment.stages_of(variant) for variant in experiment.variants] == [("compute",), ("compute",), ("rays",)]
    catalog, device = find_methods(), DeviceInfo("opencl:none", "", "", "", 1, True, "wall", ())
    planned = plan.plan(experiment, catalog, [device])
    assert [(p.cell.variant.method, p.cell.stage, p.skip) for p in planned] == [
        ("newton", "compute", None),
        ("newton", "compute", None),
        ("null", "rays", None),
    ]
    with pytest.raises(FirsthitError, match="stages: unknown 'beams'"):
        _load(tmp_path, GOOD.replace('name = "null"', 'name = "null"\nstages = ["beams"]'))


def test_the_config_of_the_docs_is_taken_as_printed(tmp_path):
    page = (Path(__file__).parent.parent / "docs" / "configs.md").read_text(encoding="utf-8")
    block = page.split("reports it.\n\n")[1].split("\n\nMistakes are answered")[0]
    (tmp_path / "mine.toml").write_text(textwrap.dedent(block), encoding="utf-8")
    experiment = reading.load(tmp_path / "mine.toml", find_methods())
    assert (experiment.config.baseline, experiment.config.focus) == ("ray_march", "newton")
    assert experiment.config.budget.rounds == 8


@pytest.mark.parametrize(("seconds", "timed"), [("0", False), ("0.5", True)])
def test_a_budget_of_no_seconds_times_nothing(tmp_path, seconds, timed):
    experiment = _load(tmp_path, f"{GOOD}[budget]\nseconds = {seconds}\n")
    planned = plan.plan(experiment, find_methods(), [DeviceInfo("opencl:none", "", "", "", 1, True, "wall", ())])
    assert {one.is_timed for one in planned} == {timed} == {one.frame is not None for one in planned}
    assert (race.tolerance_of(experiment) is not None) is timed
