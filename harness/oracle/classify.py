"""Estimates that sort rays into classes: the next root, the first root's condition, and the margin to another answer.

Plain float64 on samples of f along the ray, nothing proved; none of it decides whether a method's answer is right.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness.contract import Box, Domain, TruthStatus
from harness.oracle.balls64 import Floats
from harness.oracle.clip import clip_many, nearest, recentred
from harness.oracle.floats import FloatFunction, majorant

BLOCK = 1024  # rays at a time, so that the arrays stay in the cache
REFINEMENTS = 5
Estimates = tuple[Floats, Floats, Floats]  # following, condition, margin, each [n]


def classify(f: FloatFunction, domain: Domain, rays: Floats, first: Floats, status: NDArray[np.uint8]) -> Estimates:
    """`rays`: float64[n, 6]; `first`: the first root's t, float64[n], NaN without a hit; see contract.Truth."""
    if not len(rays):
        return np.empty(0), np.empty(0), np.empty(0)
    parts = []
    with np.errstate(all="ignore"):
        for k in range(0, len(rays), BLOCK):
            piece = slice(k, k + BLOCK)
            parts.append(_Block(f, domain, rays[piece], first[piece], status[piece]).estimates())
    following, condition, margin = (np.concatenate(columns) for columns in zip(*parts, strict=True))
    return following, condition, margin


class _Block:
    """Rays with their origins moved near the domain, f sampled along them."""

    def __init__(
        self, f: FloatFunction, domain: Domain, rays: Floats, first: Floats, status: NDArray[np.uint8]
    ) -> None:
        self.f = f
        self.domain = domain
        self.status = status
        self.shift = nearest(np.asarray(domain.center), rays)
        self.rays = recentred(rays, self.shift)
        self.length = np.sqrt((rays[:, 3:] ** 2).sum(axis=1))
        clip = clip_many(domain, rays)
        self.missed = clip.missed
        self.enter = clip.enter_lower - self.shift
        self.leave = clip.leave_upper - self.shift
        self.first = first - self.shift
        count = f.samples
        grid = 0.5 - 0.5 * np.cos(np.pi * np.arange(count) / (count - 1))
        self.t = self.enter[:, None] + (self.leave - self.enter)[:, None] * grid
        self.values = f.values(self.rays, self.t).copy()

    def estimates(self) -> Estimates:
        rows, columns = self._settle_extrema()
        hit = np.isfinite(self.first)
        following = self._following()
        margin = np.full(len(hit), np.inf)
        before = np.where(hit, self.first, np.inf)
        self._lower_margin(margin, rows, self.t[rows, columns], self.t[rows, columns] < before[rows])
        everyone = np.arange(len(hit))
        self._lower_margin(margin, everyone, self.enter, np.ones_like(hit))
        self._lower_margin(margin, everyone, self.leave, ~hit)
        self._lower_margin(margin, everyone, self._deepest(following), hit)
        room = np.minimum(self._inside(self.first), (self.first + self.shift) * self.length)
        margin = np.where(hit, np.minimum(margin, np.maximum(room, 0.0)), margin)
        margin = np.where(self.missed, self._gap(), margin)
        open_ = (self.status == TruthStatus.TOUCH) | (self.status == TruthStatus.UNDECIDED)
        return following + self.shift, self._condition(), np.where(open_, 0.0, margin)

    def _settle_extrema(self) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Moves samples at which |f| is locally least to the extremum nearby; returns those where f kept its sign."""
        size, sign = np.abs(self.values), np.sign(self.values)
        least = (size[:, 1:-1] <= size[:, :-2]) & (size[:, 1:-1] <= size[:, 2:])
        least &= (sign[:, 1:-1] == sign[:, :-2]) & (sign[:, 1:-1] == sign[:, 2:])
        rows, columns = np.nonzero(least)
        columns = columns + 1
        rays = self.rays[rows]
        lower, upper, t = (self.t[rows, columns + k] for k in (-1, 1, 0))
        inward = sign[rows, columns]  # slope·inward < 0 in front of the extremum
        slopes = [self.f.along(rays, end).slope * inward for end in (lower, upper)]
        for _ in range(REFINEMENTS):
            secant = lower - slopes[0] * (upper - lower) / (slopes[1] - slopes[0])
            t = np.where((secant > lower) & (secant < upper), secant, 0.5 * (lower + upper))
            slope = self.f.along(rays, t).slope * inward
            front = slope < 0.0
            lower, upper = np.where(front, t, lower), np.where(front, upper, t)
            # halving the kept end's slope (Illinois) keeps the secant from creeping
            slopes = [np.where(front, slope, 0.5 * slopes[0]), np.where(front, 0.5 * slopes[1], slope)]
        value = self.f.values(rays, t)
        better = np.abs(value) < size[rows, columns]
        better |= value * inward < 0.0
        self.t[rows[better], columns[better]] = t[better]
        self.values[rows[better], columns[better]] = value[better]
        same = np.sign(self.values[rows, columns]) == inward
        return rows[same], columns[same]

    def _following(self) -> Floats:
        """The next sign change behind the first root, from samples; inf where there is none."""
        positive = self.values > 0.0
        change = (positive[:, 1:] != positive[:, :-1]) & (self.t[:, :-1] > self.first[:, None])
        column = change.argmax(axis=1)
        rows = np.flatnonzero(change.any(axis=1))
        column = column[rows]
        following = np.full(len(self.rays), np.inf)
        following[rows] = self.f.root_between(
            self.rays[rows], self.t[rows, column], self.t[rows, column + 1], positive[rows, column + 1]
        )
        return following

    def _deepest(self, following: Floats) -> Floats:
        """t where |f| is largest between the first root and the next, or the clip end: how deep the ray dips."""
        stop = np.minimum(following, self.leave)
        between = (self.t > self.first[:, None]) & (self.t < stop[:, None])
        column = np.where(between, np.abs(self.values), -1.0).argmax(axis=1)
        sampled = self.t[np.arange(len(stop)), column]
        return np.where(between.any(axis=1), sampled, 0.5 * (self.first + stop))

    def _lower_margin(self, margin: Floats, rows: NDArray[np.intp], t: Floats, counts: Any) -> None:
        """Lowers margins to |f| / |grad f| at o + t·d of `rows`, where it `counts`."""
        rows, t = rows[counts], t[counts]
        rays = self.rays[rows]
        distance = np.abs(self.f.values(rays, t)) / self.f.steepness(rays, t)
        np.fmin.at(margin, rows, distance)

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
        t = np.maximum(0.0, -self.shift)  # recentred: 0 is nearest to the centre
        surface = np.abs(self.f.values(self.rays, t)) / self.f.steepness(self.rays, t)
        return np.asarray(np.fmax(np.maximum(-self._inside(t), 0.0), surface))

    def _condition(self) -> Floats:
        """Sum of |terms of f| over |df/dt|·radius at the first root."""
        terms = majorant(self.f, self.rays, self.first)
        slope = np.abs(self.f.along(self.rays, self.first).slope)
        return np.asarray(terms * self.length / (slope * self.domain.radius))
