"""Rows in Parquet parts: the same rows as in files, through every reader, whatever ends the packing."""

from __future__ import annotations

import ast
import json
import re
import shutil
import sys
from pathlib import Path

import pandas as pd
import pyarrow.parquet as pq
import pytest

from harness import ROOT
from harness.contract import FirsthitError
from harness.results import compaction, parts, salvage, sealed
from harness.results.schema import SCHEMA
from harness.results.store import FORMAT, Store
from harness.verifying import checks
from reports.analysis import derive
from reports.reading import columns, export, load

from .agreeing_rows import whole
from .synthetic_run import cell, family_cell, plan

VARIANTS = ("null", "ray_march", "newton[EPSILON=0.001]", "newton[EPSILON=1e-06]")
SURFACES = ("torus", "sphere")


def rows_of_a_run() -> list[dict]:
    """Make up rows of views and of a family, one of them an older one that lacks leaves."""
    views = [cell(v, s, "opencl:intel", p) for s in SURFACES for v in VARIANTS for p in ("float32", "float64")]
    family = family_cell("ray_march", "grazing", "opencl:intel", "float32")
    return [*map(whole, views[1:]), views[0], whole(family)]


def in_files(folder: Path) -> Path:
    """Write a run whose rows are files, sealed as a run seals them."""
    made = rows_of_a_run()
    (folder / "cells").mkdir(parents=True)
    (folder / "plan.json").write_text(json.dumps(plan(made)))
    for row in made:
        Store(folder).write_text(row["key"], sealed.sealed({"format": FORMAT, **row}))
    return folder


def texts_of(store: Store) -> dict[str, bytes]:
    """Return the bytes of every row of a store, by its key."""
    every = store.keys()
    return {key: store.text(key) for key in every}


@pytest.fixture(scope="module")
def filed(tmp_path_factory) -> Path:
    return in_files(tmp_path_factory.mktemp("filed") / "run")


@pytest.fixture
def packed(filed, tmp_path) -> Path:
    """Return a run whose rows lie in three parts, and whose last ones are files."""
    folder = tmp_path / "run"
    shutil.copytree(filed, folder)
    keys = Store(folder).files()
    kept = {key: Store(folder).text(key) for key in keys}
    for some in (keys[:5], keys[5:10], keys[10:14]):
        for key in keys:
            (folder / "cells" / f"{key}.json").unlink(missing_ok=True)
        for key in some:
            Store(folder).write_text(key, kept[key])
        assert compaction.compact(folder, most=0).rows == len(some)
        assert not Store(folder).files()
    for key in keys[14:]:
        Store(folder).write_text(key, kept[key])
    assert len(parts.parts_in(folder)) == 3
    return folder


def test_every_reader_sees_the_same_rows(filed, packed, tmp_path):
    one, other = Store(filed), Store(packed)
    assert other.keys() == one.keys() == one.files()
    assert texts_of(other) == texts_of(one) and all(map(other.has, one.files()))
    assert sorted(other.rows(), key=lambda row: row["key"]) == sorted(one.rows(), key=lambda row: row["key"])
    a, b = load.load(filed), load.load(packed)
    for name in ("frame", "families", "rungs"):
        pd.testing.assert_frame_equal(getattr(a, name), getattr(b, name))
    assert (a.unreadable, a.not_run) == (b.unreadable, b.not_run) == ((), ())
    for name, folder in (("a", filed), ("b", packed)):
        few = load.load(folder, columns.UNREAD)
        assert not columns.UNREAD & set(few.frame)
        frame = derive.derive(few.frame)
        export.write(frame, tmp_path / f"{name}.csv", tmp_path / f"{name}.parquet", rest=few.columns)
    export.write(derive.derive(a.frame), tmp_path / "c.csv", tmp_path / "c.parquet")
    assert len({(tmp_path / f"{name}.csv").read_bytes() for name in "abc"}) == 1
    assert pq.read_table(tmp_path / "c.parquet").equals(pq.read_table(tmp_path / "b.parquet"))
    told = [checks.verify([folder], lambda _: 0, 1) for folder in (filed, packed)]
    assert told[1].checked.pop("columns") == 14
    assert told[0].rows == told[1].rows == len(one.keys()) and told[0].checked == told[1].checked
    failing = [sorted((f.slot, f.check, f.wrong.figure) for f in one.failing) for one in told]
    assert failing[0] == failing[1]


def test_a_row_that_is_written_again_stands_before_its_part_and_stays_so_when_packed(packed):
    store = Store(packed)
    key = parts.Parts(packed).all()[0].keys[0].decode()
    newer = {**json.loads(store.text(key)), "reason": "run again"}
    newer.pop("checksum")
    store.write(newer)
    assert store.read(key, older=True)["reason"] == "run again"  # type: ignore[index]
    assert (load.load(packed).frame["reason"] == "run again").sum() == 1
    compaction.compact(packed, most=0)
    again = Store(packed)
    assert not again.files() and again.read(key, older=True)["reason"] == "run again"  # type: ignore[index]
    assert (load.load(packed).frame["reason"] == "run again").sum() == 1
    assert len(list(again.rows())) == len(again.keys()) == 17


class Killed(BaseException):
    """Stand for the end of a process at some moment."""


@pytest.mark.parametrize("moment", ["write_table", "flush", "rename", "between", "removing"])
def test_a_process_that_is_killed_while_it_packs_loses_and_doubles_no_row(filed, tmp_path, monkeypatch, moment):
    folder = tmp_path / "run"
    shutil.copytree(filed, folder)
    texts = texts_of(Store(folder))

    def end(*_, **__):
        raise Killed

    def some(store, keys, real=compaction._remove):
        real(store, list(keys)[:5])
        raise Killed if len(list(keys)) > 5 else SystemExit

    with monkeypatch.context() as patched:
        match moment:
            case "write_table":
                patched.setattr(pq.ParquetWriter, "write_table", end)
            case "flush":
                patched.setattr(compaction, "flush", end)
            case "rename":
                patched.setattr(Path, "replace", end)
            case "between":
                patched.setattr(compaction, "_flush_folder", end)
            case "removing":
                calls = iter((compaction._remove, some))  # the first one removes what a part held before
                patched.setattr(compaction, "_remove", lambda store, keys: next(calls)(store, keys))
        with pytest.raises(Killed):
            compaction.compact(folder, most=0)
    store = Store(folder)
    assert texts_of(store) == texts
    assert len(load.load(folder).frame) == 16
    done = compaction.compact(folder, most=0)
    left = len(texts) - 5 if moment == "removing" else len(texts)
    assert (done.rows, done.files) == ((0, left) if moment in ("between", "removing") else (left, 0))
    assert not Store(folder).files() and len(parts.parts_in(folder)) == 1
    assert texts_of(Store(folder)) == texts


def test_few_rows_stay_files_and_a_damaged_one_too(filed, tmp_path):
    folder = tmp_path / "run"
    shutil.copytree(filed, folder)
    assert compaction.compact(folder, most=17) == compaction.Packed()
    assert not parts.parts_in(folder)
    key = Store(folder).files()[0]
    path = folder / "cells" / f"{key}.json"
    path.write_bytes(path.read_bytes().replace(b"opencl", b"opencL", 1))
    assert compaction.compact(folder, most=16).rows == 16
    assert Store(folder).files() == [key] and Store(folder).read(key) is None
    (lost,) = load.load(folder).unreadable
    assert key in lost.file and "checksum" in lost.problem


def test_without_the_package_rows_stay_files_and_it_is_said(filed, packed, tmp_path, monkeypatch):
    folder = tmp_path / "files"
    shutil.copytree(filed, folder)
    monkeypatch.setitem(sys.modules, "pyarrow.parquet", None)
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    assert "pip install 'firsthit[report]'" in compaction.compact(folder, most=3).reason
    assert len(Store(folder).files()) == 17 and len(list(Store(folder).rows())) == 17
    with pytest.raises(FirsthitError, match="pip install 'firsthit") as caught:
        list(Store(packed).rows())
    assert caught.value.exit_code == 3


def _changed(path: Path, at: int) -> None:
    """Change one byte of a file."""
    content = bytearray(path.read_bytes())
    content[at] ^= 0x55
    path.write_bytes(content)


def test_a_damaged_part_is_told_and_costs_its_rows_only(packed, filed):
    part = parts.parts_in(packed)[1]
    lost = {key.decode() for key in parts.opened(part).keys.tolist()}
    column = pq.ParquetFile(part).metadata.row_group(0)
    place = next(i for i in range(column.num_columns) if column.column(i).path_in_schema == parts.TEXT)
    _changed(part, column.column(place).data_page_offset + 60)
    store, run = Store(packed), load.load(packed)
    assert set(store.keys()) == set(Store(filed).keys()) - lost
    assert len(run.frame) == 16 - len(lost & set(load.load(filed).frame["key"]))
    assert {one.file for one in run.unreadable} == {f"parts/{part.name}"}
    assert f"{len(lost)} rows of {len(lost)} cannot be read" in run.unreadable[0].problem
    failing = checks.verify([packed], lambda _: 0, 1).failing
    assert part in [one.file for one in failing]


DIES = """import os, sys
from pathlib import Path
from harness.results import salvage_child
read = salvage_child._readable
def dying(path):
    for told in list(read(path))[:3]:
        yield told
    sys.stdout.flush()
    os.abort()
salvage_child._readable = dying
salvage_child._print(Path(sys.argv[1]), sys.stdout.buffer)
"""


def test_a_part_that_ends_who_reads_it_gives_what_was_read_by_then(packed, monkeypatch):
    """As pyarrow ends the process for some damaged files: a C++ exception in one of its threads."""
    path = parts.parts_in(packed)[0]
    _changed(path, 4)  # of a column that is no text of a row
    monkeypatch.setattr(salvage, "COMMAND", (sys.executable, "-c", DIES))
    part = parts.opened(path)
    assert len(part.keys) == 2 and "of " in part.problem and "cannot be read" in part.problem
    store = Store(packed)
    assert all(store.read(key.decode(), older=True) is not None for key in part.keys.tolist())


def test_of_a_part_that_is_changed_elsewhere_the_rows_are_read_by_their_own_checksums(packed, filed):
    part = parts.parts_in(packed)[0]
    group = pq.ParquetFile(part).metadata.row_group(0)
    place = next(i for i in range(group.num_columns) if group.column(i).path_in_schema == "median_ms")
    _changed(part, group.column(place).data_page_offset + 40)
    run, whole_run = load.load(packed), load.load(filed)
    assert "0 rows of 5 cannot be read" in run.unreadable[0].problem
    pd.testing.assert_frame_equal(run.frame, whole_run.frame)
    assert compaction.compact(packed).mended == 5 and not part.exists(), "the next run writes them anew"
    assert not load.load(packed).unreadable and texts_of(Store(packed)) == texts_of(Store(filed))


@pytest.mark.parametrize("content", [b"", b"PAR1", b"PAR1" + bytes(200) + b"PAR1", None])
def test_what_is_no_part_is_told(packed, content):
    part = parts.parts_in(packed)[2]
    part.unlink()
    part.mkdir() if content is None else part.write_bytes(content)
    assert part.name in load.load(packed).unreadable[0].file
    assert len(list(Store(packed).rows())) == 13


def _forged(folder: Path, name: str, value) -> None:
    """Write the first part anew with another value in a column, under the name that its hash asks for."""
    part = parts.parts_in(folder)[0]
    table = pq.read_table(part)
    at = table.schema.get_field_index(name)
    made = table.set_column(at, name, [[value] * len(table)])
    pq.write_table(made.cast(table.schema), part)
    part.rename(part.with_name(f"000001-{parts.hash_of(part)}.parquet"))


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("median_ms", -1.0),
        ("median_ms", float("nan")),
        ("size", -5),
        ("status", "fine"),
        ("rounds", "[1,"),
        ("slot", None),
    ],
)
def test_of_a_column_that_holds_what_no_row_can_hold_nothing_is_used(packed, filed, name, value):
    _forged(packed, name, value)
    run = load.load(packed)
    (told,) = run.unreadable
    assert told.file == f"parts/{parts.parts_in(packed)[0].name}" and f"its column {name} is damaged" in told.problem
    pd.testing.assert_frame_equal(run.frame, load.load(filed).frame)


def test_columns_that_are_not_their_rows_are_found_by_verify(packed):
    _forged(packed, "median_ms", 0.5)
    failing = checks.verify([packed], lambda _: 0, 1).failing
    assert any(one.check == "columns" and "median_ms" in one.wrong.figure for one in failing)


def test_rows_are_taken_out_of_files_and_parts(packed):
    keys = Store(packed).keys()
    gone = [keys[0], keys[6], keys[16], "0123456789abcdef"]
    assert compaction.without(packed, gone) == 3
    assert set(Store(packed).keys()) == set(keys) - set(gone)
    assert {row["key"] for row in Store(packed).rows()} == set(keys) - set(gone)
    assert all(not part.problem for part in Store(packed).parts.all())


def test_rows_come_in_the_plans_order_from_any_part(packed):
    frame = load.load(packed, columns.UNREAD)
    order = [one["key"] for one in json.loads((packed / "plan.json").read_text())["cells"]]
    assert list(frame.frame["key"]) == order
    for at in (0, 7, len(order) - 1):
        assert frame.columns.at("slot", at) == frame.frame["slot"].iloc[at]
    batches = list(frame.columns.batches(["key", "identity"]))
    assert [key for batch in batches for key in batch.column("key").to_pylist()] == order


def test_a_store_sees_a_part_that_came_after_it(filed, tmp_path):
    folder = tmp_path / "run"
    shutil.copytree(filed, folder)
    early = Store(folder)
    key = early.keys()[3]
    before = early.read(key, older=True)
    compaction.compact(folder, most=0)
    assert early.read(key, older=True) == before and early.has(key)
    assert early.place(key) == parts.parts_in(folder)[0] and not early.has("0123456789abcdef")


def _names_in(path: Path) -> tuple[set[str], list[str]]:
    """Return the words of a module that may name columns, and patterns of those that it puts together."""
    words, patterns = set[str](), list[str]()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Attribute):
            words.add(node.attr)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            words.update(node.value.split())
        elif isinstance(node, ast.JoinedStr):
            told = "".join(re.escape(v.value) if isinstance(v, ast.Constant) else "[a-z0-9_]+" for v in node.values)
            patterns += [told] if len(told.replace("[a-z0-9_]+", "")) > 2 else []
    return words, patterns


def test_a_report_reads_no_column_that_it_leaves_unread():
    assert {field.name for field in SCHEMA} > columns.UNREAD
    assert not [name for name in columns.UNREAD if name.endswith(("_max", "_p99"))]  # of any unit: surface_tables.py
    rooms = ("analysis", "claims", "drawing", "for_papers", "parts", "rendering", "sentences")
    files = [*(p for room in rooms for p in (ROOT / "reports" / room).rglob("*.py")), *(ROOT / "reports").glob("*.py")]
    assert len(files) > 80
    for path in files:
        words, patterns = _names_in(path)
        named = words | {name for name in columns.UNREAD for p in patterns if re.fullmatch(p, name)}
        named |= {name for name in columns.UNREAD for w in words if w.startswith(f"{name}_")}  # of rows that are joined
        assert not named & columns.UNREAD - KNOWN_APART.get(path.name, set()), path


KNOWN_APART = {
    "compare.py": {"identity"},  # of runs that it opens with all columns
    "rerun.py": {"identity"},  # of one row, by Columns.at
    "szente_tracing.py": {"truth_misses"},  # puts names of kinds of wrong rays together
}
