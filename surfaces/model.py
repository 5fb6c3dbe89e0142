"""Define what a surface is: a formula in a domain. This module imports nothing else of the project.

Lengths are in scene units, the surface's own coordinates.
"""

from __future__ import annotations

import math
import struct
from dataclasses import dataclass
from typing import Any


class FirsthitError(Exception):
    """Report, in one line, a problem that the user can act on.

    `exit_code` is 2 for mistakes of usage or config, and 3 for failures while running.
    """

    def __init__(self, message: str, exit_code: int = 2) -> None:
        super().__init__(message)
        self.exit_code = exit_code


def as_float32(value: float) -> float:
    """Round to the nearest float32. Raises OverflowError past its range."""
    return float(struct.unpack("<f", struct.pack("<f", value))[0])


@dataclass(frozen=True)
class Sphere:
    """Define a ball. Its numbers are rounded to float32, so that kernels and oracle clip by the same domain.

    Raises FirsthitError unless the radius is positive and the centre finite.
    """

    radius: float
    center: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        object.__setattr__(self, "radius", as_float32(self.radius))
        object.__setattr__(self, "center", tuple(as_float32(c) for c in self.center))
        if not (math.isfinite(self.radius) and self.radius > 0.0 and all(map(math.isfinite, self.center))):
            raise FirsthitError(f"a sphere domain needs a positive radius and a finite centre, not {self}")


@dataclass(frozen=True)
class Box:
    """Define an axis-aligned box.

    Its numbers are rounded to float32, so that kernels and oracle clip by the same domain. Raises FirsthitError unless
    lower < upper on every axis, all finite.
    """

    lower: tuple[float, float, float]
    upper: tuple[float, float, float]

    def __post_init__(self) -> None:
        object.__setattr__(self, "lower", tuple(as_float32(c) for c in self.lower))
        object.__setattr__(self, "upper", tuple(as_float32(c) for c in self.upper))
        if not all(
            math.isfinite(a) and math.isfinite(b) and a < b for a, b in zip(self.lower, self.upper, strict=True)
        ):
            raise FirsthitError(f"a box domain needs finite lower < upper on every axis, not {self}")

    @property
    def center(self) -> tuple[float, float, float]:
        """Return the middle, rounded to float32."""
        x, y, z = (as_float32(0.5 * (a + b)) for a, b in zip(self.lower, self.upper, strict=True))
        return (x, y, z)

    @property
    def radius(self) -> float:
        """Return half the diagonal, which is the radius of the bounding sphere about `center`."""
        return 0.5 * math.dist(self.lower, self.upper)


Domain = Sphere | Box


@dataclass(frozen=True)
class Surface:
    """Define an implicit surface f(x, y, z) = 0 in its domain; all else is derived from the formula.

    What is stated beside the formula (`degree`, `distance`, `facts`) is recomputed by tests. `bounding_radius` is that
    of a sphere about the domain's centre that holds the surface; None where no better one than the domain's is known.
    """

    name: str
    title: str
    formula: str  # in the formula language of surfaces.formula
    domain: Domain
    source: str
    degree: int | None  # total degree in x, y, z; None where f is not a polynomial
    parameters: tuple[tuple[str, str], ...] = ()  # name, exact decimal: ("R", "0.7")
    distance: str | None = None  # a formula of the exact signed distance; None: not known
    bounding_radius: float | None = None
    feature_radius: float | None = None  # the length papers relate errors to (torus: minor radius r)
    facts: tuple[tuple[str, Any], ...] = ()  # what tests recompute: ("singular_points", 50), ...

    @property
    def algebraic(self) -> bool:
        """Return whether f is a polynomial."""
        return self.degree is not None

    @property
    def base(self) -> str:
        """Return the name without a form's: `chmutov` of `chmutov:nested`."""
        return self.name.partition(":")[0]

    @property
    def identity(self) -> dict[str, object]:
        """Return what decides the surface's values, for cache keys."""
        return {"formula": self.formula, "parameters": dict(self.parameters), "domain": repr(self.domain)}
