"""Order the terms of polynomials as POV-Ray does, and write sums of terms."""

from __future__ import annotations

from collections.abc import Iterable

from surfaces.files.expressions import Text, add, mul, negative, power, sub, word

Powers = tuple[int, int, int]


def order_of(degree: int) -> list[Powers]:
    """Return the powers of x, y, z of all terms up to a degree, in the order of POV-Ray's cubic, quartic and poly.

    It is that of the table in its manual, section "Poly, Cubic and Quartic": x^4, x^3*y, x^3*z, x^3, x^2*y^2, …, 1.
    There are (n + 1)(n + 2)(n + 3)/6 of them.
    """
    return [
        (i, j, k)
        for i in range(degree, -1, -1)
        for j in range(degree - i, -1, -1)
        for k in range(degree - i - j, -1, -1)
    ]


def polynomial(terms: Iterable[tuple[Text, Powers]]) -> Text | None:
    """Return a sum of terms, without those whose coefficient is 0; None where none is left."""
    total: Text | None = None
    for coefficient, powers in terms:
        if coefficient.value == 0:
            continue
        falls = coefficient.value is not None and coefficient.value < 0
        size = _without_sign(coefficient) if falls else coefficient
        axes = [(word(axis), n) for axis, n in zip("xyz", powers, strict=True) if n]
        factors = [power(axis, word(str(n))) if n > 1 else axis for axis, n in axes]
        term = None if size.value == 1 and factors else size
        for factor in factors:
            term = factor if term is None else mul(term, factor)
        assert term is not None
        total = (negative(term) if falls else term) if total is None else (sub if falls else add)(total, term)
    return total


def _without_sign(text: Text) -> Text:
    """Return the negative of a negative constant, as it was written where it is a sign and a number."""
    first, *rest = text.parts
    if first == "-" and len(rest) == 1 and isinstance(rest[0], Text):
        return rest[0]
    return negative(text)
