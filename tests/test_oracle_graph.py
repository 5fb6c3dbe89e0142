"""The oracle's own reading of a formula: what is merged, what stays shared, and how long formulas are taken."""

from __future__ import annotations

import subprocess
import sys
from fractions import Fraction
from math import cos, pi

import pytest
from flint import arb

import surfaces
from harness.contract import FirsthitError
from harness.oracle import reals, surd
from harness.oracle.graph import Graph
from harness.oracle.program import Program, compile_tape, program_of
from harness.oracle.reading import graph_of
from surfaces import formula
from surfaces.tape import Builder, Op, Tape


def graph(text: str) -> Graph:
    return graph_of(formula.parse(text))


def same(first: str, second: str) -> bool:
    """Whether two formulas are one node."""
    builder, read = Builder(), (formula.parse(first), formula.parse(second))
    for k, tape in enumerate(read):
        start = len(builder.ops)
        for op in tape.ops:
            inputs = tuple(i + start for i in op.inputs)
            builder.ops.append(Op(op.name, inputs + op.args[len(inputs) :]))
        if not k:
            first_output = tape.outputs[0]
        second_output = start + tape.outputs[0]
    # both are asked for by one operation that nothing simplifies unless its two arguments are one node
    ops = (*builder.ops, Op("below", (first_output, second_output)))
    whole = graph_of(Tape(ops, (len(ops) - 1,)))
    return whole.nodes[whole.output].name == "number"


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ("x + y - x", "y"),
        ("2*(x + y) - 2*x - y*2", "z - z"),
        ("x*y*x", "x^2*y"),
        ("(x - y)^2", "(y - x)^2"),
        ("(x - y)*(y - x)", "-(x - y)^2"),
        ("abs(3*(x - y))", "3*abs(y - x)"),
        ("sqrt(x^2 + 1)^2", "x^2 + 1"),
        ("sqrt(x^2 + 1)*sqrt(1 + x^2)", "x^2 + 1"),
        ("sqrt(4*x^4*y^2)", "2*x^2*abs(y)"),
        ("abs(x)^2*y", "x*y*x"),
        ("((x^2 + 1)^(1/3))^3", "x^2 + 1"),
        ("exp(2*log(x^2 + 1))", "(x^2 + 1)^2"),
        ("log(exp(x*y))", "y*x"),
        ("(x^2 + 1)*y/(x^2 + 1)", "y"),
        ("cos(pi/5)*x", "x*(1/4 + sqrt5/4)"),
        ("sin(-5*pi/6)*x", "-x/2"),
        ("cos(7*pi/4)*x - x*sqrt2/2", "y - y"),
        ("min(x, y)", "min(y, x)"),
        ("if(x > y, z, z)", "z"),
        ("2*pi*x + 3*x*pi", "pi*5*x"),
    ],
)
def test_what_is_the_same_is_one_node(first: str, second: str) -> None:
    assert same(first, second)


@pytest.mark.parametrize(
    ("first", "second"),
    [("sqrt(x^2)", "x"), ("abs(x)*x", "x^2"), ("x - y", "y - x"), ("sin(pi/7)*x", "x*0"), ("max(x, y)", "min(x, y)"),
     ("(x^3)^2", "x^5"), ("floor(x)", "x"), ("if(x > 0, x, y)", "if(x >= 0, x, y)")],
)  # fmt: skip
def test_what_is_not_the_same_is_not_one_node(first: str, second: str) -> None:
    assert not same(first, second)


@pytest.mark.parametrize(
    ("text", "multiplicities"),
    [
        ("(x - 1)^2*y", [1, 2]),
        ("(x - 1)*y*(x - 1)*y^3", [2, 4]),
        ("abs(x)*y", [1, 2]),
        ("abs(x)*x", [3]),
        ("abs(x*y^2)^3*(x + y)", [1, 6, 6]),
        ("-3*(x - y)*(y - x)", [2]),
        ("let u = (x - 1)*y; u^2*x*u", [1, 3, 3]),
        ("(x - 1)^2/(1 + x^2)", [1, 2]),
        ("(x - 1)*y", []),
        ("x^2 + y^2", []),
        ("pi*sqrt2*x^2", [2]),
    ],
)
def test_repeated_factors(text: str, multiplicities: list[int]) -> None:
    g = graph(text)
    radical, factors = g.radical(g.output)
    assert sorted(multiplicity for _, multiplicity in factors) == multiplicities
    if not factors:
        assert radical == g.output


def test_degrees_are_bounds_of_the_collected_formula() -> None:
    for text, degree in (("x*y*z + x^2", 3), ("(x^2 + y)^3", 6), ("x^5 + y - x^5", 1), ("(x + y)^2*(x + y)^3", 5)):
        program = compile_tape(formula.parse(text))
        assert program.is_polynomial
        assert program.degree == degree


def names(text: str) -> list[str]:
    return [i.name for i in compile_tape(formula.parse(text), lengths=True).instructions]


def test_roots_of_sums_of_squares_are_lengths() -> None:
    assert "length" in names("sqrt(x^2 + y^2 + z^2) - 1")
    assert names("sqrt((sqrt(2*x^2 + y^2/9) - 1)^2 + z^2 + 1/2)").count("length") == 2
    assert "length" in names("sqrt(3*(x^2 + y^2))")
    assert "length" not in names("sqrt(x^2 - y^2 + 9)")
    assert "length" not in names("sqrt(x^2 + y + 9)")
    assert "abs" in names("sqrt(3*x^2*y^4) + z")


def value(program: Program, point: tuple[float, float, float]) -> float:
    constants = program.constants.converted(reals.leaf, reals.FUNCTIONS)
    return float(program.run([arb(v) for v in point], constants, reals.FUNCTIONS))


@pytest.mark.parametrize("fold", [True, False])
@pytest.mark.parametrize("lengths", [True, False])
def test_programs_have_the_formula_s_value(fold: bool, lengths: bool) -> None:
    for text in (
        "x^7 - 3*(y - x)^5/(1 + z^2) + pi*e*x*2",
        "sqrt(2*x^2 + sqrt3*y^2)^3 - exp(-x)*cos(pi*y/5)^2",
        "sqrt(x^2 + (y - 1)^2 + 3)*max(x, y - z, -2*x)",
        "abs(-2*x*y)^(4/3) - cbrt(x - y)",
        "if(x > y && floor(3*z) < 1, x*atan2(y, -x), 7 - x^2) + mod(x, 1/3)",
        "((x - y)*(y - z)*(z - x))^3 / (x*y - 9)^2",
    ):
        surface = surfaces.from_formula(text, "box:1,1,1")
        for point in ((0.3, -0.7, 0.9), (-0.5, 0.25, 0.125), (0.9, 0.1, -0.8)):
            program = program_of(graph_of(surfaces.tape_of(surface)), fold=fold, lengths=lengths)
            exact = surfaces.evaluate(surface, [point])[0]
            assert value(program, point) == pytest.approx(exact, rel=1e-12, abs=1e-12), (text, point)


@pytest.mark.parametrize("text", ["cos(pi/5)", "sqrt2*sqrt(6)*sqrt3", "1/(1 + phi)", "sqrt(4/3)*sqrt3 + sin(pi/10)"])
def test_constants_of_one_field(text: str) -> None:
    program = compile_tape(formula.parse(f"({text})*x - y"))
    found = program.constants.converted(surd.leaf, surd.FUNCTIONS)
    balls = program.constants.converted(reals.leaf, reals.FUNCTIONS)
    for a, b in zip(found, balls, strict=True):
        assert abs(float(a.ball()[0]) - float(b)) < 1e-12
    assert cos(pi / 5) == pytest.approx((1 + 5**0.5) / 4)


@pytest.mark.parametrize("text", ["sqrt2 + sqrt3", "cos(pi/7)", "pi", "sqrt(1 + sqrt2)"])
def test_constants_of_no_such_field(text: str) -> None:
    with pytest.raises(surd.NotExact):
        compile_tape(formula.parse(f"({text})*x - y")).constants.converted(surd.leaf, surd.FUNCTIONS)


def shared(levels: int) -> Tape:
    """Return a tape whose every operation is used twice by the next: 2^levels terms when written out."""
    b = Builder()
    d = b.sin(b.var("x"))
    for _ in range(levels):
        d = b.add(b.mul(d, b.add(d, b.var("y"))), d)
    return b.tape(d)


def nested(levels: int) -> Tape:
    """Return a tape of roots inside one another, each used twice."""
    b = Builder()
    d = b.var("x")
    for _ in range(levels):
        d = b.sqrt(b.add(b.add(b.sqr(d), b.mul(d, b.var("y"))), b.const(1)))
    return b.tape(d)


def sums(levels: int) -> Tape:
    """Return a sum of many terms, each prefix of which is used elsewhere too."""
    b = Builder()
    total, most = b.var("x"), b.var("y")
    for k in range(levels):
        total = b.add(total, b.mul(b.const(k + 2), b.sin(b.add(b.var("y"), b.const(k)))))
        most = b.max(most, total)
    return b.tape(most)


def powers(levels: int) -> Tape:
    """Return products whose exponents would double at each level."""
    b = Builder()
    d = b.add(b.var("x"), b.var("y"))
    for k in range(levels):
        d = b.mul(b.abs(b.mul(b.const(Fraction(k + 2, 3)), d)), d)
    return b.tape(d)


@pytest.mark.parametrize("make", [shared, nested, sums, powers])
def test_shared_parts_stay_shared(make: object) -> None:
    """The count of instructions grows with that of operations; nothing is expanded, and nothing calls itself."""
    tape = make(1200)  # type: ignore[operator]
    g = graph_of(tape)
    for lengths in (True, False):
        assert len(program_of(g, lengths=lengths).instructions) < 3 * len(tape.ops)
    g.radical(g.output)
    assert len(g.nodes) < 4 * len(tape.ops)


def test_what_is_not_known_is_said() -> None:
    for op in (Op("gamma", (0,)), Op("var", ("w",))):
        with pytest.raises(FirsthitError, match="the oracle does not know"):
            graph_of(Tape((Op("var", ("x",)), op), (1,)))


def test_the_oracle_does_without_sympy() -> None:
    code = (
        "import sys, numpy as np, surfaces; from harness.oracle import first_hits;"
        "rays = np.array([[-3, 0, 0, 1, 0, 0], [-3, .5, 0, 1, 0, 0]], np.float32);"
        "names = ('torus', 'barth_sextic', 'blinn_blob');"
        "found = [first_hits(surfaces.get(n), rays).status.tolist() for n in names];"
        "own = surfaces.from_formula('sqrt(x^2+y^2)-abs(z)+floor(x)', 'sphere:2');"
        "found.append(first_hits(own, rays)); print('sympy' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"
