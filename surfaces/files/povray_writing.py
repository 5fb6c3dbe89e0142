"""Write surfaces as POV-Ray scenes, which `povray` reads: poly for polynomials up to degree 35, else an isosurface."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from surfaces import formula, lowering
from surfaces.evaluation import gradient, tape_of
from surfaces.files.expressions import Text, call, word
from surfaces.files.monomials import Powers, order_of
from surfaces.files.wording import Povray, titled, written
from surfaces.model import Box, Domain, FirsthitError, Surface
from surfaces.numbers import Arithmetic
from surfaces.tape import Tape, walk

MAX_ORDER = 35  # of poly, in POV-Ray 3.7
MAX_TERMS = 10_000  # of a polynomial that is being expanded; of degree 35 there are 8,436
_NEGLIGIBLE = 2**-200  # what rounded constants leave of a coefficient that is 0, over the largest
_SAMPLES = 4096
_SCENE = """camera {{ location <{eye}> look_at <{at}> angle 40 }}
light_source {{ <{light}> rgb 1 }}
background {{ rgb 1 }}
"""
_LOOK = "pigment {{ rgb <0.9, 0.6, 0.2> }}"


class Polynomials(Arithmetic):
    """Run a real tape in polynomials with rational coefficients."""

    def __init__(self) -> None:
        import flint

        self.flint = flint
        self.context = flint.fmpq_mpoly_ctx.get(("x", "y", "z"), "lex")

    def const(self, value: Fraction) -> Any:
        return self.context.constant(self.flint.fmpq(value.numerator, value.denominator))

    def mul(self, a: Any, b: Any) -> Any:
        """Multiply. Raises FirsthitError where the product has too many terms."""
        product = a * b
        if len(product) > MAX_TERMS:
            raise FirsthitError(f"expanded, it has more than {MAX_TERMS} terms")
        return product

    def sqr(self, a: Any) -> Any:
        return self.mul(a, a)

    def div(self, a: Any, b: Any) -> Any:
        return a * (1 / b.leading_coefficient())


def coefficients(tape: Tape) -> dict[Powers, Fraction]:
    """Return the coefficients of a polynomial's terms that are not 0; irrational constants are rounded to 320 bits."""
    numbers = Polynomials()
    axes = dict(zip("xyz", numbers.context.gens(), strict=True))
    (expanded,) = walk(lowering.real_tape(tape), numbers, axes)
    found = {tuple(map(int, powers)): Fraction(int(c.p), int(c.q)) for powers, c in expanded.to_dict().items()}
    largest = max(map(abs, found.values()), default=Fraction(0))
    return {(i, j, k): c for (i, j, k), c in found.items() if abs(c) > largest * Fraction(_NEGLIGIBLE)}


def text_of(surface: Surface) -> str:
    """Return a scene of a surface. Raises FirsthitError where POV-Ray has no words for it."""
    tape = tape_of(surface)
    head = "".join(f"// {line}\n" for line in titled(surface)) + "#version 3.7;\n" + _scene(surface.domain)
    if formula.is_polynomial(tape) and surface.degree is not None and surface.degree <= MAX_ORDER:
        return head + _poly(surface, tape)
    return head + _isosurface(surface, tape)


def _poly(surface: Surface, tape: Tape) -> str:
    """Return a poly, whose coefficients are the doubles next to the exact ones."""
    order = max(2, surface.degree or 0)
    found = coefficients(tape)
    rows: list[list[str]] = []
    last = None
    for powers in order_of(order):
        if powers[:1] != last:
            rows.append([])
            last = powers[:1]
        value = found.get(powers, Fraction(0))
        rows[-1].append(repr(value.numerator / value.denominator) if value else "0")
    lines = ",\n    ".join(", ".join(row) for row in rows)
    clip = f"  clipped_by {{ {_region(surface.domain)} }}\n"
    return f"poly {{\n  {order},\n  < {lines} >\n  sturm\n{clip}  {_LOOK.format()}\n}}\n"


def _isosurface(surface: Surface, tape: Tape) -> str:
    """Return an isosurface. Values that are used again are functions of their own."""
    declared: list[str] = []

    def name(value: Text) -> Text:
        declared.append(f"#declare V{len(declared) + 1} = function(x, y, z) {{ {value} }}\n")
        return call(f"V{len(declared)}", *map(word, "xyz"))

    value = written(tape, Povray(), name)
    steep = _steepness(surface)
    return (
        f"{''.join(declared)}isosurface {{\n  function {{ {value} }}\n  contained_by {{ {_region(surface.domain)} }}\n"
        f"  max_gradient {steep:.4g} // the largest of {_SAMPLES} samples, and half as much again\n  open\n"
        f"  {_LOOK.format()}\n}}\n"
    )


def _steepness(surface: Surface) -> float:
    """Return 1.5 times the largest length of the gradient at random points of the domain."""
    import numpy as np

    domain = surface.domain
    sides = np.random.default_rng(0).uniform(-1.0, 1.0, (_SAMPLES, 3))
    half = np.subtract(domain.upper, domain.lower) / 2 if isinstance(domain, Box) else domain.radius
    with np.errstate(all="ignore"):
        lengths = np.linalg.norm(gradient(surface, np.asarray(domain.center) + sides * half), axis=1)
    return 1.5 * float(np.max(lengths[np.isfinite(lengths)], initial=1e-3))


def _region(domain: Domain) -> str:
    """Return a domain as POV-Ray writes it."""
    if isinstance(domain, Box):
        return f"box {{ <{_triple(domain.lower)}>, <{_triple(domain.upper)}> }}"
    return f"sphere {{ <{_triple(domain.center)}>, {domain.radius:.9g} }}"


def _scene(domain: Domain) -> str:
    """Return a camera and a light for a domain."""
    x, y, z = domain.center
    far = 3.2 * domain.radius
    return _SCENE.format(
        eye=f"{x + 0.4 * far:.4g}, {y + 0.5 * far:.4g}, {z - 0.77 * far:.4g}",
        at=f"{x:.4g}, {y:.4g}, {z:.4g}",
        light=f"{x + far:.4g}, {y + 2.0 * far:.4g}, {z - 2.0 * far:.4g}",
    )


def _triple(point: tuple[float, float, float]) -> str:
    return ", ".join(f"{value:.9g}" for value in point)
