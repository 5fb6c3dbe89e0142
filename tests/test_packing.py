"""A run packs its rows when there are many, goes on with them, and says what it did."""

from __future__ import annotations

import sys

from harness.results import compaction, parts
from harness.results.store import Store
from harness.running.due import due
from harness.running.packing import Packing

from .agreeing_rows import whole
from .synthetic_run import cell


class Heard:
    """Keep what is told."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.cells: list[str] = []

    def told(self, line: str) -> None:
        self.lines.append(line)

    def warned(self, line: str) -> None:
        self.lines.append(f"warning: {line}")

    def cell(self, slot: str, row: object) -> None:
        del row
        self.cells.append(slot)


class Planned:
    """Stand for a planned cell, of which only the key is asked."""

    def __init__(self, key: str) -> None:
        self.key = key


def rows(count: int) -> list[dict]:
    made = whole(cell("newton[EPSILON=0.001]", "torus", "opencl:intel", "float32"))
    return [made | {"key": f"k{i}", "slot": f"slot {i}"} for i in range(count)]


def run(folder, made, heard) -> None:
    """Store rows one by one, as a run does, and tell of each."""
    store = Store(folder)
    packing = Packing(store, heard)
    for row in made:
        packing.cell(row["slot"], None)
        store.write(row)
        packing.cell(row["slot"], row)


def test_rows_are_packed_between_cells_and_the_run_goes_on(tmp_path, monkeypatch):
    monkeypatch.setattr(compaction, "MOST", 4)
    heard, made = Heard(), rows(12)
    run(tmp_path, made[:7], heard)
    assert heard.lines == [f"{tmp_path}: packed 5 rows into Parquet"] and len(heard.cells) == 14
    assert Store(tmp_path).files() == ["k5", "k6"] and len(parts.parts_in(tmp_path)) == 1
    run(tmp_path, made[7:], heard)
    assert heard.lines[1:] == [f"{tmp_path}: packed 5 rows into Parquet"] and len(parts.parts_in(tmp_path)) == 2
    found = due([Planned(f"k{i}") for i in (11, 3, 99, 0, 7)], Store(tmp_path))  # type: ignore[list-item]
    assert list(found.kept) == ["k11", "k3", "k0", "k7"] and [one.key for one in found.todo] == ["k99"]
    assert found.kept["k3"]["slot"] == "slot 3"


def test_without_pyarrow_rows_stay_files_and_it_is_said_once(tmp_path, monkeypatch):
    monkeypatch.setattr(compaction, "MOST", 4)
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    monkeypatch.setitem(sys.modules, "pyarrow.parquet", None)
    heard = Heard()
    run(tmp_path, rows(7), heard)
    assert len(Store(tmp_path).files()) == 7 and not parts.parts_in(tmp_path)
    assert len(heard.lines) == 1 and "warning" in heard.lines[0] and "pip install 'firsthit[report]'" in heard.lines[0]
