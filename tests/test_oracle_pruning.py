"""Programs that are shortened for a piece of a ray: the same values there, from fewer operations."""

from __future__ import annotations

import random

import pytest
from flint import arb, fmpq

from harness.oracle import reals
from harness.oracle.program import Program, program_of
from harness.oracle.pruning import pruned
from harness.oracle.reading import graph_of
from surfaces import formula

MANY = 200


def program(text: str) -> Program:
    return program_of(graph_of(formula.parse(text)), lengths=True)


def shortened(f: Program, point: list[arb]) -> Program:
    constants = f.constants.converted(reals.leaf, reals.FUNCTIONS)
    return pruned(f, f.results(point, constants, reals.FUNCTIONS))


@pytest.mark.parametrize("name", ["min", "max"])
def test_of_many_arguments_few_are_left_on_a_short_piece(name: str) -> None:
    arguments = [f"(x - {k}/{MANY})^2 + y^2 + z^2 - {k}/7" for k in range(MANY)]
    random.Random(1).shuffle(arguments)
    f = program(f"{name}({', '.join(arguments)})")
    short = shortened(f, [arb(fmpq(1, 2), fmpq(1, 1000)), arb(0), arb(0)])
    assert len(short.instructions) * 10 < len(f.instructions)


def test_of_a_chain_of_choices_one_is_left() -> None:
    text = "y"
    for k in range(40):
        text = f"if(x < {k}/40, y^2*{k + 1} - 1/2, {text})"
    f = program(text)
    short = shortened(f, [arb(fmpq(31, 80), fmpq(1, 1000)), arb(0.25), arb(0)])
    assert len(short.instructions) < 10


def random_text(pick: random.Random, depth: int) -> str:
    if not depth:
        return pick.choice(["x", "y", "z", f"({pick.randint(-9, 9)}/8)"])
    a, b, c, d = (random_text(pick, depth - 1) for _ in range(4))
    kinds = ["min({}, {}, {})", "max({}, {}, {})", "({} + {} - {})", "({}*{} + {})", "if({} < {}, {}, {})"]
    return pick.choice(kinds).format(a, b, c, d)


@pytest.mark.parametrize("seed", range(40))
def test_values_stay_the_same(seed: int) -> None:
    pick = random.Random(seed)
    f = program(f"{random_text(pick, pick.choice([2, 3, 4]))} + 3*x")
    constants = f.constants.converted(reals.leaf, reals.FUNCTIONS)
    middle = [fmpq(pick.randint(-64, 64), 64) for _ in range(3)]
    half = fmpq(1, 2 ** pick.randint(1, 8))
    short = shortened(f, [arb(m, half) for m in middle])
    assert len(short.instructions) <= len(f.instructions)
    for _ in range(20):
        point = [arb(m + half * fmpq(pick.randint(-99, 99), 100)) for m in middle]
        values = [p.run(point, constants, reals.FUNCTIONS) for p in (f, short)]
        assert values[0].overlaps(values[1]), f"{values} at {point}"
        assert values[1].rad() <= values[0].rad() + 1e-9
