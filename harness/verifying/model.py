"""State what checking rows again finds, and read from a row what it is of."""

from __future__ import annotations

import ast
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from harness.contract import Box, Domain, FirsthitError, Sphere, Surface, View

OF_A_ROW = "a row"  # the source of a surface that the catalog here has not


@dataclass(frozen=True)
class Wrong:
    """Say that one value of a row does not hold.

    figure: where it stands in the row, as `accuracy.error.max`
    stored: what the row says; found: what follows from the rest of it
    """

    figure: str
    stored: Any
    found: Any


class CannotTell(Exception):
    """Say why a check says nothing of a row; no fault of the row."""


def differing(figure: str, stored: Any, found: Any, slack: float = 0.0) -> Iterator[Wrong]:
    """Yield a Wrong where two values differ, by more than the share `slack` if they are numbers."""
    if _is_real(stored) and _is_real(found):
        holds = stored == found or math.isclose(stored, found, rel_tol=slack, abs_tol=0.0)
        holds = holds or (math.isnan(stored) and math.isnan(found))
    else:
        holds = type(stored) is type(found) and stored == found
    if not holds:
        yield Wrong(figure, stored, found)


def _is_real(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def surface_of(row: Mapping[str, Any]) -> Surface:
    """Return the surface that a row's identity states, with the lengths that its errors are told over.

    These are the catalog's where it has the same surface. Raises CannotTell where the identity names none, and
    FirsthitError where it names something that is no surface.
    """
    import surfaces

    stated = row["identity"].get("surface")
    if not isinstance(stated, dict) or "domain" not in stated:
        raise CannotTell("its identity names no surface")
    try:
        pairs = tuple(sorted((str(name), str(value)) for name, value in stated["parameters"].items()))
        domain = _domain(stated["domain"])
        surface = Surface(str(row["surface"]), "", str(stated["formula"]), domain, OF_A_ROW, row["degree"], pairs)
    except (KeyError, TypeError, ValueError, SyntaxError, AttributeError, RecursionError, MemoryError) as error:
        raise FirsthitError(f"its identity's surface is none: {error}") from None
    try:
        known = surfaces.get(surface.name)
    except FirsthitError:
        return surface
    return known if known.identity == surface.identity else surface


def is_known(surface: Surface) -> bool:
    """Tell whether a surface that `surface_of` returned is the catalog's, so that its lengths are known."""
    return surface.source != OF_A_ROW


def _domain(text: str) -> Domain:
    """Read a domain from its repr, as identities hold it. Raises ValueError or SyntaxError for other text."""
    call = ast.parse(text, mode="eval").body
    kinds: dict[str, type[Sphere] | type[Box]] = {"Sphere": Sphere, "Box": Box}
    if not isinstance(call, ast.Call) or not isinstance(call.func, ast.Name) or call.func.id not in kinds or call.args:
        raise ValueError(f"{text[:80]!r} is no domain")
    return kinds[call.func.id](**{str(word.arg): ast.literal_eval(word.value) for word in call.keywords})


def view_of(row: Mapping[str, Any]) -> View:
    """Return the view that a row's identity states. Raises CannotTell where it states none."""
    stated = row["identity"].get("view")
    if not isinstance(stated, dict):
        raise CannotTell("its identity names no view")
    try:
        target = stated.get("target")
        return View(**stated | {"target": None if target is None else tuple(target)})
    except TypeError as error:
        raise FirsthitError(f"its identity's view is none: {error}") from None
