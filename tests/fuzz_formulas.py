"""Read random formulas: python -m tests.fuzz_formulas --count 1000000 --seed 1.

A third is made by a grammar of its own, together with its value, a third are such formulas with mistakes in them, and a
third is text of any characters. None may end in anything but a tape or a FirsthitError, take longer than --limit, or
run code. What is read is written in canonical form and read again, which must give the same graph, and a made formula
must have the value that it was made with.
"""

from __future__ import annotations

import argparse
import random
import sys
import time
from collections import Counter
from typing import Any

import flint
import mpmath

from surfaces import formula
from surfaces.model import FirsthitError
from surfaces.numbers import Balls
from surfaces.tape import Tape, walk
from tests.made_formulas import PARAMETERS, POINT, Made, Maker

LIMIT = 2.0  # seconds of the processor for one formula, unless --limit says otherwise
FORBIDDEN = ("compile", "exec", "import", "open", "os.", "subprocess.", "ctypes.", "socket.", "code.")
CHARACTERS = "xyzXabeR0123456789.+-*/^()|,;=<>!?:%&# \n\t_'\"[]{}\\~@$`²³⁻¹√·×−÷π≤≥≠φ∧∨¬éß𝑥½∞\x00\u200b\ufeff"
WORDS = ["let ", "sin", "sqrt(", "if(", "min(", "pow(", "and", "or", "not", "||", "&&", "**", "==", "//", "/*", "*/"]
WORDS += ["pi", "e", "1e3", "1e999", "9^9^9", "x^2y", "2x", "atan2(", "exec(", "lambda", "__import__('os')"]


def mutated(pick: random.Random, text: str) -> str:
    """Return a text with one to four mistakes."""
    for _ in range(pick.randint(1, 4)):
        at, to = pick.randint(0, len(text)), pick.randint(0, len(text))
        match pick.randrange(6):
            case 0:
                text = text[:at] + text[at + 1 :]
            case 1:
                text = text[:at] + pick.choice(CHARACTERS) + text[at:]
            case 2:
                text = text[:at] + pick.choice(WORDS) + text[at:]
            case 3:
                text = text[:at] + text[min(at, to) : max(at, to)][:40] + text[at:]
            case 4:
                text = text[:at] + pick.choice(CHARACTERS) + text[at + 1 :]
            case 5:
                text = text[: max(at, to)] if pick.random() < 0.3 else text.replace(" ", "")
    return text


def noise(pick: random.Random) -> str:
    """Return text of any characters and words."""
    kinds = [lambda: pick.choice(CHARACTERS), lambda: pick.choice(WORDS), lambda: chr(pick.randrange(0x20, 0x3000))]
    return "".join(pick.choice(kinds)() for _ in range(pick.randrange(40)))


def value_of(tape: Tape) -> Any:
    """Return the value of a tape at POINT, as a ball."""
    with flint.ctx.workprec(200):
        point = {name: flint.arb(flint.fmpq(v.numerator, v.denominator)) for name, v in POINT.items()}
        return walk(tape, Balls(), point)[0]


def wrong(text: str, made: Made | None, seen: Counter[str]) -> str | None:
    """Return what is wrong with how a formula is read; None if nothing is. `seen` counts what became of it."""
    try:
        tape = formula.parse(text, PARAMETERS)
    except FirsthitError as error:
        seen["refused"] += 1
        if len(str(error)) > 600:
            return f"a message of {len(str(error))} characters"
        known = made is not None and mpmath.isfinite(made.value)
        return f"was refused: {error}" if known and _unexpected(str(error)) else None
    seen["read"] += 1
    written = formula.canonical(tape)
    again = formula.parse(written)
    if again.ordered() != tape.ordered():
        return f"reads as another graph from {written}"
    if formula.canonical(again) != written:
        return f"is written in two ways: {written} and {formula.canonical(again)}"
    if made is None or not mpmath.isfinite(made.value) or abs(made.value) > 1e9:
        return None
    ball = value_of(tape)
    if not ball.rad() < 1e-20:
        return None
    seen["with the right value"] += 1
    found = mpmath.mpf(ball.mid().str(45, radius=False))
    if abs(found - made.value) > mpmath.mpf(10) ** -15 * (1 + abs(made.value)):
        return f"has the value {found} and not {made.value}"
    return None


def _unexpected(message: str) -> bool:
    """Return whether a well-formed formula was refused for another reason than its sizes or a constant's value."""
    return not any(word in message for word in ("bits", "degree", "division by zero", "root of", "above 0", "solid"))


def fuzz(count: int, seed: int, limit: float) -> tuple[Counter[str], list[str], float]:
    """Read `count` random formulas. Return what became of them, what was wrong, and the longest time of one.

    One that takes more than `limit` seconds of the processor is wrong.
    """
    pick, seen, problems, longest = random.Random(seed), Counter[str](), [], 0.0
    watching = [False]
    events: list[str] = []

    def watch(event: str, _arguments: Any) -> None:
        if watching[0] and event.startswith(FORBIDDEN):
            events.append(event)

    formula.parse("atan2(x, cosh(y)) + if(x < a, mod(x, 2), 0)", PARAMETERS)  # what is imported later is imported now
    value_of(formula.parse("x"))
    sys.addaudithook(watch)
    maker = Maker(pick)
    with mpmath.workdps(45):
        for i in range(count):
            made = maker.formula() if i % 3 < 2 else None
            text = noise(pick) if made is None else made.text if i % 3 == 0 else mutated(pick, made.text)
            start, watching[0] = time.process_time(), True
            try:
                problem = wrong(text, made if i % 3 == 0 else None, seen)
            except Exception as error:  # what the fuzz is for: anything but a FirsthitError
                problem = f"ended in {type(error).__name__}: {error}"
            watching[0] = False
            took = time.process_time() - start
            longest = max(longest, took)
            if took > limit:
                problem = f"took {took:.1f} s"
            if events:
                problem = f"ran code: {sorted(set(events))}"
                events.clear()
            if problem:
                problems.append(f"{text!r}: {problem}")
    return seen, problems, longest


def main() -> int:
    """Fuzz as the command line says. Returns 1 if anything was wrong."""
    parser = argparse.ArgumentParser(description="Read random formulas.")
    parser.add_argument("--count", type=int, default=100_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--limit", type=float, default=LIMIT, help="seconds of the processor for one formula")
    options = parser.parse_args()
    seen, problems, longest = fuzz(options.count, options.seed, options.limit)
    for problem in problems[:50]:
        print(problem)
    told = ", ".join(f"{count:,} {what}" for what, count in seen.items())
    print(f"{options.count:,} formulas, seed {options.seed}: {told}")
    print(f"the longest took {longest:.2f} s of the processor; {len(problems)} wrong")
    return int(bool(problems))


if __name__ == "__main__":
    sys.exit(main())
