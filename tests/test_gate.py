"""The gate for real: a plugin is blessed, bugs are planted in it, and the row that should catch each one does."""

import subprocess
import sys
from xml.etree import ElementTree

import pytest

from harness import ROOT
from harness.cli import main

from .conftest import usable_devices

pytestmark = pytest.mark.usefixtures("devices_found_once")

CONFIG = """title = "Gate of a plugin"
surfaces = ["torus"]
families = ["double_root"]
sizes = [128]
devices = ["{device}"]
[[method]]
name = "mine"
[[method]]
name = "theirs"
[accuracy]
size = 32
[budget]
seconds = 0.5
"""
MINE, THEIRS = "newton", "interval_march"


@pytest.fixture(scope="module")
def one_device():
    names = [info.name for info in usable_devices() if info.name.startswith("opencl:")]
    if not names:
        pytest.skip("no OpenCL device")
    return names[0]


def _copy(folder, source, name):
    (folder / name).mkdir(parents=True)
    for file in ("method.py", "kernel.glsl"):
        text = (ROOT / "methods" / source / file).read_text().replace(f'name="{source}"', f'name="{name}"')
        (folder / name / file).write_text(text)


def _plant(plugins, method, file, old, new):
    path = plugins / method / file
    text = path.read_text()
    assert text.count(old) == 1, f"{old} is no longer in the {method} that is copied"
    path.write_text(text.replace(old, new))


@pytest.fixture
def gated(tmp_path, one_device, capsys, blessed_text):
    """A copy of two methods with its config and baseline; a function that gates it: exit code, stdout, stderr."""
    plugins, config = tmp_path / "plugins", tmp_path / "plugin.toml"
    _copy(plugins, MINE, "mine")
    _copy(plugins, THEIRS, "theirs")
    config.write_text(CONFIG.format(device=one_device))
    baseline = tmp_path / "baselines" / "plugin.toml"
    baseline.parent.mkdir()
    baseline.write_text(blessed_text)

    def gate(*arguments, command="gate"):
        capsys.readouterr()
        code = main(["--plugins", str(plugins), command, str(config), "--runs", str(tmp_path), *map(str, arguments)])
        captured = capsys.readouterr()
        assert "Traceback" not in captured.err
        return code, captured.out, captured.err

    gate.plugins, gate.baseline, gate.config = plugins, baseline, config
    return gate


@pytest.fixture(scope="module")
def blessed_text(tmp_path_factory, one_device, devices_found_once):  # noqa: ARG001
    """The baseline of the copies as they are, blessed once."""
    folder = tmp_path_factory.mktemp("blessed")
    _copy(folder / "plugins", MINE, "mine")
    _copy(folder / "plugins", THEIRS, "theirs")
    (folder / "plugin.toml").write_text(CONFIG.format(device=one_device))
    arguments = ["bless", folder / "plugin.toml", "--runs", folder, "--reason", "the first"]
    assert main(["--plugins", *map(str, (folder / "plugins", *arguments))]) == 0
    text = (folder / "baselines" / "plugin.toml").read_text()
    assert 'reason = "the first"' in text
    return text


def _row(out, cell, figure):
    """The table's line of this cell and figure: its verdict; None where it lists none."""
    for line in out.splitlines():
        if cell in line and f" {figure} " in line:
            return line.split()[0]
    return None


def test_an_unchanged_tree_passes_five_times_out_of_five(gated):
    for _ in range(5):
        code, out, _ = gated("--force")
        assert (code, out.splitlines()[-1]) == (0, "4 pass")


def test_a_plugin_that_cannot_be_loaded_is_no_pass_though_no_row_names_it(gated, tmp_path):
    assert gated()[0] == 0
    _copy(gated.plugins, MINE, "unnamed")
    _plant(gated.plugins, "unnamed", "method.py", "METHOD = Method(", "raise SystemExit(0)\nMETHOD = Method(")
    code, out, err = gated("--junit", tmp_path / "g.xml", "--markdown", tmp_path / "g.md", "--github")
    assert code == 3
    assert "method 'unnamed' cannot be loaded" in err and "SystemExit" in err
    suite = ElementTree.parse(tmp_path / "g.xml").getroot().find("testsuite")
    assert (suite.get("tests"), suite.get("errors")) == ("5", "1")
    (case,) = (case for case in suite.iter("testcase") if case.find("error") is not None)
    assert case.get("name") == "method unnamed" and "SystemExit" in case.find("error").text
    assert "method unnamed" in (tmp_path / "g.md").read_text()
    assert "1 incomparable, 4 pass" in out and "::warning" in out


def test_a_damaged_row_is_checked_again_and_named(gated, tmp_path):
    assert gated()[0] == 0
    row = next(tmp_path.glob("gate-*/cells/*.json"))
    row.write_bytes(row.read_bytes()[:-9])
    code, _, err = gated("--quiet")  # which hides no damaged file
    assert code == 0
    assert f"{row} is damaged" in " ".join(err.split()) and "running that cell again" in err


def test_the_command_that_gates_a_row_again_says_yes_where_the_gate_did(gated):
    _plant(gated.plugins, "mine", "method.py", '"EPSILON",\n            0.001,', '"EPSILON", 0.05,')
    told = gated("--yes", "--github")[1]
    assert "again: firsthit" in told and told.count("again: firsthit") == told.count(" --yes --force")


def test_a_config_whose_method_cannot_be_loaded_failed_and_is_no_mistake_of_usage(gated):
    _plant(gated.plugins, "mine", "method.py", "METHOD = Method(", "nonesuch\nMETHOD = Method(")
    code, out, err = gated()
    assert (code, out.splitlines()[-1]) == (3, "2 incomparable, 2 pass")
    told = [line for line in err.splitlines() if line.startswith("firsthit: method 'mine' cannot be loaded: ")]
    assert len(told) == 1 and told[0].endswith("NameError: name 'nonesuch' is not defined")


def test_finished_rows_are_used_again(gated):
    assert "[4/4]" in gated()[2]
    assert "[" not in gated()[2]


def test_a_loosened_threshold_is_caught_by_the_errors(gated, tmp_path):
    _plant(gated.plugins, "mine", "method.py", '"EPSILON",\n            0.001,', '"EPSILON", 0.05,')
    code, out, _ = gated("--junit", tmp_path / "g.xml", "--markdown", tmp_path / "g.md", "--github")
    assert code == 1
    assert _row(out, "mine torus", "error_max") == "regressed"
    assert _row(out, "theirs", "error_max") is None
    assert "::error title=regressed%3A mine torus" in out
    assert "<failure" in (tmp_path / "g.xml").read_text()
    assert "| regressed | mine torus" in (tmp_path / "g.md").read_text()


def test_a_dropped_root_is_caught_by_misses_or_wrong_roots_and_by_the_claim(gated):
    drop = "Hit first_hit(Ray ray, real t0, real t1) {\n    t0 = t0 + 0.5 * (t1 - t0);"
    _plant(gated.plugins, "theirs", "kernel.glsl", "Hit first_hit(Ray ray, real t0, real t1) {", drop)
    code, out, _ = gated()
    assert code == 1
    assert "regressed" in (_row(out, "theirs torus", "wrong_root"), _row(out, "theirs torus", "misses"))
    assert "claims" in out
    assert _row(out, "mine", "misses") is None


def test_hits_that_are_no_numbers_are_caught(gated):
    """NaN on 95 % of the hits: fewer misses and smaller errors than before, and no improvement."""
    wrong = "return hit_at(hit, fabs(ray.direction.x) > 0.01 ? sqrt(-fabs(t) - 1.0) : t);"
    _plant(gated.plugins, "mine", "kernel.glsl", "return hit_at(hit, t);", wrong)
    code, out, _ = gated()
    assert code == 1
    assert _row(out, "mine torus", "invalid") == "regressed"
    assert _row(out, "mine family double_root", "invalid") == "regressed"
    assert "1 improved" not in out.splitlines()[-1]


def test_one_more_evaluation_a_ray_is_caught_by_the_evaluations_alone(gated):
    _plant(gated.plugins, "mine", "kernel.glsl", "hit.evaluations = 1;", "hit.evaluations = 2;")
    code, out, _ = gated()
    assert code == 1
    assert _row(out, "mine torus", "evaluations_mean") == "regressed"
    changed = {line.split()[-4] for line in out.splitlines() if line.startswith("regressed")}
    assert changed == {"evaluations_mean"}


def test_a_kernel_that_no_longer_compiles_is_a_regression_with_its_line(gated):
    _plant(gated.plugins, "mine", "kernel.glsl", "return missed(hit);", "return mised(hit);")
    code, out, _ = gated()
    assert code == 1
    assert _row(out, "mine torus", "status") == "regressed"
    assert "mine/kernel.glsl:" in out


def test_a_baseline_of_another_driver_and_processor_is_held_exactly_where_both_compute_the_same(gated):
    text = gated.baseline.read_text()
    for fact in ("driver", "processor", "title"):
        line = next(line for line in text.splitlines() if line.startswith(f"{fact} = "))
        text = text.replace(line, f'{fact} = "another"')
    gated.baseline.write_text(text)
    few = "hit.evaluations = 1 + int(fabs(ray.direction.y + 0.433) < 0.01);"
    _plant(gated.plugins, "mine", "kernel.glsl", "hit.evaluations = 1;", few)
    code, out, err = gated()
    assert code == 1, "a change that last bits might explain is a regression here: " + out
    assert _row(out, "mine torus", "evaluations_mean") == "regressed"
    assert "cannot be compared" not in err


def test_a_baseline_without_fingerprints_is_held_with_slack(gated):
    lines = gated.baseline.read_text().replace("format = 2", "format = 1").splitlines()
    kept, arithmetic = [], False
    for line in lines:
        arithmetic = ".arithmetic." in line if line.startswith("[") else arithmetic
        kept += [] if arithmetic else [line]
    gated.baseline.write_text("\n".join(kept))
    assert gated()[0] == 0
    _plant(gated.plugins, "mine", "method.py", '"EPSILON",\n            0.001,', '"EPSILON", 0.05,')
    code, out, _ = gated()
    assert code == 1
    assert "the baseline does not say how" in out


def test_missing_and_new_rows_and_another_view_under_the_same_name(gated):
    config = gated.config.read_text()
    gated.config.write_text(config.replace('["torus"]', '["sphere"]'))
    code, out, _ = gated()
    assert code == 1
    assert out.splitlines()[-1] == "2 missing, 2 new, 2 pass"
    gated.config.write_text(config + "[[view]]\nname = 'default'\nazimuth = 31\n")
    code, out, err = gated()
    assert code == 3
    assert out.splitlines()[-1] == "2 incomparable, 2 pass"
    assert "2 of 4 rows cannot be compared" in err
    assert "do: firsthit bless" in err


def test_a_row_that_is_gone_can_be_gated_alone(gated):
    gated.config.write_text(gated.config.read_text().replace('["torus"]', '["sphere"]'))
    code, out, _ = gated("--only", "mine torus")
    assert (code, out.splitlines()[-1]) == (1, "1 missing")


def test_blessing_makes_the_change_pass_and_says_why(gated):
    _plant(gated.plugins, "mine", "kernel.glsl", "hit.evaluations = 1;", "hit.evaluations = 2;")
    before = set(gated.baseline.read_text().splitlines())
    assert gated("--reason", " ", command="bless")[0] == 2
    code, out, _ = gated("--reason", "it looks twice", command="bless")
    assert (code, "4 rows blessed" in out) == (0, True)
    after = set(gated.baseline.read_text().splitlines())
    kinds = {line.split(" = ")[0] for line in after - before}
    assert {"evaluations_mean", "reason"} <= kinds <= {"evaluations_mean", "reason", "program", "commit", "blessed"}
    assert gated()[0] == 0


def test_a_run_that_fails_is_not_blessed(gated):
    _plant(gated.plugins, "mine", "kernel.glsl", "return missed(hit);", "return mised(hit);")
    before = gated.baseline.read_text()
    code, _, err = gated("--reason", "why not", command="bless")
    assert code == 3
    assert "did not finish" in err
    assert gated.baseline.read_text() == before


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ("[gate.figures]\nmises = { absolute = 1 }\n", "did you mean 'misses'"),
        ("[gate.figures]\nmisses = { better = 'more' }\n", "lower or higher"),
        ("[gate.figures]\nmisses = { gated = 1 }\n", "true or false"),
        ("[gate.figures]\nerror_max = { absolute = nan }\n", "finite number"),
        ("[gate.figures]\nerror_max = { relative = inf }\n", "finite number"),
        ("[gate.figures]\nmisses = { absolute = -1.0 }\n", "not negative"),
        ("[gate.last_bits]\nmises = { absolute = 1 }\n", "did you mean 'misses'"),
        ("[gate.last_bits]\nspeed = { relative = 0.1 }\n", "unknown 'speed'"),
        ("[gate.last_bits]\nmisses = { gated = false }\n", "unknown key 'gated'"),
        ("[gate.last_bits]\nmisses = { absolute = -1.0 }\n", "not negative"),
        ("[gate.last_bits]\nerror_p99 = { relative = nan }\n", "finite number"),
        ("[gate.last_bits]\nerror_p99 = { relative = inf }\n", "finite number"),
        ("[gate]\nsame = ['driver']\n", "gate.same is gone: devices are compared by how they compute"),
    ],
)
def test_mistakes_in_the_gates_table_are_one_line_with_file_and_line(gated, more, words):
    gated.config.write_text(gated.config.read_text() + more)
    code, _, err = gated()
    assert code == 2
    assert f"{gated.config}:14: " in err or f"{gated.config}:15: " in err
    assert words in err


def test_without_a_baseline_it_says_how_to_make_one(gated):
    gated.baseline.unlink()
    code, _, err = gated()
    assert code == 2
    assert "firsthit bless" in err
    gated.config.unlink()
    code, _, err = gated()
    assert code == 2 and f"cannot read {gated.config}" in err and "no baseline" not in err


def _git(folder, *arguments):
    who = ("-c", "user.name=t", "-c", "user.email=t@example.org", "-c", "commit.gpgsign=false")
    subprocess.run(["git", "-C", str(folder), *who, *arguments], check=True, capture_output=True)


def test_speed_against_a_revision_is_the_ratio_of_both_programs(gated):
    """One kernel stays, the other is made to evaluate f forty times where once would do."""
    _git(gated.plugins, "init", "-q")
    _git(gated.plugins, "add", "-A")
    _git(gated.plugins, "commit", "-q", "-m", "first")
    slow = """for (int i = 0; i < 40; i++) {
        Dual again = surface_dual_along(along, t + real(i) * 1e-3);
        if (again.value == 12345.0) return missed(hit);
    }
    bool outside_is_negative"""
    _plant(gated.plugins, "mine", "kernel.glsl", "bool outside_is_negative", slow)
    code, out, err = gated("--against", "HEAD")
    assert code == 1, out + err
    assert _row(out, "mine torus default 128x128x1 float32 compute: speed", "speed") == "regressed"
    assert "95 %, " in out
    assert "theirs" not in out, "the same program needs no race"
    assert not list((gated.plugins / ".git" / "worktrees").glob("*"))
    code, _, err = gated("--against", "nonesuch")
    assert code == 2
    assert "has no revision 'nonesuch'" in err


def test_the_projects_own_gate_config_and_baseline_fit_one_another():
    from harness.experiment import reading
    from harness.gate import baseline
    from harness.plugins import find_methods

    experiment = reading.load(ROOT / "configs" / "gate.toml", find_methods())
    blessed = baseline.read(ROOT / "configs" / "baselines" / "gate.toml")
    for slots in blessed.rows.values():
        for variant in experiment.variants:
            for surface in experiment.surfaces:
                assert any(slot.startswith(f"{variant} {surface.name} ") for slot in slots)
            for family in experiment.config.families:
                assert f"{variant} family {family} float32" in slots


def test_gating_needs_no_report_packages():
    code = "import harness.commands.gate, sys; assert not {'pandas', 'matplotlib', 'typst'} & set(sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True, cwd=ROOT)
