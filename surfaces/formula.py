"""Parse formulas into tapes, and derive what follows from a tape: its degree, its expression, its text.

The language is in `surfaces.language`; `grammar` and `prelude` there list what it has. Numbers are exact: 0.3 is 3/10.
Nothing is ever evaluated as Python, and every size is checked before anything of that size is built.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from functools import lru_cache
from typing import Any

from surfaces.language.canonical import canonical
from surfaces.language.grammar import MAX_DEPTH, MAX_LENGTH
from surfaces.language.reading import MAX_DEGREE, MAX_OPERATIONS, MAX_STEPS, Read, read
from surfaces.language.tokens import MAX_BITS
from surfaces.model import FirsthitError
from surfaces.numbers import BallPolynomials, Symbols
from surfaces.tape import Tape, walk
from surfaces.words import COORDINATES

__all__ = [
    "MAX_BITS",
    "MAX_DEGREE",
    "MAX_DEPTH",
    "MAX_LENGTH",
    "MAX_OPERATIONS",
    "MAX_STEPS",
    "canonical",
    "degree",
    "exact",
    "expression",
    "is_polynomial",
    "number",
    "parse",
    "reading",
]


def __getattr__(name: str) -> Any:
    """Return X, Y or Z, the symbols of `expression`; sympy is imported when one is first asked for.

    Raises FirsthitError without sympy, and AttributeError for any other name.
    """
    if name in ("X", "Y", "Z"):
        return _sympy().Symbol(name.lower(), real=True)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def exact(text: str) -> Fraction:
    """Return a rational constant exactly: a decimal, or a formula as 1/3. Raises FirsthitError for other text."""
    from surfaces.language import tokens

    try:
        return tokens.exact(text)
    except FirsthitError as error:
        reason = str(error)
    try:
        tape = parse(text)
    except FirsthitError:
        raise FirsthitError(reason) from None
    op = tape.ops[tape.outputs[0]]
    if op.name != "const":
        raise FirsthitError(f"{text[:40]!r} is no rational number")
    return Fraction(op.args[0])


def number(text: str) -> float:
    """Return the float64 nearest to a constant formula, as sqrt(2). Raises FirsthitError for other text."""
    from surfaces.language import tokens
    from surfaces.lowering import enclosures

    try:
        return float(tokens.exact(text))
    except FirsthitError:
        tape = parse(text)
    try:
        known = enclosures(tape)
    except ZeroDivisionError as error:
        raise FirsthitError(f"{text[:40]!r}: {error}") from None
    if tape.outputs[0] not in known:
        raise FirsthitError(f"{text[:40]!r} is no constant")
    return float(sum(known[tape.outputs[0]]) / 2)


@lru_cache(maxsize=1024)
def _read(text: str, parameters: tuple[tuple[str, str], ...], free: bool) -> Read:
    """Read a formula; parameters are sorted pairs, so that they can be a key."""
    return read(text, dict(parameters), free)


def reading(text: str, parameters: Mapping[str, str] | None = None, free: bool = False) -> Read:
    """Return what a formula was read as: its tape, the parameters that occur in it, and notes for the user.

    `parameters` are formulas of constants by name. If `free`, they become variables, as the coordinates are. Raises
    FirsthitError, which names the column and shows it with a caret, if the text is no formula.
    """
    return _read(text, tuple(sorted((parameters or {}).items())), free)


def parse(text: str, parameters: Mapping[str, str] | None = None, free: bool = False) -> Tape:
    """Return the tape of a formula, with its operations in the order written. Arguments and errors are `reading`'s."""
    return reading(text, parameters, free).tape


def expression(tape: Tape) -> Any:
    """Return the exact sympy expression of a tape's first output, in the symbols X, Y, Z of this module.

    Raises FirsthitError without sympy, which nothing else needs.
    """
    symbols = {name: _sympy().Symbol(name, real=True) for name in COORDINATES}
    return walk(tape, Symbols(), symbols)[0]


def _sympy() -> Any:
    """Return the package sympy. Raises FirsthitError where it is not installed."""
    try:
        import sympy
    except ImportError:
        raise FirsthitError("an expression needs the package sympy: pip install 'firsthit[sympy]'") from None
    return sympy


def is_polynomial(tape: Tape) -> bool:
    """Return whether a tape is built as a polynomial: it divides by, and calls functions of, constants only."""
    constant = tape.constants()
    ring = {"add", "sub", "mul", "neg", "sqr", "powi", "var"}
    return all(
        constant[i] or op.name in ring or (op.name == "div" and constant[op.args[1]]) for i, op in enumerate(tape.ops)
    )


def degree(tape: Tape) -> int | None:
    """Return the total degree in x, y, z, -1 for zero; None if the formula is not built as a polynomial.

    It is computed along one fixed generic line in 2000-bit balls, so that terms that cancel do not count. Only a
    leading form that vanishes in the line's direction, three ratios of large primes, would be missed.
    """
    if not is_polynomial(tape):
        return None
    import flint

    line = {"x": (7919, 104729, 1299709), "y": (6997, 100003, 1299721), "z": (5003, 99991, 1299743)}
    with flint.ctx.workprec(2000):
        coordinates = {name: flint.arb_poly([flint.arb(a) / c, flint.arb(b) / c]) for name, (a, b, c) in line.items()}
        along = walk(tape, BallPolynomials(), coordinates)[0]
        if isinstance(along, flint.arb):
            return -1 if along.contains(0) else 0
        return max((k for k in range(len(along)) if not along[k].contains(0)), default=-1)
