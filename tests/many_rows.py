"""Make a run of many rows from one that was run: copies, each with a variant's name of its own, that all hold."""

from __future__ import annotations

import copy
import shutil
from pathlib import Path

from harness.contract import digest
from harness.results import plan_file, sealed
from harness.results.store import Row, Store

CONFIG = """title = "Rows that are copied"
surfaces = ["torus", "klein"]
sizes = [64]
devices = ["{device}"]
[[method]]
name = "newton"
[[method]]
name = "interval_adaptive"
[accuracy]
size = {side}
[budget]
seconds = 0.01
rounds = 8
repetitions = 16
"""


def copies(run: Path, folder: Path, count: int) -> list[Row]:
    """Write `count` rows into `folder`, copies of a run's rows in turn, with their arrays and truth; return them."""
    rows = [row for row in Store(run).rows() if row["time"] and row["casts"] == "rays" and row["stage"] == "compute"]
    (folder / "cells").mkdir(parents=True)
    (folder / "arrays").mkdir()
    shutil.copytree(Store(run).truth, Store(folder).truth)
    made = []
    for number in range(count):
        row = copied(rows[number % len(rows)], number)
        shutil.copy(run / rows[number % len(rows)]["arrays"], folder / row["arrays"])
        (folder / "cells" / f"{row['key']}.json").write_bytes(sealed.sealed(row))
        made.append(row)
    plan = dict(plan_file.read(run / "plan.json")) | {"families": []}
    plan["cells"] = [{"slot": row["slot"], "key": row["key"]} for row in made]
    (folder / "plan.json").write_bytes(sealed.sealed(plan))
    return made


def copied(row: Row, number: int) -> Row:
    """Return a row as another variant's, with the key that follows."""
    found: Row = copy.deepcopy(row)
    found["variant"] = f"{row['method']}[COPY={number}]"
    found["slot"] = found["variant"] + row["slot"].removeprefix(row["variant"])
    found["key"] = digest(found["slot"], found["identity"])
    found["arrays"] = f"arrays/{found['key']}.npz"
    return found
