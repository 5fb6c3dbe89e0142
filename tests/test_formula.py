"""The formula language: what it means, what it refuses and how, and that nothing breaks or hangs it."""

from __future__ import annotations

import os
from fractions import Fraction

import flint
import mpmath
import pytest
import sympy
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import surfaces
from harness.contract import Box, FirsthitError, Sphere
from surfaces import formula
from surfaces.formula import degree, expression, parse
from surfaces.numbers import Balls
from surfaces.tape import walk

FUNCTIONS = ("sqrt", "exp", "log", "sin", "cos", "tan", "abs", "min", "max")
FUZZ = int(os.environ.get("FIRSTHIT_FUZZ", "1"))  # times as many formulas; 40 take about a minute

X, Y, Z = formula.X, formula.Y, formula.Z
MEANINGS = [
    ("-x^2", -(X**2)),
    ("2^3^2*x", 512 * X),
    ("x**2**1", X**2),
    ("x - y - z", X - Y - Z),
    ("x/2/4", X / 8),
    ("-2^2*x", -4 * X),
    ("2^-3 + x", X + sympy.Rational(1, 8)),
    ("- - x", X),
    ("x*-y", -X * Y),
    ("0.3*x", sympy.Rational(3, 10) * X),
    ("1e-3*x + .5", X / 1000 + sympy.Rational(1, 2)),
    ("phi*x", (1 + sympy.sqrt(5)) / 2 * X),
    ("sqrt2*x + sqrt7", sympy.sqrt(2) * X + sympy.sqrt(7)),
    ("e^x", sympy.exp(X)),
    ("pi*exp(x) + log(y) - tan(z)", sympy.pi * sympy.exp(X) + sympy.log(Y) - sympy.tan(Z)),
    ("sin(x)*cos(y) + sqrt(z)", sympy.sin(X) * sympy.cos(Y) + sympy.sqrt(Z)),
    ("1/(2 + x)", 1 / (2 + X)),
    ("x^-2", X**-2),
    ("a*x + b^2", sympy.Rational(1, 10) * X + 4),
    ("((((x))))", X),
    ("x\n + y", X + Y),
]


@pytest.mark.parametrize(("text", "meaning"), MEANINGS, ids=[text for text, _ in MEANINGS])
def test_meaning(text: str, meaning: sympy.Expr) -> None:
    assert sympy.expand(expression(parse(text, {"a": "0.1", "b": "-2"})) - meaning) == 0


def test_extremes_and_absolute_values_keep_their_meaning() -> None:
    value = expression(parse("max(x, y, 2) + min(x, -1) + abs(z)"))
    assert value.subs({X: 1, Y: 3, Z: -4}) == 3 - 1 + 4


def test_numbers_are_exact() -> None:
    assert formula.exact("0.1") == Fraction(1, 10)
    assert formula.exact("-12.50e-2") == Fraction(-1, 8)


REFUSALS = [
    ("", 1, "found the end"),
    ("x +", 4, "found the end"),
    ("(x", 3, "expected ')'"),
    ("x)", 2, "without its '('"),
    ("x, y", 2, "without its '('"),
    ("|x", 3, "expected '|'"),
    ("sin x", 1, "write sin(...)"),
    ("sin²(x)", 1, "write sin(...)^2"),
    ("sin(x, y)", 1, "takes one value, not 2"),
    ("mod(x)", 1, "takes 2 values, not 1"),
    ("atan(x, y, z)", 1, "takes 1 or 2 values, not 3"),
    ("min(x)", 1, "two values"),
    ("x + sqr_t(y)", 5, "did you mean 'sqrt'"),
    ("rho*x", 1, "unknown name 'rho'"),
    ("4(τ²x² - y²)", 3, "write phi or 2*pi"),
    ("x - w", 5, "a parameter needs a value: --parameter w=1, or w = 1; before the formula"),
    (r"\frac{x}{2}", 1, r"no LaTeX; write (a)/(b) for \frac{a}{b}"),
    ("y + xsin(y)", 5, "did you mean x*sin(...)?"),
    ("x.^2", 2, "operators have no dot"),
    ("x^{2}", 3, "write ( ) around parts"),
    ("x2 + y", 1, "did you mean x^2 or 2*x?"),
    ("1/2x", 4, "write /2*x or /(2*x)"),
    ("x/2 (y + z)", 5, "two ways"),
    ("1/xy", 3, "write /(x*y) or /x*y"),
    ("z^xy", 3, "two ways"),
    ("e^2x", 4, "two ways"),
    ("√2x", 3, "write √(...)"),
    ("2 3", 3, "write 2*3"),
    ("x 2", 3, "write * for a product or ^ for a power"),
    ("x²^2", 3, "needs parentheses"),
    ("|x|y|z|", 5, "two ways"),
    ("0 < x < 1 ? x : y", 7, "a chain of comparisons"),
    ("x < 1", 3, "describes a solid"),
    ("x = y = z", 7, "one '='"),
    ("if(x = 0, y, z)", 6, "write == to compare"),
    ("x + d; d = 2", 1, "only the last statement"),
    ("d = 2", 1, "only defines a name"),
    ("f(x, y, z) = x^2 - 1", 1, "only defines a name"),
    ("a = b; b = 2; a*x", 5, "defined later"),
    ("f(u) = f(u - 1); f(x)", 8, "defined later or by itself"),
    ("a = 1; a = 2; a*x", 8, "two definitions of 'a'"),
    ("f(u, u) = u; f(x, y)", 6, "two arguments"),
    ("z = x^2; z + y", 1, "'z' cannot be defined"),
    ("x.real", 2, "U+002E"),
    ("x.__class__", 2, "U+002E"),
    ("'x'", 1, "U+0027"),
    ("__import__(x)", 1, "unknown function"),
    ("lambda: x", 1, "unknown name"),
    ("x[0]", 2, "U+005B"),
    ("x /* y", 3, "no end"),
    ("𝑥 + 1", 1, "U+1D465"),
    ("x;y", 1, "only the last statement"),
    ("x\x00", 2, "U+0000"),
    ("9^9^9 + x", 2, "bits"),
    ("9^9^9^9^9 + x", 6, "bits"),
    ("((x^8)^8)^8", 10, "degree is past 64"),
    ("(x + 1)^100000", 8, "degree is past 64"),
    ("x^40*y^40", 5, "degree here is past 64"),
    ("exp(x)^65", 7, "degree is past 64"),
    ("abs(x)^64.5", 7, "degree is past 64"),
    ("(-2)^x", 5, "needs a base above 0"),
    ("x*(-8)^(1/3)", 7, "cbrt(a)"),
    ("x/0", 2, "division by zero"),
    ("x/(2 - 2)", 2, "division by zero"),
    ("x % 0", 3, "division by zero"),
    ("x*0^-1", 4, "division by zero"),
    ("1" * 1000 + "*x", 1, "a number of 1000 characters"),
    ("x + " + "x" * 1000000, 5, "a name of 1000000 characters"),
    ("x" + "²" * 1000, 2, "a number of 1000 characters"),
    ("x" + "²" * 50, 2, "degree is past 64"),
    ("1e999*x", 1, "range of float64"),
    ("1e-999*x", 1, "range of float64"),
    ("2^900*2^900*x", 6, "bits"),
    ("(" * 300 + "x" + ")" * 300, 201, "nested"),
    ("-" * 500 + "x", 201, "nested"),
    ("x" + "^1" * 500, 401, "nested"),
    ("sqrt(" * 300 + "x", 501, "nested"),
    ("|1 - " * 300 + "x", 501, "nested"),
    ("f(x) = " + "(" * 300 + "; f(x)", 208, "nested"),
]


@pytest.mark.timeout(60)
@pytest.mark.parametrize(("text", "column", "reason"), REFUSALS, ids=[repr(text[:20]) for text, _, _ in REFUSALS])
def test_refusal_names_the_column(text: str, column: int, reason: str) -> None:
    with pytest.raises(FirsthitError) as caught:
        parse(text)
    first, shown, caret = str(caught.value).split("\n")
    assert first.startswith(f"formula, column {column}: ") and reason in first
    at = caret.index("^")
    assert shown[at : at + 1] in (text[column - 1 : column], "?")


def test_refusals_in_several_lines_name_the_line() -> None:
    with pytest.raises(FirsthitError, match="formula, line 2, column 3: ") as caught:
        parse("x^2 + # a comment\n  $ + z\n- 1")
    assert str(caught.value).split("\n")[1:] == ["      $ + z", "      ^"]
    with pytest.raises(FirsthitError, match="line 2, column 1: a new line is no operator"):
        parse("x^2\ny^2")


def test_refuses_what_is_too_long_and_bad_parameters() -> None:
    with pytest.raises(FirsthitError, match="2000001 characters"):
        parse("x+" * 1000000 + "x")
    for name in ("x", "and", "a b", "é", ""):
        with pytest.raises(FirsthitError, match="cannot be a parameter's name"):
            parse("x", {name: "1"})
    with pytest.raises(FirsthitError, match="parameter a: 'x' is no constant"):
        parse("x*a", {"a": "x"})


@pytest.mark.timeout(60)
@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("1/x - 2", "divisor must not vanish"),
        ("1/(x^2 + y^2 + z^2 - 1)", "divisor must not vanish"),
        ("log(x^2 + y^2)", "log needs a positive argument"),
        ("sqrt(x) - y", "sqrt needs an argument that is not negative"),
        ("tan(2*x)", "tan must stay off its poles"),
        ("x + log(-1)", "undefined"),
        ("x + sqrt(1 - 2)", "undefined"),
        ("x + 1/(sqrt2^2 - 2)", "undefined"),
        ("x + exp(exp(7e2))", r"2\^1000 or larger"),
        ("x - x", "does not depend"),
        ("1 + 2", "does not depend"),
        ("(x + y)^2 - x^2 - 2*x*y - y^2 + 3", "does not depend"),
        ("sin(2)", "does not depend"),
        ("+".join(f"1/(x - {k})" for k in range(200)), "divisor must not vanish"),
    ],
)
def test_refuses_what_has_no_value_all_over_the_domain(text: str, reason: str) -> None:
    with pytest.raises(FirsthitError, match=reason):
        surfaces.from_formula(text, "sphere:1.5")


@pytest.mark.parametrize(
    "text",
    ["1/(x + 2) - y", "log(3 + x*y)", "sqrt(x^2 + y^2) - 1", "tan(x) - z", "x/(1 + y^2)", "x*sqrt(1.5^2 - y^2/1.01)"],
)
def test_accepts_partial_functions_where_the_domain_allows_them(text: str) -> None:
    assert surfaces.from_formula(text, "sphere:1.5").degree is None


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("x", 1),
        ("x*y*z - 1", 3),
        ("(x^2 + y)^5 - x^10", 9),
        ("(x + y)^3 - (x + y)^2*(x + y) + z", 1),
        ("phi^2*x^4 - (phi + 1)*x^4 + x*y", 2),
        ("(x^2 - sqrt2*y^2)*(x^2 + sqrt2*y^2) - x^4 + 2*y^4 - z", 1),
        ("x^20 + y^19*z", 20),
        ("x/sqrt(2)", 1),
        ("x/y", None),
        ("exp(x)", None),
        ("abs(x)", None),
    ],
)
def test_degree(text: str, expected: int | None) -> None:
    assert degree(parse(text)) == expected


def test_domains() -> None:
    assert surfaces.from_formula("x", "sphere:2").domain == Sphere(2.0)
    assert surfaces.from_formula("x", "box:1,2,3").domain == Box((-1, -2, -3), (1, 2, 3))
    assert surfaces.from_formula("x", " box : 0,0,0 : 1,2,3 ").domain == Box((0, 0, 0), (1, 2, 3))
    for text in (
        "",
        "sphere",
        "sphere:",
        "sphere:-1",
        "sphere:1e300",
        "box:1,2",
        "box:1,1,1:0,2,2",
        "cube:1",
        "sphere:x",
    ):
        with pytest.raises(FirsthitError):
            surfaces.from_formula("x", text)


words = st.sampled_from(
    [*"xyz", *FUNCTIONS, "pi", "e", "phi", "sqrt2", "a", *"+-*/^(),", "**", "2", "0.5", "1e3", " ", "99"]
)


@settings(max_examples=400 * FUZZ, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(st.lists(words, max_size=30).map("".join) | st.text(max_size=40))
def test_any_text_parses_or_is_refused(text: str) -> None:
    try:
        tape = parse(text, {"a": "0.25"})
    except FirsthitError:
        return
    assert tape.outputs


@st.composite
def formulas(draw: st.DrawFn, depth: int = 4) -> str:
    """Well-formed formulas, most of them with a value."""
    if depth == 0 or draw(st.booleans()):
        return draw(st.sampled_from(["x", "y", "z", "a", "1", "0.3", "-2", "phi", "pi", "e", "7e2", "sqrt3"]))
    inner = formulas(depth=depth - 1)
    kind = draw(st.sampled_from(["+", "-", "*", "/", "^", "call", "pair", "sign"]))
    if kind == "^":
        return f"({draw(inner)})^{draw(st.integers(-3, 6))}"
    if kind == "call":
        return f"{draw(st.sampled_from(FUNCTIONS[:-2]))}({draw(inner)})"
    if kind == "pair":
        return f"{draw(st.sampled_from(FUNCTIONS[-2:]))}({draw(inner)}, {draw(inner)})"
    return f"-({draw(inner)})" if kind == "sign" else f"({draw(inner)}) {kind} ({draw(inner)})"


@settings(max_examples=150 * FUZZ, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(formulas())
def test_formulas_become_surfaces_or_are_refused(text: str) -> None:
    """What is accepted has an expression whose values are those of the tape."""
    try:
        surface = surfaces.from_formula(text, "sphere:1.5", parameters={"a": "0.25"})
    except FirsthitError:
        return
    point = {"x": (1, 3), "y": (-1, 5), "z": (2, 7)}
    with flint.ctx.workprec(300):
        variables = {name: flint.arb(flint.fmpq(*value)) for name, value in point.items()}
        walked = walk(surfaces.tape_of(surface), Balls(), variables)[0].str(50, radius=False)
    with mpmath.workdps(60):
        function = sympy.lambdify((X, Y, Z), surfaces.expression(surface), "mpmath")
        built = function(*(mpmath.mpf(p) / q for p, q in point.values()))
        assert abs(mpmath.mpf(walked) - built) <= mpmath.mpf(10) ** -12 * (1 + abs(built))
