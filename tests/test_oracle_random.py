"""Random formulas of every operation against an evaluator of this test's own: mpmath in 50 digits.

f is sampled along each ray before the certified first hit, and all along a certified miss. Where two neighbouring
samples have different signs, halving the gap between them tells a jump, which is no root, from a root, which refutes
the oracle. The evaluator works on the trees that the formulas' texts are written from, and shares nothing with parser,
tape or oracle. FIRSTHIT_FORMULAS asks for more formulas.
"""

from __future__ import annotations

import os
import random
from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np
import pytest

import surfaces
from harness.contract import FirsthitError, Surface, TruthStatus
from harness.oracle import first_hits
from tests.distance_functions import clip

FORMULAS = int(os.environ.get("FIRSTHIT_FORMULAS", "32"))
RAYS, SAMPLES, HALVINGS = 10, 60, 100
SMALL = mpmath.mpf(10) ** -25
mpf = mpmath.mpf
Tree = tuple[Any, ...]


def angle(y: Any, x: Any) -> Any:
    return mpf(0) if x == 0 and y == 0 else mpmath.pi if y == 0 and x < 0 else mpmath.atan2(y, x)


def modulo(a: Any, b: Any) -> Any:
    return a - b * mpmath.floor(a / b)


# a text with places for the operands, and what it means; a part of "if" that is not taken is never computed
OPERATIONS: dict[str, tuple[str, int, Callable[..., Any]]] = {
    "add": ("({} + {})", 2, lambda a, b: a + b),
    "sub": ("({} - {})", 2, lambda a, b: a - b),
    "mul": ("({} * {})", 2, lambda a, b: a * b),
    "square": ("({})^2", 1, lambda a: a * a),
    "cube": ("({})^3", 1, lambda a: a**3),
    "div": ("({})/(1/2 + ({})^2)", 2, lambda a, b: a / (mpf(1) / 2 + b * b)),
    "abs": ("abs({})", 1, abs),
    "min": ("min({}, {})", 2, min),
    "max": ("max({}, {})", 2, max),
    "length": ("sqrt(({})^2 + ({})^2)", 2, lambda a, b: mpmath.sqrt(a * a + b * b)),
    "exp": ("exp(sin({}))", 1, lambda a: mpmath.exp(mpmath.sin(a))),
    "sin": ("sin(3*{})", 1, lambda a: mpmath.sin(3 * a)),
    "cos": ("cos(2*{})", 1, lambda a: mpmath.cos(2 * a)),
    "tan": ("tan(sin({}))", 1, lambda a: mpmath.tan(mpmath.sin(a))),
    "log": ("log(1/4 + ({})^2)", 1, lambda a: mpmath.log(mpf(1) / 4 + a * a)),
    "third": ("abs({})^(1/3)", 1, lambda a: mpmath.cbrt(abs(a))),
    "seven": ("abs({})^(7/3)", 1, lambda a: abs(a) ** 2 * mpmath.cbrt(abs(a))),
    "floor": ("floor(2*{})", 1, lambda a: mpmath.floor(2 * a)),
    "mod": ("mod({}, 3/4)", 1, lambda a: modulo(a, mpf(3) / 4)),
    "atan2": ("atan2({}, {})", 2, angle),
    "sign": ("sign({})", 1, mpmath.sign),
}
SMOOTH = ("add", "sub", "mul", "square", "cube", "div", "exp", "sin", "cos", "tan", "log")
COMPARED = {"<": lambda a, b: a < b, ">=": lambda a, b: a >= b, "<=": lambda a, b: a <= b, ">": lambda a, b: a > b}


def tree(pick: random.Random, depth: int) -> Tree:
    """Return a random tree: ("x",), ("number", n), ("if", relation, a, b, p, q), or an operation and its operands."""
    if not depth or pick.random() < 0.1:
        return (pick.choice("xxyyz"),) if pick.random() < 0.8 else ("number", pick.randint(-6, 6))
    kind = pick.random()
    if kind < 0.12:
        return ("if", pick.choice(list(COMPARED)), *(tree(pick, depth - 1) for _ in range(4)))
    name = pick.choice(SMOOTH) if kind < 0.5 else pick.choice(list(OPERATIONS))
    return (name, *(tree(pick, depth - 1) for _ in range(OPERATIONS[name][1])))


def text(node: Tree) -> str:
    if node[0] == "number":
        return f"({node[1]}/4)"
    if node[0] == "if":
        a, b, p, q = map(text, node[2:])
        return f"if({a} {node[1]} {b}, {p}, {q})"
    return OPERATIONS[node[0]][0].format(*map(text, node[1:])) if len(node) > 1 else node[0]


def value(node: Tree, point: dict[str, Any]) -> Any:
    if node[0] == "number":
        return mpf(node[1]) / 4
    if node[0] == "if":
        holds = COMPARED[node[1]](value(node[2], point), value(node[3], point))
        return value(node[4 if holds else 5], point)
    return OPERATIONS[node[0]][2](*(value(n, point) for n in node[1:])) if len(node) > 1 else point[node[0]]


def drawn(pick: random.Random) -> tuple[Tree, Surface]:
    while True:
        node = ("add", tree(pick, pick.choice([2, 3, 3, 4])), ("number", pick.randint(-3, 3)))
        try:
            return node, surfaces.from_formula(text(node), "box:1.5,1.25,1")
        except FirsthitError:
            continue


def is_root_between(f: Callable[[Any], Any], low: Any, high: Any) -> bool:
    """Whether f goes through 0 where it changes its sign between two numbers; where it jumps, it does not."""
    at_low, at_high = f(low), f(high)
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        at_middle = f(middle)
        if at_middle == 0:
            return True
        if (at_middle > 0) == (at_low > 0):
            low, at_low = middle, at_middle
        else:
            high, at_high = middle, at_middle
    return bool(max(abs(at_low), abs(at_high)) < mpf(10) ** -7)


def rays_for(rng: np.random.Generator) -> np.ndarray:
    """Half of the rays along coarse directions from a grid, so that they meet kinks and jumps exactly."""
    directions = rng.normal(size=(RAYS, 3))
    origins = rng.uniform(-0.8, 0.8, (RAYS, 3))
    half = RAYS // 2
    directions[:half] = rng.choice([0.0, 0.0, 1.0, -1.0, 0.5], (half, 3))
    directions[:half][~directions[:half].any(axis=1), 0] = 1.0
    origins[:half] = rng.choice([0.0, 0.5, -0.5, 0.25], (half, 3))
    return np.hstack([origins - rng.choice([0.0, 3.0], (RAYS, 1)) * directions, directions]).astype(np.float32)


@pytest.mark.parametrize("block", range(4))
def test_no_answer_is_refuted(block: int) -> None:
    seen = np.zeros(4, int)
    for seed in range(block, FORMULAS, 4):
        pick, rng = random.Random(seed), np.random.default_rng(seed)
        node, surface = drawn(pick)
        rays = rays_for(rng)
        truth = first_hits(surface, rays)
        seen += np.bincount(truth.status, minlength=4)
        enter, leave = clip(surface.domain, rays)
        with mpmath.workdps(50):
            for k in np.flatnonzero((enter < leave - 1e-6) & (truth.status != TruthStatus.UNDECIDED)):
                ray = [mpf(float(v)) for v in rays[k]]

                def f(t: Any, node: Tree = node, ray: list[Any] = ray) -> Any:
                    return value(node, {axis: ray[i] + t * ray[3 + i] for i, axis in enumerate("xyz")})

                where = f"{surface.formula} along {rays[k].tolist()}"
                hit = truth.status[k] != TruthStatus.MISS
                last = mpf(float(truth.lower[k] if hit else leave[k])) - mpf(10) ** -9
                start = mpf(float(enter[k])) + mpf(10) ** -9
                if start < last:
                    places = [start + (last - start) * s / SAMPLES for s in range(SAMPLES + 1)]
                    values = [f(t) for t in places]
                    assert all(v != 0 for v in values), where
                    for (a, at_a), (b, at_b) in zip(
                        zip(places, values, strict=True), list(zip(places, values, strict=True))[1:], strict=False
                    ):
                        assert at_a * at_b > 0 or not is_root_between(f, a, b), where
                if hit and enter[k] + 1e-6 < truth.lower[k] and truth.upper[k] < leave[k] - 1e-6:
                    check_hit(f, truth.status[k], float(truth.lower[k]), float(truth.upper[k]), where)
    assert seen[TruthStatus.UNDECIDED] * 15 <= seen.sum()
    assert (seen[:2] > 0).all()


def check_hit(f: Callable[[Any], Any], status: int, lower: float, upper: float, where: str) -> None:
    """f comes near 0 in the certified interval, unless it may jump there, and changes its sign about a crossing."""
    low, high = mpf(lower) - mpf(10) ** -11, mpf(upper) + mpf(10) ** -11
    signs = mpmath.sign(f(low)), mpmath.sign(f(high))
    if status == TruthStatus.CROSSING:
        assert signs[0] * signs[1] < 0, where
        near = min(abs(f(low + (high - low) * s / 8)) for s in range(9))
        assert near < mpf(10) ** -3 or any(word in where for word in ("sign", "if", "floor", "mod")), where
