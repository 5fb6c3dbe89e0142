"""Make numbers from fixed bits, without any function that may round differently elsewhere, and hash answers' bits."""

from __future__ import annotations

import hashlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness.contract import Precision

Array = NDArray[Any]
FIELDS: dict[Precision, tuple[type, type, int, int]] = {  # type, type of its bits, bits of its fraction, exponent of 1
    "float32": (np.float32, np.uint32, 23, 127),
    "float64": (np.float64, np.uint64, 52, 1023),
}


def hash_of(*arrays: Array) -> str:
    """Return a hash of arrays' bits, 16 digits. Every NaN counts as one; the machine's order of bytes does not."""
    found = hashlib.sha256()
    for values in arrays:
        if values.dtype.kind == "f":
            values = np.where(np.isnan(values), np.array(np.nan, values.dtype), values)
        found.update(values.astype(values.dtype.newbyteorder("<")).tobytes())
    return found.hexdigest()[:16]


def words(count: int, seed: int) -> NDArray[np.uint64]:
    """Return uint64[count], random bits that are the same with every version of numpy (splitmix64)."""
    x = (np.arange(1, count + 1, dtype=np.uint64) + np.uint64(seed << 32)) * np.uint64(0x9E3779B97F4A7C15)
    x = (x ^ (x >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    x = (x ^ (x >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return np.asarray(x ^ (x >> np.uint64(31)))


def any_numbers(count: int, seed: int, precision: Precision) -> Array:
    """Return numbers [count] whose bits are random: of every magnitude, denormals, infinities and NaN among them."""
    kind, bits, _, _ = FIELDS[precision]
    return (words(count, seed) >> np.uint64(64 - 8 * np.dtype(bits).itemsize)).astype(bits).view(kind)


def scaled_numbers(count: int, seed: int, precision: Precision, least: int, most: int) -> Array:
    """Return numbers [count] of both signs with random fractions, and exponents of 2 from `least` to `most`."""
    kind, bits, fraction, one = FIELDS[precision]
    kept = any_numbers(count, seed, precision).view(bits) & bits(~((2 * one + 1) << fraction) & np.iinfo(bits).max)
    exponents: Array = (one + least + words(count, seed + 1) % np.uint64(most - least + 1)).astype(bits)
    return np.asarray(kept | exponents << bits(fraction)).view(kind)


def even_numbers(count: int, seed: int, precision: Precision, limit: float) -> Array:
    """Return numbers [count] that are spread evenly from -limit to limit; `limit` is a power of 2."""
    kind, _, fraction, _ = FIELDS[precision]
    whole = (words(count, seed) >> np.uint64(63 - fraction)).astype(np.int64) - 2**fraction
    return np.asarray(whole.astype(np.float64) * (limit / 2**fraction), kind)


def special_numbers(count: int, seed: int, precision: Precision) -> Array:
    """Return numbers [count] out of few: zeros, infinities, NaN, denormals, the greatest, and neighbours of 1."""
    kind, bits, fraction, one = FIELDS[precision]
    finite = [1 << fraction, (1 << fraction) - 1, 1, ((2 * one + 1) << fraction) - 1, one << fraction]
    finite += [(one << fraction) + 1, (one << fraction) - 1, (one + fraction + 1) << fraction, (one - 1) << fraction]
    patterns = [0, (2 * one + 1) << fraction, ((4 * one + 3) << fraction) >> 1, *finite]
    values: Array = np.array(patterns, bits).view(kind)
    chosen = words(count, seed)
    signs = np.where(chosen >> np.uint64(63), kind(-1), kind(1))
    return np.asarray(values[(chosen % np.uint64(len(values))).astype(np.int64)] * signs)
