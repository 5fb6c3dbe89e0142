"""What a new way to cast must say is said by every one that there is, and what it leaves out is told."""

import dataclasses
from typing import get_args

import numpy as np
import pytest

import surfaces
from harness.contract import Casts, FirsthitError, Variant, View
from harness.devices.raster import Batch
from harness.devices.trial_launch import trial_launch
from harness.experiment.cells import Cell
from harness.experiment.kinds.casts import WAYS
from harness.experiment.kinds.drawing import Drawing
from harness.experiment.kinds.model import Asked
from harness.experiment.kinds.programs import Programs
from harness.experiment.kinds.shots import ShotKind
from harness.kernels import prepass
from harness.kernels.assemble import ROOMS, STAGES, Entry, method_program
from harness.kernels.sections import KERNELS
from harness.plugins import find_methods
from harness.scenes.model import single

BY_ENTRY = {"rays": "newton", "camera": "newton", "beams": "interval_uniform", **dict.fromkeys(STAGES, "tiles")}


class Recording:
    """Stands in for a device: keeps what it is asked to launch."""

    def launch_steps(self, buffers, outputs, steps):
        return buffers, outputs, steps


def program(entry):
    plugin = find_methods().get(BY_ENTRY[entry])
    variant = plugin.variant({})
    return method_program(plugin.method, plugin.folder, variant, surfaces.get("torus"), "float32", "cl", entry)


def test_every_word_for_what_methods_cast_has_its_kinds():
    assert set(WAYS) == set(get_args(Casts))


def test_every_entry_of_a_kind_has_a_folder_and_files():
    assert set(ROOMS) == set(get_args(Entry)) == set(BY_ENTRY)
    assert {entry for way in WAYS.values() for entry in way.methods.entries} == set(ROOMS)
    for entry, room in ROOMS.items():
        name, _ = STAGES.get(entry, (entry, False))
        assert all((KERNELS / room / f"entry_{name}.{language}").exists() for language in ("glsl", "cl"))


@pytest.mark.parametrize("entry", ROOMS)
def test_every_entry_is_tried_over_one_item(entry):
    buffers, outputs, (step,) = trial_launch(Recording(), program(entry), None)
    assert step.grid == (1, 1) and not outputs
    assert step.buffers == tuple(range(len(buffers)))


def test_an_entry_that_nobody_knows_how_to_try_is_told_with_the_file_to_mend():
    unknown = dataclasses.replace(program("rays"), entry="fans")
    with pytest.raises(FirsthitError, match=r"harness/devices/trial_launch\.py .* fans program"):
        trial_launch(Recording(), unknown, None)


@pytest.mark.parametrize(
    "left_out", ["what", "entries", "unlisted", "undrawn", "shot_entries", "shot", "shot_hits", "validated"]
)
def test_a_kind_of_methods_that_leaves_something_out_cannot_be_made(left_out):
    stated = dict.fromkeys(ShotKind.__abstractmethods__)
    del stated[left_out]
    with pytest.raises(TypeError, match=left_out):
        type("Fans", (ShotKind,), stated)()


def test_a_kind_that_cannot_be_listed_refuses_listed_rays_and_rays_of_no_camera():
    beams, rays = WAYS["quadtree"].methods, WAYS["rays"].methods
    assert beams.unlisted == "casts the beams of a camera's pixels, and listed rays have none"
    assert beams.stage_refusal("rays") == f"the method {beams.unlisted}" and beams.stage_refusal("compute") is None
    assert beams.shot_refusal(None) == beams.unlisted and beams.shot_refusal(np.zeros(12, np.float32)) is None
    assert rays.stage_refusal("rays") is None and rays.shot_refusal(None) is None
    assert all(
        isinstance(way.methods, ShotKind) or way.methods.shot_refusal(np.zeros(12, np.float32)) for way in WAYS.values()
    )
    assert WAYS["mesh"].methods.stage_refusal("compute") == "the method draws triangles, in stage raster"


def test_what_a_kind_cannot_make_is_refused_with_the_reason():
    beams, mesh = WAYS["beams"], WAYS["mesh"]
    group = single(surfaces.get("sphere"), View("v")).groups[0]
    plugin = find_methods().get("interval_uniform")
    with pytest.raises(FirsthitError, match=r"interval_uniform casts the beams .* a fragment has one ray"):
        beams.methods.draw_programs(plugin, Drawing(group, plugin.variant({}), "box"))
    cell = Cell(Variant("polygon"), surfaces.get("torus"), View("v"), 8, 1, "float32", "compute", "opengl:none")
    asked = Asked(cell, None, find_methods(), mesh.methods, 1)
    assert mesh.cells.refusal(asked) == "the method draws triangles, in stage raster"
    with pytest.raises(FirsthitError, match="the method draws triangles, in stage raster"):
        mesh.cells.casting(asked)


@pytest.mark.parametrize(
    ("old", "new", "same"),
    [
        ("__global int *answer", "__global int *answer, __global int *more", False),
        ("__global int *answer", "__global uint *answer", False),
        ("__kernel void rays(", "__kernel void rays(   ", True),
        ("get_global_id(0)", "get_global_id(0) + 0", True),
    ],
)
def test_another_revisions_programs_are_launched_only_with_the_same_buffers(old, new, same):
    mine = program("rays")
    *ahead, entry = mine.sections
    assert old in entry.text
    theirs = dataclasses.replace(mine, sections=(*ahead, dataclasses.replace(entry, text=entry.text.replace(old, new))))
    assert of_checks(theirs).launched_as(of_checks(mine)) is same
    assert of_checks(theirs).hash != of_checks(mine).hash
    assert not of_checks(mine, mine).launched_as(of_checks(mine))


def of_checks(*checks):
    return Programs(checks, None, (), {})


def test_knobs_and_triangles_count_although_they_are_in_no_programs_text():
    mine = program("beams")
    batch = Batch(mine, np.zeros((1, 32), np.float32), np.arange(3, dtype=np.uint32), None, True)
    moved = dataclasses.replace(batch, vertices=np.zeros((3, 6), np.float32))
    own = [
        Programs((mine,), None, (), knobs, batches)
        for knobs in ({}, {"GROUPED": 0})
        for batches in ((), (batch,), (moved,))
    ]
    own += [dataclasses.replace(own[0], tables={"bounds": np.full(2, value)}) for value in (1.0, 2.0)]
    assert len({one.hash for one in own}) == len(own)


def test_a_frames_hash_holds_every_program_and_table_of_it():
    mine = program("rays")
    other = dataclasses.replace(mine, sections=mine.sections[1:])
    frames = [
        Programs((), mine, others, {}, tables=tables)
        for others in ((), (mine,), (other,))
        for tables in ({}, {"bounds": np.ones(2)})
    ]
    assert len({frame.frame_hash for frame in frames}) == len(frames)
    assert of_checks(mine).frame_hash is None


def test_a_prepass_is_launched_over_the_tiles_that_its_own_program_was_made_with(monkeypatch):
    made = {}
    for bits in (3, 5):
        monkeypatch.setattr(prepass, "TILE_BITS", bits)
        made[bits] = prepass.program(surfaces.get("torus"), "float32", "cl")
    monkeypatch.undo()
    assert [prepass.tile_bits(one) for one in made.values()] == [3, 5]
    assert [prepass.tiles_per_side(64, bits) for bits in made] == [8, 2]
