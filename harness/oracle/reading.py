"""Turn the parser's tape into a graph, in one pass."""

from __future__ import annotations

from fractions import Fraction

from harness.contract import FirsthitError
from harness.oracle.graph import ONE, Graph
from surfaces.tape import Op, Tape

SUMS = frozenset({"add", "sub"})
PRODUCTS = frozenset({"mul", "sqr", "powi", "div"})
FUNCTIONS = frozenset({"sqrt", "exp", "log", "sin", "cos", "tan", "abs", "min", "max"})
FUNCTIONS |= {"floor", "atan2", "below", "select", "sign"}


def graph_of(tape: Tape) -> Graph:
    """Return the graph of a tape's first output. Raises FirsthitError for an operation or a variable not known."""
    return _Reader(Tape(tape.ops, tape.outputs[:1]).pruned()).graph


class _Reader:
    """Read one tape. Operations of a long sum or product that nothing else uses are gathered into one node."""

    def __init__(self, tape: Tape) -> None:
        self.ops = tape.ops
        self.graph = Graph()
        self.inner = self._inner()
        self.found: list[int] = []
        for k, op in enumerate(self.ops):
            self.found.append(-1 if self.inner[k] else self._node(k, op))
        self.graph.output = self.found[tape.outputs[0]]

    def _factor(self, op: Op) -> Fraction | None:
        """Return the rational number that an operation multiplies one other operation with; None if it is none."""
        if op.name == "neg":
            return -ONE
        first = self.ops[op.args[0]] if op.name == "mul" else None
        return first.args[0] if first is not None and first.name == "const" else None

    def _inner(self) -> list[str]:
        """Return for each operation "sum" or "product" if only a larger one uses it, else ""."""
        uses = [0] * len(self.ops)
        user = [-1] * len(self.ops)
        for k, op in enumerate(self.ops):
            for a in op.inputs:
                uses[a] += 1
                user[a] = k
        inner = [""] * len(self.ops)
        for k in range(len(self.ops) - 1, -1, -1):
            if uses[k] != 1:
                continue
            op, outer = self.ops[k], self.ops[user[k]]
            scaled = self._factor(outer) is not None
            in_sum = outer.name in SUMS or (scaled and inner[user[k]] == "sum")
            if in_sum and (op.name in SUMS or self._factor(op) is not None):
                inner[k] = "sum"
            elif not in_sum and (outer.name in PRODUCTS or scaled) and (op.name in PRODUCTS or op.name == "neg"):
                inner[k] = "product"
        return inner

    def _node(self, k: int, op: Op) -> int:
        """Return the node of an operation whose inputs are read."""
        graph = self.graph
        match op.name:
            case "const":
                return graph.number(op.args[0])
            case "pi" | "e":
                return graph.node(op.name)
            case "var":
                if op.args[0] not in ("x", "y", "z"):
                    raise FirsthitError(f"the oracle does not know the variable {op.args[0]}")
                return graph.node("input", value="xyz".index(op.args[0]))
            case "powr":
                return graph.power(self.found[op.args[0]], op.args[1])
        if op.name in SUMS:
            return graph.sum(self._terms(k))
        if op.name in PRODUCTS or op.name == "neg":
            return graph.product(*self._factors(k))
        if op.name not in FUNCTIONS:
            raise FirsthitError(f"the oracle does not know the operation {op.name}")
        node: int = getattr(graph, op.name)(*(self.found[a] for a in op.inputs))
        return node

    def _terms(self, k: int) -> list[tuple[int, Fraction]]:
        """Return the terms of the sum that operation k ends."""
        terms, stack = [], [(k, ONE)]
        while stack:
            index, weight = stack.pop()
            op = self.ops[index]
            if index != k and self.inner[index] != "sum":
                terms.append((self.found[index], weight))
            elif op.name in SUMS:
                stack += [(op.args[1], weight if op.name == "add" else -weight), (op.args[0], weight)]
            else:
                factor = self._factor(op)
                assert factor is not None
                stack.append((op.args[-1], weight * factor))
        return terms

    def _factors(self, k: int) -> tuple[list[tuple[int, int]], Fraction]:
        """Return the factors of the product that operation k ends, with their exponents, and a rational factor."""
        factors, scale, stack = [], ONE, [(k, 1)]
        while stack:
            index, power = stack.pop()
            op = self.ops[index]
            if index != k and self.inner[index] != "product":
                factors.append((self.found[index], power))
                continue
            match op.name:
                case "neg":
                    scale *= (-1) ** power
                    stack.append((op.args[0], power))
                case "sqr":
                    stack.append((op.args[0], 2 * power))
                case "powi":
                    stack.append((op.args[0], op.args[1] * power))
                case _:
                    stack += [(op.args[1], power if op.name == "mul" else -power), (op.args[0], power)]
        return factors, scale
