"""One row of a gate: chosen by --only, got again by the command that the outputs name, and drawn by --pictures."""

import shlex
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest

from harness import ROOT
from harness.cli import main
from harness.gate import baseline, pictures
from harness.gate.baseline import Baseline
from harness.gate.judge import Judged, Verdict
from harness.results.store import FORMAT, Store

from . import test_gate as of_a_plugin
from .agreeing_rows import whole

pytestmark = pytest.mark.usefixtures("devices_found_once")

one_device, blessed_text, gated = of_a_plugin.one_device, of_a_plugin.blessed_text, of_a_plugin.gated  # fixtures
TORUS, FAMILY = "mine torus default 128x128x1 float32 compute", "mine family double_root float32"


def _cases(path):
    return {case.get("name"): case for case in ElementTree.parse(path).iter("testcase")}


def _loosen(gate):
    of_a_plugin._plant(gate.plugins, "mine", "method.py", '"EPSILON",\n            0.001,', '"EPSILON", 0.05,')


def test_only_judges_the_rows_that_it_chooses(gated):
    code, out, err = gated("--only", TORUS)
    assert (code, out) == (0, "1 pass\n")
    assert "[1/1]" in err
    code, out, _ = gated("--only", "family", "--only", TORUS)
    assert (code, out) == (0, "3 pass\n")
    code, _, err = gated("--only", "tours")
    assert code == 2
    assert "--only: no row's name holds 'tours'; did you mean 'torus'?" in err


def test_only_still_finds_a_row_that_is_gone(gated):
    gated.config.write_text(gated.config.read_text().replace('["torus"]', '["sphere"]'))
    code, out, _ = gated("--only", TORUS)
    assert code == 1
    assert out.splitlines()[-1] == "1 missing"


def test_each_command_in_junit_gets_its_row_again(gated, tmp_path, capsys):
    """Those of a regressed row, of a row that passes, and of a family; each as a person would paste it."""
    _loosen(gated)
    assert gated("--junit", tmp_path / "g.xml")[0] == 1
    for name, expected in ((TORUS, 1), ("theirs torus default 128x128x1 float32 compute", 0), (FAMILY, 0)):
        case = _cases(tmp_path / "g.xml")[name]
        told = {p.get("name"): p.get("value") for p in case.iter("property")}
        program, *arguments = shlex.split(told["command"])
        assert program == "firsthit"
        capsys.readouterr()
        assert main([*arguments, "--junit", str(tmp_path / "again.xml")]) == expected
        (again,) = _cases(tmp_path / "again.xml").values()
        assert again.get("name") == name
        assert {p.get("name"): p.get("value") for p in again.iter("property")} == told
        assert float(again.get("time")) > 0


def test_a_row_of_an_earlier_run_says_so(gated, tmp_path):
    gated("--junit", tmp_path / "g.xml")
    assert not [
        p for case in _cases(tmp_path / "g.xml").values() for p in case.iter("property") if "ear" in p.get("name")
    ]
    gated("--junit", tmp_path / "g.xml")
    for case in _cases(tmp_path / "g.xml").values():
        told = {p.get("name"): p.get("value") for p in case.iter("property")}
        assert told["earlier"][:2] == "20"
        assert float(case.get("time")) > 0


def test_pictures_show_each_row_that_fell_before_and_now(gated, tmp_path):
    from PIL import Image

    folder = tmp_path / "new" / "pictures"
    assert gated("--pictures", folder)[1].splitlines()[-1] == f"{folder}: 0 pictures of wrong rays"
    _loosen(gated)
    drop = "Hit first_hit(Ray ray, real t0, real t1) {\n    t0 = t0 + 0.5 * (t1 - t0);"
    of_a_plugin._plant(gated.plugins, "theirs", "kernel.glsl", "Hit first_hit(Ray ray, real t0, real t1) {", drop)
    more = ("--junit", tmp_path / "g.xml", "--markdown", tmp_path / "g.md")
    folders = ("--plugins", gated.plugins, "gate", gated.config, "--runs", tmp_path, "--pictures", folder)
    command = [sys.executable, "-m", "harness.cli", *folders, *more]  # another process, since this one knows the kernel
    result = subprocess.run(list(map(str, command)), cwd=ROOT, capture_output=True, text=True, check=False)
    code, out = result.returncode, result.stdout
    assert code == 1, result.stderr
    drawn = sorted(folder.iterdir())
    fell = {line.split("  ")[1] for line in out.splitlines() if line.startswith("regressed")}
    assert len(drawn) == len(fell) >= 2
    assert all(min(Image.open(path).size) > 400 for path in drawn)
    for name, case in _cases(tmp_path / "g.xml").items():
        named = [p.get("value") for p in case.iter("property") if p.get("name") == "picture"]
        assert len(named) == (name in fell)
        assert all(value in map(str, drawn) and value in (tmp_path / "g.md").read_text() for value in named)


def test_a_package_that_pictures_need_is_missed_before_anything_runs(gated, tmp_path, monkeypatch):
    for name in [name for name in sys.modules if name.partition(".")[0] in ("reports", "matplotlib")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    code, out, err = gated("--pictures", tmp_path / "pictures")
    assert (code, out) == (3, "")
    assert err == "firsthit: --pictures needs the package matplotlib: pip install 'firsthit[report]'\n"


def test_a_folder_that_cannot_be_is_said_before_anything_runs(gated, tmp_path):
    (tmp_path / "file").write_text("")
    code, out, err = gated("--pictures", tmp_path / "file")
    assert (code, out) == (2, "")
    assert "--pictures" in err


SIZE = 16
SLOT, DEVICE = "m sphere default 16x16x1 float32 compute", "opencl:a"


def _stored(folder, key, program, wrong=(), started="2026-01-01T00:00:00+00:00"):
    """Store a row of SLOT with its answers; the rays `wrong` are misses."""
    codes = np.zeros((SIZE, SIZE), np.uint8)
    for place in wrong:
        codes[place] = 1
    arrays = {
        "truth": np.ones_like(codes),
        "error": np.where(codes > 0, np.nan, 1e-6).astype(np.float32),
        "wrong": codes,
        "grazing": np.zeros(codes.shape, bool),
        "shade": np.where(codes > 0, np.nan, 0.5).astype(np.float32),
        "evaluations": np.full(codes.shape, 7, np.int32),
    }
    row = {"format": FORMAT, "key": key, "slot": f"{SLOT} {DEVICE}", "program": {"hash": program}}
    row |= {"rungs": None, "family": None}
    row |= {"environment": {"started": started}, "status": "ok", "variant": "m", "surface": "sphere", "view": "default"}
    Store(folder).write(whole(row | {"precision": "float32", "arrays": None}), arrays)
    return Store(folder).read(key)


def _blessed(program):
    entry = {"status": "ok", "scene": "s", "program": program}
    return Baseline("t", {"k": {"name": DEVICE, "blessed": "2026-01-01"}}, {"k": {SLOT: entry}})


FELL = Judged(SLOT, DEVICE, "m", Verdict.REGRESSED)


def test_the_blessed_programs_answers_are_found_among_earlier_rows(tmp_path):
    _stored(tmp_path, "a", "old", [(1, 1)])
    _stored(tmp_path, "b", "old", [(2, 2)], "2026-02-01T00:00:00+00:00")
    _stored(tmp_path, "c", "other", [(3, 3)], "2026-03-01T00:00:00+00:00")
    now = _stored(tmp_path, "d", "new")
    side = pictures.blessed_in(_blessed("old"), tmp_path)(FELL, now)
    assert (side.told, side.title) == ("", "blessed 2026-01-01: program old")
    assert np.argwhere(side.arrays["wrong"]).tolist() == [[2, 2]], "the newest one"


@pytest.mark.parametrize(
    ("program", "words"),
    [
        ("gone", "the answers of the blessed program, gone, are not on this machine"),
        ("new", "this is the blessed program: what it answered where it was blessed is not on this machine"),
        (None, "the baseline names no program"),
    ],
)
def test_where_the_blessed_answers_are_not_here_the_picture_says_so(tmp_path, program, words):
    now = _stored(tmp_path, "d", "new", [(4, 4)])
    side = pictures.blessed_in(_blessed(program), tmp_path)(FELL, now)
    assert side.told.startswith(words)
    assert not side.arrays


def test_answers_of_another_revision_are_drawn_from_its_rows(tmp_path):
    then, now = _stored(tmp_path, "a", "old", [(1, 1)]), _stored(tmp_path, "d", "new", [(4, 4)])
    before = pictures.rows_in({(SLOT, DEVICE): then}, tmp_path, "at v1")
    for end in ("", ": accuracy", ": speed"):
        judged = Judged(SLOT + end, DEVICE, "m", Verdict.REGRESSED)
        assert np.argwhere(before(judged, now).arrays["wrong"]).tolist() == [[1, 1]]
    assert pictures.rows_in({}, tmp_path, "at v1")(FELL, now).told == "there are no answers at v1"


def test_a_picture_is_drawn_whatever_is_missing(tmp_path):
    import io

    from PIL import Image

    from reports.drawing import pairs

    now = pictures.side_of(_stored(tmp_path, "d", "new", [(4, 4)]), tmp_path, "now")
    nothing = pictures.Side("before", told="not on this machine")
    damaged = pictures.Side("before", told="its answers cannot be read: damaged")
    for before, after in ((nothing, now), (damaged, now), (nothing, nothing)):
        image = np.asarray(Image.open(io.BytesIO(pairs.png(("m", "fell"), before, after, evaluations=True))))
        assert image.shape[2] >= 3
    (tmp_path / "arrays" / "d.npz").write_bytes(b"PK\x03\x04 no archive")
    assert "cannot be read" in pictures.side_of(Store(tmp_path).read("d"), tmp_path, "now").told


def test_wrong_rays_have_the_colours_of_their_kinds(tmp_path):
    import io

    from matplotlib.colors import to_rgb
    from PIL import Image

    from reports.drawing import pairs, style

    row = _stored(tmp_path, "d", "new", [(r, c) for r in range(8) for c in range(SIZE)])
    side = pictures.side_of(row, tmp_path, "now")
    clean = pictures.side_of(_stored(tmp_path, "e", "old"), tmp_path, "before")
    image = np.asarray(Image.open(io.BytesIO(pairs.png(("m", "fell"), clean, side))).convert("RGB"))
    miss = np.round(255 * np.array(to_rgb(style.WRONG[0].color))).astype(int)
    painted = (np.abs(image.astype(int) - miss) <= 1).all(axis=2)
    left, right = painted[:, : image.shape[1] // 2].sum(), painted[:, image.shape[1] // 2 :].sum()
    half = pairs.PANEL**2 // 2
    assert right >= 1.9 * half, "half of the picture, and half of the map of errors"
    assert left < half // 10, "a patch of the key alone"


def test_the_baseline_is_left_as_it_is(gated):
    before = baseline.read(gated.baseline)
    gated("--only", "mine")
    assert baseline.read(gated.baseline) == before


def test_a_rung_without_a_mark_is_explained_for_the_side_that_lacks_it():
    from reports.drawing import pairs

    whole = {"decided": 4, "right": 4, "worst_ratio": 1.0}
    assert pairs.across("gap", [whole]) == "Across: gap."
    wrong, unknown = whole | {"right": 2, "worst_ratio": None}, whole | {"decided": 0, "worst_ratio": None}
    hit, ray = "no hit that was answered rightly.", "no ray that can be decided."
    assert pairs.across("gap", [whole, wrong]).endswith(f"On the right, a place without a mark has {hit}")
    assert pairs.across("gap", [whole, unknown]).endswith(f"On the left, a place without a mark has {ray}")
