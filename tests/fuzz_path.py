"""Take random formulas all the way: python -m tests.fuzz_path --count 10000 --seed 1.

Each is made or mutated by tests.fuzz_formulas, and becomes a surface in a random domain. Then come its canonical form,
its tapes, how it lies in its domain, the kernel text of all generated functions in both languages and precisions, and
certified hits of three rays; nothing is compiled. Nothing may end in anything but a FirsthitError, no step may take
longer than LIMIT, the canonical form must read as the same graph, and a certified hit must be where f is 0.
"""

from __future__ import annotations

import argparse
import itertools
import random
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterator
from typing import Any, get_args

import flint
import mpmath
import numpy as np

import surfaces
from harness.contract import Language, Precision, Surface, Truth, TruthStatus
from harness.kernels.functions import FUNCTIONS, surface_sections, too_long, unsupported
from harness.oracle import first_hits
from surfaces import formula
from surfaces.lowering import gradient, real_tape
from surfaces.model import FirsthitError, domain_text
from surfaces.numbers import Balls
from surfaces.proofs.extent import remark
from surfaces.tape import JUMPS, walk
from tests.fuzz_formulas import LIMIT, mutated
from tests.made_formulas import PARAMETERS, Maker

DOMAINS = (
    "sphere:1.5",
    "sphere:3,-2,1/2:1.5",
    "box:1,2,0.5",
    "box:-1,0,2:3,1,2.5",
    "sphere:1e-3",
    "sphere:200",
    "auto",
)
Step = tuple[str, Callable[[], Any]]


def rays_through(surface: Surface, pick: random.Random, count: int) -> Any:
    """Return rays float32[count, 6] towards places in the domain; the first is along an axis."""
    center, radius = np.array(surface.domain.center), surface.domain.radius
    rows = []
    for k in range(count):
        heading = np.array([pick.gauss(0, 1) for _ in range(3)])
        heading = np.eye(3)[pick.randrange(3)] if k == 0 else heading / np.linalg.norm(heading)
        place = center + 0.5 * radius * np.array([pick.uniform(-1, 1) for _ in range(3)])
        rows.append([*(place - 2.0 * radius * heading), *heading])
    return np.array(rows, np.float32)


def taken(text: str, domain: str, pick: random.Random) -> Iterator[Step]:
    """Give the steps of a formula's way, each as its name and what does it. Raises FirsthitError where one is refused.

    Raises AssertionError where the result of a step is wrong.
    """
    made: dict[str, Any] = {}

    def surface() -> None:
        used = formula.reading(text, PARAMETERS).used
        mine = {name: value for name, value in PARAMETERS.items() if name in used}
        made["surface"] = surfaces.from_formula(text, domain, parameters=mine)

    def canonical() -> None:
        surfaces.reading(made["surface"]).told()
        again = formula.parse(surfaces.canonical(made["surface"]))
        assert again.ordered() == surfaces.tape_of(made["surface"]).ordered(), "its canonical form is another graph"

    def tapes() -> None:
        real = real_tape(surfaces.tape_of(made["surface"]))
        assert len(gradient(real).outputs) == 3

    def extent() -> None:
        box = made["surface"].domain
        assert surfaces.from_formula("x", domain_text(box)).domain == box, f"{domain_text(box)} is not its domain"
        remark(made["surface"])

    def hits() -> None:
        rays = rays_through(made["surface"], pick, 3)
        truth = first_hits(made["surface"], rays)
        for k in np.flatnonzero(truth.status == TruthStatus.CROSSING):
            assert _holds_root(made["surface"], rays[k], truth, k), (
                f"no root of ray {rays[k].tolist()} where it is told"
            )

    yield "from_formula", surface
    yield "canonical", canonical
    yield "tapes", tapes
    yield "extent", extent
    for language, precision in itertools.product(get_args(Language), get_args(Precision)):
        yield f"{language} {precision}", lambda: unsupported(made["surface"], precision, language)  # noqa: B023
        for name in FUNCTIONS:
            yield f"{name} in {language} {precision}", lambda: _text(made["surface"], name, precision, language)  # noqa: B023
    yield "oracle", hits


def _text(surface: Surface, name: str, precision: Precision, language: Language) -> None:
    """Make the text of a generated function, which must not hold what is no number of the language."""
    reason = too_long(surface, (name,), precision, language)
    try:
        sections = surface_sections(surface, (name,), precision, language)
    except FirsthitError:
        return
    assert reason is None, f"it is told too long, but written: {reason}"
    words = {word for section in sections if section.origin.startswith("generated") for word in section.text.split()}
    assert not words & {"nan", "inf", "-inf", "None"}, "its text holds what is no number"


def _holds_root(surface: Surface, ray: Any, truth: Truth, k: int) -> bool:
    """Return whether f may be 0 in a certified interval, by balls; of what jumps this tells less, and so nothing."""
    tape = surfaces.tape_of(surface)
    if any(op.name in JUMPS for op in tape.ops):
        return True
    low, high = float(truth.lower[k]), float(truth.upper[k])
    with flint.ctx.workprec(200):
        t = flint.arb(low).union(flint.arb(high))
        point = {v: flint.arb(float(ray[i])) + t * flint.arb(float(ray[i + 3])) for i, v in enumerate("xyz")}
        value = walk(tape, Balls(), point)[0]
        return not value.is_finite() or bool(value.contains(0))


def wrong(text: str, domain: str, pick: random.Random, seen: Counter[str], slow: Counter[str]) -> str | None:
    """Return what is wrong on a formula's way; None if nothing is.

    `seen` counts how formulas end, `slow` holds the longest time of each step in milliseconds.
    """
    for name, do in taken(text, domain, pick):
        start = time.process_time()
        try:
            do()
        except FirsthitError as error:
            if name == "from_formula":
                seen["refused"] += 1
                return f"a message of {len(str(error))} characters" if len(str(error)) > 600 else None
            return f"{name} ended in {error}"
        except Exception as error:  # what the fuzz is for: anything but a FirsthitError
            return f"{name} ended in {type(error).__name__}: {error}"
        finally:
            took = time.process_time() - start
            kind = name.partition(" ")[0]
            slow[kind] = max(slow[kind], round(1000 * took))
            if took > LIMIT:
                seen["slow"] += 1
        if took > LIMIT:
            return f"{name} took {took:.1f} s"
    seen["taken all the way"] += 1
    return None


def fuzz(count: int, seed: int) -> tuple[Counter[str], list[str], Counter[str]]:
    """Take `count` random formulas all the way. Return how they ended, what was wrong, and each step's longest time."""
    pick, seen, slow = random.Random(seed), Counter[str](), Counter[str]()
    wrong("atan2(x, cosh(y)) + if(x < 0.5, mod(x, 2), 0) - 0.1", DOMAINS[0], pick, Counter(), Counter())  # imports
    maker, problems = Maker(pick), []
    for i in range(count):
        with mpmath.workdps(45):
            text = maker.formula().text
        text = mutated(pick, text) if i % 4 == 3 else text
        domain = pick.choice(DOMAINS)
        if problem := wrong(text, domain, pick, seen, slow):
            problems.append(f"{text!r} in {domain}: {problem}")
    return seen, problems, slow


def main() -> int:
    """Fuzz as the command line says. Returns 1 if anything was wrong."""
    parser = argparse.ArgumentParser(description="Take random formulas all the way.")
    parser.add_argument("--count", type=int, default=2_000)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    seen, problems, slow = fuzz(options.count, options.seed)
    for problem in problems[:50]:
        print(problem)
    print(f"{options.count:,} formulas, seed {options.seed}: {', '.join(f'{n:,} {what}' for what, n in seen.items())}")
    print(f"longest, in ms of the processor: {', '.join(f'{step} {ms}' for step, ms in slow.most_common(8))}")
    print(f"{len(problems)} wrong")
    return int(bool(problems))


if __name__ == "__main__":
    sys.exit(main())
