"""Read a parsed formula as a graph of sums, products and functions, in which equal parts are one.

**Theory.** The tape that the parser makes is walked once, without recursion, so that named parts of a formula stay
shared and a formula of n operations becomes a graph of about n nodes. Sums are collected: equal terms are added up, and
equal factors become powers, so that x − x is 0 and (x − 1)·y·(x − 1) is (x − 1)²·y. What is used in several places is
not expanded. Rules that hold wherever f has a value simplify further: √u² is |u|, (√u)² is u, |u|² is u².

This is the oracle's own reading: it shares nothing with the lowering that prints kernels, so that an error there cannot
hide here.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from heapq import heappop, heappush
from math import floor, isqrt
from typing import Any

ONE = Fraction(1)
FEW = 8  # parts of a sum or product used in several places, up to which it is merged into another one
MOST_BITS = 256  # of a rational factor; what would give a larger one is not merged
MOST_EXPONENT = 256  # of a factor, likewise
MOST_POWER = 32  # up to which exp(n·log(a)) becomes a power
# cos(q·π) for q from 0 to 1/2, as the rationals a and b and the whole number d of a + b·√d
COSINES = {
    Fraction(0): (ONE, Fraction(0), 1),
    Fraction(1, 6): (Fraction(0), Fraction(1, 2), 3),
    Fraction(1, 5): (Fraction(1, 4), Fraction(1, 4), 5),
    Fraction(1, 4): (Fraction(0), Fraction(1, 2), 2),
    Fraction(1, 3): (Fraction(1, 2), Fraction(0), 1),
    Fraction(2, 5): (Fraction(-1, 4), Fraction(1, 4), 5),
    Fraction(1, 2): (Fraction(0), Fraction(0), 1),
}


@dataclass(frozen=True)
class Node:
    """Hold one part of a formula.

    A `number` has a Fraction as its `value`; `input` has the index of x, y or z. A `sum` has its terms' `weights`, a
    `product` the whole exponents of its factors as `weights` and a rational factor as `value`; `powr` has its exponent
    as `value`. `parts` are indices of earlier nodes.
    """

    name: str
    parts: tuple[int, ...] = ()
    weights: tuple[Any, ...] = ()
    value: Any = None


class Graph:
    """Build and hold nodes, each after its parts."""

    def __init__(self) -> None:
        self.nodes: list[Node] = []
        self.constant: list[bool] = []  # whether a node depends on no input
        self.squares: dict[int, tuple[int, ...]] = {}  # u, v, … of nodes √(u² + v² + …)
        self._known: dict[Node, int] = {}
        self.one = self.number(ONE)
        self.output = self.one

    def node(self, name: str, *parts: int, weights: tuple[Any, ...] = (), value: Any = None) -> int:
        """Return the index of a node, which is added if it is not there yet."""
        node = Node(name, parts, weights, value)
        if node not in self._known:
            self._known[node] = len(self.nodes)
            self.nodes.append(node)
            self.constant.append(name != "input" and all(self.constant[p] for p in parts))
        return self._known[node]

    def number(self, value: Fraction) -> int:
        return self.node("number", value=value)

    def value(self, index: int) -> Fraction | None:
        """Return a node's number, None if it is no rational number."""
        node = self.nodes[index]
        return node.value if node.name == "number" else None

    def split(self, index: int) -> tuple[Fraction, int]:
        """Return a node as a rational factor and the rest."""
        node = self.nodes[index]
        if node.name == "number":
            return node.value, self.one
        if node.name == "product" and node.value != ONE:
            return node.value, self._product(ONE, dict(self.powers(index)))
        return ONE, index

    def powers(self, index: int) -> list[tuple[int, Any]]:
        """Return the factors of a product with their exponents, or the terms of a sum with their factors."""
        return list(zip(self.nodes[index].parts, self.nodes[index].weights, strict=True))

    def sum(self, terms: Iterable[tuple[int, Fraction]]) -> int:
        """Return a sum of nodes with rational factors."""
        found: dict[int, Fraction] = {}
        for index, weight in terms:
            factor, rest = self.split(index)
            node, factor = self.nodes[rest], factor * weight
            flat = node.name == "sum" and len(node.parts) <= FEW
            flat = flat and max(map(_bits, node.weights)) + _bits(factor) <= MOST_BITS
            for part, share in self.powers(rest) if flat else ((rest, ONE),):
                found[part] = found.get(part, Fraction(0)) + factor * share
        found = {part: weight for part, weight in found.items() if weight}
        constants = {part: weight for part, weight in found.items() if self.constant[part]}
        if 1 < len(constants) < len(found):
            whole = self._sum(constants)
            found = {part: weight for part, weight in found.items() if part not in constants} | {whole: ONE}
        return self._sum(found)

    def _sum(self, terms: Mapping[int, Fraction]) -> int:
        """Return the sum of collected terms."""
        if not terms:
            return self.number(Fraction(0))
        if len(terms) == 1:
            ((part, weight),) = terms.items()
            return self.number(weight) if part == self.one else self.product([(part, 1)], weight)
        parts = tuple(sorted(terms))
        return self.node("sum", *parts, weights=tuple(terms[p] for p in parts))

    def product(self, factors: Iterable[tuple[int, int]], scale: Fraction = ONE) -> int:
        """Return a product of nodes with whole exponents. A division by the number 0 stays one, which has no value."""
        found: dict[int, int] = {}
        stack = list(factors)[::-1]
        while stack:
            index, power = stack.pop()
            node = self.nodes[index]
            if not power:
                continue
            if node.name == "number" and (node.value or power > 0) and _bits(node.value) * abs(power) <= MOST_BITS:
                scale *= node.value**power
            elif node.name == "product" and len(node.parts) <= FEW and self._is_small(index, power):
                scale *= node.value**power
                stack += [(p, e * power) for p, e in self.powers(index)]
            elif node.name == "sqrt" and abs(power) > 1:
                whole = int(power / 2)
                stack += [(node.parts[0], whole), (index, power - 2 * whole)]
            elif node.name == "abs" and power % 2 == 0:
                stack.append((node.parts[0], power))
            elif node.name == "powr" and (node.value * power).denominator == 1:
                stack.append((node.parts[0], int(node.value * power)))
            else:
                sign, index = self._turned(index)
                scale *= sign**power
                total = found.pop(index, 0) + power
                if total and node.name in ("sqrt", "abs", "powr") and total != power:
                    stack.append((index, total))
                elif total:
                    found[index] = total
        return self._product(scale, found)

    def _is_small(self, index: int, power: int) -> bool:
        """Return whether a product to a power has a factor and exponents of moderate size."""
        node = self.nodes[index]
        largest = max((abs(e) for e in node.weights), default=0) * abs(power)
        return largest <= MOST_EXPONENT and _bits(node.value) * abs(power) <= MOST_BITS

    def _product(self, scale: Fraction, powers: dict[int, int]) -> int:
        """Return the product of collected factors; constant ones become one factor."""
        if not scale or not powers:
            return self.number(scale)
        constants = sorted(part for part in powers if self.constant[part])
        if 1 < len(constants) < len(powers):
            whole = self.node("product", *constants, weights=tuple(powers[p] for p in constants), value=ONE)
            powers = {part: power for part, power in powers.items() if not self.constant[part]} | {whole: 1}
        parts = tuple(sorted(powers))
        if scale == ONE and len(parts) == 1 and powers[parts[0]] == 1:
            return parts[0]
        return self.node("product", *parts, weights=tuple(powers[p] for p in parts), value=scale)

    def _turned(self, index: int) -> tuple[Fraction, int]:
        """Return a sign and a node whose product is this node; of a − b and b − a the same node is returned."""
        node = self.nodes[index]
        if node.name != "sum" or node.weights[-1] > 0 or len(node.parts) > FEW:
            return ONE, index
        return -ONE, self.node("sum", *node.parts, weights=tuple(-w for w in node.weights))

    def power(self, index: int, exponent: Fraction) -> int:
        """Return a node to a power that is not whole only if the node is not negative."""
        if exponent.denominator == 1:
            return self.product([(index, int(exponent))])
        if exponent < 0:
            return self.product([(self.power(index, -exponent), -1)])
        if exponent.denominator == 2:
            return self.product([(self.sqrt(index), exponent.numerator)])
        return self.node("powr", index, value=exponent)

    def sqrt(self, index: int) -> int:
        number, (factor, rest) = self.value(index), self.split(index)
        if number is not None:
            roots = isqrt(abs(number.numerator)), isqrt(number.denominator)
            if number >= 0 and (roots[0] ** 2, roots[1] ** 2) == (number.numerator, number.denominator):
                return self.number(Fraction(*roots))
            return self.node("sqrt", index)
        root = self._root_of_square(index, ONE)
        if root is not None:
            return self.abs(root)
        squares = self._roots(rest, factor) if self.nodes[rest].name == "sum" else ()
        found = self.node("sqrt", index)
        if squares:
            self.squares[found] = squares
        return found

    def _roots(self, index: int, scale: Fraction) -> tuple[int, ...]:
        """Return u, v, … of a sum that is written as u² + v² + … once it is multiplied by `scale`; else nothing."""
        node = self.nodes[index]
        roots = [self._root_of_square(p, scale * w) for p, w in zip(node.parts, node.weights, strict=True)]
        return tuple(r for r in roots if r is not None) if None not in roots else ()

    def _root_of_square(self, index: int, scale: Fraction) -> int | None:
        """Return u, whose square is `scale` times a node; None if it is not written as a square."""
        factor, rest = self.split(index)
        node, factor = self.nodes[rest], factor * scale
        if factor <= 0:
            return None
        if rest == self.one:
            return self.sqrt(self.number(factor))
        if node.name != "product" or any(power % 2 for power in node.weights):
            return None
        halves = [(part, power // 2) for part, power in self.powers(rest)]
        return self.product([(self.sqrt(self.number(factor)), 1), *halves])

    def abs(self, index: int) -> int:
        factor, rest = self.split(index)
        rest = self._turned(rest)[1]
        node = self.nodes[rest]
        if rest == self.one:
            return self.number(abs(factor))
        if node.name == "product":
            even = [(part, power) for part, power in self.powers(rest) if power % 2 == 0]
            odd = self.product([(part, power) for part, power in self.powers(rest) if power % 2])
            size = odd if odd == self.one else self.abs(odd) if even else self.node("abs", odd)
            return self.product([*even, (size, 1)], abs(factor))
        kept = node.name in ("abs", "sqrt", "exp", "powr")
        return self.product([(rest if kept else self.node("abs", rest), 1)], abs(factor))

    def exp(self, index: int) -> int:
        if self.value(index) == 0:
            return self.one
        factor, rest = self.split(index)
        if self.nodes[rest].name == "log" and factor.denominator <= 2 and abs(factor) <= MOST_POWER:
            return self.power(self.nodes[rest].parts[0], factor)
        return self.node("exp", index)

    def log(self, index: int) -> int:
        if index == self.one:
            return self.number(Fraction(0))
        return self.nodes[index].parts[0] if self.nodes[index].name == "exp" else self.node("log", index)

    def sin(self, index: int) -> int:
        turns = self._turns(index)
        found = None if turns is None else self._cosine(turns - Fraction(1, 2))
        return self.node("sin", index) if found is None else found

    def cos(self, index: int) -> int:
        turns = self._turns(index)
        found = None if turns is None else self._cosine(turns)
        return self.node("cos", index) if found is None else found

    def tan(self, index: int) -> int:
        return self.number(Fraction(0)) if self.value(index) == 0 else self.node("tan", index)

    def _turns(self, index: int) -> Fraction | None:
        """Return a node over π if that is a rational number."""
        factor, rest = self.split(index)
        if rest == self.one:
            return Fraction(0) if not factor else None
        return factor if self.nodes[rest].name == "pi" else None

    def _cosine(self, turns: Fraction) -> int | None:
        """Return cos(turns·π) if COSINES has it."""
        turns = abs((turns + 1) % 2 - 1)  # in [0, 1]
        sign = -1 if turns > Fraction(1, 2) else 1
        found = COSINES.get(1 - turns if sign < 0 else turns)
        if found is None:
            return None
        root = self.sqrt(self.number(Fraction(found[2])))
        return self.sum([(self.one, sign * found[0]), (root, sign * found[1])])

    def min(self, a: int, b: int) -> int:
        return self._extreme("min", a, b)

    def max(self, a: int, b: int) -> int:
        return self._extreme("max", a, b)

    def _extreme(self, name: str, a: int, b: int) -> int:
        """Return the lesser or the greater of two nodes."""
        x, y = self.value(a), self.value(b)
        if x is not None and y is not None:
            return a if (x <= y) == (name == "min") else b
        return a if a == b else self.node(name, *sorted((a, b)))

    def floor(self, a: int) -> int:
        value = self.value(a)
        return self.node("floor", a) if value is None else self.number(Fraction(floor(value)))

    def atan2(self, a: int, b: int) -> int:
        y, x = self.value(a), self.value(b)
        if y == 0 and x is not None and x >= 0:
            return a
        return self.node("atan2", a, b)

    def below(self, a: int, b: int) -> int:
        x, y = self.value(a), self.value(b)
        if a == b or (x is not None and y is not None):
            return self.number(Fraction(int(a == b or x <= y)))  # type: ignore[operator]
        return self.node("below", a, b)

    def sign(self, a: int) -> int:
        """Return 1 if a >= 0, else −1."""
        return self.sum([(self.below(self.number(Fraction(0)), a), Fraction(2)), (self.one, -ONE)])

    def select(self, c: int, p: int, q: int) -> int:
        value = self.value(c)
        if value is not None:
            return p if value > 0 else q
        return p if p == q else self.node("select", c, p, q)

    def radical(self, index: int) -> tuple[int, list[tuple[int, int]]]:
        """Return the radical of a node as it is written, and its factors with their multiplicities.

        (x − 1)²·y gives (x − 1)·y and [(x − 1, 2), (y, 1)]. A node without repeated factors gives itself and []. |u|
        counts as u twice, since it has the roots of u and, like u², never changes its sign; so does a power of u that
        is not whole.
        """
        open_, found = {index: 1}, dict[int, int]()
        queue = [-index]  # parts come after what holds them
        while queue:
            last = -heappop(queue)
            power, node = open_.pop(last), self.nodes[last]
            inner: list[tuple[int, int]] = []
            if node.name in ("abs", "powr"):
                inner = [(node.parts[0], 2 * power)]
            elif node.name == "product" and any(e > 0 and not self.constant[p] for p, e in self.powers(last)):
                inner = [(p, e * power) for p, e in self.powers(last) if e > 0 and not self.constant[p]]
                poles = self.product([(p, e) for p, e in self.powers(last) if e < 0 and not self.constant[p]])
                found |= {poles: 1} if poles != self.one else {}
            else:
                found[last] = found.get(last, 0) + power
            for part, multiplicity in inner:
                if part not in open_:
                    heappush(queue, -part)
                open_[part] = open_.get(part, 0) + multiplicity
        if all(multiplicity == 1 for multiplicity in found.values()):
            return index, []
        return self.product([(part, 1) for part in found]), list(found.items())


def _bits(value: Fraction) -> int:
    """Return the length of the longer of numerator and denominator, in bits."""
    return max(value.numerator.bit_length(), value.denominator.bit_length())
