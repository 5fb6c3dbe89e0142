"""Certify a row's rays anew, and hold what it says of the truth, and of errors against it, to that.

The rays are those of the row's view and size, as the check made them. A row does not keep each answer's t, but its
distance from the certified interval, on either side of it. So errors in other units are computed again from that; of
normals and residuals the row's value has to lie between those of both sides.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness import memory
from harness.accuracy import judge
from harness.accuracy.check import BYTES_PER_RAY
from harness.contract import UNIT_ROUNDOFF, Hits, RayStatus, Surface, Truth, TruthStatus, View, plural
from harness.results import sources
from harness.scenes.camera import camera_for, meets, pixel_footprint, rays_of
from harness.verifying.answers import TOP, Arrays, quantiles
from harness.verifying.model import CannotTell, Wrong, differing, is_known, surface_of, view_of

ROUNDED = 1e-6  # of an error that is kept as float32
BETWEEN = 1e-3  # of a residual or an angle, whose t is known to a float32 only
NOISE = {"residual": 1e-12, "normal_error_degrees": 1e-6}  # of float64, where both points are nearly one
Rays = NDArray[np.float32]


def rays_for(row: Mapping[str, Any]) -> tuple[Surface, Rays]:
    """Return a row's surface and rays float32[n, 6]. Raises CannotTell where the row does not say them."""
    if row.get("accuracy") is None:
        raise CannotTell("it has no accuracy")
    if row["stage"] == "raster":
        raise CannotTell("its rays are those of fragments, which only the device knows")
    surface = surface_of(row)
    view = _placed(row, surface)
    size = row["accuracy"]["size"]
    what, instead = f"certifying {plural(size**2, 'ray')}", "verify it on a machine with more memory"
    if reason := memory.refusal(BYTES_PER_RAY * size**2, what, instead):
        raise CannotTell(reason)
    return surface, rays_of(camera_for(view, surface), size)


def _placed(row: Mapping[str, Any], surface: Surface) -> View:
    """Return a row's view, with its eye at the distance that the row tells if it follows from lengths unknown here."""
    view, camera = view_of(row), row.get("camera")
    if is_known(surface) or view.distance is not None:
        return view
    if not camera:
        raise CannotTell("its eye's distance follows from a length of a surface that the catalog here has not")
    return replace(view, distance=camera["distance"])


def truth(row: Mapping[str, Any], kept: Arrays | None, surface: Surface, rays: Rays, found: Truth) -> Iterator[Wrong]:
    """Yield what a row and its arrays say otherwise than the certified truth of its rays.

    Without arrays the row's own counts of that truth are held against it.
    """
    told = row["accuracy"]
    if kept is None:
        yield from _counts(row, surface, rays, found)
        return
    undecided = (kept["truth"] == TruthStatus.UNDECIDED) | (found.status == TruthStatus.UNDECIDED)
    same = _same_oracle(row)
    odd = (kept["truth"] != found.status) & (same | ~undecided)
    if odd.any():
        ray = int(np.argmax(odd))
        names = [TruthStatus(array[ray]).name.lower() for array in (kept["truth"], found.status)]
        yield Wrong("arrays.truth", f"ray {ray}: {names[0]}, and {int(odd.sum()) - 1} more", names[1])
        return  # the rest would only repeat it
    margin = told["grazing_margin"] * told["scene_radius"]
    if same:
        grazing = found.margin < margin
        drowned = ~grazing & (found.contrast < judge.DROWNED * UNIT_ROUNDOFF[row["precision"]])
        for name, classes in (("grazing", grazing), ("drowned", drowned)):
            if (odd := kept[name] != classes).any():
                ray = int(np.argmax(odd))
                yield Wrong(f"arrays.{name}", f"ray {ray}: {bool(kept[name][ray])}", bool(classes[ray]))
    yield from differing("accuracy.domain_rays", told["domain_rays"], int(meets(surface.domain, rays).sum()))
    yield from _in_other_units(row, kept, surface, rays, found)


def _counts(row: Mapping[str, Any], surface: Surface, rays: Rays, found: Truth) -> Iterator[Wrong]:
    """Yield counts of rays by their truth that are others; an undecided ray there may be a decided one here."""
    told = row["accuracy"]
    yield from differing("accuracy.rays", told["rays"], len(rays))
    yield from differing("accuracy.domain_rays", told["domain_rays"], int(meets(surface.domain, rays).sum()))
    hits = int(np.isin(found.status, (TruthStatus.CROSSING, TruthStatus.TOUCH)).sum())
    misses = int((found.status == TruthStatus.MISS).sum())
    slack = 0 if _same_oracle(row) else told["undecided"] + len(rays) - hits - misses
    for name, count in (("truth_hits", hits), ("truth_misses", misses)):
        if abs(told[name] - count) > slack:
            yield Wrong(f"accuracy.{name}", told[name], count)


def _same_oracle(row: Mapping[str, Any]) -> bool:
    """Tell whether the row's truth is by this oracle, packages and processor: then estimates are the same bits."""
    identity = row["identity"]
    files = identity.get("methodology")
    if not isinstance(files, dict) or identity.get("packages") != sources.packages():
        return False
    from harness.devices.host import processor

    return identity.get("processor") == processor() and all(files.get(name) == one for name, one in _ours().items())


@cache
def _ours() -> dict[str, str]:
    """Return the hashes of the oracle's files here that a row names."""
    return {name: one for name, one in sources.hashes(*sources.TRUTH).items() if sources.left_out(name) is None}


def _in_other_units(
    row: Mapping[str, Any], kept: Arrays, surface: Surface, rays: Rays, found: Truth
) -> Iterator[Wrong]:
    told = row["accuracy"]
    clear = ~(kept["grazing"] | kept["drowned"])
    measured = clear & np.isfinite(kept["error"]) & np.isfinite(found.lower)
    error, t = kept["error"][measured].astype(np.float64), found.lower[measured]
    kind_of_t = np.float32 if row["precision"] == "float32" else np.float64
    allowed = np.fmax(found.condition[measured], 1.0) * UNIT_ROUNDOFF[row["precision"]] * surface.domain.radius
    footprint = pixel_footprint(camera_for(_placed(row, surface), surface), row["size"])
    units = {
        "pixel_error": footprint * np.maximum(t, np.finfo(float).tiny),
        "ulp_error": np.spacing(np.abs(t).astype(kind_of_t)).astype(np.float64),
        "condition_ratio": allowed,
    }
    same = _same_oracle(row)
    slack = ROUNDED if same else BETWEEN
    for name, unit in units.items():
        for top, value in quantiles(error / unit).items():
            yield from _near(f"accuracy.{name}.{top}", told[name][top], value, slack)
    if same and "certified_width" in told:
        width = float(np.max((found.upper - found.lower)[measured], initial=0.0))
        yield from differing("accuracy.certified_width", told["certified_width"], width)
    yield from _between(row, kept, surface, rays, found, measured)


def _near(figure: str, stored: float | None, found: float | None, slack: float) -> Iterator[Wrong]:
    """Yield a Wrong where values differ by more than a float32 error's rounding; tiny ones are rounded to 0 there."""
    if stored is not None and found is not None and abs(stored - found) <= slack * max(stored, found) + 1e-30:
        return
    yield from differing(figure, stored, found)


def _between(
    row: Mapping[str, Any],
    kept: Arrays,
    surface: Surface,
    rays: Rays,
    found: Truth,
    measured: NDArray[np.bool_],
) -> Iterator[Wrong]:
    """Yield quantiles of residuals and angles that lie outside those of the answers' two possible places."""
    error = np.where(measured, kept["error"].astype(np.float64), np.nan)
    sides = []
    for t in (found.lower - error, found.upper + error):
        status = np.where(measured, np.uint8(RayStatus.HIT), np.uint8(RayStatus.MISS))
        hits = Hits(t, status, kept["evaluations"])
        verdicts = judge.Verdicts(kept["wrong"], error, kept["grazing"], kept["drowned"])
        sides.append(judge.deviations(surface, rays, hits, found, verdicts))
    for name in NOISE:
        first, second = (getattr(side, name.split("_")[0])[measured] for side in sides)
        least = np.where(error[measured] == 0.0, 0.0, np.fmin(first, second))  # the root is somewhere between
        low, high = quantiles(least), quantiles(np.fmax(first, second))
        for top in TOP:
            stored, under, over = row["accuracy"][name][top], low[top], high[top]
            figure = f"accuracy.{name}.{top}"
            if stored is None or under is None or over is None:
                yield from differing(figure, stored, over)
                continue
            noise = NOISE[name]
            under = under * (1.0 - BETWEEN) - noise
            if not under <= stored <= over * (1.0 + BETWEEN) + noise:
                yield Wrong(figure, stored, f"{low[top]:.6g} to {high[top]:.6g}")
