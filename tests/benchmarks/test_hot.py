"""The hot pieces under pytest-benchmark: `make bench` times them, `make test` runs each once.

No time is asserted: a benchmark is compared with another run of the same machine (`--benchmark-compare`).
"""

from __future__ import annotations

import pytest

import surfaces
from harness.contract import View
from harness.devices.interface import Device
from harness.experiment import kinds
from harness.experiment.cells import Cell
from harness.kernels.assemble import method_program
from harness.kernels.functions import FUNCTIONS, surface_sections
from harness.oracle import first_hits
from harness.plugins import find_methods
from harness.results.store import Store
from harness.scenes.camera import camera_for, rays_of
from tests import synthetic_rows
from tests.conftest import opened, usable_devices

CATALOG = find_methods()
VIEW = View("oblique", azimuth=30, elevation=35)


@pytest.fixture(scope="module")
def first_device() -> Device:
    if not usable_devices():
        pytest.skip("no device")
    return opened(usable_devices()[0].name)


@pytest.mark.parametrize("name", ["torus", "barth_decic"])
def test_lowering(benchmark, name):
    """Formula → straight-line operations → kernel text, with nothing kept from before."""
    stated = surfaces.get(name)
    counter = iter(range(10**9))

    def lower():
        text = f"{stated.formula} + 0*{next(counter)}.5"
        surface = surfaces.from_formula(text, "sphere:1.5", parameters=dict(stated.parameters))
        return surface_sections(surface, ("surface_along", "surface_dual_along"), "float32", "cl")

    assert benchmark(lower)


@pytest.mark.parametrize("name", ["torus", "barth_sextic", "blinn_blob"])
def test_oracle(benchmark, name):
    surface = surfaces.get(name)
    rays = rays_of(camera_for(VIEW, surface), 32)
    first_hits(surface, rays[:1])
    assert len(benchmark(first_hits, surface, rays).lower) == len(rays)


def test_assemble(benchmark):
    plugin, surface = CATALOG.get("eft_yuksel"), surfaces.get("barth_sextic")
    made = (plugin.method, plugin.folder, plugin.variant({}), surface, "float32", "cl", "camera")
    assert benchmark(lambda: method_program(*made).hash)


@pytest.mark.one_in(3)
@pytest.mark.parametrize("method", CATALOG.plugins)
def test_kernel(benchmark, first_device, method):
    """One 256 × 256 frame of the torus, on the first device."""
    plugin, info = CATALOG.get(method), first_device.info
    cell = Cell(plugin.variant({}), surfaces.get("torus"), VIEW, 256, 1, "float32", "compute", info.name)
    kind = kinds.of_cell(cell, plugin.method)
    asked = kinds.Asked(cell, info, CATALOG, kinds.of_method(plugin.method), 0)
    if reason := kind.refusal(asked):
        pytest.skip(reason)
    frame = kind.casting(asked).frame()
    launch = frame.launch(first_device, [first_device.build(program) for program in frame.programs])
    assert benchmark(launch.run).wall_ms >= 0.0
    launch.release()


def test_reading_rows(benchmark, tmp_path):
    """Two hundred rows of ordinary size from a run folder."""
    store = Store(tmp_path)
    made = synthetic_rows.cell("newton[EPSILON=0.001]", "torus", "opencl:intel", "float32")
    for i in range(200):
        store.write(made | {"key": f"{i:016x}", "slot": f"slot {i}", "arrays": None})
    assert len(benchmark(lambda: list(store.rows()))) == 200


def test_the_functions_named_here_exist():
    assert {"surface_along", "surface_dual_along"} <= set(FUNCTIONS)
