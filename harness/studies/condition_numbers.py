"""L² condition numbers of the fitting matrices H (szente, Table 1).

The nodes are cos(iπ/n), i = 0 … n: on [-1, 1] for the monomial basis, mapped to [0, 1] for the Bernstein basis. That is
the reading that gives every digit the paper prints. The monomial basis on [0, 1], which the paper says is worse, is
computed beside them.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

TITLE = "Condition numbers of fitting matrices"
DEGREES = (3, 5, 10)


def compute() -> list[dict[str, Any]]:
    """One row for each basis and degree: basis, degree, condition."""
    rows = []
    for basis in ("monomial", "Bernstein", "monomial on [0, 1]"):
        for n in DEGREES:
            x = np.cos(np.arange(n + 1) * math.pi / n)
            y = x if basis == "monomial" else (1.0 + x) / 2.0
            matrix = _bernstein(y, n) if basis == "Bernstein" else np.vander(y, increasing=True)
            rows.append({"basis": basis, "degree": n, "condition": float(np.linalg.cond(matrix, 2))})
    return rows


def _bernstein(y: Any, n: int) -> Any:
    return np.stack([math.comb(n, j) * y**j * (1.0 - y) ** (n - j) for j in range(n + 1)], axis=1)
