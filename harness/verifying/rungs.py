"""Check what a row says of a family's rungs by the family's rays and their truth, which are certified anew."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np

from harness.accuracy.rungs import knowable_margin
from harness.contract import FirsthitError, Surface, Truth, TruthStatus, plural
from harness.hardcases import groups
from harness.verifying.model import CannotTell, Wrong, differing
from harness.verifying.truth import Rays

Certify = Callable[[Surface, Rays], Truth]


def rungs(row: Mapping[str, Any], certify: Certify) -> Iterator[Wrong]:
    """Yield what rungs say otherwise than the family's rays and their truth.

    Raises CannotTell where this version has no such family, or another one of its name.
    """
    try:
        family = groups.identity(row["family"])
    except FirsthitError as error:
        raise CannotTell(str(error)) from None
    if row["identity"].get("family") != family:
        raise CannotTell(f"the family {row['family']} has other rays here")
    told = iter(enumerate(row["rungs"]))
    for group in groups.groups(row["family"]):
        truth, start = certify(group.surface, group.rays), 0
        for rung in group.rungs:
            number, stored = next(told, (-1, None))
            if stored is None:
                yield Wrong("rungs", f"{plural(len(row['rungs']), 'rung')}", "more of them")
                return
            part = slice(start, start := start + len(rung.rays))
            at, undecided = f"rungs[{number}]", truth.status[part] == TruthStatus.UNDECIDED
            near = np.minimum(truth.margin[part], rung.margin) < knowable_margin(rung, row["precision"])
            yield from differing(f"{at}.parameter", stored["parameter"], rung.parameter)
            yield from differing(f"{at}.rays", stored["rays"], len(rung.rays))
            if not stored.get("invalid"):  # whose rays are decided, whatever the truth
                yield from differing(f"{at}.undecided", stored["undecided"], int(undecided.sum()))
                yield from differing(f"{at}.undecidable", stored["undecidable"], int((near & ~undecided).sum()))
            yield from _ratio(at, stored, truth, part, row["precision"], rung.surface)
    if next(told, None):
        yield Wrong("rungs", f"{plural(len(row['rungs']), 'rung')}", "fewer of them")


def _ratio(
    at: str, stored: Mapping[str, Any], truth: Truth, part: slice, precision: str, surface: Surface
) -> Iterator[Wrong]:
    """Yield a rung's largest ratio where no ray of the rung could have it with its largest error."""
    from harness.contract import UNIT_ROUNDOFF

    if stored["max_error"] is None or stored["worst_ratio"] is None:
        yield from differing(f"{at}.worst_ratio", stored["worst_ratio"], stored["max_error"])
        return
    unit = UNIT_ROUNDOFF[precision] * surface.domain.radius  # type: ignore[index]
    conditions = np.fmax(truth.condition[part], 1.0)
    conditions = conditions[np.isfinite(conditions)]
    if not len(conditions):
        return
    least, most = stored["max_error"] / (unit * conditions.max()), stored["max_error"] / (unit * conditions.min())
    if not least * (1.0 - 1e-9) <= stored["worst_ratio"] <= most * (1.0 + 1e-9):
        yield Wrong(f"{at}.worst_ratio", stored["worst_ratio"], f"{least:.6g} to {most:.6g}")
