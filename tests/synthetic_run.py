"""Make up run folders: surfaces, variants, devices, two precisions, families of hard rays, and all that goes wrong."""

from __future__ import annotations

import json
from collections.abc import Collection
from pathlib import Path
from typing import Any

import numpy as np

from reports import content, report
from reports.analysis import breaks, derive
from reports.reading import load
from tests.agreeing_rows import stated
from tests.synthetic_rows import (
    BROKEN_FROM as BROKEN_FROM,
)
from tests.synthetic_rows import (
    DEVICES as DEVICES,
)
from tests.synthetic_rows import (
    FAMILIES as FAMILIES,
)
from tests.synthetic_rows import (
    GRID as GRID,
)
from tests.synthetic_rows import (
    IDENTITY as IDENTITY,
)
from tests.synthetic_rows import (
    LEVELS as LEVELS,
)
from tests.synthetic_rows import (
    SURFACES as SURFACES,
)
from tests.synthetic_rows import (
    VARIANTS as VARIANTS,
)
from tests.synthetic_rows import (
    accuracy as accuracy,
)
from tests.synthetic_rows import (
    arrays as arrays,
)
from tests.synthetic_rows import (
    cell as cell,
)
from tests.synthetic_rows import (
    family_cell as family_cell,
)
from tests.synthetic_rows import (
    retime as retime,
)
from tests.synthetic_rows import (
    rung as rung,
)
from tests.synthetic_rows import (
    sampled as sampled,
)
from tests.synthetic_rows import (
    troubled as troubled,
)


def plan(cells: list[dict[str, Any]]) -> dict[str, Any]:
    """Make up the plan of a run of these cells, as plan.json holds it."""
    devices = [
        {
            "name": name,
            "title": "Intel(R) Xeon(R) *Platinum* @ 2.60GHz",
            "driver": "2026.2.0_#1",
            "compiler": "OpenCL C 3.0",
            "compute_units": 2,
            "float64": name != "opencl:gpu#0_$",
            "clock": "wall" if name.startswith("opengl") else "device",
            "versions": {"pyopencl": "2026.1.4"},
            "problem": None,
            "probes": {"peak_gflops": 143.5},
        }
        for name in DEVICES
    ]
    environment = {
        "firsthit": "0.1.0",
        "commit": "abc1234",
        "dirty": True,
        "python": "3.11.7",
        "platform": "Linux-6.1 #1 SMP",
        "cpu": "Xeon @ 2.6 GHz",
        "versions": {"numpy": "2.4.6", "sympy": "1.14.0"},
    }
    return {
        "format": 1,
        "name": "quick_$",
        "title": "Quick look: 3 surfaces × 4 variants #1 $2 *all* _devices_",
        "config": "configs/quick.toml",
        "config_text": 'title = "quick"  # a comment\n[methods]\nnewton = { EPSILON = [1e-3, 1e-6] }\n',
        "command": "firsthit run configs/quick.toml",
        "created": "2026-11-22T03:00:00+00:00",
        "environment": environment,
        "devices": devices,
        "cells": [{"slot": cell["slot"], "key": cell["key"]} for cell in cells if not cell["family"]],
        "families": [{"slot": cell["slot"], "key": cell["key"]} for cell in cells if cell["family"]],
        "family_facts": FAMILIES,
    }


def write_run(folder: Path, surfaces: Collection[str] = tuple(SURFACES)) -> Path:
    """Write a run of 40 planned cells for each of three surfaces, or of `surfaces`, into `folder`; return the folder.

    Cells are ok, skipped, failed, timed out and crashed; two have not run, and two are unreadable.
    """
    cells = [
        troubled(cell(variant, surface, device, precision))
        for surface in surfaces
        for device in DEVICES
        for precision in ("float32", "float64")
        for variant in VARIANTS
    ]
    (folder / "cells").mkdir(parents=True)
    (folder / "arrays").mkdir()
    (folder / "plan.json").write_text(json.dumps(plan(cells)))
    for finished in cells[:-2]:
        text = json.dumps(finished)
        (folder / "cells" / f"{finished['key']}.json").write_text(text)
        if finished["arrays"]:
            np.savez_compressed(folder / finished["arrays"], **arrays(finished))
    (folder / "cells" / f"{cells[0]['key']}.json").write_text('{"format": 1, "key"')
    (folder / "cells" / f"{cells[7]['key']}.json").write_text('{"somebody": "else\'s"}')
    (folder / "cells" / "0123456789abcdef.json").write_text("stale: no longer in the plan")
    return folder


def stability_run(folder: Path) -> Path:
    """Write a run of families alone, on two devices that agree, into `folder`, and return the folder.

    One cell is skipped, one has not run, and one is unreadable.
    """
    cells = [
        family_cell(variant, family, device, precision)
        for family in FAMILIES
        for device in ("opencl:intel", "opencl:pocl")
        for precision in ("float32", "float64")
        for variant in VARIANTS
        if variant != "null"
    ]
    cells[0] |= {"status": "skipped", "reason": "no *interval* extension", "rungs": None, "operations": None}
    tiny_run(folder, *cells)
    (folder / "cells" / f"{cells[1]['key']}.json").unlink()
    (folder / "cells" / f"{cells[2]['key']}.json").write_text('{"format": 1, "key"')
    return folder


def tiny_run(folder: Path, *cells: dict[str, Any]) -> Path:
    """Write a run of just these cells, without arrays, into `folder`, and return the folder.

    Quantiles that a cell does not state are filled in. Raises ValueError where a cell contradicts itself.
    """
    (folder / "cells").mkdir(parents=True)
    (folder / "plan.json").write_text(json.dumps(plan(list(cells))))
    for finished in cells:
        (folder / "cells" / f"{finished['key']}.json").write_text(json.dumps(stated(finished)))
    return folder


def reported(folder: Path) -> tuple[load.Run, content.Document]:
    """Read the run in `folder`; return it with the report on it."""
    run = load.load(folder)
    return run, report.report(run, derive.derive(run.frame, run.plan.peaks), breaks.derive(run.families, run.rungs))


def printed(blocks: tuple[content.Block, ...]) -> str:
    """Return all that these blocks' texts, tables and captions say, with cells as a renderer prints them."""
    words = []
    for block in blocks:
        match block:
            case content.Text() | content.Code():
                words.append(block.text)
            case content.Table():
                rows = [[c.show(v) for c, v in zip(block.columns, row, strict=True)] for row in block.rows]
                words += [block.title, block.caption, *(" | ".join(row) for row in rows)]
            case content.Matrix():
                rows = [[heading, *(square.text for square in squares)] for heading, squares in block.rows]
                words += [block.title, block.caption, " | ".join(block.columns), *(" | ".join(row) for row in rows)]
            case content.Figure() | content.Gallery():
                words.append(block.caption)
    return "\n".join(words)
