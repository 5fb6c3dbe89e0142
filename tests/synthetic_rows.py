"""Make up rows, with answers ray by ray: cells and families of hard rays whose figures agree with each other."""

from __future__ import annotations

import random
import statistics
from typing import Any

import numpy as np

from harness.contract import digest
from harness.results import timings
from tests.agreeing_rows import PERCENTILES

SURFACES = {"sphere": ("Sphere", 2, 1.0), "torus": ("Torus", 4, 0.6), "barth": ("Barth #6 $extic_* @65 <b>", 6, 0.2)}
VARIANTS: dict[str, dict[str, float]] = {
    "null": {},
    "ray_march": {},
    "newton[EPSILON=0.001]": {"EPSILON": 0.001},
    "newton[EPSILON=1e-06]": {"EPSILON": 1e-6},
    "_odd#[STEP_$=0.5,RELAXATION_OF_THE_LAST_STEP=1.25]": {"STEP_$": 0.5, "RELAXATION_OF_THE_LAST_STEP": 1.25},
}
DEVICES = {"opencl:intel": 8.0, "opencl:pocl": 1.0, "opengl:llvmpipe": 4.0, "opencl:gpu#0_$": 60.0}
FAMILIES = {
    "grazing": {
        "title": "Grazing #rays_ $*",
        "parameter": "distance from tangency, scene units",
        "harder": "smaller",
        "why": "two roots merge",
        "source": "firsthit",
    },
    "thin_torus": {
        "title": "Thin tori",
        "parameter": "R/r",
        "harder": "larger",
        "why": "the hit is a short dip in a long ray",
        "source": "firsthit",
    },
    "double_root": {
        "title": "Double roots",
        "parameter": "sine of the angle",
        "harder": "smaller",
        "why": "f never changes sign",
        "source": "firsthit",
    },
}
LEVELS = {
    "grazing": [10.0**-n for n in range(1, 8)],
    "thin_torus": [10.0, 100.0, 1e3, 1e4],
    "double_root": [1.0, 0.1, 0.01],
}
BROKEN_FROM = {  # the rung that breaks a variant, and the kind of wrong answer
    ("grazing", "newton[EPSILON=0.001]"): (3, "false_hits"),
    ("grazing", "ray_march"): (5, "exhausted"),
    ("thin_torus", "newton[EPSILON=0.001]"): (1, "misses"),
    ("thin_torus", "_odd#[STEP_$=0.5,RELAXATION_OF_THE_LAST_STEP=1.25]"): (0, "wrong_root"),
}
GRID = 48
IDENTITY = {"formula": "x^2 + y^2 + z^2 - 1"}  # of every cell


def cell(variant: str, surface: str, device: str, precision: str) -> dict[str, Any]:
    """Make up a finished cell whose figures agree with each other."""
    rng = random.Random(f"{variant} {surface} {device} {precision}")
    title, degree, coverage = SURFACES[surface]
    slot = f"{variant} {surface} front 256x256x1 {precision} compute {device}"
    method = variant.partition("[")[0]
    slow = {"null": 0.04, "ray_march": 12.0, "newton": 0.7, "_odd#": 0.4}[method] * (2.0 if "1e-06" in variant else 1.0)
    median = slow * degree / DEVICES[device] * (1.8 if precision == "float64" else 1.0) * rng.uniform(0.9, 1.1)
    narrow = rng.random() > 0.1
    drawn = [rng.gauss(1.0, 0.005 if narrow else 0.05) for _ in range(20)]
    samples = [median * one / statistics.median(drawn) for one in drawn]
    finished: dict[str, Any] = {
        "format": 1,
        "key": digest(slot, IDENTITY),
        "slot": slot,
        "comparison": f"{surface} front 256x256x1 compute",
        "method": method,
        "variant": variant,
        "parameters": VARIANTS[variant],
        "surface": surface,
        "surface_title": title,
        "formula": "x^2 + y^2 + z^2 - 1",
        "degree": degree,
        "domain": "sphere:1.5",
        "extent": None,
        "view": "front",
        "size": 256,
        "samples_per_pixel": 1,
        "precision": precision,
        "stage": "compute",
        "device": device,
        "status": "ok",
        "reason": None,
        "answers": method != "null",
        "time": {
            "clock": "wall" if device.startswith("opengl") else "device",
            "samples_ms": samples,
            "rounds": list(range(20)),
            "session": surface,
            "batch": 1,
            "median_ms": median,
            "lower_ms": max(min(samples), median * (0.995 if narrow else 0.95)),
            "upper_ms": min(max(samples), median * (1.005 if narrow else 1.06)),
            "overhead_share": 0.12 if rng.random() < 0.1 else 0.02,
            "narrow": narrow,
            **timings.steadiness(samples),
        },
        "build": {"compile_ms": 120.0, "upload_ms": 0.1, "readback_ms": 0.4},
        "accuracy": None,
        "family": None,
        "rungs": None,
        "arrays": None,
        "operations": {"add": 7, "mul": 12},
        "evaluation_operations": None if method == "null" else 25,
        "program": {"hash": digest(variant, precision)},
        "environment": {"started": "2026-11-22T03:00:10+00:00", "commit": "abc1234"},
        "identity": IDENTITY,
    }
    if method == "null":  # it finds nothing, so that its misses say nothing
        finished["accuracy"] = accuracy(rng, method, precision, coverage, exact=True)
        finished["accuracy"] |= {"misses": finished["accuracy"]["truth_hits"], "error": dict.fromkeys(PERCENTILES)}
    else:
        exact = variant == "_odd#[STEP_$=0.5,RELAXATION_OF_THE_LAST_STEP=1.25]" and surface == "sphere"
        finished["accuracy"] = accuracy(rng, method, precision, coverage, exact)
        finished["arrays"] = f"arrays/{finished['key']}.npz"
    return finished


def retime(finished: dict[str, Any], median: float) -> dict[str, Any]:
    """Change `finished` so that it takes `median` ms, with its samples and their interval; return it."""
    time = finished["time"]
    factor = median / time["median_ms"]
    time |= {name: factor * time[name] for name in ("median_ms", "lower_ms", "upper_ms")}
    time["samples_ms"] = [factor * sample for sample in time["samples_ms"]]
    return finished


def sampled(finished: dict[str, Any], samples: list[float]) -> dict[str, Any]:
    """Change `finished` so that each round of one session timed one of these samples, ms; return it."""
    median, lower, upper, _ = timings.median_interval(samples)
    finished["time"] |= {"samples_ms": samples, "rounds": list(range(len(samples)))}
    finished["time"] |= {"median_ms": median, "lower_ms": lower, "upper_ms": upper, **timings.steadiness(samples)}
    return finished


def family_cell(variant: str, family: str, device: str, precision: str) -> dict[str, Any]:
    """Make up a finished cell of a family of hard rays.

    Every ray is right but for what BROKEN_FROM says, and no double root can be decided.
    """
    slot = f"{variant} family {family} {precision} {device}"
    made = cell(variant, "torus", device, precision) | {"slot": slot, "key": digest(slot), "family": family}
    made |= {"comparison": f"family {family}", "view": "none", "size": 0, "stage": "rays"}
    made |= {"time": None, "accuracy": None, "arrays": None}
    first, kind = BROKEN_FROM.get((family, variant), (99, "misses"))
    made["rungs"] = [
        rung(
            parameter,
            wrong=10 * (level - first + 1) if level >= first else 0,
            kind=kind,
            decided=family != "double_root",
        )
        for level, parameter in enumerate(LEVELS[family])
    ]
    return made


def rung(parameter: float, wrong: int, kind: str, decided: bool) -> dict[str, Any]:
    """Make up a rung of 96 rays, of which 90 are decided, or none.

    Of the decided rays `wrong` are answered wrongly, all in the way that `kind` names.
    """
    counts = {"misses": 0, "false_hits": 0, "exhausted": 0, "wrong_root": 0, "invalid": 0}
    errors = (
        {"max_error": 1e-6 / parameter, "worst_ratio": 2.5 + wrong}
        if decided
        else dict.fromkeys(("max_error", "worst_ratio"))
    )
    return {
        "parameter": parameter,
        "rays": 96,
        "decided": 90 if decided else 0,
        "right": 90 - wrong if decided else 0,
        **counts | ({kind: wrong} if decided else {}),
        "undecidable": 6 if decided else 96,
        "undecidable_right": 5 if decided else 40,
        "undecided": 0,
        **errors,
    }


def accuracy(rng: random.Random, method: str, precision: str, coverage: float, exact: bool) -> dict[str, Any]:
    """Make up a cell's accuracy on GRID × GRID rays, of which half the share `coverage` hit the surface.

    `exact` makes every error 0, and no ray away from silhouettes wrong.
    """
    top = 0.0 if exact else {"ray_march": 1e-5, "newton": 1e-3, "_odd#": 3e-2}[method] * rng.uniform(0.5, 2.0)
    top *= 1e-4 if precision == "float64" else 1.0
    error = dict(zip(PERCENTILES, (top, top / 3, top / 10, top / 1000), strict=True))
    wrong = rng.randrange(1, 40) if method == "_odd#" and not exact else 0
    hits = int(GRID * GRID * coverage * 0.5)
    return {
        "size": GRID,
        "rays": GRID * GRID,
        "truth_hits": hits,
        "truth_misses": GRID * GRID - hits,
        "undecided": 0,
        "grazing": 57,
        "drowned": 2,
        "grazing_margin": 0.001,
        "scene_radius": 1.0,
        "misses": wrong,
        "false_hits": wrong // 3,
        "exhausted": wrong // 5,
        "wrong_root": 0,
        "invalid": 0,
        "grazing_misses": 3,
        "grazing_false_hits": 1,
        "grazing_exhausted": 0,
        "grazing_wrong_root": 0,
        "grazing_invalid": 0,
        "drowned_misses": 0,
        "drowned_false_hits": 2,
        "drowned_exhausted": 0,
        "drowned_wrong_root": 0,
        "drowned_invalid": 0,
        "error": error,
        "relative_error": dict(error),
        "feature_error": {name: value / 0.3 for name, value in error.items()},
        "pixel_error": {name: 200 * value for name, value in error.items()},
        "ulp_error": {name: value / 2.0**-23 for name, value in error.items()},
        "condition_ratio": {name: value / 2.0**-22 for name, value in error.items()},
        "normal_error_degrees": {name: 57 * value for name, value in error.items()},
        "residual": {name: value / 40 for name, value in error.items()},
        "evaluations_mean": 5.4 if method == "newton" else 812.5,
        "evaluations_max": 40,
    }


def arrays(finished: dict[str, Any]) -> dict[str, np.ndarray]:
    """Make up a finished cell's arrays, [GRID, GRID] each, by name.

    They show a ball with an error that grows to its rim, and a few wrong rays.
    """
    y, x = np.mgrid[1 : -1 : GRID * 1j, -1 : 1 : GRID * 1j]
    radius = np.hypot(x, y)
    ball = radius < 0.8
    rng = np.random.default_rng(int(finished["key"][:8], 16))
    top = finished["accuracy"]["error"]["max"]
    wrong = np.zeros((GRID, GRID), np.uint8)
    for code, name in ((1, "misses"), (2, "false_hits"), (3, "exhausted")):
        inside = np.flatnonzero(~ball if name == "false_hits" else ball)
        wrong.flat[rng.choice(inside, finished["accuracy"][name], replace=False)] = code
    error = np.where(ball & (wrong == 0), top * 10.0 ** (4 * (radius - 0.8)) * rng.uniform(0.3, 1, ball.shape), np.nan)
    return {
        "status": np.where(ball, 1, 0).astype(np.uint8),
        "truth": np.where(ball, 1, 0).astype(np.uint8),
        "error": error.astype(np.float32),
        "wrong": wrong,
        "condition": np.where(ball, 1 / np.sqrt(np.clip(1 - (radius / 0.8) ** 2, 1e-9, 1)), np.nan).astype(np.float32),
        "evaluations": np.full((GRID, GRID), 5, np.int32),
        "grazing": np.abs(radius - 0.8) < 0.03,
        "shade": np.where(ball, np.sqrt(np.clip(1 - (radius / 0.8) ** 2, 0, 1)), np.nan).astype(np.float32),
    }


def troubled(finished: dict[str, Any]) -> dict[str, Any]:
    """Take the result from `finished` where the story says that the cell fails; return it."""
    status = reason = None
    if finished["precision"] == "float64" and finished["device"] == "opencl:gpu#0_$":
        status, reason = "skipped", "opencl:gpu#0_$ has no float64"
    elif (finished["device"], finished["surface"], finished["method"]) == ("opengl:llvmpipe", "barth", "ray_march"):
        status, reason = "timeout", "still running after 20 s"
    elif (finished["device"], finished["surface"], finished["method"]) == ("opencl:pocl", "barth", "_odd#"):
        status, reason = "failed", "kernel.glsl line 7: use of `$x` @ *p = a_b[#i]\n  <7:3>\n\x1b[31m^~~~\x1b[0m\n" * 9
    elif (finished["device"], finished["surface"], finished["precision"]) == ("opencl:pocl", "torus", "float64"):
        status, reason = "crashed", "the worker died of signal 11"
    if status:
        finished |= dict.fromkeys(("time", "build", "accuracy", "arrays", "operations"))
        finished |= {"status": status, "reason": reason}
    return finished
