"""What formulas as people write them mean: values by functions written by hand, and what is told of the reading."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import surfaces
from surfaces import formula
from surfaces.evaluation import evaluate_tape
from surfaces.formula import canonical, parse, reading
from surfaces.language import reading as language_reading
from surfaces.language.names import BUILT_IN
from surfaces.language.prelude import library
from surfaces.lowering import real_tape
from surfaces.model import FirsthitError

Function = Callable[[float, float, float], float]
POINTS = [
    (0.3, -0.4, 0.5),
    (-0.7, 0.25, -0.125),
    (0.0, 0.0, 0.0),
    (1.0, 0.5, -1.0),
    (0.9, -0.9, 0.75),
    (-0.2, -0.6, 1.0),
]
LETTERS = {"a": "1/3", "b": "sqrt(2)", "c": "-2.5", "d": "1e-1", "e": "3", "f": "pi/4"}


def mod(a: float, b: float) -> float:
    return a - b * math.floor(a / b)


# what is written, what it means, where it has values (default: at all POINTS)
MEANINGS: list[tuple[str, Function]] = [
    ("2x^2+y^2+z^2-1", lambda x, y, z: 2 * x * x + y * y + z * z - 1),
    ("2(x+y)z", lambda x, y, z: 2 * (x + y) * z),
    ("3x y", lambda x, y, z: 3 * x * y),
    ("x(y+1)", lambda x, y, z: x * (y + 1)),
    ("(x+1)(y-z)(2)", lambda x, y, z: (x + 1) * (y - z) * 2),
    ("2 x sin(y)cos(z)", lambda x, y, z: 2 * x * math.sin(y) * math.cos(z)),
    ("xy + yz - xyz", lambda x, y, z: x * y + y * z - x * y * z),
    ("xy^2 - 1/(xy + 3)", lambda x, y, z: x * y**2 - 1 / (x * y + 3)),
    ("x^2y + 2^3*x^-0", lambda x, y, z: x * x * y + 8),
    ("x^2+y^2+z^2=9", lambda x, y, z: x * x + y * y + z * z - 9),
    ("4x+3y-2z=12", lambda x, y, z: 4 * x + 3 * y - 2 * z - 12),
    ("x^2 - y = 0", lambda x, y, z: x * x - y),
    ("0 = x^2 - y", lambda x, y, z: -(x * x - y)),
    ("z = x y", lambda x, y, z: z - x * y),
    ("|x|+|y|=5", lambda x, y, z: abs(x) + abs(y) - 5),
    ("|x||y| - 2|z - |x||", lambda x, y, z: abs(x) * abs(y) - 2 * abs(z - abs(x))),
    ("||x| - |y||^2 + |(x|y|)|", lambda x, y, z: (abs(x) - abs(y)) ** 2 + abs(x * abs(y))),
    ("pow(x,2)+pow(y,2)+pow(z,2)-1", lambda x, y, z: x * x + y * y + z * z - 1),
    ("square(x) + cube(y) + sqr(z)", lambda x, y, z: x**2 + y**3 + z**2),
    ("ln(x + 2) + log2(y + 2) + log10(z + 2)", lambda x, y, z: math.log(x + 2) + math.log2(y + 2) + math.log10(z + 2)),
    ("abs(x)^2.5+abs(y)^2.5+abs(z)^2.5-1", lambda x, y, z: abs(x) ** 2.5 + abs(y) ** 2.5 + abs(z) ** 2.5 - 1),
    ("(x+1)^(1/2) + abs(y)^(2/3) - (z+2)^-0.7", lambda x, y, z: (x + 1) ** 0.5 + abs(y) ** (2 / 3) - (z + 2) ** -0.7),
    ("(x^2)^(1/2) + (x^2)^(3/2) + (y^4)^0.25", lambda x, y, z: abs(x) + abs(x) ** 3 + abs(y)),
    ("2^x + exp2(y) - 2**-z", lambda x, y, z: 2**x + 2**y - 2**-z),
    ("(x^2 + 1)^(y z) + e^(x + y)", lambda x, y, z: (x * x + 1) ** (y * z) + math.exp(x + y)),
    ("exp(x)^y + exp(x)^(1/3)", lambda x, y, z: math.exp(x * y) + math.exp(x / 3)),
    ("8^(1/3)*x + 4^-0.5 + 2^sqrt2", lambda x, y, z: 2 * x + 0.5 + 2 ** math.sqrt(2)),
    ("sqrt(x²+y²)−1", lambda x, y, z: math.hypot(x, y) - 1),
    ("x·y + 2×z − x∗y ÷ 4", lambda x, y, z: x * y + 2 * z - x * y / 4),
    ("−z + (x+2)⁻¹ + (y²)¹⁰", lambda x, y, z: -z + 1 / (x + 2) + y**20),
    ("√(x²+1) + √2·y + √3", lambda x, y, z: math.sqrt(x * x + 1) + math.sqrt(2) * y + math.sqrt(3)),
    ("√cos(x) - √(z + 1)²", lambda x, y, z: math.sqrt(math.cos(x)) - (z + 1)),
    ("π x + φ y + ϕ", lambda x, y, z: math.pi * x + (1 + math.sqrt(5)) / 2 * (y + 1)),
    ("atan2(y,x) + atan(z, x)", lambda x, y, z: math.atan2(y, x) + math.atan2(z, x)),
    ("atan(x) + asin(y) + acos(z)", lambda x, y, z: math.atan(x) + math.asin(y) + math.acos(z)),
    ("sinh(x) + cosh(y) + tanh(3z)", lambda x, y, z: math.sinh(x) + math.cosh(y) + math.tanh(3 * z)),
    ("asinh(x) + acosh(y + 3) + atanh(z/2)", lambda x, y, z: math.asinh(x) + math.acosh(y + 3) + math.atanh(z / 2)),
    ("sec(x) + csc(y + 2) + cot(z + 2)", lambda x, y, z: 1 / math.cos(x) + 1 / math.sin(y + 2) + 1 / math.tan(z + 2)),
    ("sign(x) + 2 sign(y)", lambda x, y, z: float(np.sign(x) + 2 * np.sign(y))),
    ("floor(3x) + ceil(3y)", lambda x, y, z: math.floor(3 * x) + math.ceil(3 * y)),
    ("round(3z) - round(x)", lambda x, y, z: math.floor(3 * z + 0.5) - math.floor(x + 0.5)),
    ("trunc(3x) + fract(y)", lambda x, y, z: math.trunc(3 * x) + y - math.floor(y)),
    ("mod(x,1) + y % 0.3 + 2x % 0.75", lambda x, y, z: mod(x, 1) + mod(y, 0.3) + mod(2 * x, 0.75)),
    ("fmod(x, 0.3) + XY - Yx", lambda x, y, z: math.fmod(x, 0.3)),
    ("if(x>0,y,z)", lambda x, y, z: y if x > 0 else z),
    ("if(x>=0,y,z) + (x < y ? 1 : 2)", lambda x, y, z: (y if x >= 0 else z) + (1 if x < y else 2)),
    ("if(x>0 && !(y<z) || z==0.5, x, 7)", lambda x, y, z: x if (x > 0 and not y < z) or z == 0.5 else 7),
    ("if(not x > 0 and (y != z or x ≤ y), x, 7)", lambda x, y, z: x if not x > 0 and (y != z or x <= y) else 7),
    ("if(|x|>0.5 || |y|>0.5, 1, 2)", lambda x, y, z: 1 if abs(x) > 0.5 or abs(y) > 0.5 else 2),
    ("if(x, 1, 2) + if(floor(y) + 1, 3, 4)", lambda x, y, z: (1 if x else 2) + (3 if math.floor(y) + 1 else 4)),
    ("x > 0 ? y > 0 ? 1 : 2 : 3", lambda x, y, z: (1 if y > 0 else 2) if x > 0 else 3),
    ("clamp(2x, -1, 0.5) + saturate(y)", lambda x, y, z: min(max(2 * x, -1), 0.5) + min(max(y, 0), 1)),
    ("mix(x, y, z) + step(x, y)", lambda x, y, z: x + (y - x) * z + (y >= x)),
    ("smoothstep(-1, 1, x)", lambda x, y, z: ((x + 1) / 2) ** 2 * (3 - (x + 1))),
    ("length(x,y,z) + length(x, y)", lambda x, y, z: math.hypot(x, y, z) + math.hypot(x, y)),
    ("length(x, y, z, 2) + length(x)", lambda x, y, z: math.hypot(x, y, z, 2) + abs(x)),
    ("hypot(x, y) + norm(x, y, z)", lambda x, y, z: math.hypot(x, y) + math.hypot(x, y, z)),
    ("dot(x, y, z, 1, 2, 3) + dot(x, y, y, z)", lambda x, y, z: x + 2 * y + 3 * z + x * y + y * z),
    ("cbrt(x) + cbrt(-8)*z", lambda x, y, z: math.copysign(abs(x) ** (1 / 3), x) - 2 * z),
    ("min(x, y, z) + max(x, y)", lambda x, y, z: min(x, y, z) + max(x, y)),
    ("# one\nX + Y^2 - Z // two\n/* and\nthree */ - Sin(PI*x);", lambda x, y, z: x + y * y - z - math.sin(math.pi * x)),
    (".5 + 5. + 1e-3 + 5.x", lambda x, y, z: 5.501 + 5 * x),
    ("let d = sqrt(x^2+y^2); (d-0.7)^2 + z^2 - 0.09", lambda x, y, z: (math.hypot(x, y) - 0.7) ** 2 + z * z - 0.09),
    ("d = x + 1; g(u, v) = u*v - d; h(u) = g(u, u); g(y, z) + h(x);;", lambda x, y, z: y * z - x - 1 + x * x - x - 1),
    ("r = |x|; let f(x, y) = x^2 + r; f(z, 0) = 2f(r, r)", lambda x, y, z: z * z + abs(x) - 2 * (x * x + abs(x))),
    ("d = 2zxy; q = xzx/2; d + q", lambda x, y, z: 2 * x * y * z + x * x * z / 2),
    ("let xy = x + y; xy^2", lambda x, y, z: (x + y) ** 2),
    ("let pi = 3; let min(a) = a/2; pi x + min(y)", lambda x, y, z: 3 * x + y / 2),
]  # fmt: skip


@pytest.mark.parametrize(("text", "meant"), MEANINGS, ids=[text for text, _ in MEANINGS])
def test_meaning(text: str, meant: Function) -> None:
    tape = parse(text)
    values = evaluate_tape(real_tape(tape), np.array(POINTS))[:, 0]
    assert values == pytest.approx([meant(*point) for point in POINTS], rel=1e-12, abs=1e-12)
    written = canonical(tape)
    again = parse(written)
    assert again.ordered() == tape.ordered() and canonical(again) == written
    assert surfaces.from_formula(text, "box:1,1,1").degree == formula.degree(tape)


def test_the_page_names_every_function_and_its_examples_are_read() -> None:
    page = (Path(__file__).parent.parent / "docs" / "formulas.md").read_text(encoding="utf-8")
    names = {*BUILT_IN, *(name for name in library() if not name.startswith("_"))}
    words = set(re.findall(r"\w+", page))
    assert names <= words
    table = page[page.index("## Functions") : page.index("All but")]
    told = " ".join(re.findall(r"`([^`]*)`", table))
    assert set(re.sub(r"\(.*?\)", "", told).split()) <= names
    examples = [re.split(" {3,}", line[4:])[0] for line in page.splitlines() if line.startswith("    ")]
    for text in examples:
        parse(text, {"a": "1/3"} if text.endswith("- a") else {})
    assert len(examples) == 9
    for refused in re.findall(r"`([^`]*)`", page[page.index("A formula that can") : page.index("A word such")]):
        with pytest.raises(FirsthitError):
            parse(refused)
    for limit in (formula.MAX_LENGTH, formula.MAX_OPERATIONS, formula.MAX_STEPS, formula.MAX_DEPTH, formula.MAX_DEGREE):
        assert f"{limit:,}" in page[page.index("## Limits") :]


@pytest.mark.parametrize("letter", "abcdef")
def test_parameters_of_a_quintic_win_over_constants(letter: str) -> None:
    values = {"a": 1 / 3, "b": math.sqrt(2), "c": -2.5, "d": 0.1, "e": 3.0, "f": math.pi / 4}
    text = f"a x^5 + b*y^4 + c z^3 + d*x^2 + e*y + f = {letter}x"
    found = reading(text, LETTERS)
    values_found = evaluate_tape(real_tape(found.tape), np.array(POINTS))[:, 0]
    a, b, c, d, e, f = values.values()
    wanted = [a * x**5 + b * y**4 + c * z**3 + d * x**2 + e * y + f - values[letter] * x for x, y, z in POINTS]
    assert values_found == pytest.approx(wanted, rel=1e-12, abs=1e-12)
    assert found.notes == ("e is your parameter, not Euler's number",)
    assert formula.degree(found.tape) == 5


def test_a_parameter_or_part_of_several_letters_wins_over_a_product() -> None:
    assert parse("xy", {"xy": "2"}) == parse("2")
    assert parse("ab + ba", {"a": "2", "b": "3"}) == parse("12")
    assert parse("X - x", {"X": "2"}) == parse("2 - x")
    with pytest.raises(FirsthitError, match="unknown name 'E'; did you mean 'e'"):
        parse("E*x", {"e": "2"})


def test_the_same_meaning_gives_the_same_tape() -> None:
    sphere = parse("x^2 + y^2 + z^2 - 1")
    for text in (
        "pow(x, 2) + pow(y, 2) + pow(z, 2) - 1",
        "x² + y² + z² = 1",
        "square(x) + square(y) + square(z) - 1",
        "|x|^2 + |y|^2 + |z|^2 - 1",
        "x**2.0 + y^(6/3) + z^(1 + 1) - 1",
        "s(u) = u^2; s(x) + s(y) + s(z) = 1",
    ):
        assert parse(text).ordered() == sphere.ordered(), text
    assert formula.degree(parse("pow(|x|, 2) + y^(4/2)")) == 2
    assert parse("x^-2").ordered() == parse("1/x^2").ordered() and parse("x^0.5") == parse("sqrt(x)")
    assert parse("x^2.5").ordered() == parse("x^2*sqrt(x)").ordered()


def test_powers_are_polynomials_where_they_are_whole() -> None:
    found = surfaces.from_formula("pow(x, 2) + |y|^4 + cube(z) = a^2", parameters={"a": "sqrt(2)"})
    assert (found.degree, found.parameters) == (4, (("a", "sqrt(2)"),))


def test_values_of_parameters() -> None:
    for text, value in (
        ("1/3", 1 / 3),
        ("sqrt(2)", math.sqrt(2)),
        ("pi/4", math.pi / 4),
        ("-1e-3", -1e-3),
        ("2^0.5", 2**0.5),
    ):
        found = surfaces.from_formula("x^2 + y^2 - a", parameters={"a": text})
        assert surfaces.evaluate(found, np.array([[1.0, 0.5, 0.0]]))[0] == pytest.approx(1.25 - value)
        assert formula.number(text) == value
    assert formula.exact("1/3") == formula.exact("2/6") and surfaces.get("torus", R="1/2").feature_radius == 0.3
    with pytest.raises(FirsthitError, match="is no rational number"):
        surfaces.get("torus", R="sqrt(2)")
    with pytest.raises(FirsthitError, match="parameter a: formula, column 3: "):
        surfaces.from_formula("x - a", parameters={"a": "2*"})


def test_a_parameter_that_does_not_occur_is_refused() -> None:
    with pytest.raises(FirsthitError, match="no 'b' occurs in the formula; its parameters are a"):
        surfaces.from_formula("x^2 - a", parameters={"a": 1, "b": 2})
    with pytest.raises(FirsthitError, match="no 'b' occurs in the formula; it has no parameters"):
        surfaces.from_formula("x^2 - 2", parameters={"b": 2})
    with pytest.raises(FirsthitError, match="two definitions of 'a': it is a parameter too"):
        surfaces.from_formula("a = 2; x^2 - a", parameters={"a": 2})


def test_a_parameter_that_occurs_in_a_part_counts() -> None:
    found = surfaces.from_formula("half(u) = b*u; x^2 + y^2 - 1", parameters={"b": 2})
    assert found.parameters == (("b", "2"),)


CANONICAL = [
    ("x>0 ? y : z", "if(x > 0, y, z)"),
    ("if(x <= 0 and not (y > z or z == 1), 1, x)", "if(x <= 0 and not (y > z or z == 1), 1, x)"),
    ("if((x < 1 or y < 1) and z != 1, y, x)", "if((x < 1 or y < 1) and not z == 1, y, x)"),
    ("if(1 - (1 - (x < y)), y, 0)*sign(z)", "if(1 - (1 - (y > x)), y, 0)*((z >= 0) - (z <= 0))"),
    ("-x*y - (-3)*z - (x - y)", "-x*y - (-3*z) - (x - y)"),
    ("x^2.5 + x^-2 - abs(y)^(1/3) + 1/3*x", "x^2*sqrt(x) + 1/x^2 - abs(y)^(1/3) + 1/3*x"),
    ("1e-30*x + 12345678901234567890*y + 0.1", "1e-30*x + 12345678901234567890*y + 0.1"),
    ("(x^2 + y^2 + z^2 + 1)^2 - 4(x^2 + y^2 + z^2 + 1)", "let s1 = x^2 + y^2 + z^2 + 1; s1^2 - 4*s1"),
    ("s1 = sin(x + y); s1 - (x - (y - s1^2))", "sin(x + y) - (x - (y - sin(x + y)^2))"),
]


@pytest.mark.parametrize(("text", "wanted"), CANONICAL, ids=[text for text, _ in CANONICAL])
def test_the_canonical_form_has_few_parentheses(text: str, wanted: str) -> None:
    assert canonical(parse(text)) == wanted
    assert parse(wanted).ordered() == parse(text).ordered()


def test_free_parameters_are_variables_but_no_exponents() -> None:
    tape = parse("x^2 - (a + 1)^2 y", {"a": "2"}, free=True)
    assert {op.args[0] for op in tape.ops if op.name == "var"} == {"x", "y", "a"}
    with pytest.raises(FirsthitError, match="cannot be an exponent"):
        parse("x^a", {"a": "2"}, free=True)


def test_what_is_told_of_a_reading() -> None:
    told = surfaces.reading(surfaces.from_formula("2x y = a", parameters={"a": "1/3"})).told()
    assert told == ["read as: 2*(x*y) - 1/3"]
    assert surfaces.reading(surfaces.from_formula("x^2+y^2 - 1")).told() == []
    notes = surfaces.reading(surfaces.from_formula("let exp = x; exp + 1e-3*e", parameters={"e": 2})).notes
    assert notes == (
        "exp is your part, not the function",
        "1e-3 is one number; the e in it is not yours",
        "e is your parameter, not Euler's number",
    )


@pytest.mark.timeout(60)
def test_large_formulas_are_read_in_linear_time() -> None:
    terms = " + ".join(f"{k}.5x^{k % 7}*sin({k}*y)*z" for k in range(2_000))
    tape = parse(terms)
    assert 10_000 < len(tape.ops) < 20_000
    assert parse(canonical(tape)).ordered() == tape.ordered()


def _chain(body: str) -> str:
    """Return definitions of f1 to f39, each with two calls of the one before."""
    return "".join(f"f{k}(u) = {body.format(k - 1)};" for k in range(1, 40))


@pytest.mark.timeout(60)
@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("f0(u) = u + 1/(u + 2);" + _chain("f{0}(f{0}(u) + 1)") + "f39(x)", "5,000 operations"),
        ("+".join(f"sin({k}x)" for k in range(3_000)), "5,000 operations"),
    ],
    ids=["doubling calls", "a long sum"],
)  # fmt: skip
def test_growth_is_refused_with_a_count(text: str, reason: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(language_reading, "MAX_OPERATIONS", 5000)
    with pytest.raises(FirsthitError, match=reason):
        parse(text)


def test_calls_are_counted() -> None:
    """A function of many steps whose operations are shared may be called so often, and no more."""
    long = "g(u) = 0*u" + "+ x" * 2000 + ";" + "+".join(f"g({k})" for k in range(200))
    with pytest.raises(FirsthitError, match="more than 200,000 steps"):
        parse(long)


def test_calls_share_what_is_equal() -> None:
    assert len(parse("f0(u) = u*u/2 + 1;" + _chain("f{0}(u)/2 + f{0}(u)*y") + "f39(x)").ops) < 200


def test_deep_graphs_are_written_so_that_they_can_be_read() -> None:
    """Nested by definitions, a graph may be deeper than the text of a formula."""
    for body in ("1 - {0}/2", "-{0}^3 + 1", "sqrt(1 + |{0}|)", "2^(-{0})", "if({0} > 0, -{0}, y)", "x*({0} + 1)%2"):
        text = "p0 = x;" + "".join(f"p{k} = {body.format(f'p{k - 1}')};" for k in range(1, 300)) + "p299"
        try:
            tape = parse(text)
        except FirsthitError as error:
            assert "degree" in str(error)
            continue
        written = canonical(tape)
        assert parse(written).ordered() == tape.ordered() and canonical(parse(written)) == written


def test_nested_polynomials_of_a_high_degree_are_read() -> None:
    text = "1"
    for k in range(1, 65):
        text = f"{k} - x*({text})"
    assert formula.degree(parse(text)) == 64
