"""The gallery on the command line and in configs."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import surfaces
from harness.cli import main
from harness.contract import FirsthitError
from harness.experiment import reading, shipped
from harness.plugins import find_methods

from .conftest import usable_devices

CONFIG = """title = "t"
surfaces = {surfaces}
[[method]]
name = "newton"
"""


def chosen(folder: Path, names: list[str]) -> list[str]:
    path = folder / "c.toml"
    path.write_text(CONFIG.format(surfaces=str(names).replace("'", '"')))
    return [surface.name for surface in reading.load(path, find_methods()).surfaces]


def test_list_shows_the_catalog_and_each_group(capsys):
    assert main(["list", "surfaces"]) == 0
    out = capsys.readouterr().out
    for group, title in surfaces.groups().items():
        start = out.index(f"{group}: {title}")
        for name in surfaces.names(group):
            assert f"\n{name} " in out[start:], name
    assert "chmutov:nested" in out


def test_a_config_names_groups_and_surfaces_together(tmp_path):
    nodal = list(surfaces.names("nodal"))
    assert chosen(tmp_path, ["nodal", "torus", "goursat"]) == [*nodal, "torus"], "goursat is nodal, and named once"
    assert chosen(tmp_path, ["all"]) == chosen(tmp_path, ["catalog"]) == list(surfaces.names())
    assert chosen(tmp_path, ["gallery"]) == list(surfaces.names("gallery"))
    with pytest.raises(FirsthitError, match=r"c\.toml:2: there is no surface 'nodall'"):
        chosen(tmp_path, ["nodall"])


def test_the_gallerys_config_has_every_method_that_casts_rays_and_answers():
    methods = find_methods()
    casting = {n for n, p in methods.plugins.items() if p.method.casts == "rays" and p.method.answers}
    experiment = reading.load(shipped.located("gallery"), methods)
    assert {variant.method for variant in experiment.variants} == casting
    assert [surface.name for surface in experiment.surfaces] == list(surfaces.names("gallery"))


def test_a_sheet_of_a_group(tmp_path, capsys):
    devices = usable_devices()
    if not devices:
        pytest.skip("a picture needs a device")
    sheet = tmp_path / "sheet.png"
    words = ["sheet", "--method", "newton", "--device", devices[0].name, "--size", "24", "--columns", "2"]
    assert main([*words, "--group", "immersed", "-o", str(sheet)]) == 0
    count = len(surfaces.names("immersed"))
    assert f"{count} surfaces" in capsys.readouterr().out
    with Image.open(sheet) as image:
        assert image.size == (48, 38 * ((count + 1) // 2))
        assert np.asarray(image.convert("L"))[:24, :24].min() < 200
    assert main([*words, "--group", "imersed", "-o", str(sheet)]) == 2
    assert "did you mean 'immersed'?" in capsys.readouterr().err
