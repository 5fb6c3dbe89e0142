"""Find by trying what a device's arithmetic and clock are worth.

Whether error-free transforms are exact there is a device's fact, and how far its own clock may be trusted.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated

import numpy as np
from numpy.typing import NDArray

from harness.contract import Precision, Section
from harness.devices.interface import Device, map_rows, real_type
from harness.kernels.assemble import map_program
from harness.kernels.sections import KERNELS, file_section
from harness.results.declared import NOT_NEGATIVE, SHARE

CASES = 65536
PEAK_ITEMS = 1024  # of the first launch; their number grows until a launch takes PEAK_MS, since a GPU needs more
MOST_ITEMS = 1 << 20
PEAK_MS = 5.0
PEAK_TRIES = 12  # launches of each of the PEAK_FINALISTS best shapes, since other programs may slow any of them down
PEAK_FINALISTS = 3
PEAK_OPERATIONS = 131072  # per item, two for each multiply-add
# (independent chains of multiply-adds, whether they are fused). Compilers differ in which of them they turn into
# vectors, and in how many of them hide the arithmetic's latency: the rates of two shapes may differ by a factor of 100
PEAK_SHAPES = (
    (8, True),
    (8, False),
    (16, True),
    (16, False),
    (24, True),
    (32, True),
    (64, True),
    (64, False),
    (96, True),
)
BELIEVABLE = (0.5, 1.05)  # least and most of Probes.clock_ratio at which a device's clock is trusted


@dataclass(frozen=True)
class Probes:
    """Hold what was found. Shares are of CASES random pairs; rates are of float32 multiply-adds, two operations each.

    two_sum: the share on which two_sum is exact
    two_prod_split: the share on which two_prod by Dekker's splitting is exact
    two_prod_fma: the share on which a * b and fma(a, b, -a * b) add up to the product
    round_to_nearest: the share of sums and products that are rounded to nearest
    division: the share of quotients that are rounded to nearest
    peak_gflops: the best rate of any of PEAK_SHAPES
    peak_median_gflops: the rate of the median launch of that shape, which shows how far the best one may be trusted
    peak_shape: that shape, in words
    clock_ratio: the device's clock over the host's, the median over all launches that measured the peak, each of about
        PEAK_MS or more; None if the device has no clock
    """

    two_sum: Annotated[float, SHARE]
    two_prod_split: Annotated[float, SHARE]
    two_prod_fma: Annotated[float, SHARE]
    round_to_nearest: Annotated[float, SHARE]
    division: Annotated[float, SHARE]
    peak_gflops: Annotated[float, NOT_NEGATIVE]
    peak_median_gflops: Annotated[float, NOT_NEGATIVE]
    peak_shape: str
    clock_ratio: Annotated[float | None, NOT_NEGATIVE]


def _pairs(precision: Precision) -> NDArray[np.float64]:
    """Return float64[CASES, 2]: pairs of random numbers that the precision holds, the same in every run."""
    generator = np.random.default_rng(1)
    pairs = generator.standard_normal((CASES, 2)) * 2.0 ** generator.integers(-10, 10, (CASES, 2))
    return pairs if precision == "float64" else pairs.astype(np.float32).astype(np.float64)


def probe(device: Device) -> Probes:
    """Run the probes in float32, and compare with the host: its float64 sums and products of such pairs are exact."""
    program = map_program(file_section(KERNELS / "map/probe.glsl"), "float32", device.language)
    pairs = _pairs("float32")
    sums, sum_errors, products, product_errors, fma_errors, quotients = map_rows(device, program, pairs, 6).T.astype(
        np.float64
    )
    a, b = pairs.T
    nearest = (sums == _rounded(a + b)) & (products == _rounded(a * b))
    peak = _peak(device)
    return Probes(
        two_sum=float(np.mean(sums + sum_errors == a + b)),
        two_prod_split=float(np.mean(products + product_errors == a * b)),
        two_prod_fma=float(np.mean(products + fma_errors == a * b)),
        round_to_nearest=float(np.mean(nearest)),
        division=float(np.mean(quotients == _rounded(a / b))),
        peak_gflops=peak.gflops,
        peak_median_gflops=peak.median,
        peak_shape=peak.shape,
        clock_ratio=float(np.median(peak.clock_ratios)) if peak.clock_ratios else None,
    )


def _rounded(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return float64[...]: the values rounded to float32."""
    return values.astype(np.float32).astype(np.float64)


@dataclass(frozen=True)
class _Peak:
    """Hold rates in Gflop/s: of the best launch and of the median one.

    clock_ratios: the device's clock over the host's, of each launch that the device's clock told of
    """

    gflops: float
    median: float
    shape: str
    clock_ratios: tuple[float, ...]


def _peak(device: Device) -> _Peak:
    """Measure the peak rate: that of the fastest of many launches, of the fastest shapes of the program.

    The fastest launch is taken because other work on the machine can only slow a launch. The median rate of the same
    shape is returned beside it. If the median is far below, the machine was busy, and the peak depends on chance.

    The clocks' ratios are of all launches. A launch that waits for a processor that other programs hold takes longer by
    the host's clock alone, so that one launch may tell half its time by a clock that is right, also the fastest one.
    """
    tried = [(_rate(device, shape, tries=2), shape) for shape in PEAK_SHAPES]
    tried.sort(key=lambda pair: -pair[0].gflops)
    again = [_rate(device, shape, PEAK_TRIES) for _, shape in tried[:PEAK_FINALISTS]]
    best = max([tried[0][0], *again], key=lambda peak: peak.gflops)
    ratios = tuple(ratio for peak in (*(peak for peak, _ in tried), *again) for ratio in peak.clock_ratios)
    return replace(best, median=next(peak.median for peak in again if peak.shape == best.shape), clock_ratios=ratios)


def peak_section(chains: int, fused: bool) -> Section:
    """Return a map item of `chains` independent chains of multiply-adds.

    It has PEAK_OPERATIONS operations, or a few more. Each chain has a variable of its own name, since compilers keep an
    array of them in memory.
    """
    names = [f"a{k}" for k in range(chains)]
    step = "{0} = fma({0}, scale, shift);" if fused else "{0} = {0} * scale + shift;"
    lines = [
        "#define INPUTS 1",
        "#define OUTPUTS 1",
        "void map_item(IN real x[INPUTS], OUT real y[OUTPUTS]) {",
        "    real scale = real(0.999);",
        "    real shift = real(0.001);",
        *(f"    real {name} = x[0] + real({k});" for k, name in enumerate(names)),
        f"    for (int i = 0; i < {_turns(chains)}; i++) {{",
        *(f"        {step.format(name)}" for name in names),
        "    }",
        f"    y[0] = {' + '.join(names)};",
        "}",
    ]
    return Section(f"generated: {_words(chains, fused)}", "\n".join(lines))


def _words(chains: int, fused: bool) -> str:
    return f"{chains} chains of {'fused' if fused else 'separate'} multiply-adds"


def _turns(chains: int) -> int:
    return -(-PEAK_OPERATIONS // (2 * chains))


def _rate(device: Device, shape: tuple[int, bool], tries: int) -> _Peak:
    """Measure one shape: the best and the median of `tries` launches, of PEAK_MS or more each."""
    program = map_program(peak_section(*shape), "float32", device.language)
    built, kind = device.build(program), real_type(program)
    items = PEAK_ITEMS
    while True:
        launch = device.launch(built, [np.ones(items, kind)], [(items, kind)], (items, 1))
        launch.run()
        timings = [launch.run()]
        if enough := timings[0].wall_ms >= PEAK_MS or items >= MOST_ITEMS:
            timings += [launch.run() for _ in range(tries - 1)]
        launch.release()
        if enough:
            break
        lacking = min(64.0, 1.3 * PEAK_MS / max(timings[0].wall_ms, 1e-6))
        items = min(MOST_ITEMS, max(2 * items, 1 << round(np.log2(items * lacking))))
    best = min(timings, key=lambda timing: timing.wall_ms)
    typical = float(np.median([timing.wall_ms for timing in timings]))
    operations = 2 * shape[0] * _turns(shape[0]) * items
    ratios = tuple(timing.device_ms / timing.wall_ms for timing in timings if timing.device_ms is not None)
    return _Peak(operations / best.wall_ms * 1e-6, operations / typical * 1e-6, _words(*shape), ratios)
