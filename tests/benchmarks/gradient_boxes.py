"""Hold derivatives over boxes by the million: `python -m tests.benchmarks.gradient_boxes N --seed S --device NAME`.

N boxes are divided among all surfaces of the catalog and the gallery, and as many random formulas: distance functions
of kinks, and formulas of the language's own grammar that can be shown to be defined. Each box is held against f's
change between two of its points, as tests/secants.py states it. A row is printed for each formula whose derivatives do
not hold, and one for all: boxes, and how many of them have known derivatives. Returns 1 if any does not hold.
"""

from __future__ import annotations

import argparse
import random
import sys
from collections.abc import Iterator

import numpy as np

import surfaces
from harness.contract import FirsthitError, Surface
from harness.devices.interface import open_device
from harness.kernels.functions import too_long, unsupported
from tests.distance_functions import random_shape
from tests.made_formulas import Maker
from tests.secants import NEED, hold

TEXT = 400  # letters of a random formula at most


def random_formulas(pick: random.Random) -> Iterator[Surface]:
    """Yield surfaces of random formulas, one of distances and one of the language's own by turns."""
    while True:
        made = random_shape(pick, pick.randint(1, 4)).text
        yield surfaces.from_formula(made, "sphere:1.5", "distance")
        text = Maker(pick).made(3).text
        try:
            if len(text) < TEXT:
                yield surfaces.from_formula(text, "sphere:1", "made", {"a": 0.7, "b": -1.3})
        except FirsthitError:
            continue  # of no variable, or not shown to be defined


def candidates(seed: int) -> Iterator[Surface]:
    """Yield the catalog's and the gallery's surfaces, and as many of random formulas."""
    names = [*surfaces.names(), *surfaces.names("gallery")]
    yield from map(surfaces.get, names)
    made = random_formulas(random.Random(seed))
    yield from (next(made) for _ in names)


def main(arguments: list[str]) -> int:
    """Print what does not hold. Returns 1 if anything does not."""
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks.gradient_boxes")
    parser.add_argument("boxes", type=int)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--device", default="opencl:intel")
    options = parser.parse_args(arguments)
    device, chosen = open_device(options.device), list(candidates(options.seed))
    each, boxes, known, wrong = max(1, options.boxes // len(chosen)), 0, 0, 0
    for k, surface in enumerate(chosen):
        if unsupported(surface, "float32", device.language) or too_long(surface, (NEED,), "float32", device.language):
            continue
        found = hold(surface, device, "float32", each, np.random.default_rng([options.seed, k]))
        boxes, known, wrong = boxes + found.boxes, known + found.known, wrong + len(found.wrong)
        if found.wrong:
            print(f"{surface.name}: {surface.formula}: {len(found.wrong)}: {found.wrong[0]}", flush=True)
    print(f"{boxes} boxes of {len(chosen)} formulas, {known} with known derivatives; {wrong} do not hold")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
