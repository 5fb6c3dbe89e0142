"""Count a row's answers again from its arrays, which hold them ray by ray.

Errors are kept there as float32. Rounding keeps their order, so that quantiles of the kept errors are the rounded
quantiles of the row, to the last bit.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness.accuracy.judge import FAR, NAMES
from harness.accuracy.judge import Wrong as Verdict
from harness.contract import RayStatus, TruthStatus
from harness.results import pictures_file
from harness.verifying.model import CannotTell, Wrong, differing, is_known, surface_of

NEEDED = ("status", "truth", "wrong", "grazing", "drowned", "error", "evaluations")
TOP = {"max": None, "p999": 0.999, "p99": 0.99, "p50": 0.5}
Arrays = Mapping[str, NDArray[Any]]


def arrays_of(folder: Path, row: Mapping[str, Any]) -> Arrays:
    """Read a row's arrays, [size, size] each, flattened. Raises CannotTell where it has none or an older form.

    Raises ValueError or OSError where the file is missing or damaged.
    """
    if row.get("accuracy") is None or row.get("arrays") is None:
        raise CannotTell("it has no answers ray by ray")
    if row["arrays"] != f"arrays/{row['key']}.npz":
        raise ValueError(f"arrays/{row['key']}.npz is not what it names")
    found = pictures_file.read(folder / row["arrays"])
    if lacking := [name for name in NEEDED if name not in found]:
        raise CannotTell(f"its arrays lack {', '.join(lacking)}")
    if found["truth"].shape != (row["accuracy"]["size"],) * 2:
        raise ValueError(
            f"{row['arrays']} holds {found['truth'].shape} rays, and the row {row['accuracy']['size']} a side"
        )
    return {name: found[name].ravel() for name in (*NEEDED, "condition") if name in found}


def quantiles(values: NDArray[Any]) -> dict[str, float | None]:
    """Return what a row says of values: quantiles of the finite ones, None where there is none."""
    values = values[np.isfinite(values)]
    if not len(values):
        return dict.fromkeys(TOP)
    return {
        name: float(values.max() if share is None else np.quantile(values, share, method="higher"))
        for name, share in TOP.items()
    }


def answers(row: Mapping[str, Any], kept: Arrays) -> Iterator[Wrong]:
    """Yield what a row's accuracy says otherwise than its arrays."""
    told = row["accuracy"]
    yield from _impossible(row, kept)
    clear = ~(kept["grazing"] | kept["drowned"])
    counts = {
        "rays": told["size"] ** 2,
        "truth_hits": int(np.isin(kept["truth"], (TruthStatus.CROSSING, TruthStatus.TOUCH)).sum()),
        "truth_misses": int((kept["truth"] == TruthStatus.MISS).sum()),
        "undecided": int((kept["truth"] == TruthStatus.UNDECIDED).sum()),
        "grazing": int(kept["grazing"].sum()),
        "drowned": int(kept["drowned"].sum()),
        "judged": int((clear & (kept["truth"] != TruthStatus.UNDECIDED)).sum()),
    }
    for kind, name in NAMES.items():
        wrong = kept["wrong"] == kind
        counts[name] = int((clear & wrong).sum())
        counts[f"grazing_{name}"] = int((kept["grazing"] & wrong).sum())
        counts[f"drowned_{name}"] = int((kept["drowned"] & wrong).sum())
    if row["casts"] in ("beams", "quadtree"):
        counts["beam_only"] = int((_right_hits(kept) & np.isnan(kept["error"]) & _decided(kept)).sum())
    elif row["casts"] == "tiles":  # evaluations are of all pixels of the check's frame
        if any(told["stages"].values()):
            yield from differing("accuracy.stages", sum(told["stages"].values()), 1.0, 1e-9)
    else:
        spent = kept["evaluations"][kept["status"] != RayStatus.INVALID]
        mean = float(spent.mean()) if len(spent) else None
        yield from differing("accuracy.evaluations_mean", told["evaluations_mean"], mean, 1e-12)
        counts["evaluations_max"] = int(spent.max()) if len(spent) else 0
    for name, found in counts.items():
        if name in told:
            yield from differing(f"accuracy.{name}", told[name], found)
    yield from _chosen(row)
    yield from _errors(row, kept, clear)


def _right_hits(kept: Arrays) -> NDArray[np.bool_]:
    return np.asarray((kept["wrong"] == Verdict.RIGHT) & (kept["status"] == RayStatus.HIT))


def _decided(kept: Arrays) -> NDArray[np.bool_]:
    return np.asarray(kept["truth"] != TruthStatus.UNDECIDED)


def _impossible(row: Mapping[str, Any], kept: Arrays) -> Iterator[Wrong]:
    """Yield a Wrong for each kind of ray whose verdict does not follow from answer and truth."""
    status, truth, wrong, error = (kept[name] for name in ("status", "truth", "wrong", "error"))
    there, decided = np.isin(truth, (TruthStatus.CROSSING, TruthStatus.TOUCH)), _decided(kept)
    hit, miss, gave_up = (status == kind for kind in (RayStatus.HIT, RayStatus.MISS, RayStatus.EXHAUSTED))
    expected = np.full(len(status), Verdict.INVALID, np.uint8)
    expected[hit & there] = Verdict.WRONG_ROOT
    expected[hit & ~there] = Verdict.FALSE_HIT
    expected[miss & there] = Verdict.MISS
    expected[gave_up] = Verdict.EXHAUSTED
    expected[(miss & ~there) | (~decided & (hit | miss | gave_up))] = Verdict.RIGHT
    expected[hit & there & np.isfinite(error)] = Verdict.RIGHT
    odd = wrong != expected
    if row["casts"] in ("beams", "quadtree"):
        odd &= ~_right_hits(kept)  # a beam may see what its ray passes by
    known = np.isin(truth, list(TruthStatus)) & np.isin(status, list(RayStatus))
    measured = np.isfinite(error)
    far = FAR * row["accuracy"]["scene_radius"] * (1.0 + 1e-6)
    for name, bad in {
        "wrong": odd | ~known,
        "error": measured & (~(hit & there & (wrong == Verdict.RIGHT)) | (error < 0.0) | (error > far)),
        "grazing": kept["grazing"] & kept["drowned"],
    }.items():
        if bad.any():
            ray = int(np.argmax(bad))
            told = {key: array[ray].item() for key, array in kept.items()}
            yield Wrong(f"arrays.{name}", f"ray {ray}: {told[name]}", f"what follows from {told}")


def _chosen(row: Mapping[str, Any]) -> Iterator[Wrong]:
    """Yield what the accuracy says otherwise than the config's choices and the surface."""
    told, choice = row["accuracy"], row["identity"].get("accuracy")
    if isinstance(choice, dict):
        yield from differing("accuracy.size", told["size"], choice["size"])
        yield from differing("accuracy.grazing_margin", told["grazing_margin"], choice["grazing_margin"])
    if row.get("scene") is not None:
        return
    try:
        surface = surface_of(row)
    except CannotTell:
        return
    if "domain_radius" in told:
        yield from differing("accuracy.domain_radius", told["domain_radius"], surface.domain.radius, 1e-12)
    if is_known(surface):
        radius = surface.bounding_radius or surface.domain.radius
        yield from differing("accuracy.scene_radius", told["scene_radius"], radius, 1e-12)
        feature = surface.feature_radius or radius
        for name in TOP:
            if told["error"][name] is not None:
                found = told["error"][name] / feature
                yield from differing(f"accuracy.feature_error.{name}", told["feature_error"][name], found, 1e-12)


def _errors(row: Mapping[str, Any], kept: Arrays, clear: NDArray[np.bool_]) -> Iterator[Wrong]:
    """Yield quantiles of errors that do not follow from the arrays."""
    told = row["accuracy"]
    for name, found in quantiles(kept["error"][clear]).items():
        stored = told["error"][name]
        if stored is None or found is None or float(np.float32(stored)) != found:
            yield from differing(f"accuracy.error.{name}", stored, found)
        relative = None if stored is None else stored / told["scene_radius"]
        yield from differing(f"accuracy.relative_error.{name}", told["relative_error"][name], relative, 1e-12)
