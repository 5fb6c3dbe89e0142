"""Where beams' cells lie: the first level, the order of work items, and the lanes that wait."""

import dataclasses
import json

import numpy as np
import pytest

import surfaces
from harness.contract import DeviceInfo, RayStatus
from harness.devices import lanes
from harness.devices.quadtree import Layout, beam_hits_from, first_level, last_level, layout_of, start_of
from harness.experiment.plan import plan
from harness.experiment.reading import load
from harness.plugins import find_methods
from harness.scenes.camera import camera_for

from .test_beams import FIRST, VIEW, frame, outputs_of
from .test_runner import rows, run


def test_neighbouring_work_items_have_the_pixels_that_the_knob_says(device):
    """The first eight items alone: eight pixels of the first row, or a block of four by two."""
    surface = surfaces.get("sphere")
    for grouped, shape in ((0, (1, 8)), (1, (2, 4))):
        knobs = {"GROUPED": grouped, "edit": lambda text: text.replace("item < count", "item < 8")}
        hits, _ = frame(device, "interval_uniform", surface, camera_for(VIEW, surface), 16, **knobs)
        answered = np.argwhere(hits.status.reshape(16, 16) != RayStatus.INVALID)
        assert answered.tolist() == [[y, x] for y in range(shape[0]) for x in range(shape[1])]


def test_a_remapped_quarter_comes_after_the_others(device):
    """Cells that cost more than the limit are queued from the end, and none of them from the front."""
    surface, size = surfaces.get("octdong"), 64
    camera = camera_for(VIEW, surface)
    for limit in (0, 5):
        outputs, layout = outputs_of(device, "interval_adaptive", surface, camera, size, FIRST_LEVEL=FIRST, REMAP=limit)
        hits, levels = beam_hits_from(outputs)
        shape, (queue, counts) = (size, size), outputs[2:]
        tree = lanes.Tree(size, FIRST, last_level(size), layout.grouped)
        spent = lanes.spent_by_items(tree, hits.evaluations.reshape(shape), levels.reshape(shape), queue, counts)
        assert sum(int(own.sum()) for own in spent.values()) == hits.evaluations.sum()
        assert (counts[16 + FIRST] > 0) == (limit > 0)
        cells = queue[: 3 * 4**FIRST].reshape(-1, 3)
        front, later = cells[: counts[FIRST], 2], cells[len(cells) - counts[16 + FIRST] :, 2]
        if limit:
            assert front.max() <= limit < later.min()


def test_the_first_level_fills_the_device():
    """132 units of 1,024 work items, as on an H100; a processor's unit is filled by a work group."""
    named = DeviceInfo("opencl:none", "", "", "", 132, True, "wall", (), resident=1024)
    level = first_level(named, 14)
    assert 4 ** (level - 1) < 132 * 1024 <= 4**level
    assert first_level(named, 5) == 5
    processor = dataclasses.replace(named, compute_units=4, resident=None)
    assert first_level(processor, 14) == 4
    assert 4**4 == 4 * 64
    assert start_of(named, 4096, True, layout_of({"FIRST_LEVEL": -1})) == level
    assert start_of(named, 4096, True, layout_of({"FIRST_LEVEL": 3})) == 3
    assert start_of(named, 64, True, layout_of({"FIRST_LEVEL": 9})) == 6
    assert start_of(named, 64, False, layout_of({"FIRST_LEVEL": 3})) == 6


def test_a_gpu_is_filled_by_the_first_level(device):
    info = device.info
    if info.resident is None:
        pytest.skip("a processor: no GPU whose compute units hold many work items")
    surface, size = surfaces.get("sphere"), 4096
    _, levels = frame(device, "interval_adaptive", surface, camera_for(VIEW, surface), size)
    assert 4 ** int(levels.min()) >= info.resident * (info.compute_units or 1)


def test_a_configs_knobs_reach_the_launch(tmp_path):
    path = tmp_path / "made.toml"
    path.write_text(
        'title = "t"\nsurfaces = ["sphere"]\nsizes = [64]\ndevices = ["opencl:none"]\n[[method]]\n'
        'name = "interval_adaptive"\nparameters = { FIRST_LEVEL = 3, GROUPED = 0 }\n[[view]]\nname = "v"\n'
    )
    catalog = find_methods()
    info = DeviceInfo("opencl:none", "", "", "", 1, True, "wall", ())
    (planned,) = plan(load(path, catalog), catalog, [info])
    assert planned.frame.layout == Layout(3, grouped=False)


def test_idle_lanes_of_known_counts():
    assert lanes.idle_share(np.array([4, 4, 4, 4]), 4) == 0.0
    assert lanes.idle_share(np.array([4, 0, 0, 0, 2, 2, 2, 2]), 4) == pytest.approx(12 / 24)
    assert lanes.idle_share(np.array([3, 1, 2]), 2) == pytest.approx(1 - 6 / 10)  # the last lane has no item
    assert lanes.idle_share(np.zeros(5, np.int64), 4) == 0.0


@pytest.mark.parametrize("grouped", [0, 1])
def test_a_levels_items_are_its_pixels_in_the_layouts_order(device, grouped):
    surface, size = surfaces.get("torus"), 50
    camera = camera_for(VIEW, surface)
    outputs, layout = outputs_of(device, "interval_uniform", surface, camera, size, GROUPED=grouped)
    hits, levels = beam_hits_from(outputs)
    (level,) = lanes.of_frame(lanes.Tree(size, 6, 6, layout.grouped), hits, levels, outputs)
    picture = np.zeros((64, 64), np.int64)
    picture[:size, :size] = hits.evaluations.reshape(size, size)
    blocks = picture if not grouped else picture.reshape(16, 4, 8, 8).transpose(0, 2, 1, 3)  # of 4 x 8: 32 items
    expected = 1.0 - picture.sum() / (32 * blocks.reshape(-1, 32).max(axis=1).sum())
    assert (level["level"], level["items"], level["evaluations"]) == (6, 4096, hits.evaluations.sum())
    assert level["idle"]["32"] == pytest.approx(expected)


def test_a_row_keeps_its_lanes_and_every_sample_of_a_pixels_shading(tmp_path):
    """Four samples of each accuracy pixel; of one sample a pixel, its own shading says it all."""
    path = tmp_path / "t.toml"
    path.write_text(
        'title = "t"\nsurfaces = ["sphere"]\nsizes = [32]\nsamples_per_pixel = [1, 4]\ndevices = ["any"]\n'
        '[[method]]\nname = "interval_adaptive"\n[[method]]\nname = "newton"\n[[view]]\nname = "v"\n'
        "[accuracy]\nsize = 16\nmax_wrong_share = 1.0\n[budget]\nseconds = 0.01\n"
    )
    done = run("run", path, "--runs", tmp_path / "runs")
    assert done.returncode == 0, done.stderr
    _, found = rows(tmp_path / "runs" / "t")
    assert len(found) == 4
    for row in found.values():
        arrays = np.load(tmp_path / "runs" / "t" / row["arrays"])
        assert ("samples" in arrays) == (row["samples_per_pixel"] == 4)
        if "samples" in arrays:
            assert arrays["samples"].shape == (32, 32)
            drawn = np.isfinite(arrays["samples"]).reshape(16, 2, 16, 2).mean(axis=(1, 3))
            assert 0 < np.mean((drawn > 0) & (drawn < 1)) < 0.5, "silhouettes alone are covered in part"
            assert np.all(drawn[np.isfinite(arrays["shade"])] > 0)
        levels = row["accuracy"].get("lanes")
        assert (levels is not None) == (row["method"] == "interval_adaptive")
        if levels:
            assert [level["level"] for level in levels][-1] == (6 if row["samples_per_pixel"] == 4 else 5)
            assert json.dumps(levels[0]["idle"]).count(":") == len(lanes.WIDTHS)
