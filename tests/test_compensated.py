"""f in compensated arithmetic: its errors are those of twice the precision, also for rays from far away."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

import surfaces
from harness.conformance import dense
from harness.contract import UNIT_ROUNDOFF, FirsthitError, Section
from harness.devices.interface import map_rows
from harness.kernels.assemble import map_program
from harness.kernels.compensated import compensated_value
from harness.kernels.sections import files
from surfaces.lowering import real_tape

COUNT = 150
VALUE = Section(
    "tests: compensated_value over rows",
    """#define INPUTS 8
#define OUTPUTS 2
void map_item(IN real x[INPUTS], OUT real y[OUTPUTS]) {
    WideVec3 o;
    WideVec3 d;
    o.x = x[0]; o.y = x[1]; o.z = x[2];
    d.x = x[3]; d.y = x[4]; d.z = x[5];
    WidePair value = compensated_value(wide_far_point(o, x[6], d), x[7], d);
    y[0] = value.hi;
    y[1] = value.lo;
}
""",
)
ONES = {"add": lambda a, b: a + b, "sub": lambda a, b: a - b, "mul": lambda a, b: a * b, "neg": lambda a: -a}


def exact(tape, point):
    """f at a point of fractions, and the sum of the magnitudes of what it is made of."""
    values = []
    for op in tape.ops:
        if op.name == "var":
            values.append((point["xyz".index(op.args[0])], abs(point["xyz".index(op.args[0])])))
        elif op.name == "const":
            values.append((op.args[0], abs(op.args[0])))
        else:
            inputs = [values[i] for i in (op.inputs * 2 if op.name == "sqr" else op.inputs)]
            one = ONES["mul" if op.name == "sqr" else op.name]
            grown = ONES["mul" if op.name in ("sqr", "mul") else "add"]
            size = inputs[0][1] if op.name == "neg" else grown(inputs[0][1], inputs[1][1])
            values.append((one(*(value for value, _ in inputs)), size))
    return values[tape.outputs[0]]


def rays(surface, rng, far, kind):
    """Rows of origin, direction, the shift to the point nearest to the domain's centre, and t behind it."""
    center, radius = np.array(surface.domain.center), surface.domain.radius
    aside, d = rng.normal(size=(2, COUNT, 3))
    d /= np.linalg.norm(d, axis=1)[:, None]
    o = (center + 0.3 * radius * aside - far * radius * d).astype(kind)
    d = d.astype(kind)
    shift = np.sum((center - o) * d, axis=1).astype(kind)
    t = (radius * rng.uniform(-0.7, 0.7, COUNT)).astype(kind)
    return np.column_stack([o, d, shift, t])


CASES = ["torus", "endrass_octic", "heart", "sixteen_ball", "dense"]


@pytest.mark.parametrize("precision", ["float32", "float64"])
@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("far", [3.0, 1e5])
def test_errors_are_those_of_twice_the_precision(device, name, precision, far, rng):
    if precision == "float64" and not device.info.float64:
        pytest.skip("the device has no float64")
    surface = dense.surface_of(8, dense.seed_of(8)) if name == "dense" else surfaces.get(name)
    heads = files("tiles/lanes_one.glsl", "tiles/wide.glsl", "tiles/compensated.glsl")
    section = compensated_value(surface, precision, device.language)
    program = map_program([*heads, section, VALUE], precision, device.language)
    rows = rays(surface, rng, far, np.dtype(precision).type)
    found, tape, unit = (
        map_rows(device, program, rows, 2),
        real_tape(surfaces.tape_of(surface)),
        UNIT_ROUNDOFF[precision],
    )
    plain = 0
    for row, (high, low) in zip(rows.tolist(), found.tolist(), strict=True):
        o, d, (shift, t) = row[:3], row[3:6], row[6:]
        point = [Fraction(a) + (Fraction(shift) + Fraction(t)) * Fraction(b) for a, b in zip(o, d, strict=True)]
        value, size = exact(tape, point)
        # the errors of coordinates grow with how far away the rays begin
        allowed = 8 * unit * unit * (len(tape.ops) + Fraction(far) * (surface.degree or 1)) * size
        assert abs(Fraction(high) + Fraction(low) - value) <= allowed
        plain += abs(Fraction(high) - value) > 100 * allowed
    assert plain > COUNT / 10 or far > 10.0  # without the second number


def test_what_is_no_polynomial_is_refused():
    with pytest.raises(FirsthitError, match="f must be a polynomial"):
        compensated_value(surfaces.get("blinn_blob"), "float32", "cl")


def test_constants_have_the_digits_of_two_numbers():
    text = compensated_value(surfaces.from_formula("x^2 + y^2 + z^2 - 1/3", "sphere:1", "mine"), "float32", "cl").text
    assert "wide_pair(wide(0.33333334f), wide((-9.934108e-09f)))" in text
