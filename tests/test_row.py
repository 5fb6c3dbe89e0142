"""A stored row is what harness/results/row.py declares, from the runner to the last part of a report."""

from __future__ import annotations

import csv
import importlib
import json
import pkgutil
import types
import typing
from pathlib import Path
from typing import Any, NotRequired

import pyarrow.parquet as pq
import pytest

from harness import ROOT
from harness.accuracy.judge import NAMES
from harness.contract import Casts
from harness.results import columns, row, schema, sealed
from harness.results.row import KINDS, Accuracy, StoredRow
from harness.results.schema import DERIVED, LEAVES, SCHEMA
from reports import parts, report
from reports.analysis import breaks, derive
from reports.material import Material
from reports.parts import papers
from reports.reading import load
from reports.reading.arrays import Shelf

from . import tiny_runs
from .conftest import usable_devices

BY_MACHINE = {("time", "overhead_share"), ("environment", "commit")}  # null without a device's clock, without git
NOT_SHOWN = {"szente_tables"}  # the tiny runs have no settings or studies for it


@pytest.fixture(scope="module")
def run(tmp_path_factory) -> Path:
    devices = {info.name.split(":")[0]: info.name for info in reversed(usable_devices())}
    if set(devices) != {"opencl", "opengl"}:
        pytest.skip("rows of every kind need a device of OpenCL and one of OpenGL")
    return tiny_runs.make(tmp_path_factory.mktemp("tiny"), devices["opencl"], devices["opengl"])


@pytest.fixture(scope="module")
def rows(run) -> list[dict[str, Any]]:
    return [sealed.read(path) for path in sorted(run.parent.glob("*/cells/*.json"))]


def faults(kind: Any, value: Any, path: str = "row") -> list[str]:
    """What is undeclared, missing or of another type in a value that is declared to be of `kind`."""
    if typing.is_typeddict(kind):
        if not isinstance(value, dict):
            return [f"{path} is no object"]
        hints = typing.get_type_hints(kind, include_extras=True)
        absent = {name for name, hint in hints.items() if typing.get_origin(hint) is NotRequired} - value.keys()
        found = [f"{path}.{name} is not declared" for name in value.keys() - hints.keys()]
        found += [f"{path}.{name} is missing" for name in hints.keys() - value.keys() - absent]
        for name, plain in typing.get_type_hints(kind).items():
            found += faults(plain, value[name], f"{path}.{name}") if name in value else []
        return found
    if typing.get_origin(kind) in (types.UnionType, typing.Union):
        if value is None:
            return []
        (kind,) = (part for part in typing.get_args(kind) if part is not types.NoneType)
        return faults(kind, value, path)
    if typing.get_origin(kind) is list:
        if not isinstance(value, list):
            return [f"{path} is no list"]
        return [fault for item in value for fault in faults(typing.get_args(kind)[0], item, f"{path}[]")]
    if typing.get_origin(kind) is dict:
        return [] if isinstance(value, dict) else [f"{path} is no object"]
    if typing.get_origin(kind) is typing.Literal:
        return [] if value in typing.get_args(kind) else [f"{path} is {value!r}"]
    kinds = (int, float) if kind is float else (kind,)
    return [] if type(value) in kinds else [f"{path} is {value!r}"]


def values_at(value: Any, path: tuple[str, ...]) -> list[Any]:
    """Every value that is there and not null at a leaf's path."""
    if value is None:
        return []
    if not path:
        return [value]
    if path[0] == "[]":
        return [found for item in value for found in values_at(item, path[1:])]
    return values_at(value.get(path[0]), path[1:])


def test_every_kind_of_cell_ran(rows):
    ok = [row for row in rows if row["status"] == "ok"]
    assert {(row["casts"], row["stage"]) for row in ok if row["family"] is None} == {
        *(("rays", stage) for stage in ("compute", "rays", "raster")),
        ("beams", "compute"),
        ("quadtree", "compute"),
        ("tiles", "compute"),
        ("mesh", "raster"),
    }
    assert {row["casts"] for row in ok} == set(typing.get_args(Casts)), "tests/tiny_runs.py has a method of each"
    assert {row["device"].split(":")[0] for row in ok} == {"opencl", "opengl"}
    assert any(row["prepass"] == "beams" for row in ok)
    assert any(row["family"] for row in ok) and any(row["scene"] for row in ok)
    assert {row["status"] for row in rows} == {"ok", "skipped", "failed"}


def test_a_stored_row_has_exactly_the_declared_leaves(rows):
    assert {fault for row in rows for fault in faults(StoredRow, row)} == set()


@pytest.mark.parametrize(
    ("edit", "fault"),
    [
        (lambda row: row["accuracy"].update(new=1), "row.accuracy.new is not declared"),
        (lambda row: row["accuracy"]["error"].pop("p50"), "row.accuracy.error.p50 is missing"),
        (lambda row: row.pop("degree"), "row.degree is missing"),
        (lambda row: row["time"].update(batch=1.5), "row.time.batch is 1.5"),
        (lambda row: row.update(stage="paper"), "row.stage is 'paper'"),
        (lambda row: row["accuracy"].update(lanes=[{"level": 0}]), "row.accuracy.lanes[].items is missing"),
    ],
)
def test_a_leaf_that_differs_is_seen(rows, edit, fault):
    timed = next(row for row in rows if row["time"] and row["accuracy"])
    changed = json.loads(json.dumps(timed))
    edit(changed)
    assert fault in faults(StoredRow, changed)


def test_every_declared_leaf_has_a_value_in_some_row(rows):
    empty = {leaf.path for leaf in LEAVES if not any(values_at(row, leaf.path) for row in rows)}
    assert empty <= BY_MACHINE


def test_every_leaf_has_a_meaning_and_no_two_share_a_column():
    assert all(leaf.meaning for leaf in (*LEAVES, *DERIVED))
    names = [field.name for field in (*SCHEMA, *DERIVED)]
    assert len(names) == len(set(names))


def test_the_kinds_of_wrong_answers_are_leaves_in_each_class():
    assert tuple(NAMES.values()) == KINDS
    assert {f"{kind}{name}" for kind in ("", "grazing_", "drowned_") for name in KINDS} <= set(Accuracy.__annotations__)
    assert set(KINDS) <= set(row.RungVerdict.__annotations__)


def test_a_report_reads_every_row_and_leaf(run, rows):
    loaded = load.load(run)
    assert not loaded.unreadable and not loaded.not_run
    assert len(loaded.frame) + len(loaded.families) == len(rows)
    labels = ["label", "method_label"]
    assert list(loaded.frame) == [*(field.name for field in SCHEMA), *labels]
    assert list(loaded.families) == [*(field.name for field in schema.FAMILY), *labels]
    assert list(loaded.rungs) == [field.name for field in schema.RUNG]
    stored = {row["key"]: row for row in rows}
    for leaf in (leaf for leaf in LEAVES if leaf.name):
        told = loaded.frame.set_index("key", drop=False)[leaf.name]
        here = {key for key in told.index if values_at(stored[key], leaf.path)}
        assert set(told.dropna().index) == here, leaf.name
    assert len(loaded.rungs) == sum(len(row["rungs"] or []) for row in rows)


def test_csv_and_parquet_have_exactly_the_declared_columns(run):
    made = report.build(run).parent
    names = [field.name for field in (*SCHEMA, *DERIVED)]
    with (made / "results.csv").open(newline="") as file:
        assert next(csv.reader(file)) == names
    assert pq.read_table(made / "results.parquet").column_names == names
    with (made / "stability.csv").open(newline="") as file:
        assert [field.name for field in schema.RUNG[1:]] == [
            name for name in next(csv.reader(file)) if name in {field.name for field in schema.RUNG[1:]}
        ]


def test_the_page_of_columns_is_as_printed():
    page = (ROOT / "docs" / "columns.md").read_text(encoding="utf-8")
    assert page == columns.page(), "python -m harness.results.columns > docs/columns.md"
    for leaf in LEAVES:
        assert f"| `{'.'.join(leaf.path).replace('.[]', '[]')}` | " in page
    for field in (*SCHEMA, *DERIVED, *schema.RUNG[1:]):
        assert f"| `{field.name}` | " in page


def material(folder: Path) -> Material:
    loaded = load.load(folder)
    frame = derive.derive(loaded.frame, loaded.plan.peaks)
    answering = frame.loc[frame["answers"].astype(bool), "method"]
    focus = str(answering.iloc[0]) if len(answering) else ""
    return Material(loaded, frame, breaks.derive(loaded.families, loaded.rungs), Shelf(loaded.folders), focus)


def part_names(package: Any) -> list[str]:
    modules = (importlib.import_module(f"{package.__name__}.{m.name}") for m in pkgutil.iter_modules(package.__path__))
    return [module.__name__ for module in modules if hasattr(module, "ORDER")]


def test_what_the_runner_wrote_goes_through_every_part_of_a_report(run):
    """A part may have nothing to say of one run; each says something of one of these.

    The run that collects the others is asked for parts that only it has. All its parts are in the report that is built
    above.
    """
    made, whole = [material(run.parent / name) for name in tiny_runs.PARTS], material(run)
    silent = set()
    for name in {*part_names(parts), *part_names(papers)} - {papers.__name__}:
        sections = importlib.import_module(name).sections
        told = [section for one in made for section in sections(one)] or sections(whole)
        if not told:
            silent.add(name.rpartition(".")[2])
        assert all(section.title and (section.blocks or section.details) for section in told), name
    assert silent == NOT_SHOWN
    assert not any(one.shelf.damaged for one in (*made, whole))
