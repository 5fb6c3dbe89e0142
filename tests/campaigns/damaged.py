"""Damage a file of each kind at random, and read it as commands do; and now and then report a whole damaged run."""

from __future__ import annotations

import json
import random
import shutil
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np

from harness.contract import FirsthitError
from harness.results import sealed, store
from reports import compare
from reports.reading import load
from tests import synthetic_run
from tests.campaigns import damaged_kinds, mutations
from tests.campaigns.damaged_kinds import KEY, KINDS, LADDER, REFUSED, Kind
from tests.campaigns.frame import Campaign, Fell, Place

EACH = 100
REPORTED = 0.25  # of all trials report a whole run
CELLS = 6


def _prepare(shared: Path) -> None:
    """Write the good files, and a run that is reported."""
    (shared / "files").mkdir()
    damaged_kinds.prepare(shared / "files")
    cells = [
        synthetic_run.cell(variant, surface, device, "float32")
        for surface, device in (("torus", "opencl:intel"), ("sphere", "opencl:pocl"))
        for variant in ("null", "ray_march", "newton[EPSILON=0.001]")
    ]
    cells += [synthetic_run.family_cell("ray_march", "grazing", "opencl:intel", "float32")]
    synthetic_run.tiny_run(shared / "run", *cells)
    for path in (shared / "run" / "cells").iterdir():
        path.write_bytes(sealed.sealed(json.loads(path.read_bytes())))
    (shared / "run" / "arrays").mkdir()
    for one in cells:
        if one["arrays"]:
            np.savez_compressed(shared / "run" / one["arrays"], **synthetic_run.arrays(one))
    (shared / "run" / "studies").mkdir()
    shutil.copy(shared / "files" / "condition_numbers.json", shared / "run" / "studies" / "abc.json")
    plan = json.loads((shared / "run" / "plan.json").read_bytes())
    studies = {"studies": [{"study": "condition_numbers", "key": "abc"}]}
    (shared / "run" / "plan.json").write_bytes(sealed.sealed(plan | studies))


def _damaged(dice: random.Random, kind: Kind, path: Path) -> bool:
    """Damage a good file; return whether its checksum was mended, so that only what it says is wrong."""
    content = path.read_bytes()
    if kind.form in ("npz", "npy") and dice.random() < 0.6:
        if kind.form == "npz":
            with np.load(path) as arrays:
                path.write_bytes(mutations.repacked(dice, dict(arrays)))
        else:
            path.write_bytes(mutations._claimed(dice, content))
        return True
    if kind.form == "json" and dice.random() < 0.7:
        document = mutations.changed(dice, {k: v for k, v in json.loads(content).items() if k != sealed.CHECKSUM})
        text = mutations.text(document)
        mended = dice.random() < 0.8
        if mended and dice.random() < 0.2:  # what a file of an older version, without a checksum, is like
            path.write_text(text)
        elif mended and text.startswith("{\n"):
            path.write_bytes(sealed.with_seal(text))
        else:
            path.write_bytes(content.split(b"\n")[0] + b"\n" + text.encode().partition(b"\n")[2])
        return mended
    path.write_bytes(mutations.scribbled(dice, content))
    if kind.form == "json" and dice.random() < 0.5:
        rest = path.read_bytes().partition(b"\n")[2].decode("utf-8", "replace")
        path.write_bytes(sealed.with_seal("{\n" + rest))
        return True
    return kind.form in ("toml", "npy")  # such files have no checksum


def _tried(dice: random.Random, kind: Kind, good: Any, shared: Path, own: Path) -> str:
    """Damage a file of a kind, read it, and say what happened."""
    path, replaced = own / kind.path, dice.random() < 0.01
    content = (shared / kind.path).read_bytes()
    path.write_bytes(content)
    try:
        if replaced:
            mutations.in_place_of(dice, path)
            mended = False
        else:
            mended = _damaged(dice, kind, path)
        kept = None if replaced else path.read_bytes()
        try:
            found = kind.read(own)
        except REFUSED as error:
            if "\n" in sealed.problem(error):
                raise Fell(f"{kind.name}: more than a line: {error}") from None
            return "named"
        except Exception as error:
            raise _told(kind, kept) from error
        if found is None:
            return "made again"
        if damaged_kinds.same(found, good):
            return "harmless"
        if not mended or not kind.sound(found):
            raise _told(kind, kept)
        return "possible"
    finally:
        if path.is_dir() and not path.is_symlink():
            path.rmdir()
        path.unlink(missing_ok=True)
        path.write_bytes(content)


def _told(kind: Kind, content: bytes | None) -> Fell:
    return Fell(f"{kind.name}: of a file that begins with {content[:3000] if content else content!r}")


def _possible(dice: random.Random, path: Path) -> None:
    """Change a row until a reader takes it, or leave it as it is."""
    content = path.read_bytes()
    for _ in range(30):
        document = mutations.changed(dice, {k: v for k, v in json.loads(content).items() if k != sealed.CHECKSUM})
        text = mutations.text(document)
        if text.startswith("{\n"):
            path.write_bytes(sealed.with_seal(text))
            try:
                store.read_row(path, path.stem)
            except (OSError, ValueError):
                continue
            return
    path.write_bytes(content)


def _reported(dice: random.Random, shared: Path, own: Path) -> str:
    """Report a run of which much is damaged, and compare it with what it was."""
    run = own / "run"
    shutil.copytree(shared / "run", run)
    paths = sorted(path for path in run.rglob("*") if path.is_file())
    for path in paths:
        what = dice.random()
        if path.parent.name == "cells" and what < 0.6:
            _possible(dice, path)
        elif path.parent.name == "arrays" and what < 0.5:
            with np.load(path) as arrays:
                path.write_bytes(mutations.repacked(dice, dict(arrays)))
        elif path.name == "plan.json" and what < 0.8:
            _possible_plan(dice, run)
        elif what > 0.93:
            dice.choice((path.unlink, lambda path=path: mutations.in_place_of(dice, path)))()
    if dice.random() < 0.1:
        shutil.rmtree(run / dice.choice(("arrays", "studies", "cells")))
    try:
        synthetic_run.reported(run)
        compare.report(load.load(shared / "run"), load.load(run))
    except FirsthitError:
        return "runs: named"
    return "runs: reported"


def _possible_plan(dice: random.Random, run: Path) -> None:
    """Change a plan until a reader takes it, or leave it as it is."""
    path = run / "plan.json"
    content = path.read_bytes()
    for _ in range(30):
        document = mutations.changed(dice, {k: v for k, v in json.loads(content).items() if k != sealed.CHECKSUM})
        if dice.random() < 0.1:
            document |= {dice.choice(("devices", "cells")): []}
        text = mutations.text(document)
        if text.startswith("{\n"):
            path.write_bytes(sealed.with_seal(text))
            try:
                load.plan_of(run)
            except FirsthitError:
                continue
            return
    path.write_bytes(content)


def _trial(dice: random.Random, place: Place) -> Counter[str]:
    seen: Counter[str] = Counter()
    files, own = place.shared / "files", place.own / "files"
    shutil.copytree(files, own)
    goods = {kind.name: kind.read(own) for kind in KINDS}
    for _ in range(EACH):
        for kind in KINDS:
            seen[f"{kind.name}: {_tried(dice, kind, goods[kind.name], files, own)}"] += 1
    if dice.random() < REPORTED:
        seen[_reported(dice, place.shared, place.own)] += 1
    return seen


assert KEY != LADDER
CAMPAIGN = Campaign(
    name="damaged",
    tries="damages a file of each kind and reads it as commands do; every 400th time reports a whole damaged run",
    promise="no traceback, no hang, no figure from a damaged file",
    trial=_trial,
    small=300,
    whole=100_000,
    each=EACH,
    block=2,
    prepare=_prepare,
    limit=300,
)
