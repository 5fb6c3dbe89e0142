"""Prove that f is a distance bound: its Lipschitz constant is 1, so that no point of the surface is nearer than |f|.

**Theory.** Each operation gets a symmetric matrix M that no gradient g of it leaves: (a.g)^2 <= a.M.a for every
direction a, wherever the operation has a gradient. The largest eigenvalue of M is the square of a Lipschitz constant.
Coordinates have unit matrices of one entry; sums of u and v have (1 + s) M_u + (1 + 1/s) M_v for any s > 0; the root of
a sum of squares has the sum of its parts' matrices, so that the length of x, y and z has the unit matrix. A minimum, a
maximum and a smooth minimum -log(sum exp(-k d))/k are convex combinations where they have a gradient: theirs is any
matrix above those of their parts. Other functions scale M by their steepest slope on the part's range (`signs`).

Where structure does not tell, the gradient itself is bounded on boxes that cover the domain.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from surfaces.evaluation import Floats64, evaluate_tape
from surfaces.lowering import gradient, real_tape
from surfaces.model import Domain
from surfaces.proofs.blending import is_blend
from surfaces.proofs.boxes import box_about, corners, halved, outside
from surfaces.proofs.ranges import outputs
from surfaces.proofs.signs import MOST_TERMS, Range, ranges_of
from surfaces.tape import JUMPS, Op, Tape

ONE = 1.0 + 2.0**-30  # what rounding of the bounds themselves may add to 1; a float32 is wrong by 2^-24
SECONDS, PER_OPERATION, PER_BOX = 0.3, 2e-5, 1e-7  # of bounding gradients on boxes, counted by the work
MOST_OPERATIONS = 3000  # of a formula whose gradient is bounded on boxes
STEEP = 0.5
SEGMENTS = 512  # on which places are looked for where f changes its sign
PAIRS = 256  # of near points on which f is tried before anything is proved
Matrix = tuple[float, float, float, float, float, float]  # xx, yy, zz, xy, xz, yz
_ZERO: Matrix = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


def is_distance(tape: Tape, domain: Domain) -> bool:
    """Return whether f may be taken as the distance: it is a bound, and where it is 0 it is STEEP enough.

    A march ends where the distance is small; of a bound that is much smaller than the distance this says nothing.
    """
    return is_distance_bound(tape, domain) and _steep(tape, domain)


def is_distance_bound(tape: Tape, domain: Domain) -> bool:
    """Return whether a tape without undefined places is proved to have the Lipschitz constant 1 all over a domain."""
    if any(op.name in JUMPS for op in tape.ops) or not _plausible(tape, domain):
        return False
    bound = _Bounds(tape, ranges_of(tape, box_about(domain))).of(tape.outputs[0])
    return (bound is not None and _largest(bound) <= ONE) or _on_boxes(tape, domain)


def _plausible(tape: Tape, domain: Domain) -> bool:
    """Return whether no two of some near points contradict the Lipschitz constant 1."""
    rng, radius, center = np.random.default_rng(1), domain.radius, np.array(domain.center)
    lower, upper = (np.array(corner) for corner in corners(domain))
    points = rng.uniform(lower, upper, (PAIRS, 3))
    points = points[~outside(domain, points, points)]
    away = rng.normal(size=points.shape)
    away *= 1e-3 * radius / np.linalg.norm(away, axis=1)[:, None]
    others = points + np.where(np.sum(away * (points - center), axis=1)[:, None] > 0.0, -away, away)
    real = real_tape(tape)
    with np.errstate(all="ignore"):
        apart = np.abs(evaluate_tape(real, points) - evaluate_tape(real, others))[:, 0]
    return bool((apart <= 1.001 * np.linalg.norm(points - others, axis=1)).all())


def _steep(tape: Tape, domain: Domain) -> bool:
    """Return whether f has slopes of STEEP or more at most of some places where it changes its sign."""
    rng, real = np.random.default_rng(2), real_tape(tape)
    lower, upper = (np.array(corner) for corner in corners(domain))
    ends = rng.uniform(lower, upper, (2, SEGMENTS if len(tape.ops) <= MOST_OPERATIONS else SEGMENTS // 16, 3))

    def f(points: Floats64) -> Floats64:
        return evaluate_tape(real, points)[:, 0]

    first, last = ends
    signs = f(first) < 0.0
    crossed = signs != (f(last) < 0.0)
    first, last, signs = first[crossed], last[crossed], signs[crossed]
    for _ in range(20):
        middle = 0.5 * (first + last)
        same = ((f(middle) < 0.0) == signs)[:, None]
        first, last = np.where(same, middle, first), np.where(same, last, middle)
    step = 1e-5 * domain.radius
    slopes = [(f(first + step * axis) - f(first - step * axis)) / (2.0 * step) for axis in np.eye(3)]
    return bool(len(first)) and bool(np.median(np.linalg.norm(slopes, axis=0)) >= STEEP)


def _on_boxes(tape: Tape, domain: Domain) -> bool:
    """Return whether the gradient is at most 1 long on boxes that cover the domain, which are halved in time."""
    if len(tape.ops) > MOST_OPERATIONS:
        return False
    slopes, left = gradient(real_tape(tape), guarded=False), SECONDS
    used = np.array([any(op.name == "var" and op.args[0] == axis for op in tape.ops) for axis in "xyz"])
    lower, upper = (np.array([corner], np.float64) for corner in corners(domain))
    while len(lower) and left > 0.0:
        left -= len(slopes.ops) * (PER_OPERATION + PER_BOX * len(lower))
        steep = np.maximum(*(np.abs(end) for end in outputs(slopes, lower, upper)))
        with np.errstate(over="ignore"):
            steeper = ~((steep * steep).sum(axis=1) <= ONE) & ~outside(domain, lower, upper)
        lower, upper = halved(lower[steeper], upper[steeper], used)
    return not len(lower)


class _Bounds:
    """Compute the matrix of each operation of a tape whose `ranges` are known; None where there is none."""

    def __init__(self, tape: Tape, ranges: Sequence[Range]) -> None:
        self.ops, self.ranges = tape.ops, ranges
        self.constant = tape.constants()
        self.affine: list[tuple[float, float, float] | None] = []  # the gradient of what is linear in x, y and z
        self.bounds: list[Matrix | None] = []
        for index in range(len(tape.ops)):
            slope = self._affine(index)
            self.affine.append(slope)
            self.bounds.append(_outer(slope) if slope else self._bound(index))

    def of(self, index: int) -> Matrix | None:
        return self.bounds[index]

    def _affine(self, index: int) -> tuple[float, float, float] | None:
        op = self.ops[index]
        if self.constant[index]:
            return 0.0, 0.0, 0.0
        if op.name == "var":
            return tuple(float(op.args[0] == axis) for axis in "xyz")  # type: ignore[return-value]
        if op.name not in ("add", "sub", "neg", "mul"):
            return None
        parts = [self.affine[i] for i in op.inputs]
        if op.name == "mul":
            part = parts[1] if self.constant[op.args[0]] else parts[0] if self.constant[op.args[1]] else None
            fixed = self.ranges[op.args[0] if self.constant[op.args[0]] else op.args[1]]
            return None if part is None else _times(part, 0.5 * (fixed.low + fixed.high))
        if None in parts:
            return None
        first, last = parts[0], _times(parts[-1], 1.0 if op.name == "add" else -1.0)  # type: ignore[arg-type]
        return last if op.name == "neg" else tuple(a + b for a, b in zip(first, last, strict=True))  # type: ignore[arg-type, return-value]

    def _bound(self, index: int) -> Matrix | None:
        op = self.ops[index]
        of = [self.bounds[i] for i in op.inputs]
        if None in of:
            return None
        match op.name:
            case "neg" | "abs" | "sin" | "cos":
                return of[0]
            case "min" | "max":
                return self._above(op.args)
            case "sqrt" | "powr" if (parts := list(self._norm(op))) and all(part is not None for part in parts):
                return _total([part for part in parts if part is not None])
            case "log" if (inner := self._exponents(op.args[0])) is not None:
                return self._above(inner)
            case "add" | "sub":
                return self._sum(op)
            case "mul" | "div":
                return self._product(op)
        slope = _steepest(op, self.ranges[op.args[0]])
        return _scaled(of[0], slope * slope) if slope is not None and of[0] is not None else None

    def _above(self, parts: Sequence[int]) -> Matrix | None:
        """Return a matrix above those of some operations."""
        made: Matrix = _ZERO
        for i in parts:
            bound = self.bounds[i]
            if bound is None:
                return None
            made = _over(made, bound)
        return made

    def _sum(self, op: Op) -> Matrix | None:
        a, b = op.args
        first, second = self.bounds[a], self.bounds[b]
        assert first is not None and second is not None
        if op.name == "add" and (self._apart(a, b) or self._apart(b, a)):
            return self._above((a, b))
        plain = _added(first, second)
        if _largest(plain) > ONE and (ends := is_blend(self.ops, op)):
            return self._above(ends)
        return plain

    def _apart(self, a: int, b: int) -> bool:
        """Return whether a = length(max(q, 0), …) and b = min(max(q, …), 0), of which one is 0 everywhere."""
        a, b = self._without_offset(a), self._without_offset(b)
        if self.ops[b].name != "min" or not any(self._is_zero(i) for i in self.ops[b].args):
            return False
        most, stack, steps = set(), [i for i in self.ops[b].args if not self._is_zero(i)], 0
        while stack and steps < MOST_TERMS:
            index, steps = stack.pop(), steps + 1
            most.add(index)
            stack += self.ops[index].args if self.ops[index].name == "max" else ()
        squares = self._leaves(self.ops[a].args[0]) if self.ops[a].name == "sqrt" else []
        outer = [self.ops[i].args[0] for i in squares if self.ops[i].name == "sqr"] if squares else [a]
        if len(outer) < len(squares):
            return False
        return all(
            self.ops[i].name == "max"
            and any(self._is_zero(j) for j in self.ops[i].args)
            and any(j in most for j in self.ops[i].args)
            for i in outer
        )

    def _is_zero(self, index: int) -> bool:
        return self.ops[index].name == "const" and self.ops[index].args[0] == 0

    def _without_offset(self, index: int) -> int:
        op = self.ops[index]
        return op.args[0] if op.name in ("add", "sub") and self.constant[op.args[1]] else index

    def _leaves(self, index: int) -> list[int]:
        """Return the terms of a sum; it alone where they are more than MOST_TERMS."""
        found, stack = [], [index]
        while stack:
            at = stack.pop()
            if self.ops[at].name == "add":
                stack += self.ops[at].args
            else:
                found.append(at)
            if len(found) + len(stack) > MOST_TERMS:
                return [index]
        return found

    def _norm(self, op: Op) -> Iterator[Matrix | None]:
        """Yield the matrices of the parts of a root of squares, or of a root of even powers; None for what is no part.

        The gradient of (|u|^p + |v|^p)^(1/p) by u and v is at most 1 long for every p >= 2.
        """
        power = 2 if op.name == "sqrt" else 1 / op.args[1]
        for index in self._leaves(op.args[0]):
            term, factor = self.ops[index], 1.0
            if term.name == "mul" and self.constant[term.args[0]]:
                factor, term = self.ranges[term.args[0]].high, self.ops[term.args[1]]
            raised = 2 if term.name == "sqr" else term.args[1] if term.name in ("powi", "powr") else None
            even = term.name != "powi" or term.args[1] % 2 == 0 or self.ranges[term.args[0]].low >= 0.0
            part = self.bounds[term.args[0]] if term.inputs else None
            if self.constant[index] and self.ranges[index].low >= 0.0:
                yield _ZERO
            elif raised is not None and raised == power >= 2 and even and factor >= 0.0 and part is not None:
                yield _scaled(part, factor ** (2.0 / float(power)) * (1.0 + 1e-15))
            else:
                yield None

    def _exponents(self, index: int) -> list[int] | None:
        """Return u, v, … of a sum of positive multiples of exp(u), exp(v), … and constants; None for another sum."""
        found = []
        for leaf in self._leaves(index):
            op = self.ops[leaf]
            if op.name == "mul" and self.constant[op.args[0]] and self.ranges[op.args[0]].low > 0.0:
                op = self.ops[op.args[1]]
            if op.name == "exp":
                found.append(op.args[0])
            elif not (self.constant[leaf] and self.ranges[leaf].low >= 0.0):
                return None
        return found

    def _product(self, op: Op) -> Matrix | None:
        a, b = op.args
        first, second, u, v = self.bounds[a], self.bounds[b], self.ranges[a], self.ranges[b]
        assert first is not None and second is not None
        if op.name == "mul":
            return _added(_stretched(first, _size(v)), _stretched(second, _size(u)))
        least = max(v.low, -v.high)
        if not least > 0.0:
            return None
        return _added(_stretched(first, 1.0 / least), _stretched(second, _size(u) / least / least))


def _size(known: Range) -> float:
    return max(abs(known.low), abs(known.high))


def _steepest(op: Op, known: Range) -> float | None:
    """Return the largest |slope| of a function of one value on its range; None where there is none."""
    most = _size(known)
    try:
        match op.name:
            case "sqr":
                return 2.0 * most
            case "powi":
                return float(op.args[1] * most ** (op.args[1] - 1))
            case "exp":
                return math.exp(known.high) * (1.0 + 1e-14)
            case "log" if known.low > 0.0:
                return 1.0 / known.low
            case "sqrt" if known.low > 0.0:
                return 0.5 / math.sqrt(known.low)
            case "powr":
                q = float(op.args[1])
                base = known.high if q >= 1.0 else known.low
                return q * base ** (q - 1.0) * (1.0 + 1e-14) if base > 0.0 else None
    except OverflowError:
        return None
    return None


def _outer(g: tuple[float, float, float]) -> Matrix:
    x, y, z = g
    return x * x, y * y, z * z, x * y, x * z, y * z


def _times(g: tuple[float, float, float], by: float) -> tuple[float, float, float]:
    return g[0] * by, g[1] * by, g[2] * by


def _scaled(m: Matrix, by: float) -> Matrix:
    return m[0] * by, m[1] * by, m[2] * by, m[3] * by, m[4] * by, m[5] * by


def _stretched(m: Matrix, slope: float) -> Matrix:
    """Return the matrix of what grows `slope` times as fast; nothing that does not grow does it infinitely fast."""
    return _ZERO if m == _ZERO else _scaled(m, slope * slope)


def _total(parts: Sequence[Matrix]) -> Matrix:
    xx, yy, zz, xy, xz, yz = (sum(values) for values in zip(*parts, strict=True))
    return xx, yy, zz, xy, xz, yz


def _largest(m: Matrix) -> float:
    """Return the largest eigenvalue; infinity where an entry is not finite."""
    if not all(map(math.isfinite, m)):
        return math.inf
    xx, yy, zz, xy, xz, yz = m
    if not (xy or xz or yz):
        return max(xx, yy, zz)
    return float(np.linalg.eigvalsh([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])[-1])


def _added(a: Matrix, b: Matrix) -> Matrix:
    """Return a matrix for the sum of two operations: of some s > 0 the one whose largest eigenvalue is least."""
    if a == _ZERO or b == _ZERO:
        return b if a == _ZERO else a
    u, v = _largest(a), _largest(b)
    if not math.isfinite(u + v) or min(u, v) <= 0.0:
        return _total([_scaled(a, 2.0), _scaled(b, 2.0)])
    ratios = [s for s in (math.sqrt(v / u), v / u) if s > 0.0] or [1.0]  # a quotient may underflow
    return min((_total([_scaled(a, 1.0 + s), _scaled(b, 1.0 + 1.0 / s)]) for s in ratios), key=_largest)


def _over(a: Matrix, b: Matrix) -> Matrix:
    """Return a matrix above two others."""
    if a in (_ZERO, b):
        return b
    if not any((*a[3:], *b[3:])):
        return (max(a[0], b[0]), max(a[1], b[1]), max(a[2], b[2]), 0.0, 0.0, 0.0)
    most = max(_largest(a), _largest(b))
    x, y, z = (most if a[k] or b[k] else 0.0 for k in range(3))
    return x, y, z, 0.0, 0.0, 0.0
