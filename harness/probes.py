"""What a device's arithmetic and clock are worth, found by trying."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from harness.assemble import KERNELS, file_section, map_program
from harness.backends import Device, map_rows, real_type
from harness.contract import Precision

CASES = 65536
PEAK_ITEMS = 4096  # at first: doubled until a launch takes PEAK_MS, since a GPU is not filled by so few
MOST_ITEMS = 1 << 20
PEAK_MS = 5.0
PEAK_OPERATIONS = 131072  # per item, as peak.glsl counts them
BELIEVABLE = (0.5, 1.05)  # device clock over wall clock, for a launch of some milliseconds, that is to be trusted


@dataclass(frozen=True)
class Probes:
    """Shares are of CASES random pairs; rates are of float32 multiply-adds, two operations each."""

    two_sum: float  # share where two_sum is exact
    two_prod_split: float  # share where two_prod by Dekker splitting is exact
    two_prod_fma: float  # share where a * b and fma(a, b, -a * b) sum to the product
    round_to_nearest: float  # share of sums and products that are rounded to nearest
    division: float  # share of quotients that are rounded to nearest
    peak_gflops: float
    clock_ratio: float | None  # device clock over wall clock; None where the device has none


def _pairs(precision: Precision) -> NDArray[np.float64]:
    generator = np.random.default_rng(1)
    pairs = generator.standard_normal((CASES, 2)) * 2.0 ** generator.integers(-10, 10, (CASES, 2))
    return pairs if precision == "float64" else pairs.astype(np.float32).astype(np.float64)


def probe(device: Device) -> Probes:
    """Run the probes in float32: the host's float64 sums and products of such pairs are exact."""
    program = map_program(file_section(KERNELS / "probe.glsl"), "float32", device.language)
    pairs = _pairs("float32")
    sums, sum_errors, products, product_errors, fma_errors, quotients = map_rows(device, program, pairs, 6).T.astype(
        np.float64
    )
    a, b = pairs.T
    nearest = (sums == _rounded(a + b)) & (products == _rounded(a * b))
    peak, ratio = _peak(device)
    return Probes(
        two_sum=float(np.mean(sums + sum_errors == a + b)),
        two_prod_split=float(np.mean(products + product_errors == a * b)),
        two_prod_fma=float(np.mean(products + fma_errors == a * b)),
        round_to_nearest=float(np.mean(nearest)),
        division=float(np.mean(quotients == _rounded(a / b))),
        peak_gflops=peak,
        clock_ratio=ratio,
    )


def _rounded(values: NDArray[np.float64]) -> NDArray[np.float64]:
    return values.astype(np.float32).astype(np.float64)


def _peak(device: Device) -> tuple[float, float | None]:
    program = map_program(file_section(KERNELS / "peak.glsl"), "float32", device.language)
    kind = real_type(program)
    built = device.build(program)
    items = PEAK_ITEMS
    while True:
        launch = device.launch(built, [np.ones(items, kind)], [(items, kind)], (items, 1))
        launch.run()
        timings = [launch.run() for _ in range(3)]
        launch.release()
        if items >= MOST_ITEMS or min(timing.wall_ms for timing in timings) >= PEAK_MS:
            break
        items *= 2
    best = min(timings, key=lambda timing: timing.wall_ms)
    rate = PEAK_OPERATIONS * items / best.wall_ms * 1e-6
    return rate, None if best.device_ms is None else best.device_ms / best.wall_ms
