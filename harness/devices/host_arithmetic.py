"""Hash what this host computes with the functions that camera rays, errors and scenes go through.

Numpy chooses its loops, and its library of matrices, by the processor; the C library gives `math` its functions.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from harness.devices.bits import even_numbers, hash_of

Floats = NDArray[np.float64]
COUNT = 1023  # of numbers for each function: no multiple of any vector's width


def _each(function: Callable[[float], float], values: Floats) -> Floats:
    return np.array([function(float(value)) for value in values])


def host_arithmetic() -> dict[str, str]:
    """Return part → hash: a camera's angles and rays, a surface's functions, and the sums and products of vectors."""

    def numbers(seed: int, limit: float) -> Floats:
        return even_numbers(COUNT, 100 + seed, "float64", limit)

    angles, wide, positive = numbers(1, 4.0), numbers(2, 1024.0), np.abs(numbers(3, 128.0)) + 2.0**-20
    a, b = (np.stack([numbers(seed + k, 8.0) for k in range(3)], axis=1) for seed in (10, 20))
    turned = np.stack([a, b, a - b], axis=1)
    parts = {
        "camera": [_each(function, angles) for function in (math.sin, math.cos, math.tan)],
        "sqrt": [np.sqrt(positive)],
        "exp": [np.exp(8.0 * angles), np.exp2(wide)],
        "log": [np.log(positive), np.log2(positive)],
        "sin": [np.sin(angles), np.sin(wide)],
        "cos": [np.cos(angles), np.cos(wide)],
        "tan": [np.tan(angles), np.tan(wide)],
        "arctan2": [np.degrees(np.arctan2(angles, wide))],
        "lengths": [np.linalg.norm(a, axis=1), np.hypot(angles, wide), a / np.linalg.norm(a, axis=1, keepdims=True)],
        "products": [np.einsum("ij,ij->i", a, b), np.einsum("nij,nj->ni", turned, a), np.cross(a, b)],
        "matmul": [a @ b[:7].T, turned @ turned[0], (turned[0] @ turned[1])],
    }
    return {part: hash_of(*values) for part, values in parts.items()}
