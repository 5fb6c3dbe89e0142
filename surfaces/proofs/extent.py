"""Say how a surface lies in its domain: whole, cut, not at all, or nowhere; and find a box that holds it.

Everything said is proved in interval arithmetic; what cannot be proved within the time for it is "unknown". A surface
that goes on without end is cut by every domain, on purpose, so that nothing is said of it.
"""

from __future__ import annotations

import contextlib
import math
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from importlib import import_module
from typing import Literal

import numpy as np

from surfaces.evaluation import Floats64, tape_of
from surfaces.model import Box, Domain, FirsthitError, Sphere, Surface, as_float32, domain_text
from surfaces.proofs.boxes import corners, outside
from surfaces.proofs.search import Bools, Hull, Searcher, hull, zero_beyond
from surfaces.tape import Tape

REACH = 4.0  # times the domain's radius: how far about its centre a cut surface is looked for
SECONDS = 0.1  # for asking whether a domain holds some of a surface, and whether it holds all
HULL_SECONDS = 0.3  # for finding a tight box, which most surfaces take a tenth of
AUTO_REACH = 1000.0  # scene units from the origin, within which `auto` looks for the surface
AUTO_SECONDS = 1.0
AUTO_LOOSE = 0.1  # of the surface's extent: how much wider the box that is found may be at most
SLIVER = 1e-3  # of the domain's radius; what lies beyond the domain by less is not called cut
MOST_OPERATIONS = 5000  # of a formula; more take seconds
_STEP = 0.02  # of the surface's extent; a box is rounded outward to a short decimal step of at most this


@dataclass(frozen=True)
class Extent:
    """Hold what is proved of a surface.

    kind: "held", the domain holds all of it; "cut", some lies in the domain and some beyond it; "missed", the domain
        has none of it; "empty", there is none within REACH times the domain's radius of its centre
    box: one that holds all of it, rounded outward; None where none was found
    """

    kind: Literal["held", "cut", "missed", "empty", "unknown"]
    box: Box | None = None


UNKNOWN = Extent("unknown")


@lru_cache(maxsize=512)
def extent(surface: Surface) -> Extent:
    """Return what can be proved of how a surface lies in its domain, in about half a second at most."""
    tape, domain = tape_of(surface), surface.domain
    if len(tape.ops) > MOST_OPERATIONS:
        return UNKNOWN
    center, far = np.array(domain.center), REACH * domain.radius
    searcher = Searcher(tape, SECONDS)
    present = zero_beyond(
        searcher, *_ends(domain), lambda a, b: outside(domain, a, b), lambda a, b: _within(domain, a, b)
    )
    searcher.left = HULL_SECONDS
    found = hull(searcher, center - far, center + far)
    if found is None:
        return Extent("empty")
    closed = bool((found.lower > center - far).all() and (found.upper < center + far).all())
    box = _rounded(found) if closed else None
    if present is False:
        return Extent("missed", box)
    if box is None:
        return UNKNOWN
    wider = _widened(domain, SLIVER * domain.radius)
    searcher.left = SECONDS
    beyond = zero_beyond(
        searcher, found.lower, found.upper, lambda a, b: _within(wider, a, b), lambda a, b: outside(wider, a, b)
    )
    if beyond is None or (beyond and not present):
        return UNKNOWN
    return Extent("cut" if beyond else "held", box)


def remark(surface: Surface) -> str | None:
    """Say in one sentence that a surface's domain cuts it, or has nothing of it; None where there is nothing to say.

    Of a surface of the catalog in the domain that it states nothing is said: where that cuts it, it is on purpose.
    """
    if _as_stated(surface):
        return None
    found = extent(surface)
    domain, box = f"its domain {domain_text(surface.domain)}", found.box and domain_text(found.box)
    if found.kind == "cut":
        return f"{surface.name}: {domain} cuts the surface; the domain {box} holds all of it"
    if found.kind == "missed" and box:
        return f"{surface.name}: {domain} has nothing of the surface; the domain {box} holds all of it"
    if found.kind == "missed":
        return f"{surface.name}: {domain} has nothing of the surface: f is 0 nowhere in it"
    if found.kind == "empty":
        return f"{surface.name}: there is no surface, in {domain} or {REACH:g} times as far out: f is 0 nowhere there"
    return None


def _as_stated(surface: Surface) -> bool:
    """Return whether a surface is one that `surfaces.get` knows, in the domain that is stated there."""
    get = import_module("surfaces").get  # which imports this module for formulas
    for parameters in ({}, dict(surface.parameters)):
        with contextlib.suppress(FirsthitError):
            known = get(surface.name, **parameters)
            if (known.formula, known.domain) == (surface.formula, surface.domain):
                return True
    return False


def held_by(tape: Tape) -> Box:
    """Return a box, in short decimals, that is proved to hold all of a tape's zeros within AUTO_REACH of the origin.

    Raises FirsthitError where there are none, they reach that far, or the box cannot be found tight enough in time.
    """
    give = "give a domain that shows the part you want, as in sphere:2"
    if len(tape.ops) > MOST_OPERATIONS:
        raise FirsthitError(f"no domain is found for a formula of more than {MOST_OPERATIONS} operations; {give}")
    end = np.full(3, AUTO_REACH)
    found = hull(Searcher(tape, AUTO_SECONDS), -end, end)
    within = f"within {AUTO_REACH:g} of the origin along each axis"
    if found is None:
        raise FirsthitError(f"there is no surface {within}: f is 0 nowhere there")
    if not ((found.lower > -end).all() and (found.upper < end).all()):
        raise FirsthitError(
            f"no box {within} is found that holds the surface, which seems to go on without end; {give}"
        )
    size = float((found.outer - found.inner).max())
    if not max((found.inner - found.lower).max(), (found.upper - found.outer).max()) <= AUTO_LOOSE * size:
        raise FirsthitError(f"no tight box is found in {AUTO_SECONDS:g} s that holds the surface; {give}")
    return _rounded(found)


def _ends(domain: Domain) -> tuple[Floats64, Floats64]:
    """Return the corners of the box about a domain, float64[3] each."""
    lower, upper = corners(domain)
    return np.array(lower), np.array(upper)


def _within(domain: Domain, lower: Floats64, upper: Floats64) -> Bools:
    """Return which boxes float64[n, 3] are proved to lie in the domain: bool[n]."""
    if isinstance(domain, Box):
        return np.asarray((lower >= domain.lower).all(axis=1) & (upper <= domain.upper).all(axis=1))
    center = np.asarray(domain.center)
    reach = np.maximum(np.abs(lower - center), np.abs(upper - center))
    return np.asarray((reach * reach).sum(axis=1) <= domain.radius * domain.radius * (1.0 - 1e-14))


def _widened(domain: Domain, by: float) -> Domain:
    """Return the domain, wider by a length on all sides."""
    if isinstance(domain, Sphere):
        return Sphere(domain.radius + by, domain.center)
    low, high = ([v + s * by for v in side] for s, side in ((-1, domain.lower), (1, domain.upper)))
    return Box((low[0], low[1], low[2]), (high[0], high[1], high[2]))


def _rounded(found: Hull) -> Box:
    """Return a box about the one found, whose ends are multiples of a short decimal step."""
    far = max(float(np.abs(found.lower).max()), float(np.abs(found.upper).max()))
    size = max(float((found.upper - found.lower).max()), 1e-6 * far, 1e-30)  # which a point has none of
    power = Fraction(10) ** math.floor(math.log10(_STEP * size))
    step = max(factor * power for factor in (1, 2, 5) if float(factor * power) <= _STEP * size)
    room = Fraction(size) / 10_000
    high = [_stepped(Fraction(v) + room, step, v) for v in found.upper]
    low = [-_stepped(room - Fraction(v), step, -v) for v in found.lower]
    return Box((low[0], low[1], low[2]), (high[0], high[1], high[2]))


def _stepped(value: Fraction, step: Fraction, least: float) -> float:
    """Return the first multiple of a step from a value on that is above `least` as float32 too."""
    count = math.ceil(value / step)
    while as_float32(float(count * step)) <= least:  # far from the origin, floats lie farther apart than steps
        count += 1
    return float(count * step)
