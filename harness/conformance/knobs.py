"""Check that a knob which says which way it is finer moves the error that way."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import pairwise

import numpy as np

from harness.accuracy.judge import FAR, Wrong
from harness.conformance.cases import Bench, Case, Finding
from harness.contract import UNIT_ROUNDOFF, Parameter
from harness.plugins import Plugin

COARSER = (4096.0, 64.0, 1.0)  # times the default of a knob that is finer downwards and names no sweep
FEWER = (64, 8, 4, 2, 1)  # parts of the default of a knob that is finer upwards and names no sweep
FLOOR_ROUNDINGS = 4.0  # times mean condition × unit roundoff × radius: the error that no finer knob can bring down
GROWTH = 1.1  # from one setting to the next finer one: an error that grows by less has not grown
FALL = 0.75  # from the coarsest setting to the finest: an error of at most this part of the first has fallen


def settings_of(parameter: Parameter) -> list[float]:
    """Return a knob's values from coarse to fine, the default among them."""
    if parameter.sweep:
        return sorted({*parameter.sweep, parameter.default}, reverse=parameter.finer == "down")
    if parameter.finer == "down":
        return [parameter.default * factor for factor in COARSER]
    if isinstance(parameter.default, int):
        return list(dict.fromkeys(parameter.default // part for part in FEWER))
    return [parameter.default / part for part in FEWER]


def swept(
    bench: Bench, plugin: Plugin, case: Case, parameter: Parameter, others: Mapping[str, float | int]
) -> Iterator[Finding]:
    """Yield two findings: the error grows at no step towards finer, and falls from the coarsest to the finest value.

    `others` are values of the method's other knobs. An error is the mean over clear rays that meet the surface, in
    scene radii; a wrong answer counts as FAR. A ray that no value answers rightly says nothing about this knob, and is
    left out. Errors below the limit of float32 pass both checks.
    """
    values = settings_of(parameter)
    answered = [bench.cast(plugin, case, "float32", **{**others, parameter.name: value}) for value in values]
    verdicts = [case.judged(hits, "float32") for hits in answered]
    right = [verdict.wrong == Wrong.RIGHT for verdict in verdicts]
    there = case.there & case.clear(verdicts[0])
    there = there if there.any() else case.there  # of a surface that is only touched every ray is grazing
    condition = np.fmax(case.truth.condition[there], 1.0)
    condition = condition[np.isfinite(condition)]
    floor = FLOOR_ROUNDINGS * UNIT_ROUNDOFF["float32"] * case.surface.domain.radius / case.radius
    floor *= float(condition.mean()) if len(condition) else 1.0
    told_by = there & np.any(right, axis=0)
    errors = [
        float(np.where(good, verdict.error / case.radius, FAR)[told_by].mean()) if told_by.any() else np.nan
        for good, verdict in zip(right, verdicts, strict=True)
    ]
    told = ", ".join(f"{value:g}: {error:.1e}" for value, error in zip(values, errors, strict=True))
    told = f"{case.surface.name}, {told_by.sum()} rays, mean errors by setting {told}; float32 ends at {floor:.1e}"
    advice = f"turn `finer` of {parameter.name} round, or leave it out where the knob trades no speed for error"
    growth = max((after - GROWTH * before for before, after in pairwise(errors)), default=0.0)
    worst = growth if not np.isnan(errors).any() else np.nan
    name = f"{parameter.name} finer {parameter.finer}"
    yield Finding(
        f"{name}: never worse",
        worst,
        floor,
        f"mean error in radii at a finer setting, less {GROWTH:g} times that of the next coarser one",
        told,
        advice,
    )
    yield Finding(
        f"{name}: gets better",
        errors[-1],
        max(FALL * errors[0], floor),
        f"mean error in radii at the finest setting: {FALL:g} times the coarsest one's, or float32's end",
        told,
        advice,
    )
