"""Define implicit surfaces: the catalog, formulas of one's own, and what is derived from them.

    import surfaces
    torus = surfaces.get("torus", R="0.5")
    nested = surfaces.get("chmutov:nested")  # the same polynomial, written in another way
    mine = surfaces.from_formula("x^2 + y^2*z^3 - z^4", "sphere:1.5")
    values = surfaces.evaluate(mine, points)  # float64[n, 3] → float64[n]

This is the ground: it imports nothing else of the project. `model` says what a surface is. `catalog`, `families` and
`forms` hold the surfaces of the papers, `gallery` others of the literature, all written by means of `entries`.
`formula` parses text into a `tape`, by means of the package `language`. `numbers` runs tapes in several number systems,
and `lowering` turns them into other tapes: derivatives, coefficients along a ray. `evaluation` computes values.
`proofs` shows of a formula of one's own that it is defined all over its domain, whether it is a distance bound, and how
it lies in its domain. `files` reads and writes the formats of other programs.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from importlib import import_module
from typing import TYPE_CHECKING, Any

from surfaces.entries import CATALOG
from surfaces.forms import FORMS, SEPARATOR
from surfaces.model import Box, Domain, FirsthitError, Sphere, Surface, beginning, is_number
from surfaces.words import name_problem, suggestion

if TYPE_CHECKING:
    from surfaces.evaluation import evaluate, expression, gradient, operations, tape_of

AUTO = "auto"  # the domain that is found
LONGEST_NUMBER = 10_000  # bits of a whole number that is given; Python writes none of more than 14,000
_EVALUATION = ("evaluate", "expression", "gradient", "operations", "tape_of")
__all__ = [
    "AUTO",
    "Reading",
    "canonical",
    "evaluate",
    "expression",
    "forms_of",
    "from_formula",
    "get",
    "gradient",
    "groups",
    "names",
    "operations",
    "reading",
    "tape_of",
]
GALLERY = "gallery"  # all groups but the catalog


def __getattr__(name: str) -> Any:
    """Return a function of surfaces.evaluation, or surfaces.files, which are imported when they are first asked for.

    Raises AttributeError for any other name.

    It needs numpy; harness.contract, and with it every command, imports this package for surfaces.model alone.
    """
    if name in _EVALUATION:
        return getattr(import_module("surfaces.evaluation"), name)
    if name == "files":
        return import_module("surfaces.files")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


@dataclass(frozen=True)
class Reading:
    """Hold how a surface's formula was read: as written, its canonical form, and notes, each a phrase for the user."""

    written: str
    canonical: str
    notes: tuple[str, ...]

    def told(self, most: int = 400) -> list[str]:
        """Return lines for the user: the canonical form, cut at `most` characters, if it is not what was written."""
        shown = self.canonical if len(self.canonical) <= most else f"{self.canonical[:most]} ..."
        same = "".join(self.written.split()) == "".join(self.canonical.split())
        return [*([] if same else [f"read as: {shown}"]), *(f"note: {note}" for note in self.notes)]


def canonical(surface: Surface) -> str:
    """Return a surface's formula in the language's primitives, without parameters; it reads back as the same graph."""
    from surfaces import formula

    return formula.canonical(formula.parse(surface.formula, dict(surface.parameters)))


def reading(surface: Surface) -> Reading:
    """Return how a surface's formula was read."""
    from surfaces import formula

    notes = formula.reading(surface.formula, dict(surface.parameters)).notes
    return Reading(surface.formula, canonical(surface), notes)


def names(group: str = CATALOG) -> tuple[str, ...]:
    """Return all names of a group, sorted, without those of forms: of the catalog, unless `group` says otherwise.

    `group` is "catalog", "gallery" for all of the gallery, or one of the gallery's groups. Raises FirsthitError for
    any other.
    """
    if group == CATALOG:
        from surfaces.catalog import FIXED
        from surfaces.families import FAMILIES

        return tuple(sorted((*FAMILIES, *(surface.name for surface in FIXED))))
    from surfaces.gallery import GROUPS

    if group == GALLERY:
        return tuple(sorted(surface.name for known in GROUPS.values() for surface in known.surfaces))
    if group not in GROUPS:
        raise FirsthitError(f"there is no group {group!r}; {suggestion(group, (CATALOG, GALLERY, *GROUPS))}")
    return tuple(sorted(surface.name for surface in GROUPS[group].surfaces))


def groups() -> dict[str, str]:
    """Return what the surfaces of each group have in common, by the group's name: the catalog, then the gallery's."""
    from surfaces.gallery import GROUPS

    return {CATALOG: "The surfaces of the papers, and hard ones with singular points"} | {
        name: group.title for name, group in GROUPS.items()
    }


def forms_of(name: str) -> tuple[str, ...]:
    """Return the names of a catalog surface's other forms, as `get` takes them: `("chmutov:nested", …)`."""
    return tuple(f"{name}{SEPARATOR}{form}" for form in FORMS.get(name, ()))


def get(name: str, **parameters: str | float) -> Surface:
    """Return a surface of the catalog or the gallery, or one of its forms, with the parameters given.

    As in `get("torus", R="0.5")`.

    A parameter that is a number, of Python's or numpy's kinds, is taken as the decimal that it prints. Raises
    FirsthitError for an unknown name, with the nearest names, and for an unknown form or parameter or a value that is
    no decimal.
    """
    if not isinstance(name, str):
        raise FirsthitError(f"a surface's name is a text, as in 'torus', not {name!r}")
    name, _, form = name.partition(SEPARATOR)
    surface = _as_printed(name, parameters)
    if not form:
        return surface
    if form not in FORMS.get(name, {}):
        raise FirsthitError(f"surface {name!r} has no form {form!r}; {suggestion(form, FORMS.get(name, {}))}")
    title, written = f"{surface.title}, {form}", FORMS[name][form]
    return replace(surface, name=f"{name}{SEPARATOR}{form}", title=title, formula=written)


def _as_printed(name: str, parameters: Mapping[str, str | float]) -> Surface:
    """Return a surface of the catalog or of the gallery as its source writes it. Raises FirsthitError as `get`."""
    from surfaces.catalog import FIXED
    from surfaces.families import FAMILIES
    from surfaces.gallery import GROUPS

    if name not in names() and name not in names(GALLERY):
        hint = suggestion(name, (*names(), *names(GALLERY)), most=3, otherwise="see `firsthit list surfaces`")
        raise FirsthitError(f"there is no surface {name!r}; {hint}")
    known = FAMILIES[name][2] if name in FAMILIES else {}
    for key in parameters:
        if key not in known:
            told = suggestion(key, known) if known else "it takes none"
            raise FirsthitError(f"surface {name!r} has no parameter {key!r}; {told}")
    if name not in FAMILIES:
        hung = (surface for group in GROUPS.values() for surface in group.surfaces)
        return next(surface for surface in (*FIXED, *hung) if surface.name == name)
    title, make, defaults = FAMILIES[name]
    return make(name, title, defaults | _decimals(parameters))


def from_formula(
    text: str,
    domain: str | Domain = "sphere:1.5",
    name: str = "formula",
    parameters: Mapping[str, str | float] | None = None,
    distance: str | None = None,
) -> Surface:
    """Return the surface of a formula in the language of surfaces.formula.

    `parameters` are numbers or formulas of constants, as "1/3" and "sqrt(2)". `domain` is "sphere:R", "sphere:x,y,z:R"
    about another centre, "box:a,b,c" with half extents, "box:x0,y0,z0:x1,y1,z1", a Sphere or a Box, or "auto": a box
    that is proved to hold the whole surface (surfaces.proofs.extent). `distance` is a formula as Surface.distance
    describes it, with the same parameters; it is tested where it is used (harness.oracle.stated_distance). Without it,
    f is the distance where that can be proved (surfaces.proofs.lipschitz).

    Raises FirsthitError if the text is no formula, the domain is none, a parameter no constant or in no formula, if f
    does not depend on x, y and z, if f or the distance cannot be shown to be defined all over the domain, or if no
    domain is found.
    """
    if not isinstance(name, str) or (problem := name_problem(name)):
        raise FirsthitError(f"a surface's name: {problem if isinstance(name, str) else 'it is a text'}")
    if not isinstance(text, str):
        raise FirsthitError(f"a formula is a text, as in 'x^2 + y^2 + z^2 - 1', not {text!r}")
    from surfaces import formula
    from surfaces.proofs.extent import held_by
    from surfaces.proofs.lipschitz import is_distance
    from surfaces.proofs.validity import check, check_constants, undefined

    bound = _texts(parameters or {})
    found = formula.reading(text, bound)
    stated = None if distance is None else formula.reading(distance, bound)
    used = found.used | (stated.used if stated else frozenset())
    if unused := sorted(bound.keys() - used):
        hint = suggestion(unused[0], sorted(used), otherwise=f"its parameters are {', '.join(sorted(used))}")
        raise FirsthitError(f"no {unused[0]!r} occurs in the formula; {hint if used else 'it has no parameters'}")
    check_constants(name, found.tape)
    degree, line = formula.degree(found.tape), " ".join(text.split())
    surface = Surface(
        name=name,
        title=line if len(line) <= 60 else line[:57] + "...",
        formula=text,
        domain=held_by(found.tape) if domain == AUTO else _domain(domain),
        source="given as a formula",
        degree=degree,
        parameters=tuple(sorted(bound.items())),
    )
    check(surface)
    if distance is None:
        return replace(surface, distance=text) if is_distance(found.tape, surface.domain) else surface
    assert stated is not None
    check_constants(f"{name}'s distance", stated.tape)
    if problem := undefined(stated.tape, surface.domain):
        raise FirsthitError(f"{name}'s distance: {problem}")
    return replace(surface, distance=distance)


def _decimals(values: Mapping[str, str | float]) -> dict[str, str]:
    """Return parameters as rational numbers' texts. Raises FirsthitError for a value that is none."""
    from surfaces import formula

    texts = _texts(values)
    for name, text in texts.items():
        try:
            formula.exact(text)
        except FirsthitError as error:
            raise FirsthitError(f"parameter {name}: {error}") from None
    return texts


def _texts(values: Mapping[str, str | float]) -> dict[str, str]:
    """Return parameters as texts. Raises FirsthitError for a value that is neither a number nor a text."""
    for name, value in values.items():
        if not isinstance(value, str) and not is_number(value):
            raise FirsthitError(f"parameter {name} is a number or the text of a constant, not {value!r}")
        if isinstance(value, int) and value.bit_length() > LONGEST_NUMBER:
            raise FirsthitError(f"parameter {name} is {beginning(value)}")
    return {name: str(value).strip() for name, value in values.items()}


def _domain(text: str | Domain) -> Domain:
    """Return a domain, or the one that a text describes. Raises FirsthitError if it describes none."""
    from surfaces import formula

    if isinstance(text, Domain):
        return text
    if not isinstance(text, str):
        raise FirsthitError(f"a domain is a text, as in 'sphere:1.5', a Sphere or a Box, not {text!r}")
    kind, *groups = (part.strip() for part in text.split(":"))
    numbers = [[float(formula.exact(item.strip())) for item in group.split(",")] for group in groups]
    match kind, numbers:
        case "sphere", [[radius]]:
            return Sphere(radius)
        case "sphere", [[x, y, z], [radius]]:
            return Sphere(radius, (x, y, z))
        case "box", [[a, b, c]]:
            return Box((-a, -b, -c), (a, b, c))
        case "box", [[x0, y0, z0], [x1, y1, z1]]:
            return Box((x0, y0, z0), (x1, y1, z1))
    raise FirsthitError(f"domain {text!r}: write sphere:R, sphere:x,y,z:R, box:a,b,c, box:x0,y0,z0:x1,y1,z1 or auto")
