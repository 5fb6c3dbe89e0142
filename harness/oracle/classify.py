"""Estimates that sort rays into classes: the next root, the first root's condition, and the margin to another answer.

Plain float64 on samples along the ray, nothing proved; none of it decides whether a method's answer is right.

**Theory.** Where the first root t1 is known, the samples are of g = f / (t - t1)^m, m its multiplicity (2 for a touch),
with g(t1) = f'(t1): a next root or a near touch close to t1, which f's samples would step over, is an ordinary sign
change or least |g| of these. This is deflation without dividing polynomials, and `_root` steps by Maehly's formula.
Everything is as good as f' and f are in float64: a next root t2 to about condition · 2^-53 radii.

Another answer is near where |f| is small at one of a few places: near touches before the first root, the ends of the
stay, and the bottom of the first root's dip. Over |grad f| there, |f| is the margin: how far the surface is. Over what
kernels may be off in f's value there (harness.oracle.noise) it is the contrast: the unit roundoff at which f's sign
begins to be in doubt. Far from the surface the margin is large, and yet, where f is flat, the contrast may be none.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from harness.contract import Box, Domain, TruthStatus
from harness.oracle.balls64 import Floats
from harness.oracle.clip import clip_many, nearest, recentred
from harness.oracle.enclosure import Enclosure
from harness.oracle.floats import FloatFunction, majorant
from harness.oracle.noise import Noise, NoiseAlong

BLOCK = 1024  # rays at a time, so that the arrays stay in the cache
MOST_STEPS = 40  # of a bracketed search; it halves at least every second time
LAST_STEP = 2.0**-38  # of Newton's method, in domain radii: its error is about this one squared over a gap
SETTLED = 0.1  # an extremum is settled when |g| can fall by no more than this share
UNIT = 2.0**-53
CERTIFIED = 2.0**-42  # bound of the first root's error, in domain radii
BLUNT = 2.0**40  # condition of a first root above which f'(t1) is taken for rounding errors
DROWNED = 2.0**-40  # interpolated values below this share of the largest are not believed
FAINT_STEP = 3  # every so many samples are looked at for where |f| is faint: minima of |f| are looked at one by one
BOUNDS = 4  # pieces of the stay, at whose ends f's rounding errors are bounded for a first look
Estimates = tuple[Floats, Floats, Floats, Floats]  # following, condition, margin, contrast, each [n]
Indices = NDArray[np.intp]


@cache
def lobatto(degree: int) -> Floats:
    """Chebyshev's extrema in [0, 1], degree + 1 of them."""
    return np.asarray(0.5 - 0.5 * np.cos(np.pi * np.arange(degree + 1) / degree))


@cache
def interpolation(degree: int, finer: int) -> Floats:
    """Values of a polynomial at lobatto(degree * finer) from those at lobatto(degree), by its Chebyshev series."""
    weight = np.where(np.arange(degree + 1) % degree == 0, 0.5, 1.0) if degree > 1 else np.full(2, 0.5)
    order = np.arange(degree + 1)
    at_nodes = np.cos(np.pi / degree * np.outer(order, order)) * np.outer(weight, weight) * 2.0 / degree
    at_samples = np.cos(np.pi / (degree * finer) * np.outer(np.arange(degree * finer + 1), order))
    return np.asarray(at_samples @ at_nodes)


def classify(
    f: FloatFunction,
    enclosure: Enclosure,
    noise: Noise,
    domain: Domain,
    rays: Floats,
    first: Floats,
    status: NDArray[np.uint8],
    t_min: float = 0.0,
) -> Estimates:
    """`rays`: float64[n, 6]; `first`: the first root's t, float64[n], NaN without a hit; see contract.Truth.

    `enclosure` is of f or of a function with the same roots: it tells two close roots from rounding errors. `noise` is
    of f as kernels evaluate it.
    """
    if not len(rays):
        return np.empty(0), np.empty(0), np.empty(0), np.empty(0)
    parts = []
    with np.errstate(all="ignore"):
        for k in range(0, len(rays), BLOCK):
            piece = slice(k, k + BLOCK)
            block = _Block(f, enclosure, noise, domain, rays[piece], first[piece], status[piece], t_min)
            parts.append(block.estimates())
    following, condition, margin, contrast = (np.concatenate(columns) for columns in zip(*parts, strict=True))
    return following, condition, margin, contrast


@dataclass(frozen=True)
class _Extrema:
    """Where |g| is locally least on rays `rows`; all arrays [k]."""

    rows: Indices
    lower: Floats  # t in front of it, with g of the sign `side`
    t: Floats
    side: Floats
    width: Floats  # how far from `t` the two complex roots are that make it
    crossed: NDArray[np.bool_]  # g's sign at `t` is the other, and beyond rounding errors


class _Block:
    """Rays with their origins moved near the domain, f and g sampled along them."""

    def __init__(
        self,
        f: FloatFunction,
        enclosure: Enclosure,
        noise: Noise,
        domain: Domain,
        rays: Floats,
        first: Floats,
        status: NDArray[np.uint8],
        t_min: float,
    ) -> None:
        self.f = f
        self.t_min = t_min
        self.enclosure = enclosure
        self.noise = noise
        self.given = rays
        self.domain = domain
        self.status = status
        self.shift = nearest(np.asarray(domain.center), rays)
        self.rays = recentred(rays, self.shift)
        self.length = np.sqrt((rays[:, 3:] ** 2).sum(axis=1))
        clip = clip_many(domain, rays, t_min)
        self.missed = clip.missed
        self.enter = clip.enter_lower - self.shift
        self.leave = clip.leave_upper - self.shift
        self.first = first - self.shift
        self.hit = np.isfinite(self.first)
        self.order = np.where(self.hit, np.where(status == TruthStatus.TOUCH, 2.0, 1.0), 0.0)  # m
        self.slope = self.f.along(self.rays, self.first).slope
        terms = majorant(self.f, self.rays, self.first)
        self.condition = terms * self.length / (np.abs(self.slope) * domain.radius)
        self._sample()

    def estimates(self) -> Estimates:
        found = self._least()
        following = self._parted(self._following(found))
        everyone, n = np.arange(len(self.hit)), len(self.hit)
        before = np.where(self.hit, self.first, np.inf)
        ahead = before[found.rows] - found.t
        near = (ahead > self.blur[found.rows]) & ~(3.0**0.5 * found.width > ahead)
        behind = np.where(self.hit, self._deepest(following), self.leave)
        rows = np.concatenate((found.rows[near], everyone, everyone))
        t = np.concatenate((found.t[near], self.enter, behind))
        margin, contrast = np.full(n, np.inf), np.full(n, np.inf)
        rays = self.rays[rows]
        np.fmin.at(margin, rows, np.abs(self.f.values(rays, t)) / self.f.steepness(rays, t))
        noise = self.noise.along(self.rays)
        faint, at = self._faintest(noise)
        rows, t = np.concatenate((rows, faint)), np.concatenate((t, at))
        np.fmin.at(contrast, rows, np.abs(self.f.values(self.rays[rows], t)) / noise.bound(rows, t))
        room = np.minimum(self._inside(self.first), (self.first + self.shift - self.t_min) * self.length)
        room = np.minimum(room, 0.5 * (following - self.first) * self.length)  # nothing between two roots is deeper
        margin = np.where(self.hit, np.minimum(margin, np.maximum(room, 0.0)), margin)
        margin = np.where(self.missed, self._gap(), margin)
        contrast = np.where(self.missed, np.inf, contrast)
        open_ = (self.status == TruthStatus.TOUCH) | (self.status == TruthStatus.UNDECIDED)
        return (
            following + self.shift,
            self.condition,
            np.where(open_, 0.0, margin),
            np.where(open_, 0.0, contrast),
        )

    def _parted(self, following: Floats) -> Floats:
        """The next roots, where f has the sign behind a crossing that it has before it: then another root lies between,
        and where none was found it is nearer to the first than its blur."""
        rows = np.flatnonzero(self.order == 1.0)
        column = self.column[rows]
        before, behind = (np.sign(self.values[rows, column + step]) for step in (-1, 1))
        hidden = (before == behind) & (before != 0.0) & ~(following[rows] <= self.t[rows, column + 1])
        near = rows[hidden]
        following[near] = self.first[near] + self.blur[near]
        return following

    def _faintest(self, noise: NoiseAlong) -> tuple[Indices, Floats]:
        """Rays, and t of the sample before the first root at which |f| is least beside its rounding errors.

        Samples at which |f| is over half of what the first root's slope makes it belong to that root.
        """
        some = slice(None, None, FAINT_STEP)
        t, g, size = self.t[:, some], np.abs(self.g[:, some]), np.abs(self.values[:, some])
        ends, share = lobatto(BOUNDS), lobatto(self.t.shape[1] - 1)[some]
        looked = self.enter[:, None] + (self.leave - self.enter)[:, None] * ends
        rows = np.repeat(np.arange(len(looked)), BOUNDS + 1)
        bounds = noise.by_tape(rows, looked.ravel()).reshape(looked.shape)
        place = np.clip(np.searchsorted(ends, share, side="right") - 1, 0, BOUNDS - 1)
        weight = (share - ends[place]) / (ends[place + 1] - ends[place])
        about = np.add(bounds[:, place] * (1.0 - weight), bounds[:, place + 1] * weight)
        own = self.hit[:, None] & (g >= 0.5 * np.abs(self.slope)[:, None])
        own |= self.hit[:, None] & (t >= (self.first - self.blur)[:, None])
        ratio = np.where(~own & np.isfinite(about), size / about, np.inf)
        column = ratio.argmin(axis=1)
        faint = np.flatnonzero(np.isfinite(ratio[np.arange(len(ratio)), column]))
        return faint, t[faint, column[faint]]

    def _sample(self) -> None:
        """t, f and g at Chebyshev's points of the clip interval, one of them moved to t1."""
        last = self.f.samples - 1
        self.t = self.enter[:, None] + (self.leave - self.enter)[:, None] * lobatto(last)
        self.values = self._interpolated() if self.f.interpolates else self.f.values(self.rays, self.t).copy()
        place = np.clip((self.first - self.enter) / (self.leave - self.enter), 0.0, 1.0)
        nearest_sample = np.rint(np.arccos(1.0 - 2.0 * place) * last / np.pi)
        self.column = np.clip(np.nan_to_num(nearest_sample), 1, last - 1).astype(np.intp)
        rows, column = np.flatnonzero(self.hit), self.column[self.hit]
        self.t[rows, column] = self.first[rows]
        self.values[rows, column] = 0.0
        touch = self.order == 2.0
        gap = self.t - self.first[:, None]
        gap[touch] *= gap[touch]
        self.g = np.divide(self.values, gap, out=self.values.copy(), where=self.hit[:, None])
        # nearer to t1 than rounding errors move roots, g is what it is at t1; that is unknown where f' is only noise
        sharp = (self.order == 1.0) & (self.condition < BLUNT)
        spacing = 2.0 * np.spacing(np.abs(self.first + self.shift))
        blur = (4.0 * UNIT * self.condition + CERTIFIED) * self.domain.radius / self.length + spacing
        self.blur = np.where(sharp, blur, 0.0)
        behind = self.g[rows, column + 1]
        self.g[rows, column] = np.where(sharp[rows], self.slope[rows], behind)
        least_gap = np.minimum(np.abs(gap[rows, column - 1]), np.abs(gap[rows, column + 1]))
        for row in rows[least_gap <= self.blur[rows]]:
            self.g[row, np.abs(gap[row]) <= self.blur[row]] = self.slope[row]
        positive = self.g > 0.0
        self.differ = positive[:, 1:] != positive[:, :-1]
        change = self.differ & (np.arange(last) >= np.where(self.hit, self.column, last)[:, None])
        self.change = np.where(change.any(axis=1), change.argmax(axis=1), last)  # column before g's, behind t1

    def _interpolated(self) -> Floats:
        """f at the samples, a polynomial from degree + 1 of them; what drowns in its rounding errors, one by one."""
        every = (self.f.samples - 1) // self.f.program.degree
        known = self.f.values(self.rays, self.t[:, ::every])
        values = known @ interpolation(self.f.program.degree, every).T
        rows, columns = np.nonzero(np.abs(values) < DROWNED * np.abs(known).max(axis=1, keepdims=True))
        values[rows, columns] = self.f.values(self.rays[rows], self.t[rows, columns])
        return np.asarray(values)

    def _least(self) -> _Extrema:
        """The extrema at which |g| is locally least, up to the sampled change of sign behind t1."""
        size = np.abs(self.g)
        rises = size[:, 1:] > size[:, :-1]
        least = np.arange(size.shape[1]) <= self.change[:, None]
        least[:, 1:] &= ~rises | self.differ
        least[:, :-1] &= rises | self.differ
        rows, columns = np.nonzero(least)
        slope = self._deflated(rows, self.t[rows, columns])[1] * np.sign(self.g[rows, columns])
        at_first = self.hit[rows] & (columns == self.column[rows])  # where the slope is not known: both sides
        ahead, behind = (slope <= 0.0) | at_first, (slope > 0.0) | at_first
        rows = np.concatenate((rows[ahead], rows[behind]))
        left = np.concatenate((columns[ahead], columns[behind] - 1))
        slopes = np.concatenate((slope[ahead], slope[behind]))
        is_left = np.arange(len(rows)) < ahead.sum()
        inside = (left >= 0) & (left < self.differ.shape[1])
        inside &= ~self.differ[rows, np.where(inside, left, 0)]
        rows, left, slopes, is_left = rows[inside], left[inside], slopes[inside], is_left[inside]
        return self._settled(rows, left, slopes, is_left)

    def _settled(self, rows: Indices, left: Indices, known: Floats, is_left: NDArray[np.bool_]) -> _Extrema:
        """The least |g| between samples `left` and `left` + 1 by cubics; `known` is |g|' at the one that `is_left`."""
        side = np.sign(self.g[rows, left])
        lower, upper = self.t[rows, left], self.t[rows, left + 1]
        low, high = np.abs(self.g[rows, left]), np.abs(self.g[rows, left + 1])
        other = self._deflated(rows, np.where(is_left, upper, lower))[1] * side
        falls, climbs = np.where(is_left, known, other), np.where(is_left, other, known)
        # the slope at t1 itself is that of a parabola, with the sign that makes a bracket
        secant = 2.0 * (high - low) / (upper - lower)
        at_first = self.first[rows]
        falls = np.where(lower == at_first, -np.abs(secant - climbs), falls)
        climbs = np.where(upper == at_first, np.abs(secant - falls), climbs)
        t, depth = np.where(low < high, lower, upper), np.minimum(low, high)
        stuck = np.zeros(len(rows), dtype=bool)
        k = np.arange(len(rows))
        for _ in range(MOST_STEPS):
            if not len(k):
                break
            a, b, fall, climb = lower[k], upper[k], falls[k], climbs[k]
            width = b - a
            bend = fall + climb - 3.0 * (high[k] - low[k]) / width
            root = np.sqrt(bend * bend - fall * climb)
            guess = b - width * (climb + root - bend) / (climb - fall + 2.0 * root)
            guess = np.where((guess > a) & (guess < b) & ~stuck[k], guess, 0.5 * (a + b))
            g, slope = self._deflated(rows[k], guess)
            g, slope = g * side[k], slope * side[k]
            better = g < depth[k]
            t[k[better]], depth[k[better]] = guess[better], g[better]
            front = (slope < 0.0) & (g > 0.0)
            lower[k], low[k], falls[k] = (
                np.where(front, guess, a),
                np.where(front, g, low[k]),
                np.where(front, slope, fall),
            )
            upper[k], high[k], climbs[k] = (
                np.where(front, b, guess),
                np.where(front, high[k], g),
                np.where(front, climb, slope),
            )
            left_over = upper[k] - lower[k]
            stuck[k] = left_over > 0.5 * width
            go_on = (g > 0.0) & (np.abs(slope) * left_over > SETTLED * g) & (left_over > UNIT * np.abs(guess))
            k = k[go_on]
        crossed = depth < 0.0
        crossed[crossed] = self._proved(rows[crossed], t[crossed])
        bend = (climbs - falls) / (upper - lower)
        return _Extrema(rows, lower, t, side, np.sqrt(2.0 * np.maximum(depth, 0.0) / bend), crossed)

    def _proved(self, rows: Indices, t: Floats) -> NDArray[np.bool_]:
        """Whether f is not 0, for what float64 balls can tell."""
        return np.asarray(self.enclosure.along(self.given[rows], t + self.shift[rows]).sign != 0)

    def _following(self, found: _Extrema) -> Floats:
        """The first change of g's sign behind the first root, sampled or settled; inf where there is none."""
        last = self.t.shape[1] - 1
        everyone = np.arange(len(self.hit))
        end = np.minimum(self.change + 1, last)
        lower, side = self.t[everyone, end - 1], np.sign(self.g[everyone, end])
        upper = np.where(self.change < last, self.t[everyone, end], np.inf)
        crossed = found.crossed & (found.t > self.first[found.rows])
        rows = found.rows[crossed]
        np.minimum.at(upper, rows, found.t[crossed])
        mine = upper[rows] == found.t[crossed]
        lower[rows[mine]], side[rows[mine]] = found.lower[crossed][mine], -found.side[crossed][mine]
        rows = np.flatnonzero(self.hit & np.isfinite(upper))
        following = np.full(len(upper), np.inf)
        following[rows] = self._root(rows, np.maximum(lower, self.first)[rows], upper[rows], side[rows])
        return following

    def _root(self, rows: Indices, lower: Floats, upper: Floats, side: Floats) -> Floats:
        """The root of g in each bracket, at whose upper end g has the sign `side`: Newton, halving as it must."""
        t = 0.5 * (lower + upper)
        enough = LAST_STEP * self.domain.radius / self.length[rows]
        moved = upper - lower
        k = np.arange(len(rows))
        for _ in range(MOST_STEPS):
            if not len(k):
                break
            at = t[k]
            g, slope = self._deflated(rows[k], at)
            high = g * side[k] > 0.0
            lower[k], upper[k] = np.where(high, lower[k], at), np.where(high, at, upper[k])
            step = at - g / slope
            good = (step >= lower[k]) & (step <= upper[k]) & (np.abs(step - at) < 0.5 * moved[k])
            t[k] = np.where(good, step, 0.5 * (lower[k] + upper[k]))
            moved[k] = np.abs(t[k] - at)
            k = k[moved[k] > enough[k]]
        return t

    def _deflated(self, rows: Indices, t: Floats) -> tuple[Floats, Floats]:
        """g and dg/dt on `rows`; NaN or infinite at t1."""
        f = self.f.along(self.rays[rows], t)
        order = self.order[rows]
        gap = np.where(order > 0.0, t - self.first[rows], 1.0)
        power = np.where(order == 2.0, gap * gap, gap)
        return f.value / power, (f.slope - order * f.value / gap) / power

    def _deepest(self, following: Floats) -> Floats:
        """t where |f| is largest between the first root and the next, or the clip end: how deep the ray dips."""
        stop = np.minimum(following, self.leave)
        between = (self.t > self.first[:, None]) & (self.t < stop[:, None])
        size = np.where(between, np.abs(self.values), -1.0)
        column = size.argmax(axis=1)
        everyone = np.arange(len(stop))
        middle = 0.5 * (self.first + stop)
        sampled = size[everyone, column] > np.abs(self.f.values(self.rays, middle))
        return np.where(sampled, self.t[everyone, column], middle)

    def _inside(self, t: Floats) -> Floats:
        """Distance of o + t·d to the domain's boundary; negative outside."""
        points = self.rays[:, :3] + t[:, None] * self.rays[:, 3:]
        if isinstance(self.domain, Box):
            lower, upper = np.asarray(self.domain.lower), np.asarray(self.domain.upper)
            return np.asarray(np.minimum(points - lower, upper - points).min(axis=1))
        offset = points - np.asarray(self.domain.center)
        return np.asarray(self.domain.radius - np.sqrt((offset**2).sum(axis=1)))

    def _gap(self) -> Floats:
        """For rays that miss the domain: how far it is from them, or the surface from there if that is more."""
        t = np.maximum(0.0, self.t_min - self.shift)  # recentred: 0 is nearest to the centre
        surface = np.abs(self.f.values(self.rays, t)) / self.f.steepness(self.rays, t)
        return np.asarray(np.fmax(np.maximum(-self._inside(t), 0.0), surface))
