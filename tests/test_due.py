"""Which cells must run is decided in one place, for run, plan, gate and recommend alike."""

from types import SimpleNamespace

import pytest

from harness.results.store import Store
from harness.running.due import PREPARING, due, estimate_seconds

from .agreeing_rows import whole
from .synthetic_run import cell

STATUSES = ("ok", "skipped", "failed", "timeout", "crashed")


def planned(key, skip=None, method="sturm"):
    cell = SimpleNamespace(slot=f"slot of {key}", device="opencl:intel", variant=SimpleNamespace(method=method))
    programs = [SimpleNamespace(hash=text) for text in "aba"]
    return SimpleNamespace(key=key, skip=skip, failure=None, cell=cell, programs=programs)


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
    def estimate(*cells, again="nothing"):
        return estimate_seconds(due(cells, store, again), store, 2.0)

    assert estimate(planned("new")) == 2.0 + 2 * PREPARING, "two programs"
    assert estimate(planned("new", method="newton")) == 7.0, "as its method took on its device"
    assert estimate(planned("new", method="newton"), planned("ok")) == 7.0, "also by a row that is kept"
    assert estimate(planned("ok"), planned("failed"), again="everything") == 14.0, "also of cells that run again"
    assert estimate(planned("none", skip="no float64")) == 0.0
    changed = planned("new")
    changed.cell.slot = "slot of ok"
    assert estimate(changed) == 7.0, "its slot has a row under another key"


def test_each_row_is_read_once_before_a_run_begins(store, monkeypatch):
    read, whole_text = [], Store.text
    monkeypatch.setattr(Store, "text", lambda self, key: read.append(key) or whole_text(self, key))
    estimate_seconds(due([planned(key) for key in STATUSES], store), store, 2.0)
    assert sorted(read) == sorted(STATUSES)
    read.clear()
    estimate_seconds(due([planned("new"), *map(planned, STATUSES)], store, "unfinished"), store, 2.0)
    assert sorted(read) == sorted(["new", *STATUSES, "damaged"])
