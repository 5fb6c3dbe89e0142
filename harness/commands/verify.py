"""Offer `firsthit verify`: check stored rows again by what they say."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable
from pathlib import Path

from harness import console
from harness.commands import Add
from harness.commands.answers import verifying
from harness.commands.machine import Answer, add_json
from harness.commands.options import add_jobs, whole
from harness.contract import plural
from harness.limits import SEED
from harness.verifying.checks import CHECKS, Verified, verify

USUAL_SAMPLE = "20"
DOES_NOT_HOLD = 1
SHOWN = 30  # values that are printed


def add_parsers(add: Add) -> None:
    parser = add(
        "verify",
        "firsthit verify runs/quick --sample all",
        "Check rows again by what they say: each row's file and key, its times by its samples, its counts and errors "
        "by its answers ray by ray, and, of a sample of rows, the truth itself, certified anew. Nothing is cast, and "
        "no device is needed. Exit codes: 0 all that was checked holds, 1 a value does not.",
    )
    parser.add_argument("folders", type=Path, metavar="RUN", nargs="+", help="a folder below runs/")
    sample = "rows whose truth is certified anew: a number, a share as 1%%, or all (default: 20)"
    parser.add_argument("--sample", type=_sample, default=_sample(USUAL_SAMPLE), metavar="N", help=sample)
    parser.add_argument("--seed", type=whole(SEED), default=1, help="of the sample (default: 1)")
    add_jobs(parser)
    add_json(parser)
    parser.set_defaults(run=_verify)


def _sample(text: str) -> Callable[[int], int]:
    """Read how many rows of a number of rows are the sample. Raises ArgumentTypeError for other text."""
    problem = argparse.ArgumentTypeError(f"{text[:40]!r} is no number of rows, no share as 1%, and not all")
    if text == "all":
        return lambda count: count
    try:
        value = float(text.removesuffix("%")) if text.endswith("%") else int(text)
    except ValueError:
        raise problem from None
    if not 0.0 <= value <= (100.0 if text.endswith("%") else 1e9):
        raise problem
    if text.endswith("%"):
        return lambda count: math.ceil(count * value / 100.0)
    return lambda _: int(value)


def _verify(options: argparse.Namespace) -> int | Answer:
    """Check rows again and tell what does not hold."""
    with console.working() as tell:
        found = verify(options.folders, options.sample, options.seed, tell)
    code = DOES_NOT_HOLD if found.failing else 0
    if options.json:
        return Answer(verifying.answer(found), code)
    _print(found)
    return code


def _print(found: Verified) -> None:
    if found.failing:
        listed = [
            (str(one.file), one.slot, one.wrong.figure, _short(one.wrong.stored), _short(one.wrong.found))
            for one in found.failing[:SHOWN]
        ]
        print(console.table(("row", "cell", "figure", "stored", "found"), listed))
        if len(found.failing) > SHOWN:
            print(f"and {len(found.failing) - SHOWN} more")
        print()
    lines = []
    for name, meaning in CHECKS.items():
        failing = len({one.file for one in found.failing if one.check == name})
        left = sum(count for (check, _), count in found.not_checked.items() if check == name)
        lines.append((name, str(found.checked[name]), str(failing), str(left), meaning))
    print(console.table(("check", "rows", "do not hold", "cannot tell", "what holds"), lines))
    for (name, reason), count in sorted(found.not_checked.items()):
        print(f"  {name}: of {count} it cannot tell: {reason}")
    rows = len({one.file for one in found.failing})
    missing = f"; without a row: {plural(found.missing, 'cell')} of the plan" if found.missing else ""
    print(f"{plural(found.rows, 'row')}, {rows} {'does' if rows == 1 else 'do'} not hold{missing}")


def _short(value: object) -> str:
    text = repr(value) if isinstance(value, float) else str(value)
    return text if len(text) <= 60 else text[:57] + "..."
