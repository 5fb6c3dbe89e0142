"""Compile a surface's expression to a straight-line program that runs in any number system with Python operators.

The oracle compiles the exact sympy expression itself. It shares nothing with the lowering that prints kernels, so that
an error there cannot hide here. Constants stay symbolic until a number system converts them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeVar

from harness.contract import FirsthitError

if TYPE_CHECKING:
    import sympy

Number = TypeVar("Number")
Functions = Mapping[str, Callable[..., Any]]
POLYNOMIAL = frozenset({"input", "constant", "add", "sub", "mul", "neg"})
FUNCTIONS = {"exp": "exp", "log": "log", "sin": "sin", "cos": "cos", "tan": "tan", "Abs": "abs"}


@dataclass(frozen=True)
class Instruction:
    """Hold the operation `name` on the results numbered `args`; an `input` or `constant` has an `index` instead."""

    name: str
    args: tuple[int, ...] = ()
    index: int = 0


@dataclass(frozen=True)
class Program:
    """Hold instructions in order, of which the last one's result is f."""

    instructions: tuple[Instruction, ...]
    constants: tuple[sympy.Expr, ...]

    @property
    def is_polynomial(self) -> bool:
        """Return whether the program uses sums and products only."""
        return all(i.name in POLYNOMIAL for i in self.instructions)

    @property
    def degree(self) -> int:
        """Return an upper bound of a polynomial's total degree, from its structure alone."""
        degrees: list[int] = []
        for i in self.instructions:
            of = [degrees[a] for a in i.args]
            match i.name:
                case "input":
                    degrees.append(1)
                case "constant":
                    degrees.append(0)
                case "mul":
                    degrees.append(sum(of))
                case _:
                    degrees.append(max(of))
        return degrees[-1]

    def run(self, inputs: Sequence[Number], constants: Sequence[Number], functions: Functions) -> Number:
        """Return f at `inputs`, x, y and z, in their number system; `constants` are already converted to it."""
        return self.results(inputs, constants, functions)[-1]

    def results(self, inputs: Sequence[Number], constants: Sequence[Number], functions: Functions) -> list[Number]:
        """Return the result of each instruction, of which the last is f."""
        results: list[Number] = []
        for i in self.instructions:
            a: list[Any] = [results[k] for k in i.args]
            match i.name:
                case "input":
                    value = inputs[i.index]
                case "constant":
                    value = constants[i.index]
                case "add":
                    value = a[0] + a[1]
                case "sub":
                    value = a[0] - a[1]
                case "mul":
                    value = a[0] * a[1]
                case "div":
                    value = a[0] / a[1]
                case "neg":
                    value = -a[0]
                case name:
                    value = functions[name](*a)
            results.append(value)
        return results


class _Compiler:
    """Compile a sympy tree in post-order; equal subtrees are computed once."""

    def __init__(self, fold: bool, lengths: bool) -> None:
        self.fold = fold  # whether a constant subtree becomes one constant
        self.lengths = lengths  # whether the square root of a sum of squares becomes one instruction
        self.instructions: list[Instruction] = []
        self.constants: list[sympy.Expr] = []
        self.seen: dict[Instruction | sympy.Expr, int] = {}

    def emit(self, name: str, *args: int, index: int = 0) -> int:
        """Return the number of an instruction, which is added if it is not there yet."""
        instruction = Instruction(name, args, index)
        if instruction not in self.seen:
            self.seen[instruction] = len(self.instructions)
            self.instructions.append(instruction)
        return self.seen[instruction]

    def constant(self, expr: sympy.Expr) -> int:
        """Emit a constant."""
        if expr not in self.constants:
            self.constants.append(expr)
        return self.emit("constant", index=self.constants.index(expr))

    def compile(self, expr: sympy.Expr) -> int:
        """Return the number of an expression's result."""
        if expr not in self.seen:
            self.seen[expr] = self.walk(expr)
        return self.seen[expr]

    def walk(self, expr: sympy.Expr) -> int:
        """Emit an expression that was not met yet. Raises FirsthitError for an unknown function."""
        import sympy

        if expr.is_Symbol:
            return self.emit("input", index="xyz".index(expr.name))
        if expr.is_Atom or (self.fold and not expr.free_symbols):
            return self.constant(expr)
        if expr.is_Add:
            return self.sum(expr.args)
        if expr.is_Mul:
            return self.product(expr)
        if expr.is_Pow:
            return self.power(*expr.as_base_exp())
        if isinstance(expr, sympy.Min | sympy.Max):
            name = "min" if isinstance(expr, sympy.Min) else "max"
            return self.chain(name, [self.compile(a) for a in expr.args])
        name = FUNCTIONS.get(type(expr).__name__, "")
        if not name:
            raise FirsthitError(f"the oracle does not know the function {type(expr).__name__} in {expr}")
        return self.emit(name, self.compile(expr.args[0]))

    def chain(self, name: str, args: list[int]) -> int:
        """Apply an operation of two arguments to several, from left to right."""
        result = args[0]
        for a in args[1:]:
            result = self.emit(name, result, a)
        return result

    def sum(self, terms: tuple[sympy.Expr, ...]) -> int:
        """Emit a sum; terms with a minus sign come last and are subtracted."""
        ordered = sorted(terms, key=lambda t: bool(t.could_extract_minus_sign()))
        result: int | None = None
        for term in ordered:
            negative = bool(term.could_extract_minus_sign())
            value = self.compile(-term if negative else term)
            if result is None:
                result = self.emit("neg", value) if negative else value
            else:
                result = self.emit("sub" if negative else "add", result, value)
        assert result is not None
        return result

    def product(self, expr: sympy.Expr) -> int:
        """Emit a product; factors with negative exponents are divided by."""
        import sympy

        numerator: list[sympy.Expr] = []
        denominator: list[sympy.Expr] = []
        for factor in expr.args:
            base, exponent = factor.as_base_exp()
            below = base.free_symbols and exponent.is_Rational and exponent < 0
            (denominator if below else numerator).append(sympy.Pow(base, -exponent) if below else factor)
        negative = numerator[:1] == [sympy.S.NegativeOne]
        top = [self.compile(f) for f in numerator[negative:]] or [self.constant(sympy.S.One)]
        result = self.chain("mul", top)
        if denominator:
            result = self.emit("div", result, self.chain("mul", [self.compile(f) for f in denominator]))
        return self.emit("neg", result) if negative else result

    def power(self, base: sympy.Expr, exponent: sympy.Expr) -> int:
        """Emit a power."""
        import sympy

        if exponent.is_Rational and exponent < 0:
            return self.emit("div", self.constant(sympy.S.One), self.power(base, -exponent))
        if exponent == 1:
            return self.compile(base)
        if exponent.is_Integer:
            return self.power_of(self.compile(base), int(exponent))
        if exponent.is_Rational and exponent.q == 2:
            roots = _roots_of_squares(base) if self.lengths else None
            if roots is not None:
                return self.power_of(self.emit("length", *(self.compile(r) for r in roots)), int(exponent.p))
            return self.power_of(self.emit("sqrt", self.compile(base)), int(exponent.p))
        if base == sympy.E:
            return self.emit("exp", self.compile(exponent))
        logarithm = self.emit("log", self.compile(base))
        return self.emit("exp", self.emit("mul", self.compile(exponent), logarithm))

    def power_of(self, value: int, exponent: int) -> int:
        """Emit a whole power by squaring, which is exact in exact numbers; numpy's own powers are slow."""
        if exponent == 1:
            return value
        half = self.power_of(value, exponent // 2)
        square = self.emit("mul", half, half)
        return self.emit("mul", square, value) if exponent % 2 else square


def _roots_of_squares(expr: sympy.Expr) -> list[sympy.Expr] | None:
    """Return [u, v, …] if `expr` is written as u² + v² + …, else None; a positive constant counts as a square."""
    import sympy

    roots = []
    for term in sympy.Add.make_args(expr):
        root = sympy.S.One
        for factor in sympy.Mul.make_args(term):
            base, exponent = factor.as_base_exp()
            if factor.is_Rational and factor > 0:
                root *= sympy.sqrt(factor)
            elif exponent.is_Integer and exponent > 0 and exponent % 2 == 0 and base.free_symbols:
                root *= base ** (exponent / 2)
            else:
                return None
        roots.append(root)
    return roots


def compile_expression(expr: sympy.Expr, fold: bool = True, lengths: bool = False) -> Program:
    """Return the program of `expr` in symbols named x, y, z.

    If `fold`, a constant subtree becomes one constant. If `lengths`, √(u² + v² + …) becomes one instruction `length` of
    u, v, …; number systems of ranges know that its slope is bounded, which that of a root is not. Raises FirsthitError
    if `expr` uses a function that the oracle does not know.
    """
    compiler = _Compiler(fold, lengths)
    last = compiler.compile(expr)
    if last != len(compiler.instructions) - 1:  # the result was met earlier, as in f = -(-x)
        raise AssertionError("the last instruction must be the result")
    return Program(tuple(compiler.instructions), tuple(compiler.constants))


def repeated_factors(expr: sympy.Expr) -> tuple[sympy.Expr, list[tuple[sympy.Expr, int]]]:
    """Return the radical of `expr` as it is written, and its factors with their multiplicities.

    (x − 1)^2·y gives (x − 1)·y and [(x − 1, 2), (y, 1)]. An expression without repeated factors gives itself and [].
    |u| counts as u twice, since it has the roots of u and, like u², never changes its sign.
    """
    import sympy

    found: dict[sympy.Expr, int] = {}
    for factor in sympy.Mul.make_args(expr):
        base, exponent = factor.as_base_exp()
        multiplicity = int(exponent) if exponent.is_Integer and exponent > 1 else 1
        if not factor.free_symbols:
            continue
        if multiplicity == 1:
            base = factor
        if isinstance(base, sympy.Abs):
            base, multiplicity = base.args[0], 2 * multiplicity
        found[base] = found.get(base, 0) + multiplicity
    factors = list(found.items())
    if all(multiplicity == 1 for _, multiplicity in factors):
        return expr, []
    return sympy.Mul(*found), factors


def convert_constants(program: Program, leaf: Callable[[sympy.Expr], Any], functions: Functions) -> list[Any]:
    """Return the program's constants in a number system whose `leaf` converts rationals, pi, e and the golden ratio."""

    def convert(constant: sympy.Expr) -> Any:
        inner = compile_expression(constant, fold=False)
        return inner.run((), [leaf(c) for c in inner.constants], functions)

    return [convert(constant) for constant in program.constants]
