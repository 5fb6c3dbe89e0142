"""Offer `firsthit trace` and `oracle`: read rays from a file, and write answers to one."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from harness.accuracy.judge import undecided_too_many
from harness.commands import Add
from harness.commands.options import add_jobs, add_method, add_surface, caster_of, number, surface_of, tell, writable
from harness.contract import FirsthitError, RayStatus, TruthStatus, plural
from harness.experiment.config import AccuracyChoice
from harness.limits import Within
from harness.results import npz
from harness.results.writing import savez_atomically
from harness.running.trace import cast, checked_rays

T_MIN = Within(0.0, sys.float_info.max, "{value} is not a distance along the ray: it must be finite and not under 0")


def add_parsers(add: Add) -> None:
    parser = add(
        "trace",
        "firsthit trace --surface torus --method newton --rays rays.npy -o hits.npz",
        "Cast the rays float32[n, 6] (origin, direction) of a .npy file. Writes an .npz with t (float64, "
        "NaN without a hit), status (uint8: 0 miss, 1 hit, 2 exhausted, 3 invalid: an impossible answer) and "
        "evaluations (int32).",
    )
    add_surface(parser)
    add_method(parser)
    _add_files(parser)
    parser.set_defaults(run=_trace)

    parser = add(
        "oracle",
        "firsthit oracle --formula 'x^4 + y^4 + z^4 - 1' --rays rays.npy -o truth.npz",
        "Certify the first hits of the rays float32[n, 6] of a .npy file. Writes an .npz with lower and "
        "upper (float64: proved to enclose the first hit, NaN without one) and status (uint8: 0 miss, "
        "1 crossing, 2 touch, 3 undecided).",
    )
    add_surface(parser)
    _add_files(parser)
    add_jobs(parser)
    parser.set_defaults(run=_oracle)


def _add_files(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--rays", type=Path, required=True, metavar="FILE", help=".npy file, float32[n, 6]")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FILE", help=".npz file to write")
    told = "where rays begin: only hits at T or beyond count (default: 0)"
    parser.add_argument("--t-min", type=number(T_MIN), default=0.0, metavar="T", help=told)


def load_rays(path: Path) -> NDArray[np.float32]:
    """Read rays float32[n, 6] from a .npy file. Raises FirsthitError for anything else, and names the first bad row."""
    try:
        rays = npz.read_alone(path)
    except OSError as error:
        raise FirsthitError(f"cannot read {path}: {error.strerror or error}") from None
    except ValueError as error:
        raise FirsthitError(f"{path} is not a .npy file of numbers ({error}); write it with numpy.save") from None
    return checked_rays(rays, str(path))


def _trace(options: argparse.Namespace) -> int:
    surface, rays, output = surface_of(options), load_rays(options.rays), writable(options.output)
    hits = cast(caster_of(options), surface, rays, t_min=options.t_min, tell=tell)
    savez_atomically(output, t=hits.t, status=hits.status, evaluations=hits.evaluations)
    counts = {status: int((hits.status == status).sum()) for status in RayStatus}
    print(
        f"{output}: {plural(len(rays), 'ray')}, "
        + ", ".join(f"{n} {status.name.lower()}" for status, n in counts.items())
    )
    return 0


def _oracle(options: argparse.Namespace) -> int:
    from harness.oracle import first_hits

    surface, rays, output = surface_of(options), load_rays(options.rays), writable(options.output)
    truth = first_hits(surface, rays, options.t_min)
    if reason := undecided_too_many(truth, AccuracyChoice().undecided):
        print(f"firsthit: {reason} can be measured by these answers", file=sys.stderr)
    savez_atomically(output, lower=truth.lower, upper=truth.upper, status=truth.status)
    counts = {status: int((truth.status == status).sum()) for status in TruthStatus}
    print(
        f"{output}: {plural(len(rays), 'ray')}, "
        + ", ".join(f"{n} {status.name.lower()}" for status, n in counts.items())
    )
    return 0
