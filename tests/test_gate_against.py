"""The gate against another revision: bugs between two commits are found without a baseline, and nothing else is."""

import dataclasses
import subprocess

import pytest

from harness import ROOT
from harness.cli import main
from harness.experiment import identity
from harness.gate import against, revision
from harness.kernels import sections

from .conftest import usable_devices

pytestmark = pytest.mark.usefixtures("devices_found_once")

METHOD = """from firsthit import Method, Parameter

METHOD = Method(
    name="mine",
    source="none",
    needs=("surface_along", "surface_value_along"),
    parameters=(Parameter("STEPS", 200, "steps along the ray", finer="up"),),
    tables=lambda surface, knobs, precision: {"SHIFT": [0.0, 0.0]},
)
"""
KERNEL = """Hit first_hit(Ray ray, real t0, real t1) {
    Hit hit = no_hit(t1);
    Along along = surface_along(ray);
    real step = (t1 - t0) / real(STEPS);
    real before = surface_value_along(along, t0);
    hit.evaluations = 1;
    for (int i = 1; i <= STEPS; i++) {
        real t = t0 + step * real(i);
        real value = surface_value_along(along, t);
        hit.evaluations += 1;
        if ((before < 0.0) != (value < 0.0)) {
            return hit_at(hit, t - step * (value / (value - before)) + SHIFT[1]);
        }
        before = value;
    }
    return missed(hit);
}
"""
CONFIG = """title = "Gate of a plugin"
surfaces = ["torus"]
families = ["thin_torus"]
sizes = [64]
devices = ["{device}"]
[[method]]
name = "mine"
[accuracy]
size = 24
[budget]
seconds = 0.1
[gate.figures]
speed = {{ gated = false }}
"""
VIEW, FAMILY = "mine torus default 64x64x1 float32 compute", "mine family thin_torus float32"


def git(folder, *arguments):
    who = ("-c", "user.name=t", "-c", "user.email=t@example.org", "-c", "commit.gpgsign=false")
    done = subprocess.run(["git", "-C", str(folder), *who, *arguments], check=True, capture_output=True, text=True)
    return done.stdout.strip()


def device_of(*backends):
    names = [info.name for backend in backends for info in usable_devices() if info.name.startswith(backend)]
    return names[0] if names else pytest.skip(f"no device of {backends}")


@pytest.fixture(scope="module")
def shared_runs(tmp_path_factory):
    """A folder for rows and certified answers, which are named by what decides them."""
    return tmp_path_factory.mktemp("runs")


@pytest.fixture
def gated(tmp_path, capsys, shared_runs):
    """A repository of one method and its config, committed; a function that gates it: exit code, stdout, stderr."""
    top = tmp_path / "repository"
    plugins, config = top / "plugins", top / "plugin.toml"
    (plugins / "mine").mkdir(parents=True)
    (plugins / "mine" / "method.py").write_text(METHOD)
    (plugins / "mine" / "kernel.glsl").write_text(KERNEL)
    config.write_text(CONFIG.format(device=device_of("opengl:", "opencl:")))

    def gate(*arguments, plugins=plugins, runs=shared_runs):
        capsys.readouterr()
        for remembered in (sections._read, identity._of_method):  # files do not change while a command runs
            remembered.cache_clear()
        code = main(["--plugins", str(plugins), "gate", str(config), "--runs", str(runs), *arguments])
        captured = capsys.readouterr()
        assert "Traceback" not in captured.err
        return code, captured.out, captured.err

    def commit():
        git(top, "add", "-A")
        git(top, "commit", "-q", "--allow-empty", "-m", "more")

    def plant(file, old, new):
        path = top / file
        text = path.read_text()
        assert text.count(old) == 1, f"{old} is not once in {file}"
        path.write_text(text.replace(old, new))

    gate.commit, gate.plant, gate.config, gate.top, gate.runs = commit, plant, config, top, shared_runs
    git(tmp_path, "init", "-q", "repository")
    commit()
    return gate


def verdict(out, cell):
    """Return the verdict that the table states of a cell's figures; None where it lists none."""
    lines = [line.split()[0] for line in out.splitlines() if f" {cell}: accuracy" in line]
    return lines[0] if lines else None


def test_an_accuracy_bug_between_two_commits_is_found_without_a_baseline(gated):
    code, out, _ = gated("--against", "HEAD")
    assert (code, out.splitlines()) == (0, ["2 pass", "accuracy against HEAD: 2 the same program"])
    gated.plant("plugins/mine/kernel.glsl", "t - step * (value / (value - before))", "t")
    code, out, err = gated("--against", "HEAD", "--force")
    assert code == 1
    assert verdict(out, VIEW) == verdict(out, FAMILY) == "regressed"
    assert "2 with other figures" in out and "error_p99" in out
    assert len([line for line in err.splitlines() if "[2/2]" in line]) == 2, "progress of both revisions is told"
    gated.commit()
    assert gated("--against", "HEAD")[0] == 0
    gated.plant("plugins/mine/kernel.glsl", "t + SHIFT", "t - step * (value / (value - before)) + SHIFT")
    code, out, _ = gated("--against", "HEAD")
    assert code == 0 and verdict(out, VIEW) == "improved"
    assert not list((gated.top / ".git").glob("worktrees/*"))
    assert not list(gated.top.rglob("baselines"))


def test_a_changed_comment_runs_twice_and_gives_the_same_to_the_last_digit(gated):
    gated.plant("plugins/mine/kernel.glsl", "    return missed", "    // nothing was found\n    return missed")
    code, out, err = gated("--against", "HEAD", "--force")
    assert (code, out.splitlines()) == (0, ["2 pass", "accuracy against HEAD: 2 the same to the last digit"])
    assert err.count("[2/2]") == 2
    assert "[1/" not in gated("--against", "HEAD")[2], "rows of both revisions are used again"


def test_tables_are_the_other_revisions_own_on_both_sides(gated):
    gated.plant("plugins/mine/method.py", "[0.0, 0.0]", "[0.0, 0.01]")
    code, out, _ = gated("--against", "HEAD")
    assert code == 1 and verdict(out, VIEW) == "regressed"
    gated.commit()
    gated.plant("plugins/mine/method.py", "[0.0, 0.01]", "[0.0, 0.0]")
    code, out, _ = gated("--against", "HEAD")
    assert code == 0 and verdict(out, VIEW) == "improved"


def test_claims_are_counted_as_each_revision_states_them(gated):
    gated.plant("plugins/mine/method.py", 'source="none",', 'source="none", claims=frozenset({"no_false_hit"}),')
    gated.commit()
    gated.plant("plugins/mine/method.py", ' claims=frozenset({"no_false_hit"}),', "")
    code, out, _ = gated("--against", "HEAD")
    assert code == 1 and verdict(out, VIEW) == "regressed" and " claims " in out


def test_cells_that_only_one_revision_has_are_new_or_missing(gated):
    """A variant that the method no longer states is missing; a method that came later is new, and stops nothing."""
    gated.plant("plugins/mine/method.py", 'along the ray", ', 'along the ray", printed=50, ')
    gated.plant("plugin.toml", 'name = "mine"', 'name = "mine"\ndeviations = true')
    gated.commit()
    code, out, _ = gated("--against", "HEAD")
    assert (code, "4 the same program" in out) == (0, True)
    gated.plant("plugins/mine/method.py", "printed=50, ", "")
    later = gated.top / "plugins" / "later"
    later.mkdir()
    (later / "method.py").write_text(METHOD.replace('"mine"', '"later"'))
    (later / "kernel.glsl").write_text(KERNEL)
    gated.plant("plugin.toml", "[accuracy]", '[[method]]\nname = "later"\n[accuracy]')
    code, out, _ = gated("--against", "HEAD")
    assert code == 1
    assert verdict(out, VIEW.replace("mine", "mine[STEPS=50]")) == "missing"
    assert verdict(out, VIEW.replace("mine", "later")) == "new"
    assert "it has no method 'later'" in out


def test_a_cell_that_is_skipped_or_fails_at_one_revision_has_a_verdict_by_its_status(gated):
    gated.plant("plugins/mine/method.py", "    tables", '    accepts=lambda surface: "not today",\n    tables')
    code, out, _ = gated("--against", "HEAD")
    assert code == 1 and verdict(out, VIEW) == "regressed" and "the other revision casts it" in out
    gated.commit()
    code, out, _ = gated("--against", "HEAD")
    assert code == 0 and "2 skipped at both revisions" in out
    git(gated.top, "checkout", "-q", "HEAD~1", "--", ".")
    code, out, _ = gated("--against", "HEAD")
    assert code == 0 and verdict(out, VIEW) == "improved"
    gated.plant("plugins/mine/kernel.glsl", "return missed(hit);", "return missed(hit)")
    code, out, _ = gated("--against", "HEAD~1")
    assert code == 1 and verdict(out, VIEW) == "regressed" and "kernel.glsl" in out
    gated.commit()
    gated.plant("plugins/mine/kernel.glsl", "    return missed", "\n    return missed")
    code, out, _ = gated("--against", "HEAD")
    assert code == 3 and verdict(out, VIEW) == "incomparable" and "2 not compared" in out


def test_a_method_that_is_broken_at_the_other_revision_alone_is_not_improved(gated):
    gated.config.write_text(gated.config.read_text().replace("speed = {", "# {"))
    gated.plant("plugins/mine/method.py", "METHOD = Method(", "raise SystemExit(0)\nMETHOD = Method(")
    gated.commit()
    git(gated.top, "checkout", "-q", "HEAD~1", "--", "plugins")
    code, out, _ = gated("--against", "HEAD")
    assert code == 3 and verdict(out, VIEW) == verdict(out, FAMILY) == "incomparable", out
    assert out.count("at the other revision method 'mine' cannot be loaded") == 3
    assert "improved" not in out and "missing" not in out and "2 not compared" in out


def test_a_method_that_goes_wrong_at_the_other_revision_alone_is_not_improved(gated):
    gated.plant("plugins/mine/method.py", "    tables", "    accepts=lambda surface: 1 / 0,\n    tables")
    gated.commit()
    git(gated.top, "checkout", "-q", "HEAD~1", "--", "plugins")
    code, out, _ = gated("--against", "HEAD")
    assert code == 3 and verdict(out, VIEW) == verdict(out, FAMILY) == "incomparable", out
    assert "improved" not in out and "ZeroDivisionError" in out


def altered(monkeypatch, change):
    """Let the other revision tell of its cells what `change` makes of them."""
    found = revision.programs_at

    def programs_at(*arguments):
        formers = found(*arguments)
        return dataclasses.replace(formers, cells={slot: change(former) for slot, former in formers.cells.items()})

    monkeypatch.setattr(revision, "programs_at", programs_at)


def test_another_scene_under_the_same_name_is_incomparable_and_says_which_part(gated, monkeypatch):
    def change(former):
        other = former.identity | ({"view": {"azimuth": 31.0}} if "view" in former.identity else {})
        return dataclasses.replace(former, identity=other)

    altered(monkeypatch, change)
    code, out, _ = gated("--against", "HEAD")
    assert code == 3 and verdict(out, VIEW) == "incomparable" and verdict(out, FAMILY) is None
    assert "the other revision has another view under this name" in out


def test_programs_that_the_host_cannot_launch_are_incomparable(gated, monkeypatch):
    def change(former):
        checks = (dataclasses.replace(check, entry="beams") for check in former.programs.checks)
        return dataclasses.replace(former, programs=dataclasses.replace(former.programs, checks=tuple(checks)))

    altered(monkeypatch, change)
    code, out, _ = gated("--against", "HEAD")
    assert code == 3 and "launched in another way" in out


@pytest.mark.parametrize(
    ("now", "then", "parts"),
    [
        ({"surface": {"formula": "x"}, "view": 1}, {"surface": {"formula": "y"}}, ["surface"]),
        ({"view": {"fov": 40.0, "roll": 0.0}}, {"view": {"fov": 40.0}}, []),
        ({"sampling": [64, 1, "compute"]}, {"sampling": [64, 4, "compute"]}, ["sampling"]),
        ({"family": [{"rays": "a"}]}, {"family": [{"rays": "b"}]}, ["family"]),
        ({"raster": {"meshes": [64]}}, {"raster": {"meshes": [32]}}, []),
        ({"raster": {"scene": {"places": "a", "variant": 1}}}, {"raster": {"scene": {"places": "a"}}}, []),
        ({"raster": {"proxy": "box"}}, {"raster": {"proxy": "sphere"}}, ["raster"]),
        ({"budget": 1, "program": 2, "accuracy": {"size": 1}}, {"budget": 2, "accuracy": {"size": 2}}, []),
    ],
)
def test_only_what_is_asked_of_the_method_makes_cells_incomparable(now, then, parts):
    assert against.differing(now, then) == parts


def test_a_baseline_is_judged_too_where_one_is_given(gated):
    assert gated("--against", "HEAD", "--baseline", "none.toml")[0] == 2
    baseline = gated.top / "own.toml"
    arguments = ["--plugins", str(gated.top / "plugins"), "bless", str(gated.config), "--runs", str(gated.runs)]
    assert main([*arguments, "--baseline", str(baseline), "--reason", "first"]) == 0
    gated.plant("plugins/mine/kernel.glsl", "t - step * (value / (value - before))", "t")
    gated.commit()
    code, out, _ = gated("--against", "HEAD", "--baseline", str(baseline))
    assert code == 1 and verdict(out, VIEW) is None
    assert f"regressed  {VIEW}" in out and "2 regressed, 2 pass" in out


def test_mistakes_about_the_revision_are_told_before_anything_runs(gated, tmp_path):
    runs = tmp_path / "runs"
    code, _, err = gated("--against", "nonesuch", runs=runs)
    assert code == 2 and "has no revision 'nonesuch'; `git fetch`" in err
    bare = tmp_path / "bare"
    (bare / "mine").mkdir(parents=True)
    code, _, err = gated("--against", "HEAD", plugins=bare, runs=runs)
    assert code == 2 and "is in no git repository that can be read" in err
    code, _, err = gated("--against", "HEAD", plugins=tmp_path / "nowhere", runs=runs)
    assert code == 2 and "there is no folder" in err
    git(gated.top, "commit", "-q", "--allow-empty", "-m", "second")
    git(tmp_path, "clone", "-q", "--depth", "1", f"file://{gated.top}", "shallow")
    code, _, err = gated("--against", "HEAD~1", plugins=tmp_path / "shallow" / "plugins", runs=runs)
    assert code == 2 and "the clone is shallow: `git fetch --unshallow`" in err
    assert not runs.exists()


def test_methods_that_the_other_revision_does_not_have_are_new(gated):
    """So that the change that brings a method, or the folder of the first one, passes by its baseline."""
    for folder, name in (("plugins", "second"), ("young", "third")):
        (gated.top / folder / name).mkdir(parents=True)
        (gated.top / folder / name / "method.py").write_text(METHOD.replace('"mine"', f'"{name}"'))
        (gated.top / folder / name / "kernel.glsl").write_text(KERNEL)
        gated.config.write_text(gated.config.read_text().replace('name = "mine"', f'name = "{name}"'))
        code, out, err = gated("--against", "HEAD", plugins=gated.top / folder)
        assert code == 3 and "nothing was compared, which is no pass; `firsthit bless`" in err
        assert verdict(out, VIEW.replace("mine", name)) == "new" and f"it has no method '{name}'" in out
        assert "give --plugins" not in out
        blessed = gated.top / f"{name}.baseline.toml"
        words = ["--plugins", str(gated.top / folder), "bless", str(gated.config), "--reason", "first"]
        assert main([*words, "--runs", str(gated.runs), "--baseline", str(blessed)]) == 0
        code, out, err = gated("--against", "HEAD", "--baseline", str(blessed), plugins=gated.top / folder)
        assert code == 0 and "\n2 new, 2 pass\n" in out, out + err
        gated.config.write_text(CONFIG.format(device=device_of("opengl:", "opencl:")))


def test_an_installation_has_no_revisions_of_its_own(tmp_path, monkeypatch):
    """Within somebody else's repository, REV would name one of theirs."""
    git(tmp_path, "init", "-q")
    monkeypatch.setattr(revision, "ROOT", tmp_path / "site-packages")
    (tmp_path / "site-packages").mkdir()
    with pytest.raises(against.FirsthitError, match="is an installation and no clone of firsthit; give --plugins"):
        revision.found("HEAD", None)


def test_modules_beside_the_methods_folder_are_the_other_revisions(gated, monkeypatch):
    """An installation that can be edited, or PYTHONPATH, would offer the present one."""
    (gated.top / "shift_of_mine.py").write_text("SHIFT = [0.0, 0.0]\n")
    monkeypatch.syspath_prepend(str(gated.top))
    gated.plant("plugins/mine/method.py", "from firsthit", "import shift_of_mine\nfrom firsthit")
    gated.plant("plugins/mine/method.py", "[0.0, 0.0]", "shift_of_mine.SHIFT")
    gated.commit()
    (gated.top / "shift_of_mine.py").write_text("SHIFT = [0.0, 0.01]\n")
    code, out, _ = gated("--against", "HEAD")
    assert code == 1 and verdict(out, VIEW) == "regressed"


def test_every_kind_runs_the_other_revisions_programs_with_what_belongs_to_them(gated):
    """Beams, a quadtree with another layout, rays behind a prepass, fragments, and a mesh of another fineness."""
    device = device_of("opengl:")
    pytest.importorskip("pyvista")
    for name in ("interval_adaptive", "interval_uniform", "polygon"):
        folder = gated.top / "plugins" / f"my_{name}"
        folder.mkdir()
        for file in ("method.py", "kernel.glsl"):
            text = (ROOT / "methods" / name / file).read_text().replace(f'name="{name}"', f'name="my_{name}"')
            (folder / file).write_text(text)
    text = CONFIG.format(device=device).replace('families = ["thin_torus"]\n', 'stages = ["compute", "raster"]\n')
    names = "".join(
        f'[[method]]\nname = "my_{name}"\n' for name in ("interval_adaptive", "interval_uniform", "polygon")
    )
    gated.config.write_text(text.replace("sizes", 'prepass = ["none", "beams"]\nsizes').replace("[acc", f"{names}[acc"))
    gated.commit()
    code, out, _ = gated("--against", "HEAD")
    assert code == 0 and "6 the same program" in out
    gated.plant("plugins/mine/kernel.glsl", "    return missed", "    //\n    return missed")
    gated.plant("plugins/my_interval_adaptive/method.py", '"GROUPED", 1', '"GROUPED", 0')
    gated.plant("plugins/my_interval_uniform/kernel.glsl", "void cast_cell", "//\nvoid cast_cell")
    gated.plant("plugins/my_polygon/method.py", '"N", 64', '"N", 16')
    code, out, _ = gated("--against", "HEAD")
    assert code == 1
    assert verdict(out, "my_polygon torus default 64x64x1 float32 raster") == "regressed"
    assert "5 the same to the last digit, 1 with other figures" in out
    gated.commit()
    gated.plant("plugins/my_polygon/method.py", '"N", 16', '"N", 64')
    code, out, _ = gated("--against", "HEAD")
    assert code == 0 and verdict(out, "my_polygon torus default 64x64x1 float32 raster") == "improved"
