"""Derivatives over boxes hold f's change between any two points of the box, and none are known where f may jump.

python -m tests.benchmarks.gradient_boxes does the same by the million, on all surfaces and on random formulas.
"""

from __future__ import annotations

import os

import numpy as np
import pytest

import surfaces
from harness.contract import Section
from harness.kernels.functions import surface_sections, unsupported
from harness.kernels.sections import KERNELS
from tests.conftest import opened, usable_devices
from tests.secants import NEED, hold

BOXES = int(os.environ.get("FIRSTHIT_BOXES", "1500"))
FORMULAS = {
    "waves": "sin(3*x)*cos(5*y) + sin(20*z + cos(x)) + tan(0.3*z)",
    "quotients": "0.3*z/(2 + x) - y^5/7 + log(3 + x*y) - exp(z)*z",
    "kinks": "min(sqrt(x^2 + y^2 + (z - 0.5)^2) - 0.6, max(abs(x) - 0.3, y)) + pi*sin(2*x)*cos(2*x)",
    "jumps": "floor(3*x)*y + mod(z, 0.5) + if(x < y, x^2, y) + sign(z)*y + atan2(y, x)",
    "powers": "abs(x)^0.34 - abs(z)^1.1 + (y^2 + 1)^2.3 + sqrt(2 + x) + sqrt(abs(y)) - 0.1*y^7",
    "box": "sqrt(max(abs(x) - 0.5, 0)^2 + max(abs(y) - 0.4, 0)^2) + min(max(abs(x) - 0.5, abs(y) - 0.4), 0)",
}
SURFACES = [surfaces.from_formula(text, "sphere:1.5", name) for name, text in FORMULAS.items()]
SURFACES += [surfaces.get("blinn_blob"), surfaces.get("barth_sextic")]


def device_for(k, language=None):
    """One of the machine's devices, by turns; of a language, if one is given."""
    found = [opened(info.name) for info in usable_devices()]
    found = [device for device in found if language in (None, device.language)]
    return found[k % len(found)] if found else pytest.skip("no device")


@pytest.mark.parametrize("k", range(len(SURFACES)), ids=[s.name for s in SURFACES])
def test_derivatives_of_a_box_hold_all_secants_in_it(k):
    device, surface = device_for(k), SURFACES[k]
    found = hold(surface, device, "float32", BOXES, np.random.default_rng(k))
    assert not found.wrong
    assert found.known > 0.8 * BOXES and found.narrow < 1e-3


def test_the_same_in_float64():
    device, surface = device_for(0, "cl"), SURFACES[2]
    found = hold(surface, device, "float64", BOXES // 10, np.random.default_rng(1))
    assert not found.wrong and found.known


MISTAKES = {  # in the text of a formula's function: what is written, and what is wrong instead
    "sine": ("interval_cos(", "interval_sin("),
    "sign": ("interval_neg(", "checked("),
    "square": ("bounded_scale(2.0f, x", "bounded_scale(1.5f, x"),
    "lesser": ("slope_of_lesser(a", "slope_of_lesser(1 + 0*a"),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_a_mistake_in_the_function_is_caught(name):
    right, wrong = MISTAKES[name]

    def edit(sections):
        text = sections[-2].text
        assert right in text
        return [*sections[:-2], Section("tests: wrong", text.replace(right, wrong)), sections[-1]]

    text = "min(x^2 + y*sin(x + y) - z*cos(2*y), x - 0.1)"
    surface = surfaces.from_formula(text, "sphere:1.5", "planted")
    assert hold(surface, device_for(0, "cl"), "float32", 300, np.random.default_rng(2), edit).wrong


def test_a_jump_that_is_not_seen_is_caught():
    def edit(sections):
        text = sections[-2].text.replace("bool known = ", "bool known = true || ")
        return [*sections[:-2], Section("tests: wrong", text), sections[-1]]

    surface = surfaces.from_formula("floor(3*x)*y + z", "sphere:1.5", "steps")
    assert hold(surface, device_for(1), "float32", 1000, np.random.default_rng(2), edit).wrong


def test_only_programs_that_ask_for_derivatives_have_them():
    surface = SURFACES[0]
    assert not unsupported(surface, "float32", "cl")
    ranges = "".join(s.text for s in surface_sections(surface, ("surface_range",), "float32", "cl"))
    both = "".join(s.text for s in surface_sections(surface, (NEED,), "float32", "cl"))
    assert "GradientRange" not in ranges and "surface_gradient_range(" in both
    assert "GradientRange" in (KERNELS / "lib" / "interval_slopes.glsl").read_text(encoding="utf-8")
