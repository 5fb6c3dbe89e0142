"""conform as a plugin's author meets it: the docs' example and a textbook method pass, a failing check says why."""

from __future__ import annotations

import re
import textwrap
from pathlib import Path

import pytest

from harness import ROOT
from harness.cli import main

from .conftest import usable_devices

pytestmark = [
    pytest.mark.skipif(not usable_devices(), reason="no device"),
    pytest.mark.usefixtures("devices_found_once", "few_degrees"),
]


ILLINOIS = {
    "method.py": """
from harness.contract import Method, Parameter
METHOD = Method(
    name="illinois",
    source="Dowell and Jarratt 1971",
    needs=("surface_along", "surface_value_along"),
    parameters=(
        Parameter("STEPS", 256, "samples along the ray that bracket the root", finer="up"),
        Parameter("TOLERANCE", 1e-7, "shortest bracket, over the domain's radius", finer="down", sweep=(1e-6,)),
        Parameter("MAX_STEPS", 60, "of regula falsi"),
    ),
)
""",
    "kernel.glsl": """
Hit first_hit(Ray ray, real t0, real t1) {
    Hit hit = no_hit(t1);
    Along along = surface_along(ray);
    real a = t0;
    real fa = surface_value_along(along, a);
    hit.evaluations += 1;
    for (int i = 1; i <= STEPS; i++) {
        real b = t0 + (t1 - t0) * (real(i) / real(STEPS));
        real fb = surface_value_along(along, b);
        hit.evaluations += 1;
        if ((fa < 0.0) != (fb < 0.0)) {
            for (int k = 0; k < MAX_STEPS; k++) {
                if (fabs(b - a) <= TOLERANCE * DOMAIN_RADIUS || fb == 0.0) return hit_at(hit, b);
                real t = b - fb * ((b - a) / (fb - fa));
                real f = surface_value_along(along, t);
                hit.evaluations += 1;
                if ((f < 0.0) != (fb < 0.0)) { a = b; fa = fb; }
                else { fa = 0.5 * fa; }
                b = t;
                fb = f;
            }
            return hit_at(hit, b);
        }
        a = b;
        fa = fb;
    }
    return hit;
}
""",
}


def _write(folder: Path, files: dict[str, str]) -> Path:
    folder.mkdir()
    for name, text in files.items():
        (folder / name).write_text(text)
    return folder.parent


def _example() -> dict[str, str]:
    """method.py and kernel.glsl as docs/methods.md prints them."""
    page = (ROOT / "docs" / "methods.md").read_text(encoding="utf-8")
    blocks = [textwrap.dedent(block) for block in re.findall(r"(?:^(?: {4}.*)?\n)+", page, re.MULTILINE)]
    description = next(block for block in blocks if "METHOD = " in block)
    kernel = next(block for block in blocks if "Hit first_hit(" in block)
    return {"method.py": description, "kernel.glsl": kernel}


def _conform(plugins: Path, name: str, capsys, *more: str) -> tuple[int, str]:
    code = main(["--plugins", str(plugins), "conform", "--method", name, *more])
    return code, capsys.readouterr().out


def test_the_readmes_example_conforms_on_every_device(tmp_path, capsys):
    code, out = _conform(_write(tmp_path / "mine", _example()), "mine", capsys, "--surface", "torus")
    assert code == 0, out
    for info in usable_devices():
        assert re.search(rf"^mine on {info.name}: (\d+) of \1 checks hold$", out, re.MULTILINE)


def test_regula_falsi_whose_knobs_all_end_at_the_floor_of_float32_conforms(tmp_path, capsys):
    device = ("--device", usable_devices()[0].name)
    code, out = _conform(_write(tmp_path / "illinois", ILLINOIS), "illinois", capsys, *device)
    assert code == 0, out


BROKEN = {
    "answers": ("return hit_at(hit, sqrt(-1.0 - t0 * t0));", "hit whose t is not finite"),
    "right answers": ("return missed(hit);", "share of wrong answers on clear rays"),
    "error": ("return hit_at(hit, t);", "99 of 100 right hits stay below"),
}


@pytest.mark.parametrize("check", BROKEN)
def test_a_failing_check_says_what_was_measured_against_which_limit_by_which_rule(tmp_path, capsys, check):
    wrong, rule = BROKEN[check]
    files = _example()
    files["kernel.glsl"], changes = re.subn(r"return hit_at\(hit, t - step.*", wrong, files["kernel.glsl"])
    assert changes == 1
    device = ("--device", usable_devices()[0].name)
    code, out = _conform(_write(tmp_path / "mine", files), "mine", capsys, *device, "--surface", "torus")
    assert code == 1
    assert max(map(len, out.splitlines())) <= 100
    block = next(part for part in out.split("  FAILS  ")[1:] if part.startswith(check))
    measured, limit = re.search(r"measured  (\S+), at most (\S+) allowed", block).groups()
    assert measured == "nothing" or float(measured) > float(limit)
    assert rule in " ".join(block.split())
    assert "    do        " in block
    if check != "error":
        assert "the oracle says crossing at" in " ".join(block.split())


def test_where_nothing_is_checked_nothing_conforms(tmp_path, capsys):
    files = _example()
    files["method.py"] = files["method.py"].replace('name="mine",', 'name="mine", accepts=lambda _: "it likes none",')
    device = ("--device", usable_devices()[0].name)
    code, out = _conform(_write(tmp_path / "mine", files), "mine", capsys, *device)
    assert code == 1
    assert "it likes none" in out and "nothing was checked of mine" in out
