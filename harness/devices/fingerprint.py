"""Tell devices' arithmetic apart: hash what fixed programs answer to fixed numbers, bit for bit.

Two devices whose fingerprints agree compute the same, whatever their names, drivers and processors are. Every NaN
counts as one, since no method depends on its sign or payload.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from harness.contract import FirsthitError, Precision, digest
from harness.devices.bits import hash_of, words
from harness.devices.host_arithmetic import host_arithmetic
from harness.devices.interface import Array, BuildError, Device, map_rows
from harness.kernels.assemble import KERNELS, file_section, map_program

# "float32", "float64" (where the device has it), "raster" (where it draws triangles) and "host" → part → hash of bits
Fingerprint = dict[str, dict[str, str]]

SEED = 1
ROWS = 4099  # no multiple of any vector's width, so that vectors' bodies and remainders occur
ARITHMETIC = {
    **{"sums": 3, "products": 2, "quotients": 3, "roots": 3, "conversions": 4, "denormals": 5, "selection": 6},
    **{"fma": 1, "contraction": 3, "rearrangement": 3, "exact": 6, "vectors": 5},
}  # parts of arithmetic.glsl, in the order of its outputs, and how many of these each has


def fingerprint(device: Device) -> Fingerprint:
    """Return the fingerprint of a device and of this host.

    Raises FirsthitError where a program cannot be built or run.
    """
    precisions: tuple[Precision, ...] = ("float32", "float64") if device.info.float64 else ("float32",)
    found: Fingerprint = {precision: _parts(device, precision) for precision in precisions}
    return found | {"host": host_arithmetic()}


def unlike(a: Fingerprint, b: Fingerprint, precision: Precision, raster: bool) -> list[str]:
    """Return the parts in which two fingerprints differ for a row of that precision; [] where the arithmetic is equal.

    A part is named with what it is of: "float32 sin", "host tan". For a row of stage raster the parts of "raster" count
    too. What either fingerprint lacks counts as different.
    """
    found = []
    for of in (precision, "host", *(("raster",) if raster else ())):
        first, second = a.get(of, {}), b.get(of, {})
        if not first or not second:
            found.append(f"{of} (not known)")
        else:
            parts = dict.fromkeys((*first, *second))
            found += [f"{of} {part}" for part in parts if first.get(part) != second.get(part)]
    return found


def digests(found: Fingerprint) -> dict[str, str]:
    """Return one short hash, six digits, for each precision and for whatever else a fingerprint is of."""
    return {of: digest(parts)[:6] for of, parts in found.items()}


def _parts(device: Device, precision: Precision) -> dict[str, str]:
    rows = words(ROWS * 4, SEED).reshape(ROWS, 4).view(np.int64) * 2.0**-60
    return _answers(device, precision, "arithmetic", ARITHMETIC, rows)


def _answers(device: Device, precision: Precision, name: str, parts: Mapping[str, int], rows: Array) -> dict[str, str]:
    """Run one program over rows [n, INPUTS], and return a hash of the outputs of each of its parts."""
    program = map_program(file_section(KERNELS / f"map/{name}.glsl"), precision, device.language)
    try:
        answers = map_rows(device, program, rows, sum(parts.values()))
    except BuildError as error:
        raise FirsthitError(f"the fingerprint's program {name} does not compile: {error}", exit_code=3) from None
    found, first = {}, 0
    for part, count in parts.items():
        found[part] = hash_of(np.ascontiguousarray(answers[:, first : first + count]))
        first += count
    return found
