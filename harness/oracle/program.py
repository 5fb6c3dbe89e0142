"""Compile a surface's formula to a straight-line program that runs in any number system with Python operators.

The oracle compiles the exact formula itself, as the parser read it. It shares nothing with the lowering that prints
kernels, so that an error there cannot hide here. Constants stay exact until a number system converts them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import Any, TypeVar

from harness.oracle.graph import ONE, Graph, Node
from harness.oracle.reading import graph_of
from surfaces.tape import Tape

Number = TypeVar("Number")
Functions = Mapping[str, Callable[..., Any]]
Leaf = Fraction | str  # a rational number, or "pi" or "e"
POLYNOMIAL = frozenset({"input", "constant", "add", "sub", "mul", "sqr", "neg"})
LONG = 500  # instructions of a program that lets go of results, which costs time
JUMPS = frozenset({"floor", "atan2", "below", "select"})
CHOICES = frozenset({"min", "max", "select"})


@dataclass(frozen=True)
class Instruction:
    """Hold the operation `name` on the results numbered `args`.

    An `input` or `constant` has an `index` instead, and `powr` has an `exponent` beside its argument.
    """

    name: str
    args: tuple[int, ...] = ()
    index: int = 0
    exponent: Fraction = ONE


@dataclass(frozen=True)
class Constants:
    """Hold the constants of a program: numbered results of a program whose own constants are leaves."""

    leaves: tuple[Leaf, ...]
    instructions: tuple[Instruction, ...]
    numbers: tuple[int, ...]

    def converted(self, leaf: Callable[[Leaf], Any], functions: Functions) -> list[Any]:
        """Return the constants in a number system whose `leaf` converts rationals, pi and e."""
        results = _results(self.instructions, (), [leaf(c) for c in self.leaves], functions)
        return [results[k] for k in self.numbers]


@dataclass(frozen=True)
class Program:
    """Hold instructions in order, of which the last one's result is f."""

    instructions: tuple[Instruction, ...]
    constants: Constants

    @property
    def is_polynomial(self) -> bool:
        """Return whether the program uses sums and products only."""
        return all(i.name in POLYNOMIAL for i in self.instructions)

    @cached_property
    def jumps(self) -> bool:
        """Return whether f may not be continuous."""
        return any(i.name in JUMPS for i in self.instructions)

    @cached_property
    def chooses(self) -> bool:
        """Return whether some operations have the value of one of their arguments."""
        return any(i.name in CHOICES for i in self.instructions)

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
                case "sqr":
                    degrees.append(2 * of[0])
                case _:
                    degrees.append(max(of))
        return degrees[-1]

    @cached_property
    def _last_uses(self) -> tuple[tuple[int, ...], ...]:
        """Return for each instruction the results that no later one uses; nothing for a short program."""
        if len(self.instructions) < LONG:
            return ()
        seen, last = set[int](), []
        for i in reversed(self.instructions):
            last.append(tuple(a for a in dict.fromkeys(i.args) if a not in seen))
            seen.update(i.args)
        return tuple(reversed(last))

    def run(self, inputs: Sequence[Number], constants: Sequence[Number], functions: Functions) -> Number:
        """Return f at `inputs`, x, y and z, in their number system; `constants` are already converted to it.

        In a long program, a result is let go of once nothing needs it any more.
        """
        f: Number = _results(self.instructions, inputs, constants, functions, self._last_uses)[-1]
        return f

    def results(self, inputs: Sequence[Number], constants: Sequence[Number], functions: Functions) -> list[Number]:
        """Return the result of each instruction, of which the last is f."""
        return _results(self.instructions, inputs, constants, functions)


def _results(
    instructions: Sequence[Instruction],
    inputs: Sequence[Any],
    constants: Sequence[Any],
    functions: Functions,
    last_uses: Sequence[tuple[int, ...]] = (),
) -> list[Any]:
    """Return the result of each instruction; None where `last_uses` says that it is not needed to the end."""
    results: list[Any] = []
    square = functions.get("sqr")
    for k, i in enumerate(instructions):
        a = [results[n] for n in i.args]
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
            case "sqr":
                value = square(a[0]) if square else a[0] * a[0]
            case "div":
                value = a[0] / a[1]
            case "neg":
                value = -a[0]
            case "powr":
                value = functions["powr"](a[0], i.exponent)
            case name:
                value = functions[name](*a)
        results.append(value)
        if last_uses:
            for n in last_uses[k]:
                results[n] = None
    return results


@dataclass
class _Emitter:
    """Emit the instructions of one node and all that it needs; equal instructions are computed once."""

    graph: Graph
    fold: bool  # whether a constant node becomes one constant
    lengths: bool  # whether the square root of a sum of squares becomes one instruction
    instructions: list[Instruction] = field(default_factory=list)
    constants: dict[int, int] = field(default_factory=dict)  # the number of each constant node
    done: dict[int, int] = field(default_factory=dict)  # the result of each node
    seen: dict[Instruction, int] = field(default_factory=dict)

    def emit(self, name: str, *args: int, index: int = 0, exponent: Fraction = ONE) -> int:
        """Return the number of an instruction, which is added if it is not there yet."""
        instruction = Instruction(name, args, index, exponent)
        if instruction not in self.seen:
            self.seen[instruction] = len(self.instructions)
            self.instructions.append(instruction)
        return self.seen[instruction]

    def parts(self, index: int) -> tuple[int, ...]:
        """Return the nodes that a node's instructions need."""
        if self.is_leaf(index):
            return ()
        node = self.graph.nodes[index]
        if self.lengths and index in self.graph.squares:
            return self.graph.squares[index]
        return tuple(p for p in node.parts if p != self.graph.one) if node.name == "sum" else node.parts

    def is_leaf(self, index: int) -> bool:
        """Return whether a node becomes a constant."""
        return self.graph.constant[index] and (self.fold or self.graph.nodes[index].name in ("number", "pi", "e"))

    def result(self, output: int) -> int:
        """Return the result of a node, of which and of whose parts the instructions are emitted."""
        needed, stack = {output}, [output]
        while stack:
            for part in self.parts(stack.pop()):
                if part not in needed:
                    needed.add(part)
                    stack.append(part)
        for index in sorted(needed):
            if index not in self.done:
                self.done[index] = self.node(index, self.graph.nodes[index])
        return self.done[output]

    def constant(self, index: int) -> int:
        """Emit a constant node."""
        return self.emit("constant", index=self.constants.setdefault(index, len(self.constants)))

    def node(self, index: int, node: Node) -> int:
        """Emit a node whose parts are done."""
        if self.is_leaf(index):
            return self.constant(index)
        match node.name:
            case "input":
                return self.emit("input", index=node.value)
            case "sum":
                return self.sum(node)
            case "product":
                return self.product(node)
            case "powr":
                return self.emit("powr", self.done[node.parts[0]], exponent=node.value)
            case "sqrt" if self.lengths and index in self.graph.squares:
                return self.emit("length", *(self.done[p] for p in self.graph.squares[index]))
        return self.emit(node.name, *(self.done[p] for p in node.parts))

    def sum(self, node: Node) -> int:
        """Emit a sum; terms with a minus sign come last and are subtracted."""
        terms = sorted(zip(node.parts, node.weights, strict=True), key=lambda term: (term[1] < 0, not term[0]))
        result: int | None = None
        for part, weight in terms:
            value = self.scaled(abs(weight), part)
            if result is None:
                result = self.emit("neg", value) if weight < 0 else value
            else:
                result = self.emit("sub" if weight < 0 else "add", result, value)
        assert result is not None
        return result

    def scaled(self, factor: Fraction, part: int) -> int:
        """Emit a positive rational times a node that is done."""
        if part == self.graph.one:
            return self.constant(self.graph.number(factor))
        if factor == ONE:
            return self.done[part]
        return self.emit("mul", self.constant(self.graph.number(factor)), self.done[part])

    def product(self, node: Node) -> int:
        """Emit a product; factors with negative exponents are divided by."""
        scale, powers = abs(node.value), list(zip(node.parts, node.weights, strict=True))
        top = [self.power_of(self.done[part], power) for part, power in powers if power > 0]
        below = [self.power_of(self.done[part], -power) for part, power in powers if power < 0]
        if scale != ONE or not top:
            top.insert(0, self.constant(self.graph.number(scale)))
        result = self.chain(top)
        if below:
            result = self.emit("div", result, self.chain(below))
        return self.emit("neg", result) if node.value < 0 else result

    def chain(self, factors: list[int]) -> int:
        """Emit the product of several results, from left to right."""
        result = factors[0]
        for factor in factors[1:]:
            result = self.emit("mul", result, factor)
        return result

    def power_of(self, value: int, exponent: int) -> int:
        """Emit a whole power by squaring, which is exact in exact numbers; numpy's own powers are slow."""
        result, place = value, exponent.bit_length() - 2
        while place >= 0:
            result = self.emit("sqr", result)
            if exponent >> place & 1:
                result = self.emit("mul", result, value)
            place -= 1
        return result


def program_of(graph: Graph, output: int | None = None, fold: bool = True, lengths: bool = False) -> Program:
    """Return the program of a graph's node, which is its output unless another one is given.

    If `fold`, a constant node becomes one constant. If `lengths`, √(u² + v² + …) becomes one instruction `length` of u,
    v, …; number systems of ranges know that its slope is bounded, which that of a root is not.
    """
    output = graph.output if output is None else output
    emitter = _Emitter(graph, fold, lengths)
    last = emitter.result(output)
    inner = _Emitter(graph, fold=False, lengths=False)
    numbers = tuple(inner.result(index) for index in emitter.constants)
    leaves = tuple(_leaf(graph.nodes[index]) for index in inner.constants)
    return Program(tuple(emitter.instructions[: last + 1]), Constants(leaves, tuple(inner.instructions), numbers))


def compile_tape(tape: Tape, fold: bool = True, lengths: bool = False) -> Program:
    """Return the program of a tape, as `program_of`. Raises FirsthitError if the oracle does not know an operation."""
    return program_of(graph_of(tape), fold=fold, lengths=lengths)


def _leaf(node: Node) -> Leaf:
    """Return a rational number, or the name of another leaf."""
    return node.name if node.value is None else node.value
