"""Computes a surface's tape, its exact expression, and its values at numpy points."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

import numpy as np

from surfaces import formula, lowering
from surfaces.model import Surface
from surfaces.numbers import Floats, Floats64
from surfaces.tape import Tape, walk

if TYPE_CHECKING:
    import sympy


@cache
def tape_of(surface: Surface) -> Tape:
    """Return the parsed formula: constants are exact, powers whole, operations in the order written."""
    return formula.parse(surface.formula, dict(surface.parameters))


@cache
def expression(surface: Surface) -> sympy.Expr:
    """Return f as an exact sympy expression in the symbols X, Y, Z of surfaces.formula."""
    value: sympy.Expr = formula.expression(tape_of(surface))
    return value


def operations(surface: Surface) -> dict[str, int]:
    """Count the operations of one evaluation of f in a kernel, by name."""
    return lowering.counts(lowering.real_tape(tape_of(surface)))


def evaluate_tape(tape: Tape, points: Floats64) -> Floats64:
    """Evaluate a real tape at points float64[n, 3]: float64[n, outputs]."""
    points = np.asarray(points, np.float64).reshape(-1, 3)
    with np.errstate(all="ignore"):
        columns = walk(tape, Floats(), dict(zip("xyz", points.T, strict=True)))
    return np.stack([np.broadcast_to(column, len(points)) for column in columns], axis=1)


def evaluate(surface: Surface, points: Floats64) -> Floats64:
    """Evaluate f at points float64[n, 3]: float64[n]."""
    return evaluate_tape(lowering.real_tape(tape_of(surface)), points)[:, 0]


def gradient(surface: Surface, points: Floats64) -> Floats64:
    """Evaluate the gradient of f at points float64[n, 3]: float64[n, 3]."""
    return evaluate_tape(_gradient_tape(surface), points)


@cache
def _gradient_tape(surface: Surface) -> Tape:
    return lowering.gradient(lowering.real_tape(tape_of(surface)))
