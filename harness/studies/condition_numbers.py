"""Compute L² condition numbers of the fitting matrices H (szente, Table 1).

The nodes are cos(iπ/n), i = 0 … n, on [-1, 1] for the monomial basis and mapped to [0, 1] for the Bernstein basis. With
this reading every digit that the paper prints comes out. The monomial basis on [0, 1], which the paper says is worse,
is computed too.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

TITLE = "Condition numbers of fitting matrices"
DEGREES = (3, 5, 10)


def compute() -> list[dict[str, str | int | float]]:
    """Return a row for each basis and degree: basis, degree, condition."""
    rows: list[dict[str, str | int | float]] = []
    for basis in ("monomial", "Bernstein", "monomial on [0, 1]"):
        for n in DEGREES:
            x = np.cos(np.arange(n + 1) * math.pi / n)
            y = x if basis == "monomial" else (1.0 + x) / 2.0
            matrix = _bernstein(y, n) if basis == "Bernstein" else np.vander(y, increasing=True)
            rows.append({"basis": basis, "degree": n, "condition": float(np.linalg.cond(matrix, 2))})
    return rows


def _bernstein(y: NDArray[np.float64], n: int) -> NDArray[np.float64]:
    """Return the Bernstein basis of degree n at y[m]: float64[m, n + 1]."""
    return np.stack([math.comb(n, j) * y**j * (1.0 - y) ** (n - j) for j in range(n + 1)], axis=1)
