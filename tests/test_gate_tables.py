"""Tables that the host hands to programs of another revision are that revision's own."""

import dataclasses
import shutil
from types import SimpleNamespace

import numpy as np
import pytest

from harness import ROOT
from harness.contract import FirsthitError
from harness.experiment import plan, reading
from harness.gate import export, revision
from harness.plugins import find_methods

from .conftest import usable_devices
from .test_gate_against import device_of, git

pytestmark = pytest.mark.usefixtures("devices_found_once")

CONFIG = """title = "Tiles of a plugin"
surfaces = ["torus"]
sizes = [64]
devices = ["{device}"]
[[method]]
name = "my_tiles"
"""


class Recorded(Exception):
    pass


class Recorder:
    """Keep the check that is sent to it in place of an executor, and run nothing."""

    def check(self, _device, asked):
        self.asked = asked
        raise Recorded


@pytest.fixture
def top(tmp_path):
    """A repository of tiles under another name, and its config, committed."""
    made, device = tmp_path / "repository", device_of("opengl:", "opencl:")
    plugin = made / "plugins" / "my_tiles"
    shutil.copytree(ROOT / "methods" / "tiles", plugin, ignore=shutil.ignore_patterns("__*"))
    text = (plugin / "method.py").read_text()
    (plugin / "method.py").write_text(text.replace('name="tiles"', 'name="my_tiles"'))
    (made / "plugin.toml").write_text(CONFIG.format(device=device))
    git(tmp_path, "init", "-q", "repository")
    git(made, "add", "-A")
    git(made, "commit", "-q", "-m", "first")
    return made


def test_tiles_of_the_other_revision_get_its_own_bounds_of_the_surface(top):
    config, device = top / "plugin.toml", device_of("opengl:", "opencl:")
    (former,) = revision.programs_at(revision.found("HEAD", top / "plugins"), config, [device]).cells.values()
    catalog, infos = find_methods(top / "plugins"), [info for info in usable_devices() if info.name == device]
    (planned,) = plan.plan(reading.load_one(config, catalog).on([device]), catalog, infos)
    now, then = planned.casting.programs, former.programs
    assert then.hash == now.hash and then.frame_hash == now.frame_hash
    other = dataclasses.replace(then, tables={name: 2.0 * table for name, table in then.tables.items()})
    assert other.hash != now.hash and other.frame_hash != now.frame_hash
    casting = planned.casting.with_programs(other)
    own, theirs = planned.casting.frame().fourths, casting.frame().fourths
    assert own.any() and np.array_equal(theirs, 2.0 * own)
    executor = Recorder()
    with pytest.raises(Recorded):
        casting.cast(executor, 24)
    assert np.array_equal(executor.asked.frame.fourths, theirs)
    with pytest.raises(FirsthitError, match="does not tell its bounds"):
        planned.casting.with_programs(dataclasses.replace(then, tables={}))


def test_a_revision_whose_castings_tell_no_tables_is_asked_for_those_of_its_frame(tmp_path):
    def casting(entry):
        return SimpleNamespace(timed=SimpleNamespace(entry=entry), frame=lambda: SimpleNamespace(fourths=np.ones(3)))

    written = export._tables(casting("isolate"), tmp_path, "cell")
    assert {name: np.load(file).tolist() for name, file in written.items()} == {"fourths": [1.0, 1.0, 1.0]}
    assert not export._tables(casting("compute"), tmp_path, "cell")
