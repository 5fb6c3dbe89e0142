"""List what is tried: each method's default, its papers' settings and its knobs' sweeps, and the views."""

from __future__ import annotations

import itertools
import math
import random

from harness.contract import Variant, View
from harness.experiment.kinds import of_method
from harness.plugins import Catalog, Plugin

GOLDEN_ANGLE = 180.0 * (3.0 - math.sqrt(5.0))


def variants(catalog: Catalog) -> tuple[Variant, ...]:
    """Return every candidate, each binding of a method's parameters once.

    Methods whose answers are not those of single rays are left out, since no error along a ray can be told of them.
    """
    found: dict[tuple[str, tuple[tuple[str, float | int], ...]], Variant] = {}
    for _, plugin in sorted(catalog.plugins.items()):
        if plugin.method.answers and of_method(plugin.method).answers_rays:
            for variant in _of(plugin):
                found.setdefault((variant.method, variant.parameters), variant)
    return tuple(found.values())


def count(catalog: Catalog) -> int:
    """Return how many bindings `variants` goes through, which is at least as many as it returns."""
    casting = (p.method for p in catalog.plugins.values() if p.method.answers and of_method(p.method).answers_rays)
    return sum(math.prod(1 + len(p.sweep) for p in m.parameters) + len(m.settings) for m in casting)


def _of(plugin: Plugin) -> list[Variant]:
    """List a method's default, its papers' settings, and the grid of its knobs' sweeps, in this order."""
    swept = [(p.name, (None, *p.sweep)) for p in plugin.method.parameters if p.sweep]
    points = itertools.product(*(values for _, values in swept))
    named = [{name: v for (name, _), v in zip(swept, point, strict=True) if v is not None} for point in points]
    grid = [plugin.variant(point) for point in named]
    return [grid[0], *(plugin.setting(name) for name in plugin.method.settings), *grid[1:]]


def views(count: int, seed: int) -> list[View]:
    """Return `count` views in random order, whose directions are spread evenly over the sphere.

    The seed decides how they are turned and ordered. The surface fills each view.
    """
    draw = random.Random(f"views {seed}")
    turn, order = draw.uniform(0.0, 360.0), draw.sample(range(count), count)
    angles = []
    for i in range(count):
        height = 1.0 - 2.0 * (i + draw.uniform(0.2, 0.8)) / count
        angles.append(((turn + GOLDEN_ANGLE * i) % 360.0, math.degrees(math.asin(height))))
    return [
        View(f"{place} of seed {seed}", azimuth=angles[i][0], elevation=angles[i][1])
        for place, i in enumerate(order, 1)
    ]
