"""Estimate what sorts rays into classes: the next root, the first root's condition, and how near another answer is.

It is computed in plain float64 from samples along the ray. Nothing is proved, and nothing here decides whether a
method's answer is right.

**Theory.** If the first root t1 is known, not f is sampled but g = f / (t - t1)^m, where m is the root's multiplicity
(2 for a touch) and g(t1) = f'(t1). A next root or a near touch close to t1, which samples of f would step over, is an
ordinary sign change or minimum of |g|. This is deflation without dividing polynomials; `_root` steps by Maehly's
formula. Results are as accurate as f and f' are in float64: a next root t2 to about condition · 2^-53 radii.

Another answer is near if |f| is small at one of a few places: near touches before the first root, the ends of the clip
interval, and the bottom of the first root's dip. |f| / |grad f| there is the margin, the distance of the surface. |f|
over the rounding errors that kernels may make in f's value there (harness.oracle.noise) is the contrast, the unit
roundoff from which on f's sign is in doubt. Far from the surface the margin is large; but if f is flat, the contrast
may be small even there.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from harness.contract import Box, Domain, TruthStatus
from harness.oracle.balls64 import Floats
from harness.oracle.clip import clip_many, nearest, recentred
from harness.oracle.enclosure import Enclosure
from harness.oracle.floats import FloatFunction, majorant
from harness.oracle.noise import Noise, NoiseAlong
from harness.oracle.sampling import interpolation, least_of_cubic, lobatto

BLOCK = 1024  # rays at a time, so that the arrays stay in the cache
MOST_STEPS = 40  # of a bracketed search; it halves at least every second time
LAST_STEP = 2.0**-38  # of Newton's method, in domain radii: its error is about this one squared over a gap
SETTLED = 0.1  # an extremum is found when |g| can fall by no more than this share
UNIT = 2.0**-53
CERTIFIED = 2.0**-42  # bound of the first root's error, in domain radii
BLUNT = 2.0**40  # the condition of a first root above which f'(t1) is only rounding errors
DROWNED = 2.0**-40  # interpolated values below this share of the largest are not believed
FAINT_STEP = 3  # every so many samples are searched for a small |f|; its minima are searched one by one
BOUNDS = 4  # pieces of the clip interval, at whose ends f's rounding errors are bounded for a first estimate
Estimates = tuple[Floats, Floats, Floats, Floats]  # following, condition, margin, contrast, each [n]
Indices = NDArray[np.intp]


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
    """Return following, condition, margin and contrast of rays, float64[n] each; see contract.Truth.

    `rays` is float64[n, 6], `first` the first root's t, float64[n] with NaN where there is no hit, and `status` the
    TruthStatus, uint8[n]. `enclosure` encloses f, or a function with the same roots; it tells two close roots from
    rounding errors. `noise` bounds the rounding errors of f as kernels evaluate it.
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
    """Hold local minima of |g| on the rays `rows`; all arrays are [k]."""

    rows: Indices
    lower: Floats  # t before the minimum, where g has the sign `side`
    t: Floats
    side: Floats
    width: Floats  # the distance from `t` to the two complex roots that cause the minimum
    crossed: NDArray[np.bool_]  # whether g has the other sign at `t`, and not by rounding errors


class _Block:
    """Hold some rays, with their origins moved near the domain, and the samples of f and g along them."""

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
        """Return following, condition, margin and contrast of the block's rays."""
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
        room = np.minimum(room, 0.5 * (following - self.first) * self.length)  # a dip between two roots is no deeper
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
        """Return `following`, float64[n], with roots added that are too close to the first root to be found.

        If f has the same sign before and behind a crossing, another root lies there. If none was found, it is within
        the blur of the first root.
        """
        rows = np.flatnonzero(self.order == 1.0)
        column = self.column[rows]
        before, behind = (np.sign(self.values[rows, column + step]) for step in (-1, 1))
        hidden = (before == behind) & (before != 0.0) & ~(following[rows] <= self.t[rows, column + 1])
        near = rows[hidden]
        following[near] = self.first[near] + self.blur[near]
        return following

    def _faintest(self, noise: NoiseAlong) -> tuple[Indices, Floats]:
        """Return rays int[k], and float64[k]: t of the sample where |f| is least over its rounding errors.

        Only samples before the first root count.

        Samples are left out that belong to the first root itself, where |f| is more than half of what the slope at that
        root gives. A ray without other samples is not among the result.
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
        """Sample f and g at Chebyshev's points of the clip interval, of which the nearest to t1 is moved to t1."""
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
        # as near as rounding errors move roots, g is g(t1), which is not known if f' is only rounding errors
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
        self.change = np.where(change.any(axis=1), change.argmax(axis=1), last)  # the column before g's change

    def _interpolated(self) -> Floats:
        """Return a polynomial's values at all samples, float64[n, samples], interpolated from degree + 1 of them.

        Values that are lost in the rounding errors of interpolation are evaluated one by one.
        """
        every = (self.f.samples - 1) // self.f.program.degree
        known = self.f.values(self.rays, self.t[:, ::every])
        values = known @ interpolation(self.f.program.degree, every).T
        rows, columns = np.nonzero(np.abs(values) < DROWNED * np.abs(known).max(axis=1, keepdims=True))
        values[rows, columns] = self.f.values(self.rays[rows], self.t[rows, columns])
        return np.asarray(values)

    def _least(self) -> _Extrema:
        """Return the local minima of |g|, up to the first sampled change of sign behind t1."""
        size = np.abs(self.g)
        rises = size[:, 1:] > size[:, :-1]
        least = np.arange(size.shape[1]) <= self.change[:, None]
        least[:, 1:] &= ~rises | self.differ
        least[:, :-1] &= rises | self.differ
        rows, columns = np.nonzero(least)
        slope = self._deflated(rows, self.t[rows, columns])[1] * np.sign(self.g[rows, columns])
        at_first = self.hit[rows] & (columns == self.column[rows])  # its slope is not known: search both sides
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
        """Return the minima of |g| between the samples `left` and `left` + 1, searched by cubics.

        `known` is the slope of |g| at the left sample where `is_left`, else at the right one.
        """
        side = np.sign(self.g[rows, left])
        lower, upper = self.t[rows, left], self.t[rows, left + 1]
        low, high = np.abs(self.g[rows, left]), np.abs(self.g[rows, left + 1])
        other = self._deflated(rows, np.where(is_left, upper, lower))[1] * side
        falls, climbs = np.where(is_left, known, other), np.where(is_left, other, known)
        # the slope at t1 itself is taken from a parabola, with the sign that makes a bracket
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
            guess = least_of_cubic(a, b, low[k], high[k], fall, climb)
            guess = np.where((guess > a) & (guess < b) & ~stuck[k], guess, 0.5 * (a + b))
            g, slope = self._deflated(rows[k], guess)
            g, slope = g * side[k], slope * side[k]
            better = g < depth[k]
            t[k[better]], depth[k[better]] = guess[better], g[better]
            front = (slope < 0.0) & (g > 0.0)
            lower[k], upper[k] = np.where(front, guess, a), np.where(front, b, guess)
            low[k], high[k] = np.where(front, g, low[k]), np.where(front, high[k], g)
            falls[k], climbs[k] = np.where(front, slope, fall), np.where(front, climb, slope)
            left_over = upper[k] - lower[k]
            stuck[k] = left_over > 0.5 * (b - a)
            go_on = (g > 0.0) & (np.abs(slope) * left_over > SETTLED * g) & (left_over > UNIT * np.abs(guess))
            k = k[go_on]
        crossed = depth < 0.0
        crossed[crossed] = self._proved(rows[crossed], t[crossed])
        bend = (climbs - falls) / (upper - lower)
        return _Extrema(rows, lower, t, side, np.sqrt(2.0 * np.maximum(depth, 0.0) / bend), crossed)

    def _proved(self, rows: Indices, t: Floats) -> NDArray[np.bool_]:
        """Return bool[k]: whether float64 balls prove that f is not 0 on the rays `rows` at t float64[k]."""
        return np.asarray(self.enclosure.along(self.given[rows], t + self.shift[rows]).sign != 0)

    def _following(self, found: _Extrema) -> Floats:
        """Return float64[n]: t of the first change of g's sign behind the first root; inf where there is none.

        A change is seen between samples, or at a minimum.
        """
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
        if self.f.program.jumps:
            following[rows[self._is_jump(rows, following[rows])]] = np.inf
        return following

    def _is_jump(self, rows: Indices, t: Floats) -> NDArray[np.bool_]:
        """Return bool[k]: whether f does not go through 0 where it changes its sign, at t float64[k].

        Within the last step of Newton's method a root's value is what the slope gives.
        """
        f = self.f.along(self.rays[rows], t)
        step = LAST_STEP * self.domain.radius / self.length[rows]
        return np.asarray(np.abs(f.value) > 2.0**10 * step * (np.abs(f.slope) + np.abs(self.slope[rows])))

    def _root(self, rows: Indices, lower: Floats, upper: Floats, side: Floats) -> Floats:
        """Return the root of g in each bracket, float64[k], by safeguarded Newton.

        At the upper end of a bracket g has the sign `side`, [k].
        """
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
        """Return g and dg/dt on the rays `rows`, each float64[k] for t float64[k]; NaN or infinite at t1."""
        f = self.f.along(self.rays[rows], t)
        order = self.order[rows]
        gap = np.where(order > 0.0, t - self.first[rows], 1.0)
        power = np.where(order == 2.0, gap * gap, gap)
        return f.value / power, (f.slope - order * f.value / gap) / power

    def _deepest(self, following: Floats) -> Floats:
        """Return t float64[n] where |f| is largest between the first root and the next one, or the clip's end.

        |f| there tells how deep the ray dips.
        """
        stop = np.minimum(following, self.leave)
        between = (self.t > self.first[:, None]) & (self.t < stop[:, None])
        size = np.where(between, np.abs(self.values), -1.0)
        column = size.argmax(axis=1)
        everyone = np.arange(len(stop))
        middle = 0.5 * (self.first + stop)
        sampled = size[everyone, column] > np.abs(self.f.values(self.rays, middle))
        return np.where(sampled, self.t[everyone, column], middle)

    def _inside(self, t: Floats) -> Floats:
        """Return the distances of o + t·d from the domain's boundary, negative outside; `t` is float64[n]."""
        points = self.rays[:, :3] + t[:, None] * self.rays[:, 3:]
        if isinstance(self.domain, Box):
            lower, upper = np.asarray(self.domain.lower), np.asarray(self.domain.upper)
            return np.asarray(np.minimum(points - lower, upper - points).min(axis=1))
        offset = points - np.asarray(self.domain.center)
        return np.asarray(self.domain.radius - np.sqrt((offset**2).sum(axis=1)))

    def _gap(self) -> Floats:
        """Return float64[n]: the margins of rays that miss the domain, which are their distances from it.

        If the surface is farther from the ray's nearest point, that distance is taken.
        """
        t = np.maximum(0.0, self.t_min - self.shift)  # recentred: 0 is nearest to the centre
        surface = np.abs(self.f.values(self.rays, t)) / self.f.steepness(self.rays, t)
        return np.asarray(np.fmax(np.maximum(-self._inside(t), 0.0), surface))
