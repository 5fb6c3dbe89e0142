"""Write surfaces as other programs read them: .jsurf, POV-Ray, tapes, sympy and GLSL."""

from __future__ import annotations

import re
from collections.abc import Callable
from math import dist

from surfaces import formula
from surfaces.evaluation import tape_of
from surfaces.files import jsurf, povray_writing, vm_writing
from surfaces.files.expressions import Text, word
from surfaces.files.source import FORMS
from surfaces.files.wording import Glsl, Jsurf, Sympy, titled, written
from surfaces.model import FirsthitError, Sphere, Surface
from surfaces.tape import Tape
from surfaces.words import suggestion

MAX_LENGTH = 200_000  # characters of an equation without named parts
SYMPY = {
    "Abs",
    "E",
    "Integer",
    "Max",
    "Min",
    "Piecewise",
    "Rational",
    "atan2",
    "cos",
    "exp",
    "floor",
    "log",
    "pi",
    "sin",
}
SYMPY |= {"sqrt", "tan"}


def export(surface: Surface, form: str) -> str:
    """Return a surface's text in one of FORMS. Raises FirsthitError as surfaces.files.export does."""
    if form not in FORMS:
        raise FirsthitError(f"surfaces are not written as {form!r}; {suggestion(form, FORMS)}")
    writers: dict[str, Callable[[Surface], str]] = {
        "jsurf": as_jsurf,
        "pov": povray_writing.text_of,
        "vm": vm_writing.text_of,
        "sympy": as_sympy,
        "glsl": as_glsl,
    }
    try:
        return writers[form](surface)
    except FirsthitError as error:
        raise FirsthitError(f"{surface.name} cannot be written as {form}: {error}") from None


def as_jsurf(surface: Surface) -> str:
    """Return a .jsurf file. Raises FirsthitError for what is no polynomial, and for a text that is too long."""
    tape = tape_of(surface)
    if not formula.is_polynomial(tape):
        raise FirsthitError("jsurf draws polynomials, and this is none; --as pov takes it")
    if (length := _length(tape)) > MAX_LENGTH:
        raise FirsthitError(f"jsurf has no named parts; written out, the equation has {length} characters or more")
    radius = surface.domain.radius
    if not isinstance(surface.domain, Sphere):
        radius = dist(surface.domain.lower, surface.domain.upper) / 2
    return jsurf.text_of(titled(surface), str(written(tape, Jsurf(), None)), radius, surface.domain.center)


def _length(tape: Tape) -> int:
    """Return about how long a tape is when it is written without named parts, or MAX_LENGTH + 1 where it is longer."""
    lengths: list[int] = []
    for op in tape.ops:
        own = len(str(op.args[0])) if op.name in ("const", "var") else 3
        lengths.append(min(MAX_LENGTH + 1, own + sum(lengths[i] for i in op.inputs)))
    return lengths[tape.outputs[0]]


def as_sympy(surface: Surface) -> str:
    """Return Python text that sets f to the surface's expression."""
    statements: list[str] = []
    value = written(tape_of(surface), Sympy(), _naming(statements, "v{} = {}"))
    lines = [*statements, f"f = {value}"]
    used = sorted({name for line in lines for name in re.findall(r"[A-Za-z][A-Za-z0-9]*", line)} & SYMPY)
    head = [*(f"# {line}" for line in titled(surface)), f"from sympy import {', '.join([*used, 'symbols'])}", ""]
    return "\n".join([*head, 'x, y, z = symbols("x y z", real=True)', *lines]) + "\n"


def as_glsl(surface: Surface) -> str:
    """Return a GLSL function float f(vec3 p), and those that it calls."""
    statements: list[str] = []
    tape = tape_of(surface)
    words = Glsl()
    value = written(tape, words, _naming(statements, "float v{} = {};"))
    powers = sorted({op.args[1] for op in tape.ops if op.name == "powi"} | {2 for op in tape.ops if op.name == "sqr"})
    helpers = [_power_function(n) for n in powers]
    if any(op.name == "atan2" for op in tape.ops):
        helpers.append("float angle(float a, float b) { return a == 0.0 && b == 0.0 ? 0.0 : atan(a, b); }")
    body = ["float x = p.x;", "float y = p.y;", "float z = p.z;", *statements, f"return {value};"]
    head = [f"// {line}" for line in titled(surface)]
    return "\n".join([*head, *helpers, "float f(vec3 p) {", *(f"    {line}" for line in body), "}"]) + "\n"


def _power_function(n: int) -> str:
    """Return a GLSL function for a whole power, by squaring."""
    steps, value, done = [], "a", 1
    for bit in bin(n)[3:]:
        product, done = f"{value} * {value}", 2 * done
        if bit == "1":
            product, done = f"{product} * a", done + 1
        if done < n:
            steps.append(f"float a{done} = {product};")
            value = f"a{done}"
        else:
            steps.append(f"return {product};")
    return f"float power{n}(float a) {{ {' '.join(steps)} }}"


def _naming(statements: list[str], pattern: str) -> Callable[[Text], Text]:
    """Return what names a value by a statement of this pattern, and keeps the statement."""

    def name(value: Text) -> Text:
        statements.append(pattern.format(len(statements) + 1, value))
        return word(f"v{len(statements)}")

    return name
