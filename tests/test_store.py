import json

import numpy as np
import pytest

from harness.contract import CellStatus, FirsthitError
from harness.results.store import Store
from harness.results.stored import Rows, Stored
from harness.results.writing import savez_atomically, write_atomically

from .agreeing_rows import whole
from .synthetic_run import cell


def test_a_row_comes_back_and_names_its_arrays(tmp_path):
    store = Store(tmp_path)
    made = whole(cell("newton[EPSILON=0.001]", "torus", "opencl:intel", "float32")) | {"key": "a1"}
    store.write(made, {"status": np.zeros((2, 2), np.uint8)})
    row = store.read("a1")
    assert row and row["arrays"] == "arrays/a1.npz"
    assert np.load(tmp_path / row["arrays"])["status"].shape == (2, 2)
    assert [r["key"] for r in store.rows()] == ["a1"]


@pytest.mark.parametrize("damage", ["", '{"key": "a1", "form', "[]", '{"key": "other", "format": 1}', "\x00\xff"])
def test_a_damaged_row_is_no_row_and_is_told(tmp_path, damage):
    store = Store(tmp_path)
    (tmp_path / "cells").mkdir()
    (tmp_path / "cells" / "a1.json").write_bytes(damage.encode("latin-1"))
    assert store.read("a1") is None
    assert "a1.json" in store.unreadable["a1"]


def test_a_failed_write_leaves_the_old_content_and_no_debris(tmp_path):
    path = tmp_path / "x.json"
    write_atomically(path, b"old")
    with pytest.raises(TypeError):
        write_atomically(path, None)  # type: ignore[arg-type]
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]


def test_an_unwritable_place_is_one_line(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(FirsthitError, match="cannot write") as caught:
        savez_atomically(tmp_path / "file" / "x.npz", a=np.zeros(1))
    assert caught.value.exit_code == 3


def test_rows_hold_no_nan(tmp_path):
    with pytest.raises(ValueError, match="Out of range float"):
        Store(tmp_path).write({"key": "a", "x": float("nan")})
    assert not (tmp_path / "cells" / "a.json").exists()


def test_plan_is_json(tmp_path):
    Store(tmp_path).write_plan({"name": "n"})
    assert json.loads((tmp_path / "plan.json").read_text())["name"] == "n"


def test_rows_are_read_when_they_are_asked_for(tmp_path):
    store = Store(tmp_path)
    kept, again = Stored(store), Stored(store)
    for key in ("a1", "b2", "c3"):
        row = whole(cell("newton[EPSILON=0.001]", "torus", "opencl:intel", "float32")) | {"key": key, "arrays": None}
        store.write(row)
        kept.add(row)
    again.add({"key": "a1", "status": "ok"})
    rows = Rows([kept, again])
    assert [one["key"] for one in rows] == ["a1", "b2", "c3", "a1"] and len(rows) == 4
    assert [one["key"] for one in rows[1:3]] == ["b2", "c3"] and rows[-1]["key"] == "a1"
    assert list(rows.statuses) == ["ok"] * 4 and len(rows + rows) == 8
    assert len(rows.of([CellStatus.OK])) == 4 and not rows.of([CellStatus.FAILED])
    (tmp_path / "cells/b2.json").unlink()
    with pytest.raises(FirsthitError, match="cannot be read any more: its file is gone"):
        rows[1]
    assert "nonesuch" not in kept and rows[0] is not rows[0]
