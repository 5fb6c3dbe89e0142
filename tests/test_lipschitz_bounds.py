"""The bounds by which sphere_tracing_lipschitz divides: proved for many boxes at once, and tight."""

import math

import numpy as np
import pytest

import surfaces
from methods.sphere_tracing_lipschitz.method import ball_bounds, steepest_of_boxes
from surfaces.lowering import gradient, real_tape
from surfaces.numbers import Balls
from surfaces.tape import walk

NAMES = ("torus", "clebsch", "heart", "barth_sextic", "barth_decic", "sixteen_ball")


def boxes_of(surface, count, rng):
    """Middles and half sides of boxes, float64[count, 2, 3]."""
    radius = surface.domain.radius
    middles = rng.uniform(-0.8, 0.8, (count, 3)) * radius + surface.domain.center
    halves = rng.choice([0.5, 0.1, 0.02, 0.0], (count, 3)) * radius
    return np.stack([middles, halves], axis=1)


@pytest.mark.parametrize("name", NAMES)
def test_no_gradient_in_a_box_is_above_its_bound(name, rng):
    surface = surfaces.get(name)
    boxes = boxes_of(surface, 300, rng)
    bounds = np.array(steepest_of_boxes(gradient(real_tape(surfaces.tape_of(surface))), boxes))
    for _ in range(20):
        points = boxes[:, 0] + boxes[:, 1] * rng.choice([-1.0, 1.0, 0.3], (len(boxes), 3))
        slopes = np.linalg.norm(surfaces.gradient(surface, points), axis=1)
        assert (slopes <= bounds * (1 + 1e-12)).all()


@pytest.mark.parametrize("name", NAMES)
def test_a_bound_is_no_looser_than_one_in_arbitrary_precision(name, rng):
    import flint

    surface = surfaces.get(name)
    tape, numbers = gradient(real_tape(surfaces.tape_of(surface))), Balls()
    boxes = boxes_of(surface, 40, rng)
    for (middle, half), bound in zip(boxes.tolist(), steepest_of_boxes(tape, boxes), strict=True):
        box = {axis: flint.arb(m, h) for axis, m, h in zip("xyz", middle, half, strict=True)}
        slopes = sum(numbers.sqr(slope) for slope in walk(tape, numbers, box))
        assert bound <= math.sqrt(float(slopes.upper())) * (1 + 1e-9) + 1e-300


def test_a_pole_has_no_bound():
    surface = surfaces.from_formula("x + y/(z + 3)", "sphere:1")
    tape = gradient(real_tape(surfaces.tape_of(surface)))
    near, far = [[0.0, 0.0, -3.0], [0.1] * 3], [[0.0, 0.0, 0.0], [0.1] * 3]
    bounds = steepest_of_boxes(tape, np.array([near, far]))
    assert bounds[0] == math.inf
    assert math.isfinite(bounds[1])
    assert all(map(math.isfinite, ball_bounds(surface, 4)))
