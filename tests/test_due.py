"""Which cells must run is decided in one place, for run, plan, gate and recommend alike."""

from types import SimpleNamespace

import pytest

from harness.results.store import Store
from harness.running.due import PREPARING, due, estimate_seconds

from .agreeing_rows import whole
from .synthetic_run import cell

STATUSES = ("ok", "skipped", "failed", "timeout", "crashed")


def planned(key, skip=None):
    return SimpleNamespace(key=key, skip=skip, failure=None, cell=SimpleNamespace(slot=f"slot of {key}"))


@pytest.fixture
def store(tmp_path):
    store = Store(tmp_path)
    for status in STATUSES:
        row = whole(cell("newton[EPSILON=0.001]", "torus", "opencl:intel", "float32")) | {"key": status, "arrays": None}
        store.write(row | {"slot": f"slot of {status}", "status": status, "reason": "why", "seconds": 7.0})
    (tmp_path / "cells" / "damaged.json").write_text("{")
    return store


@pytest.mark.parametrize(
    ("again", "kept"),
    [("nothing", list(STATUSES)), ("unfinished", ["ok", "skipped"]), ("everything", [])],
)
def test_cells_without_a_row_run_and_of_the_others_those_wanted_again(store, again, kept):
    keys = ["new", *STATUSES, "damaged"]
    found = due([planned(key) for key in keys], store, again)
    assert list(found.kept) == kept
    assert [p.key for p in found.todo] == [key for key in keys if key not in kept], "in the plan's order"
    assert all(row["status"] == key for key, row in found.kept.items())
    assert "damaged.json" in store.unreadable["damaged"]


def test_the_estimate_is_of_the_cells_that_run_by_what_their_slots_took(store):
    assert estimate_seconds([planned("new")], store, 2.0) == 2.0 + PREPARING
    assert estimate_seconds([planned("ok"), planned("failed")], store, 2.0) == 14.0, "also of cells that run again"
    assert estimate_seconds([planned("none", skip="no float64")], store, 2.0) == 0.0
