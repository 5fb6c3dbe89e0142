"""Compare generated functions of a distance with ones by hand: `python -m tests.benchmarks.distance_costs`.

The distance is sqrt(x^2 + y^2 + z^2) - 1. What is timed is one evaluation of each kind: the value as sphere tracing
takes it, the value with its derivative along a ray, at a place of the ray that both compute, and the range over a piece
of a ray. Both functions are run in
turns, and timed by the processor's time of this process, so that other work on the machine does not count. Nothing is
asserted.
"""

from __future__ import annotations

import time

import numpy as np

import surfaces
from harness.contract import Section
from harness.devices.interface import find_devices, open_device
from harness.kernels.assemble import map_program
from harness.kernels.functions import libraries_for, surface_sections

ROWS, TURNS, ROUNDS = 40_000, 200, 25
SURFACE = surfaces.from_formula("sqrt(x^2 + y^2 + z^2) - 1", "sphere:1.5")
NEEDS = {"value": "surface_value", "dual": "surface_dual_along", "range": "surface_range_along"}
SQUARES = "real s = p.x * p.x + p.y * p.y; s = s + p.z * p.z;"
DUAL = "real r = sqrt(s); real k = p.x * d.x + p.y * d.y; k = k + p.z * d.z; return r - 1.0f + k / r;"
BY_HAND = {
    "value": f"{SQUARES} return sqrt(s) - 1.0f;",
    "dual": f"p = ray_point(make_ray(p, d), 0.0f); {SQUARES} {DUAL}",
    "range": """Interval x = bounded_affine(p.x, d.x, 0.0f, 0.01f);
    Interval y = bounded_affine(p.y, d.y, 0.0f, 0.01f);
    Interval z = bounded_affine(p.z, d.z, 0.0f, 0.01f);
    Interval s = bounded_add(bounded_add(bounded_sqr(x), bounded_sqr(y)), bounded_sqr(z));
    Interval r = interval_sub(interval_sqrt(s), make_interval(1.0f, 1.0f));
    return r.lo + r.hi;""",
}
GENERATED = {
    "value": "return surface_value(p);",
    "dual": "Dual u = surface_dual_along(surface_along(make_ray(p, d)), 0.0f); return u.value + u.derivative;",
    "range": "Interval r = surface_range_along(make_ray(p, d), 0.0f, 0.01f); return r.lo + r.hi;",
}


def item(body: str) -> Section:
    """Return a program's last section, which evaluates a function TURNS times along a row's ray."""
    text = f"""#define INPUTS 6
#define OUTPUTS 1
real evaluated(vec3 p, vec3 d) {{ {body} }}
void map_item(IN real x[INPUTS], OUT real y[OUTPUTS]) {{
    vec3 p = vec3(x[0], x[1], x[2]);
    vec3 d = vec3(x[3], x[4], x[5]);
    real sum = 0.0f;
    for (int i = 0; i < {TURNS}; i++) {{
        real v = evaluated(p, d);
        sum += v;
        p.x = p.x + 0.001f * d.x + 1.0e-6f * v;
    }}
    y[0] = sum;
}}
"""
    return Section("benchmark", text)


def main(name: str) -> None:
    """Print a line for each kind of function on a device."""
    device = open_device(name)
    rows = np.random.default_rng(1).uniform(-1, 1, (ROWS, 6)).astype(np.float32)
    for kind, need in NEEDS.items():
        sections = surface_sections(SURFACE, (need,), "float32", device.language)
        libraries = libraries_for((need, "surface_range"))
        launches = []
        for body in (BY_HAND[kind], GENERATED[kind]):
            built = device.build(map_program([*sections, item(body)], "float32", device.language, libraries))
            launches.append(device.launch(built, [rows.ravel()], [(ROWS, np.float32)], (ROWS, 1)))
            launches[-1].run()
        by_hand, generated = (launch.read()[0] for launch in launches)
        times = np.empty((ROUNDS, 2))
        for turn in range(ROUNDS):
            for k, launch in enumerate(launches):
                start = time.process_time()
                launch.run()
                times[turn, k] = time.process_time() - start
        nanoseconds = np.median(times, axis=0) / ROWS / TURNS * 1e9
        ratios = np.quantile(times[:, 1] / times[:, 0], (0.5, 0.25, 0.75))
        print(
            f"{name} {kind}: {nanoseconds[0]:.2f} ns by hand, {nanoseconds[1]:.2f} ns generated, ratio {ratios[0]:.2f}"
            f" ({ratios[1]:.2f} to {ratios[2]:.2f}), largest difference {np.abs(by_hand - generated).max():.1e}",
            flush=True,
        )


if __name__ == "__main__":
    for found in [info for backend in ("opencl", "opengl") for info in find_devices(backend)]:
        if not found.problem:
            main(found.name)
