"""Define what a surface is: a formula in a domain. This module imports nothing else of the project.

Lengths are in scene units, the surface's own coordinates.
"""

from __future__ import annotations

import contextlib
import math
import struct
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from numbers import Real
from typing import Any, TypeGuard


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


def is_number(value: object) -> TypeGuard[float]:
    """Say whether a value is a real number, of Python's or of numpy's kinds. True and False are none."""
    return isinstance(value, Real) and not isinstance(value, bool)


def beginning(value: object, most: int = 40, how: Callable[[object], str] = str) -> str:
    """Write the first `most` letters of a value for a message; Python writes no numbers of thousands of digits."""
    try:
        text = how(value)
    except ValueError:
        return "a number of thousands of digits"
    return text if len(text) <= most else f"{text[:most]}..."


def _rounded(value: object, what: str) -> float:
    """Round a number of a domain to float32. Raises FirsthitError for what is none, or past the range of float32."""
    if not is_number(value):
        raise FirsthitError(f"{what} is a number, not {value!r}")
    try:
        return as_float32(float(value))
    except OverflowError:
        raise FirsthitError(f"{what} {beginning(value)} is past the range of float32; scale the formula") from None


def _point(values: object, what: str) -> tuple[float, float, float]:
    """Round three coordinates to float32. Raises FirsthitError where `values` is anything else."""
    if isinstance(values, str) or not isinstance(values, Iterable) or len(numbers := tuple(values)) != 3:
        raise FirsthitError(f"{what} is three numbers, as in (0, 0, 1), not {values!r}")
    x, y, z = numbers
    return _rounded(x, f"{what}'s x"), _rounded(y, f"{what}'s y"), _rounded(z, f"{what}'s z")


@dataclass(frozen=True)
class Sphere:
    """Define a ball. Its numbers are rounded to float32, so that kernels and oracle clip by the same domain.

    Raises FirsthitError unless the radius is positive and the centre three numbers, all within the range of float32.
    """

    radius: float
    center: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        object.__setattr__(self, "radius", _rounded(self.radius, "a sphere's radius"))
        object.__setattr__(self, "center", _point(self.center, "a sphere's centre"))
        if not (math.isfinite(self.radius) and self.radius > 0.0 and all(map(math.isfinite, self.center))):
            raise FirsthitError(f"a sphere domain needs a positive radius and a finite centre, not {self}")


@dataclass(frozen=True)
class Box:
    """Define an axis-aligned box.

    Its numbers are rounded to float32, so that kernels and oracle clip by the same domain. Raises FirsthitError unless
    lower < upper on every axis, all within the range of float32.
    """

    lower: tuple[float, float, float]
    upper: tuple[float, float, float]

    def __post_init__(self) -> None:
        object.__setattr__(self, "lower", _point(self.lower, "a box's lower corner"))
        object.__setattr__(self, "upper", _point(self.upper, "a box's upper corner"))
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


def domain_text(domain: Domain) -> str:
    """Return the text of a domain, as `surfaces.from_formula` takes it; it reads back as the same domain."""
    if isinstance(domain, Sphere):
        center = [_point_text(domain.center)] if any(domain.center) else []
        return ":".join(["sphere", *center, _number_text(domain.radius)])
    if all(-a == b for a, b in zip(domain.lower, domain.upper, strict=True)):
        return f"box:{_point_text(domain.upper)}"
    return f"box:{_point_text(domain.lower)}:{_point_text(domain.upper)}"


def _point_text(point: tuple[float, float, float]) -> str:
    return ",".join(map(_number_text, point))


def _number_text(value: float) -> str:
    """Return the shortest decimal that float32 rounds to this number of a domain."""
    for digits in range(1, 9):
        text = f"{value:.{digits}g}"
        with contextlib.suppress(OverflowError):
            if as_float32(float(text)) == value:  # 1e+01 is written 10
                return f"{value:.0f}" if "e+" in text and abs(value) < 1e6 else text
    return f"{value:.9g}"


@dataclass(frozen=True)
class Surface:
    """Define an implicit surface f(x, y, z) = 0 in its domain; all else is derived from the formula.

    What is stated beside the formula (`degree`, `distance`, `facts`) is recomputed by tests. `distance` is any function
    of f's sign whose absolute value is nowhere in the domain greater than the distance to the surface: a step of its
    length passes no root. `bounding_radius` is that of a sphere about the domain's centre that holds the surface; None
    where no better one than the domain's is known.
    """

    name: str
    title: str
    formula: str  # in the formula language of surfaces.formula
    domain: Domain
    source: str
    degree: int | None  # total degree in x, y, z; None where f is not a polynomial
    parameters: tuple[tuple[str, str], ...] = ()  # name, exact decimal: ("R", "0.7")
    distance: str | None = None  # a formula of a bound of the distance; f itself where that is one; None: not known
    bounding_radius: float | None = None
    feature_radius: float | None = None  # the length papers relate errors to (torus: minor radius r)
    group: str | None = None  # "catalog", or the gallery's group that it is in; None of a formula of one's own
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
