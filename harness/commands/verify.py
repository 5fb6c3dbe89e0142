"""Offer `firsthit verify`: check stored rows again by what they say."""

from __future__ import annotations

import argparse
import dataclasses
import math
import secrets
from collections.abc import Callable
from pathlib import Path

from harness import console
from harness.commands import Add
from harness.commands.answers import verifying
from harness.commands.machine import Answer, add_json
from harness.commands.options import add_jobs, whole
from harness.contract import plural
from harness.limits import SEED
from harness.results import archive
from harness.verifying.checks import CHECKS, Failing, Verified, verify

USUAL_SAMPLE = "20"
DOES_NOT_HOLD = 1
SHOWN = 30  # values that are printed
UNFORESEEN = 10**9  # seeds: who makes up a row must not know whether it will be in the sample
SURE = 0.95


def add_parsers(add: Add) -> None:
    parser = add(
        "verify",
        "firsthit verify runs/quick --sample all",
        "Check rows again by what they say: each row's file and key, its times by its samples, its counts and errors "
        "by its answers ray by ray, and, of a sample of rows, the truth itself, certified anew. Nothing is cast, and "
        "no device is needed. Exit codes: 0 all that was checked holds, 1 a value does not.",
    )
    parser.add_argument("folders", type=Path, metavar="RUN", nargs="+", help="a folder below runs/, or an archive")
    sample = "rows whose truth is certified anew: a number, a share as 1%%, or all (default: 20)"
    parser.add_argument("--sample", type=_sample, default=_sample(USUAL_SAMPLE), metavar="N", help=sample)
    seed = "of the sample (default: one that nobody can foresee, which is told)"
    parser.add_argument("--seed", type=whole(SEED), help=seed)
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
    with archive.all_opened(options.folders) as folders, console.working() as tell:
        seed = secrets.randbelow(UNFORESEEN) if options.seed is None else options.seed
        found = verify(folders, options.sample, seed, tell)
    for folder, given in zip(folders, options.folders, strict=True):
        found.failing = [_named_as_given(one, folder, given) for one in found.failing]
    code = DOES_NOT_HOLD if found.failing else 0
    if options.json:
        return Answer(verifying.answer(found), code)
    _print(found)
    return code


def _named_as_given(one: Failing, folder: Path, given: Path) -> Failing:
    """Name a file in an archive by the archive's name and not by the folder where its content was."""
    inside = one.file.is_relative_to(folder) and folder != given
    return dataclasses.replace(one, file=given / one.file.relative_to(folder)) if inside else one


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
    if told := sampled(found):
        print(told)
    rows = len({one.file for one in found.failing})
    missing = f"; without a row: {plural(found.missing, 'cell')} of the plan" if found.missing else ""
    print(f"{plural(found.rows, 'row')}, {rows} {'does' if rows == 1 else 'do'} not hold{missing}")


def sampled(found: Verified) -> str:
    """Say whose truth was certified anew, and how likely that tells rows that agree with all but the truth."""
    of, number = found.certifiable, found.sampled
    if not of:
        return ""
    told = f"the truth of {number} of {plural(of, 'row')} ({number / of:.2%}) was certified anew"
    if not 0 < number < of:
        return told
    few = enough(of, number)
    more = f", of {few} such rows with {SURE:.0%}" if few > 1 else ""
    return (
        f"{told} (seed {found.seed}): this tells of a single row that only the truth contradicts with a chance of "
        f"{number / of:.2%}{more}"
    )


def enough(of: int, number: int) -> int:
    """Return how many of `of` rows must be bad so that one of `number` drawn ones is bad as good as surely (SURE)."""
    none, bad = 1.0, 0
    while none > 1.0 - SURE:
        none *= max(0.0, 1.0 - number / (of - bad))
        bad += 1
    return bad


def _short(value: object) -> str:
    text = repr(value) if isinstance(value, float) else str(value)
    return text if len(text) <= 60 else text[:57] + "..."
