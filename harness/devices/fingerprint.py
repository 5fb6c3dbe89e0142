"""Tell devices' arithmetic apart: hash what fixed programs answer to fixed numbers, bit for bit.

Devices whose fingerprints agree are taken to compute the same, whatever their names, drivers and processors are;
"Decisions" in CONTRIBUTING.md says why. The programs are arithmetic, functions and working of harness/kernels/glsl/map:
single operations, the library's functions, and searches as methods make them. Every NaN counts as one, since no method
depends on its sign or payload.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from harness.contract import FirsthitError, Precision, digest
from harness.devices.bits import Array, any_numbers, even_numbers, hash_of, scaled_numbers, special_numbers
from harness.devices.host_arithmetic import host_arithmetic
from harness.devices.interface import BuildError, Device, Launch, same_values
from harness.devices.messages import need_steady
from harness.devices.raster import Rasteriser
from harness.devices.raster_arithmetic import raster_arithmetic
from harness.kernels.assemble import map_program
from harness.kernels.sections import files

# "float32", "float64" (where the device has it), "raster" (where it draws triangles) and "host" → part → hash of bits
Fingerprint = dict[str, dict[str, str]]

# Rows of a launch: no multiple of any vector's width, so that vectors' bodies and remainders occur. The size of work
# groups was never seen to change an answer.
ROWS = 4099


@dataclass(frozen=True)
class Text:
    """State one program: files of glsl/map, the libraries they call, and its rows by precision, [ROWS, INPUTS].

    parts: in the order of the last file's outputs, with the number of outputs of each
    """

    files: tuple[str, ...]
    libraries: tuple[str, ...]
    rows: Callable[[Precision], Array]
    parts: dict[str, int]


def _arithmetic_rows(precision: Precision) -> Array:
    """Return numbers of any kind, by four; then numbers whose sums and products cancel; then special ones."""
    third = ROWS // 3
    wide = [any_numbers(third, seed, precision) for seed in range(1, 5)]
    a = scaled_numbers(third, 11, precision, -12, 12)
    near = a * -(1 + even_numbers(third, 13, precision, 2.0**-12))
    b = np.where(np.arange(third) % 2, near, scaled_numbers(third, 14, precision, -12, 12)).astype(a.dtype)
    scaled = [a, b, -(a * b), scaled_numbers(third, 16, precision, -4, 4)]
    special = [special_numbers(ROWS - 2 * third, seed, precision) for seed in range(21, 25)]
    special[1][::3] = scaled_numbers(len(special[1][::3]), 26, precision, -2, 2)
    return np.concatenate([np.stack(columns, axis=1) for columns in (wide, scaled, special)])


def _function_rows(precision: Precision) -> Array:
    """Return angles of three magnitudes, exponents to beyond the range of exp, positive numbers, and others."""
    third = ROWS // 3
    reaches = ((third, 4.0), (third, 1024.0), (ROWS - 2 * third, 2.0**20))
    angles = np.concatenate([even_numbers(n, 31 + i, precision, reach) for i, (n, reach) in enumerate(reaches)])
    exponents = even_numbers(ROWS, 34, precision, 128.0 if precision == "float32" else 1024.0)
    positive = np.abs(scaled_numbers(ROWS, 35, precision, -60, 60))
    return np.stack([angles, exponents, positive, even_numbers(ROWS, 37, precision, 1.0), _any(precision)], axis=1)


def _any(precision: Precision) -> Array:
    """Return a column [ROWS] of numbers of any kind, special ones at its end."""
    return np.concatenate([any_numbers(ROWS - 256, 38, precision), special_numbers(256, 39, precision)])


def _working_rows(precision: Precision) -> Array:
    return np.stack([even_numbers(ROWS, 41 + k, precision, 1.0) for k in range(6)], axis=1)


ARITHMETIC = Text(
    ("arithmetic.glsl",),
    (),
    _arithmetic_rows,
    {
        **{"sums": 3, "products": 2, "quotients": 3, "roots": 3, "conversions": 4, "denormals": 5, "selection": 6},
        **{"fma": 1, "contraction": 3, "rearrangement": 3, "exact": 6, "vectors": 5},
    },
)
FUNCTIONS = Text(
    ("functions.glsl",),
    ("interval", "interval_exp_log", "dual"),
    _function_rows,
    {"exp": 3, "log": 3, "sin": 2, "cos": 2, "tan": 2, "angles": 3, "powers": 3, "waves": 6},
)
WORKING = Text(
    ("torus.glsl", "working.glsl"),
    ("interval", "dual", "fit", "polynomial", "double_word"),
    _working_rows,
    {"newton": 5, "march": 4, "normals": 3, "roots of polynomials": 5, "compensated": 5, "intervals": 3},
)


TEXTS = (ARITHMETIC, FUNCTIONS, WORKING)


def fingerprint(device: Device) -> Fingerprint:
    """Return the fingerprint of a device and of this host.

    Raises FirsthitError where a program cannot be built or run.
    """
    precisions: tuple[Precision, ...] = ("float32", "float64") if device.info.float64 else ("float32",)
    try:
        found: Fingerprint = {precision: parts(device, precision) for precision in precisions}
        if isinstance(device, Rasteriser):
            found["raster"] = raster_arithmetic(device)
    except BuildError as error:
        raise FirsthitError(f"a program of the fingerprint does not compile: {error}", exit_code=3) from None
    return found | {"host": host_arithmetic()}


def parts(device: Device, precision: Precision) -> dict[str, str]:
    """Return part → hash of all texts that a device has in a precision: GLSL lacks functions in float64."""
    no_functions = device.language == "glsl" and precision == "float64"
    texts = [text for text in TEXTS if not (no_functions and text is FUNCTIONS)]
    return {part: found for text in texts for part, found in answers(device, precision, text).items()}


def answers(device: Device, precision: Precision, text: Text) -> dict[str, str]:
    """Run a text over its rows, and return for each of its parts a hash of what it answers."""
    sections = files(*(f"map/{name}" for name in text.files))
    program = map_program(sections, precision, device.language, text.libraries)
    rows, outputs = text.rows(precision), sum(text.parts.values())
    launch = device.launch(device.build(program), [rows], [(ROWS * outputs, rows.dtype.type)], (ROWS, 1))
    first, second = (_read(launch).reshape(ROWS, outputs) for _ in range(2))
    launch.release()
    need_steady(np.logical_or.reduce(~same_values(first, second), axis=1), "rows")
    ends = np.cumsum(list(text.parts.values()))
    columns = np.split(first, ends[:-1], axis=1)
    return {part: hash_of(values) for part, values in zip(text.parts, columns, strict=True)}


def _read(launch: Launch) -> Array:
    """Run a launch and return its output, which the next run leaves as it is."""
    launch.run()
    return launch.read()[0].copy()


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
            either = dict.fromkeys((*first, *second))
            found += [f"{of} {part}" for part in either if first.get(part) != second.get(part)]
    return found


def digests(found: Fingerprint) -> dict[str, str]:
    """Return one short hash, six digits, for each precision and for whatever else a fingerprint is of."""
    return {of: digest(parts)[:6] for of, parts in found.items()}
