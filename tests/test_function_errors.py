"""How far off each device's functions are, against what the oracle charges for them: numpy's long double decides."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from harness.contract import PRECISIONS, Section
from harness.devices.interface import map_rows
from harness.kernels.assemble import map_program
from harness.kernels.printing import FUNCTIONS, RealPrinter
from harness.oracle.noise import RunningErrors
from surfaces.tape import Op

UNITS = {"float32": 2.0**-24, "float64": 2.0**-53}
COUNT = 20_000
EXPONENTS = (Fraction(1, 3), Fraction(3, 10), Fraction(7, 3), Fraction(38, 5), Fraction(101, 5))


def arguments(name, rng):
    """Two columns of arguments, float64[3 COUNT, 2]: many sizes, and those at which functions are known to be hard."""
    size = (COUNT, 2)
    if name in ("log", "sqrt", "powr"):
        wide = 10.0 ** rng.uniform(-1.2, 1.2, size)
        return np.concatenate((wide, *(1.0 + rng.uniform(-near, near, size) for near in (1e-2, 1e-5))))
    if name == "atan2":
        signs = rng.choice([-1.0, 1.0], (3 * COUNT, 2))
        return signs * 10.0 ** np.concatenate([rng.uniform(-part, 1.0, size) for part in (1.0, 2.0, 4.0)])
    return np.concatenate([rng.uniform(-far, far, size) for far in (0.1, 4.0, 30.0)])


def cases():
    """Each function as an operation on its arguments 0 and 1; general powers with several exponents."""
    functions = [Op(name, (0, 1) if name == "atan2" else (0,)) for name in sorted(FUNCTIONS - {"powr"})]
    return functions + [Op("powr", (0, exponent)) for exponent in EXPONENTS]


def found_by(device, precision, ops, arguments):
    """What a device computes, longdouble[ops, n], for arguments [ops, n, 2]; the text is that which kernels have."""
    printer, lines = RealPrinter({}, precision, device.language), []
    for k, op in enumerate(ops):
        names = [f"x[{2 * k + i}]" for i in op.inputs] + [printer.literal(q) for q in op.args[len(op.inputs) :]]
        lines.append(f"    y[{k}] = {printer.operation(op, names)};\n")
    head = f"#define INPUTS {2 * len(ops)}\n#define OUTPUTS {len(ops)}\n"
    text = f"{head}void map_item(IN real x[INPUTS], OUT real y[OUTPUTS]) {{\n{''.join(lines)}}}"
    program = map_program(Section("functions", text), precision, device.language, ())
    rows = np.concatenate(arguments, axis=1)
    return np.asarray(map_rows(device, program, rows, len(ops))).astype(np.longdouble).T


def exact_value(op, columns):
    if op.name == "powr":
        return np.power(columns[0], np.longdouble(op.args[1].numerator) / op.args[1].denominator)
    return {"atan2": np.arctan2}.get(op.name, getattr(np, op.name, None))(*columns)


@pytest.mark.parametrize("precision", PRECISIONS)
def test_no_function_is_off_by_more_than_it_is_charged_for(device, precision, rng):
    if precision == "float64" and not device.info.float64:
        pytest.skip("the device has no float64")
    narrow = precision == "float64" and device.language == "glsl"  # GLSL has the others in float32 alone
    ops = [op for op in cases() if op.name == "sqrt" or not narrow]
    values = [arguments(op.name, rng).astype(precision) for op in ops]
    off = found_by(device, precision, ops, values)
    for op, value, found in zip(ops, values, off, strict=True):
        columns = value.astype(np.longdouble).T[: len(op.inputs)]
        inputs = [(column.astype(np.float64), np.zeros(len(column))) for column in columns]
        with np.errstate(all="ignore"):
            charged = getattr(RunningErrors(), op.name)(*inputs, *op.args[len(op.inputs) :])[1]
            error = np.abs(found - exact_value(op, columns)) / UNITS[precision]
        k = int(np.argmax(error / charged))
        place = f"{op.name} at {value[k].tolist()} is off by {error[k]:.4g} u"
        assert (error <= charged).all(), f"{place}, and charged for {charged[k]:.4g}"
