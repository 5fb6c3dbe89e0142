"""State each kind of file that is read back: how a good one is made, who reads it, and what may not come of it."""

from __future__ import annotations

import contextlib
import dataclasses
import json
import math
import statistics
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from unittest.mock import patch

import numpy as np

import surfaces
from harness.commands import rays as rays_command
from harness.contract import DeviceInfo, FirsthitError
from harness.devices import kept_answers
from harness.gate import baseline, pictures
from harness.gate.baseline import Baseline
from harness.oracle import cache, first_hits
from harness.results import agreement, archive, commits, compaction, sealed, store, study_file
from harness.results.schema import FAMILY, SCHEMA, flattener
from harness.results.store import Store
from harness.running import environment
from harness.scenes import meshes
from harness.studies import condition_numbers, torus_along_rays
from reports.reading import arrays as reading
from reports.reading import columns, load
from reports.site import build
from tests import kept_runs, synthetic_run
from tests.agreeing_rows import whole

KEY, LADDER = "a0", "a1"
COUNT = 64
INFO = DeviceInfo("opencl:one", "One", "1", "c", 2, True, "wall", (("pyopencl", "1"),))
PROBES = {
    **dict.fromkeys(("two_sum", "two_prod_split", "two_prod_fma", "round_to_nearest", "division"), 1.0),
    "peak_gflops": 143.5,
    "peak_median_gflops": 120.0,
    "peak_shape": "8 chains of fused multiply-adds",
    "clock_ratio": 0.9,
}


@dataclass(frozen=True)
class Kind:
    """State a kind of file.

    path: of the file, below a folder
    form: "json", "npz", "npy", "toml", "parquet" or "zip", of which a part may be read where another part is damaged
    read: reads the file in a folder as commands do; returns None where it is made again. Raises ValueError, OSError or
        FirsthitError where it is named
    sound: tells whether a value that was read may become a figure
    every: it is tried once in so many times; more than 1 where a damaged file is read by a process of its own
    """

    name: str
    path: str
    form: str
    read: Callable[[Path], Any]
    sound: Callable[[Any], bool] = lambda _: True
    every: int = 1


def _row(key: str) -> Callable[[Path], Any]:
    def read(folder: Path) -> Any:
        """Read a row as a report does, and as `run` does."""
        own = Store(folder)
        kept = own.read(key)
        try:
            found = store.read_row(folder / "cells" / f"{key}.json", key)
        except FileNotFoundError:
            return kept  # a link to nothing: the cell has not run
        except (OSError, ValueError):
            if kept is not None or key not in own.unreadable:
                raise AssertionError("run takes a row that the report refuses, or says nothing of it") from None
            raise
        flattener(FAMILY if found.get("family") else SCHEMA)(found)
        return found

    return read


def _part(folder: Path) -> Any:
    """Read a row of a part as `run` does, and its columns as a report does."""
    own = folder / "of a part"
    place = own / "parts" / (folder / "part.name").read_text()
    if not place.is_symlink():
        place.parent.mkdir(parents=True)
        place.symlink_to(folder / "part.parquet")
    packed = Store(own)
    found = packed.read(KEY, older=True)
    if found is None:
        raise ValueError(packed.unreadable.get(KEY) or next(iter(packed.parts.problems().values()), "there is no row"))
    if not packed.parts.all()[0].problem:
        assert columns.Columns((packed.parts.all()[0],), np.zeros(1, np.int32), np.zeros(1, np.int64)).column("key")
    return found


def _finite(value: Any) -> bool:
    """Tell whether nothing in a document is no number, or half a letter."""
    json.dumps(value, allow_nan=False, ensure_ascii=False).encode()
    return True


def _sound_row(row: dict[str, Any]) -> bool:
    """Tell whether the figures of a row can be: said again, without the reader's own code."""
    time, found, rungs = row.get("time"), row.get("accuracy"), row.get("rungs") or []
    good = _finite({name: value for name, value in row.items() if name != "identity"})
    if time and "samples_ms" in time:
        good &= len(time["samples_ms"]) > 0 and min(time["samples_ms"]) > 0.0
        middle = statistics.median(time["samples_ms"])
        good &= "median_ms" not in time or math.isclose(time["median_ms"], middle, rel_tol=1e-6)
        good &= all(
            len(time.get(n, time["samples_ms"])) == len(time["samples_ms"]) for n in ("rounds", "wall_samples_ms")
        )
    if found:
        good &= all(type(found[name]) is int and found[name] >= 0 for name in ("misses", "undecided") if name in found)
    return good and all(rung["right"] <= rung["decided"] <= rung["rays"] for rung in rungs)


def _truth(folder: Path) -> Any:
    found = cache.load(folder / "truth.npz", COUNT)
    return None if found is None else vars(found)


def _sound_truth(found: dict[str, Any]) -> bool:
    hit = (found["status"] == 1) | (found["status"] == 2)
    return bool((found["lower"][hit] <= found["upper"][hit]).all() and all(a.shape == (COUNT,) for a in found.values()))


def _arrays(folder: Path) -> Any:
    side = pictures.side_of({"program": None, "rungs": None, "arrays": "arrays.npz"}, folder, "now")
    try:
        found = {name: one for name, one in vars(reading.read(folder / "arrays.npz")).items() if one is not None}
    except (OSError, ValueError):
        assert side.told, "the gate draws what the report refuses"
        raise
    return found


def _sound_arrays(found: dict[str, Any]) -> bool:
    one = found["truth"].shape
    same = all(array.shape == one for name, array in found.items() if name != "samples")
    return same and bool(found["wrong"].max() <= 5 and not (found["error"] < 0).any())


def _mesh(folder: Path) -> Any:
    found = meshes._stored(folder / "mesh.npz")
    return None if found is None else {"v": found.vertices, "t": found.triangles, "c": np.array(found.closed)}


def _probes(folder: Path) -> Any:
    with patch.object(environment, "_probes_file", lambda _, where: where / "probes.json"):
        found, _ = environment.kept_probes(INFO, folder)
    return None if found is None else dataclasses.asdict(found)


def _fingerprint(folder: Path) -> Any:
    with patch.object(environment, "_probes_file", lambda _, where: where / "print.json"):
        return environment.kept_fingerprint(INFO, folder)[0]


def _answers(folder: Path) -> Any:
    with patch.object(kept_answers, "_place", lambda: folder), patch.object(kept_answers, "_surroundings", lambda: "s"):
        found = kept_answers.recall("opencl")
    return None if found is None else [dataclasses.asdict(one) for one in found.devices]


def _history(folder: Path) -> Any:
    found, problems = commits.read_all(folder / "history")
    if problems:
        raise ValueError(problems[0])
    return vars(found[0]) if found else None


def _mark(folder: Path) -> Any:
    return build._listed(folder) or None


def _rays(folder: Path) -> Any:
    return {"rays": rays_command.load_rays(folder / "rays.npy")}


def _study(name: str) -> Callable[[Path], Any]:
    return lambda folder: study_file.read(folder / f"{name}.json", name, "abc")["rows"]


def _archive(folder: Path) -> Any:
    """Read the rows of an archive whose checksums hold, as bytes."""
    found = {}
    with archive.opened(folder / "run.zip") as run:
        for path in (run / "cells").glob("*.json"):
            with contextlib.suppress(ValueError):
                sealed.read(path)
                found[path.stem] = path.read_bytes()
    return found


KINDS = (
    Kind("cells", f"cells/{KEY}.json", "json", _row(KEY), _sound_row),
    Kind("families", f"cells/{LADDER}.json", "json", _row(LADDER), _sound_row),
    Kind("parts", "part.parquet", "parquet", _part, _sound_row, every=20),
    Kind("plan", "plan.json", "json", lambda folder: vars(load.plan_of(folder)), lambda _: True),
    Kind("studies", "condition_numbers.json", "json", _study("condition_numbers"), _finite),
    Kind("studies of rays", "torus_along_rays.json", "json", _study("torus_along_rays"), _finite),
    Kind("truth", "truth.npz", "npz", _truth, _sound_truth),
    Kind("arrays", "arrays.npz", "npz", _arrays, _sound_arrays),
    Kind("meshes", "mesh.npz", "npz", _mesh),
    Kind("rays", "rays.npy", "npy", _rays),
    Kind("probes", "probes.json", "json", _probes, lambda found: 0.0 <= found["division"] <= 1.0 and _finite(found)),
    Kind("fingerprints", "print.fingerprint", "json", _fingerprint, _finite),
    Kind("devices", "opencl.json", "json", _answers, _finite),
    Kind("baseline", "baseline.toml", "toml", lambda folder: vars(baseline.read(folder / "baseline.toml"))),
    Kind("history", "history/2026-03-01-one.json", "json", _history, lambda found: _finite(found["rows"])),
    Kind("site", "firsthit-site.json", "json", _mark),
    Kind("archive", "run.zip", "zip", _archive),
)


def prepare(folder: Path) -> None:
    """Write a good file of each kind into a folder."""
    for inner in ("cells", "history"):
        (folder / inner).mkdir()
    view = whole(synthetic_run.cell("newton[EPSILON=1e-06]", "torus", "opencl:intel", "float32"))
    hard = whole(synthetic_run.family_cell("ray_march", "grazing", "opencl:intel", "float32"))
    for key, row in ((KEY, view), (LADDER, hard)):
        agreement.check_whole(row | {"key": key}, "")
        (folder / "cells" / f"{key}.json").write_bytes(sealed.sealed(row | {"key": key}))
    part = compaction.write_part(folder / "of parts", [(view | {"key": KEY}, Store(folder).text(KEY))])
    (folder / "part.name").write_text(part.name)
    part.rename(folder / "part.parquet")
    Store(folder).write_plan(synthetic_run.plan([view | {"key": KEY}, hard | {"key": LADDER}]) | _methods())
    for module in (condition_numbers, torus_along_rays):
        name = module.__name__.rpartition(".")[2]
        document = {"format": 1, "key": "abc", "study": name, "rows": module.compute()}
        (folder / f"{name}.json").write_bytes(sealed.sealed(document))
    dice = np.random.default_rng(1)
    aimed = dice.normal(size=(COUNT, 3)) * 0.5 - [0.0, 0.0, 0.0]
    rays = np.concatenate([np.tile([0.0, -3.0, 0.1], (COUNT, 1)), aimed - [0.0, -3.0, 0.1]], axis=1)
    rays[:, 3:] /= np.linalg.norm(rays[:, 3:], axis=1)[:, None]
    np.save(folder / "rays.npy", rays.astype(np.float32))
    cache.store(folder / "truth.npz", first_hits(surfaces.get("torus"), rays.astype(np.float32)))
    np.savez_compressed(folder / "arrays.npz", **synthetic_run.arrays(view))
    corners = np.array([[0, 1, 2], [1, 2, 3]], np.uint32)
    points = dice.normal(size=(4, 6)).astype(np.float32)
    np.savez_compressed(folder / "mesh.npz", vertices=points, triangles=corners, closed=np.array(False))
    (folder / "probes.json").write_bytes(sealed.sealed(PROBES))
    found = {"float32": {"sums": "a", "exp": "b"}, "raster": {"all": "c"}}
    kept = {"fingerprint": found, "digest": environment.digest(found)}
    (folder / "print.fingerprint").write_bytes(sealed.sealed(kept))
    record = {"surroundings": "s", "files": {"/nowhere": [1, 2]}, "devices": [dataclasses.asdict(INFO)]}
    (folder / "opencl.json").write_bytes(sealed.sealed(record | {"files": {}}))
    entry = {"scene": "s", "status": "ok", "program": "p", "misses": 3, "error_max": 1e-6, "last_bit": 1e-7}
    facts = {"name": "opencl:one", "processor": "P", "versions": {"pyopencl": "1"}, "arithmetic": found}
    rows = {"newton torus": entry, 'newton "kiss"': entry | {"status": "failed", "reason": "no\nway"}}
    baseline.write(
        folder / "baseline.toml", Baseline("gate", {"opencl:one 1f3a6c": facts}, {"opencl:one 1f3a6c": rows})
    )
    gated = {kept_runs.SLOT: kept_runs.row(misses=3, error_max=1.1e-6), "other": kept_runs.row(misses=0)}
    written = commits.write(folder / "history", kept_runs.kept(0, gated), "one")
    written.rename(folder / "history" / "2026-03-01-one.json")
    (folder / build.MARK).write_bytes(sealed.sealed({"format": 1, "files": ["index.html", "runs/a.html"]}))
    packed = folder.with_name("run.zip")
    archive.pack(folder, packed)
    packed.rename(folder / "run.zip")


def _methods() -> dict[str, Any]:
    """Return what a plan says of methods, studies and other runs."""
    table = {"part": "What was tried", "header": ["a", "kept"], "rows": [["b", "yes"], ["c", "no"]]}
    knob = {"name": "EPSILON", "default": 1e-6, "meaning": "share", "printed": 1e-3}
    card = {"label": "Newton", "title": "Newton", "summary": "s", "source": "toledo2007", "doc": {"Theory": "t"}}
    card |= {"tables": [table], "parameters": [knob], "claims": ["no_missed_root"], "outside": None}
    studied = [{"study": "condition_numbers", "key": "abc"}]
    return {"methods": {"newton": card}, "studies": studied, "include": [], "baseline": "ray_march", "focus": ""}


def same(a: Any, b: Any) -> bool:
    """Tell whether two values that were read are alike, arrays by their bytes."""
    if isinstance(a, np.ndarray):
        return isinstance(b, np.ndarray) and a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes()
    if isinstance(a, dict):
        return isinstance(b, dict) and a.keys() == b.keys() and all(same(a[name], b[name]) for name in a)
    return bool(a == b)


REFUSED = (ValueError, OSError, FirsthitError)
