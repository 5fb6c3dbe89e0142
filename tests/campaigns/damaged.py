"""Damage a file of each kind at random, and read it as commands do; and now and then report a whole damaged run."""

from __future__ import annotations

import json
import random
import shutil
from collections import Counter
from collections.abc import Callable
from functools import cache, partial
from pathlib import Path
from typing import Any

import numpy as np

from harness.contract import FirsthitError
from harness.results import sealed, store
from reports import compare
from reports.reading import load
from tests import synthetic_run
from tests.campaigns import damaged_kinds, mutations
from tests.campaigns.damaged_kinds import KINDS, REFUSED, Kind
from tests.campaigns.frame import Campaign, Fell, Place

EACH = 100
REPORTED = 0.05  # of all trials report a whole run


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


def _damaged(dice: random.Random, kind: Kind, path: Path) -> tuple[bytes, bool]:
    """Return a good file's bytes, damaged, and whether its checksum was mended, so that only what it says is wrong."""
    content = _content(path)
    if kind.form == "npz" and dice.random() < 0.6:
        return mutations.repacked(dice, _arrays(path)), True
    if kind.form == "npy" and dice.random() < 0.6:
        return mutations.claimed(dice, content), True
    if kind.form == "json" and dice.random() < 0.7:
        text = mutations.text(mutations.changed(dice, _document(path)))
        match dice.randrange(10):
            case 0 | 1:
                return content.split(b"\n")[0] + b"\n" + text.encode().partition(b"\n")[2], False
            case 2 | 3:  # as a file of an older version is, which has no checksum
                return text.encode(), True
        return _sealed(text), True
    made = mutations.scribbled(dice, content)
    if kind.form == "json" and dice.random() < 0.5:
        return sealed.with_seal("{\n" + made.partition(b"\n")[2].decode("utf-8", "replace")), True
    return made, kind.form in ("toml", "npy")  # such files have no checksum


@cache
def _content(path: Path) -> bytes:
    return path.read_bytes()


@cache
def _document(path: Path) -> dict[str, Any]:
    return {name: value for name, value in json.loads(_content(path)).items() if name != sealed.CHECKSUM}


@cache
def _arrays(path: Path) -> dict[str, Any]:
    with np.load(path) as arrays:
        return dict(arrays)


def _sealed(text: str) -> bytes:
    """Seal a document, also where it is empty."""
    return sealed.with_seal(text) if text.startswith("{\n") else text.encode()


def _tried(dice: random.Random, kind: Kind, good: Any, shared: Path, own: Path) -> str:
    """Damage a file of a kind, read it, and say what happened."""
    path, kept, mended = own / kind.path, None, False
    if dice.random() < 0.01:
        mutations.in_place_of(dice, path)
    else:
        kept, mended = _damaged(dice, kind, shared / kind.path)
        path.write_bytes(kept)
    try:
        found = kind.read(own)
    except REFUSED as error:
        if "\n" in sealed.problem(error):
            raise Fell(f"{kind.name}: more than a line: {error}") from None
        return "named"
    except Exception as error:
        raise _told(kind, kept) from error
    finally:
        if kept is None:
            path.rmdir() if path.is_dir() and not path.is_symlink() else path.unlink()
    if found is None:
        return "made again"
    if damaged_kinds.same(found, good):
        return "harmless"
    if kind.form == "zip" and found.items() <= good.items():
        return "in part"
    if not mended or not kind.sound(found):
        raise _told(kind, kept)
    return "possible"


def _told(kind: Kind, content: bytes | None) -> Fell:
    return Fell(f"{kind.name}: of a file that begins with {content[:3000] if content else content!r}")


def _possible(dice: random.Random, path: Path, good: Path, read: Callable[[], Any]) -> None:
    """Change a file until its reader takes it, or leave it as it is."""
    for _ in range(30):
        document = mutations.changed(dice, _document(good))
        if path.name == "plan.json" and dice.random() < 0.1:
            document |= {dice.choice(("devices", "cells")): []}
        path.write_bytes(_sealed(mutations.text(document)))
        try:
            read()
        except REFUSED:
            continue
        return
    path.write_bytes(_content(good))


def _reported(dice: random.Random, shared: Path, own: Path) -> str:
    """Report a run of which much is damaged, and compare it with what it was."""
    run = own / "run"
    shutil.copytree(shared / "run", run)
    paths = sorted(path for path in run.rglob("*") if path.is_file())
    for path in paths:
        what, good = dice.random(), shared / "run" / path.relative_to(run)
        if path.parent.name == "cells" and what < 0.6:
            _possible(dice, path, good, partial(store.read_row, path, path.stem))
        elif path.parent.name == "arrays" and what < 0.5:
            path.write_bytes(mutations.repacked(dice, _arrays(good)))
        elif path.name == "plan.json" and what < 0.8:
            _possible(dice, path, good, partial(load.plan_of, run))
        elif what > 0.93:
            dice.choice((path.unlink, partial(mutations.in_place_of, dice, path)))()
    if dice.random() < 0.1:
        shutil.rmtree(run / dice.choice(("arrays", "studies", "cells")))
    try:
        synthetic_run.reported(run)
        compare.report(load.load(shared / "run"), load.load(run))
    except FirsthitError:
        return "runs: named"
    return "runs: reported"


def _trial(dice: random.Random, place: Place) -> Counter[str]:
    seen: Counter[str] = Counter()
    files, own = place.shared / "files", place.own / "files"
    shutil.copytree(files, own)
    goods = {kind.name: kind.read(own) for kind in KINDS}
    for number in range(EACH):
        for kind in (kind for kind in KINDS if number % kind.every == 0):
            seen[f"{kind.name}: {_tried(dice, kind, goods[kind.name], files, own)}"] += 1
    if dice.random() < REPORTED:
        seen[_reported(dice, place.shared, place.own)] += 1
    return seen


CAMPAIGN = Campaign(
    name="damaged",
    tries="damages a file of each kind and reads it as commands do; every 2,000th time reports a whole damaged run",
    promise="no traceback, no hang, no figure from a damaged file",
    trial=_trial,
    small=60,
    whole=100_000,
    each=EACH,
    block=2,
    prepare=_prepare,
    limit=300,
)
