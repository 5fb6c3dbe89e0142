"""Check cells of a hostile method beside those of a good plugin and of one of firsthit's own, on every device here.

The cells are planned and checked in this process, by one executor for all trials. The rows of the other methods are
held against those that they have without the hostile one.
"""

from __future__ import annotations

import atexit
import json
import pickle
import shutil
from collections import Counter
from functools import cache
from pathlib import Path
from typing import Any

from harness.contract import CellStatus
from harness.devices.discovery import discover_devices
from harness.devices.executor import LocalExecutor
from harness.experiment import plan, reading
from harness.plugins import find_methods
from harness.results.store import Row, Store
from harness.running.due import UNFINISHED
from harness.running.environment import describe
from harness.running.runner import Runner
from tests.campaigns.frame import Fell

TIMEOUT = 5.0  # seconds of a step
TRIES = 3  # of a trial in which another method's row ended by its time-out or a kill, as on a machine with no room left
METHODS = ("analytic", "good")  # whose rows may not change
GOOD = """from firsthit import Method, Parameter

METHOD = Method(
    name="good",
    source="t",
    needs=("surface_along", "surface_value_along"),
    parameters=(Parameter("STEPS", 100, "steps along the ray"),),
    tables=lambda surface, knobs, precision: {"HALVES": [0.5, 0.25]},
)
"""
KERNEL = """Hit first_hit(Ray ray, real t0, real t1) {
    Hit hit = no_hit(t1);
    Along along = surface_along(ray);
    real before = surface_value_along(along, t0);
    for (int i = 1; i <= STEPS; i++) {
        real t = t0 + (t1 - t0) * (real(i) / real(STEPS));
        real value = surface_value_along(along, t);
        hit.evaluations += 1;
        if ((before < 0.0) != (value < 0.0)) return hit_at(hit, t);
        before = value;
    }
    return missed(hit);
}
"""
CONFIG = """title = "Beside each other"
surfaces = ["torus"]
sizes = [16]
devices = ["all"]
[[method]]
name = "analytic"
{bad}
[[method]]
name = "good"
[accuracy]
size = 16
max_wrong_share = 1.0
[budget]
seconds = 0.001
rounds = 1
"""
BAD = '[[method]]\nname = "bad"\n'


@cache
def executor() -> LocalExecutor:
    """Return the executor of all trials of this process."""
    made = LocalExecutor(TIMEOUT)
    atexit.register(made.close)
    return made


def write_good(folder: Path) -> None:
    """Write the good plugin into a folder of plugins."""
    (folder / "good").mkdir(parents=True)
    (folder / "good" / "method.py").write_text(GOOD)
    (folder / "good" / "kernel.glsl").write_text(KERNEL)


def prepare(shared: Path) -> None:
    """Keep the rows of METHODS without a hostile method in a shared folder, and what the oracle answers."""
    write_good(shared / "plugins")
    found = [info for info in discover_devices(["all"]) if not info.problem]
    (shared / "devices.pickle").write_bytes(pickle.dumps(found))
    rows = checked(shared, shared / "plugins", shared, bad="") if found else {}
    if wrong := [f"{slot}: {row['reason']}" for slot, row in rows.items() if row["status"] != CellStatus.OK]:
        raise Fell(f"without a hostile method there is {wrong[0]}")
    (shared / "rows.json").write_text(json.dumps({slot: _kept(row) for slot, row in rows.items()}))
    shutil.rmtree(shared / "runs", ignore_errors=True)


def _kept(row: Row) -> dict[str, Any]:
    return {"program": row["program"], "status": row["status"], "accuracy": row["accuracy"]}


def checked(own: Path, plugins: Path, shared: Path, bad: str = BAD) -> dict[str, Row]:
    """Check all cells of the config, and return their rows by slot; the oracle's answers are kept in `shared`."""
    found = pickle.loads((shared / "devices.pickle").read_bytes())
    devices = json.dumps([info.name for info in found])
    (own / "beside.toml").write_text(CONFIG.format(bad=bad).replace('["all"]', devices))
    catalog = find_methods(plugins).with_stand_ins()
    experiment = reading.load(own / "beside.toml", catalog)
    planned = plan.plan(experiment, catalog, found, timed=False)
    store = Store(own / "runs")
    store.truth = shared / "truth"
    environment = describe()
    runner = Runner(experiment.config, catalog, store, executor(), environment, lambda *_: None)
    return {row["slot"]: row for row in runner.run(planned).values()}


def tried(own: Path, plugins: Path, shared: Path, bad: str = BAD, good: bool = False) -> Counter[str]:
    """Check all cells, and count what became of the hostile method's rows, as `judged` does.

    Where another method's row ran out of time or was killed, all are checked again: a loaded machine does so at times,
    a hostile method each time. So are all where the hostile method's rows have to be `good`.
    """
    if not pickle.loads((shared / "devices.pickle").read_bytes()):
        return Counter({"no device": 1})
    for _ in range(TRIES):
        rows = checked(own, plugins, shared, bad)
        bound = [row["status"] for row in rows.values() if good or row["method"] in METHODS]
        if not {CellStatus.TIMEOUT, CellStatus.CRASHED} & set(bound):
            break
        shutil.rmtree(own / "runs")
    return judged(rows, shared, good)


def judged(rows: dict[str, Row], shared: Path, good: bool = False) -> Counter[str]:
    """Count what became of the hostile method's rows.

    Raises Fell where another method's row changed, or one lacks, or where the hostile method's rows have to be `good`
    and one is not.
    """
    before = json.loads((shared / "rows.json").read_text())
    now = {slot: row for slot, row in rows.items() if row["method"] in METHODS}
    if before.keys() != now.keys():
        raise Fell(f"rows of others are lost: {sorted(before.keys() ^ now.keys())}")
    for slot, row in now.items():
        if json.loads(json.dumps(_kept(row))) != before[slot]:
            raise Fell(f"{slot} changed: {row['status']} {row['reason']} {row['accuracy']}")
    seen: Counter[str] = Counter()
    for row in rows.values():
        if row["method"] in METHODS:
            continue
        if row["status"] in (*UNFINISHED, CellStatus.SKIPPED) and not row["reason"]:
            raise Fell(f"{row['slot']} is {row['status']}, without a reason")
        if row["status"] == CellStatus.OK and row["accuracy"] is None:
            raise Fell(f"{row['slot']} is ok, and nothing was judged")
        if good and row["status"] != CellStatus.OK:
            raise Fell(f"{row['slot']} did no harm, and is {row['status']}: {row['reason']}")
        seen[f"{row['status']}"] += 1
    if not seen:
        raise Fell("the hostile method has no rows")
    return seen
