"""Why a tile's verdict holds (docs/tiles.md), on random tiles of random surfaces, in exact arithmetic."""

from __future__ import annotations

import math
from functools import cache
from itertools import pairwise

import numpy as np
import pytest

import surfaces
from harness.conformance import dense
from harness.contract import View
from harness.kernels import fourths
from harness.scenes.camera import camera_for, rays_of

from . import tile_model as model

CASES = ["torus", "tangle", "barth_sextic", "barth_decic", "sixteen_ball", 3, 4, 5, 8, 11, 20]
TRUSTED = 4  # halvings of a fit
BROKEN = 1.0 / 50.0  # what a deliberately broken bound is of the right one


def surface_of(case):
    return surfaces.get(case) if isinstance(case, str) else dense.surface_of(case, 5)


@cache
def table_of(surface):
    return fourths.fourth_bounds(surface)


def tiles_of(surface, seed, count):
    """Yield tiles of random views, also from inside the domain, and a piece of depths: all, or a random part.

    Only those whose remainder is bounded are taken.
    """
    rng, left = np.random.default_rng(seed), count
    for _ in range(100 * count):
        size, side = int(rng.choice([256, 512, 1024])), int(rng.choice([4, 8, 16]))
        away = surface.domain.radius * rng.uniform(0.5, 4.0)
        view = View("random", azimuth=rng.uniform(0, 360), elevation=rng.uniform(-80, 80), distance=away)
        camera = camera_for(view, surface).astype(np.float64).reshape(4, 3)
        i, j = rng.integers(size // 4, 3 * size // 4, 2) // side * side
        half = (side - 1) / size
        tile = model.Tile(surface, camera, ((2 * i + side - size) / size, (size - 2 * j - side) / size), (half, half))
        start, stop = tile.depths
        if left % 2 and start < stop:
            start, stop = np.sort(rng.uniform(start, stop, 2))
        if start < stop and math.isfinite(tile.remainder(table_of(surface), start, stop)):
            left -= 1
            yield tile, float(start), float(stop)
        if not left:
            return
    raise AssertionError("too few tiles have a bound")


def places_of(rng, count):
    """Return places in [-1, 1]²: half of them at random, half where interpolation is farthest off."""
    places = rng.uniform(-1.0, 1.0, (count, 2))
    places[: count // 2] = rng.choice([-1.0, -0.74, 0.0, 0.74, 1.0], (count // 2, 2))
    return places


def largest_share(case, count=3, places=4):
    surface, rng = surface_of(case), np.random.default_rng(2)
    return max(
        model.largest_share(tile, table_of(surface), places_of(rng, places), start, stop, TRUSTED)
        for tile, start, stop in tiles_of(surface, 7, count)
    )


@pytest.mark.parametrize("case", CASES)
def test_the_net_and_its_bound_enclose_the_coefficients_of_every_ray(case):
    assert largest_share(case, count=1 if case in (15, 20) else 2, places=2) <= 1.0


@pytest.mark.parametrize("case", ["torus", "tangle", 4, 5])
def test_a_broken_remainder_is_caught_by_the_coefficients(case):
    assert largest_share(case) > BROKEN


def hidden(gap):
    """Return a tile of a surface that its node rays do not see, a piece of depths, and the table of its bounds.

    f is z² + gap - w, where w vanishes on the node rays at the depth where z is 0, and is 1 at most between them.
    """
    eye, half = 4.0, 0.05
    width = eye * half  # of half the tile there
    inner, outer = model.NODES[2:] * width
    wave = f"((x/{outer})^2 - 1)*((x/{inner})^2 - 1)"
    surface = surfaces.from_formula(f"z^2 + {gap!r} - {wave}", "sphere:1")
    camera = np.array([[0.0, 0.0, -eye], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    tile = model.Tile(surface, camera, (0.0, 0.0), (half, half))
    return tile, 3.85, 4.15, fourths.fourth_bounds(surface, 4)


def verdicts(tile, start, stop, table, share=1.0, judge=model.judged, behind=model.following):
    """Return the decided pieces of a tile, as the model yields them; `share` is of the right remainder."""
    net = tile.net(start, stop)
    net = net if net[0, 0] > 0.0 else -net
    factors, bound = model.growth(tile.degree), share * tile.remainder(table, start, stop)
    least = 1e-12 * np.abs(net).max()  # floats of the model
    return list(
        model.pieces_judged(
            net, lambda depth: factors[min(depth, model.DEPTHS)] * bound + least, TRUSTED, judge, behind
        )
    )


def wrong_roots(tile, start, stop, pieces, places):
    """Return rays whose roots contradict a verdict: (place, roots) of each."""
    found = []
    for place in places:
        roots = model.roots(tile, place, start, stop)
        for path, depth, verdict, _ in pieces:
            a, b = (start + (stop - start) * share for share in model.span_of(path, depth))
            inside = sum(a < root < b for root in roots)
            if (verdict, inside) not in {("empty", 0), ("single", 1)} and verdict != "open":
                found.append((tuple(place), roots))
    return found


@pytest.mark.parametrize("case", ["torus", "tangle", "barth_sextic", "barth_decic", 4, 6, 9])
def test_verdicts_hold_on_every_ray(case):
    surface, rng, kinds = surface_of(case), np.random.default_rng(4), []
    for tile, start, stop in tiles_of(surface, 11, 8):
        pieces = verdicts(tile, start, stop, table_of(surface))
        kinds += [verdict for _, _, verdict, _ in pieces]
        assert not wrong_roots(tile, start, stop, pieces, places_of(rng, 6))
    assert "empty" in kinds


def test_a_verdict_by_a_broken_remainder_is_caught():
    tile, start, stop, table = hidden(0.99)
    places = [(0.0, 0.0), (0.1, 0.5), (0.9, -0.3)]
    right = verdicts(tile, start, stop, table)
    assert [verdict for _, _, verdict, _ in right] == ["open"]
    assert not wrong_roots(tile, start, stop, right, places)
    broken = verdicts(tile, start, stop, table, BROKEN)
    assert {verdict for _, _, verdict, _ in broken} == {"empty"}
    assert wrong_roots(tile, start, stop, broken, places)


def changes_within(c, error, rng):
    """Return how often the coefficients of rays may change sign: of random rays, each coefficient off by <= error."""
    shares = rng.dirichlet(np.full(16, 0.2), 200)  # a ray's coefficient is a mean of the control values
    off = error * rng.choice([-1.0, 1.0], (200, len(c))) * rng.uniform(0.9, 1.0, (200, len(c)))
    negative = shares @ c.T + off < 0.0
    return set((negative[:, 1:] != negative[:, :-1]).sum(axis=1).tolist())


def random_controls(rng, degree):
    """Return control values of a polynomial that mostly falls from above 0 to below 0, with small ones between."""
    line = np.sort(rng.normal(size=degree + 1))[::-1] * rng.choice([0.3, 1.0, 3.0], degree + 1)
    return line[:, None] + 0.05 * rng.normal(size=(degree + 1, 16))


def contradicted(judge, rng):
    """Return how many of the verdicts of random control values are contradicted by rays within their bounds."""
    wrong = decided = 0
    for _ in range(400):
        c, error = random_controls(rng, int(rng.integers(3, 9))), float(rng.choice([0.05, 0.2, 0.4]))
        expected = {"empty": {0}, "single": {1}}.get(judge(c, error))
        if expected is not None:
            decided += 1
            wrong += changes_within(c, error, rng) != expected
    assert decided > 40
    return wrong


def trusting(c, error):
    """Judge as the model does, but let two coefficients between the certain ones be uncertain."""
    verdict = model.judged(c, error)
    above, below = (c > error).all(axis=1), (c < -error).all(axis=1)
    certain = int(np.logical_and.accumulate(above).sum() + np.logical_and.accumulate(below[::-1]).sum())
    return "single" if verdict == "open" and above[0] and below[-1] and certain >= len(c) - 2 else verdict


def careless(c, error):
    """Judge as the model does, but by the first control value's own signs, not by those of all."""
    return model.judged(c[:, :1], error)


def steep(c, error):
    """Judge as the model does, but let the coefficients fall by less than their errors."""
    falls = (c[0] > error).all() and (c[-1] < -error).all() and (np.diff(c, axis=0) < -0.5 * error).all()
    return "single" if falls else model.judged(c, error)


def test_verdicts_allow_one_change_of_sign_at_most():
    assert contradicted(model.judged, np.random.default_rng(6)) == 0


@pytest.mark.parametrize("judge", [trusting, careless, steep])
def test_a_verdict_on_uncertain_coefficients_is_caught(judge):
    assert contradicted(judge, np.random.default_rng(6)) > 0


def value_at(c, x):
    """Return the value at x in [0, 1] of a polynomial of Bernstein coefficients float64[degree + 1, ...]."""
    while len(c) > 1:
        c = (1.0 - x) * c[:-1] + x * c[1:]
    return c[0]


def lost_places(net, pieces):
    """Return the places in [0, 1] at which decided pieces leave a gap, or are not pieces of the net's polynomials."""
    spans = [model.span_of(path, depth) for path, depth, _, _ in pieces]
    found = [b[0] for a, b in pairwise(spans) if a[1] != b[0]]
    if spans[0][0] != 0.0 or (pieces[-1][2] == "empty" and spans[-1][1] != 1.0):
        found.append(spans[-1][1])
    for (start, stop), (_, _, _, c) in zip(spans, pieces, strict=True):
        found += [x for x, value in ((start, c[0]), (stop, c[-1])) if np.abs(value_at(net, x) - value).max() > 1e-12]
    return found


def late_root(at):
    """Return the control values of a polynomial of degree 5 that is 0 at one place, and positive before it."""
    x = np.linspace(0.0, 1.0, 6)
    slope = np.where(x <= 1.0, at - x, 0.0)
    return np.repeat(slope[:, None], 16, axis=1)


def one_up(path, depth):
    """Leave out the far half of the piece above: a path is lost."""
    place = model.following(path, depth)
    return None if place is None else model.following(*place)


def ends_early(path, depth):
    """Take the far half of the first piece for the last one."""
    return None if path & 1 else (path + 1, depth)


def stays_deep(path, depth):
    """Count up without leaving the depth: the far halves kept for other depths are taken."""
    return None if path + 1 == 2 << depth else (path + 1, depth)


def bumps(rng):
    """Return the control values of a polynomial that is positive, but near 0 at places: halving must go deep."""
    c = rng.choice([1.0, -0.3], 11, p=[0.75, 0.25])
    c[[0, -1]] = 1.0
    return np.repeat(c[:, None], 16, axis=1)


def test_halving_leaves_out_no_piece():
    rng, most = np.random.default_rng(8), 0
    for _ in range(50):
        for net in (bumps(rng), late_root(rng.uniform(0.1, 1.5))):
            pieces = list(model.pieces_judged(net, lambda _: 0.03, 6))
            assert not lost_places(net, pieces)
            most = max(most, len(pieces))
    assert most > 4


@pytest.mark.parametrize("behind", [one_up, ends_early, stays_deep])
def test_a_lost_path_is_caught(behind):
    rng, lost = np.random.default_rng(8), 0
    for _ in range(50):
        net = bumps(rng)
        lost += bool(lost_places(net, list(model.pieces_judged(net, lambda _: 0.03, 6, behind=behind))))
    assert lost


@pytest.mark.parametrize(("size", "distance"), [(64, None), (1024, 1.5), (4096, None), (16384, 30.0)])
def test_listed_rays_are_rays_of_their_tiles(size, distance):
    """A float32 ray from the eye is a ray of the camera's family, off its pixel's middle by less than 1/32 pixel."""
    camera = camera_for(View("v", azimuth=33.0, elevation=21.0, distance=distance), surfaces.get("torus"))
    eye, forward, right, up = camera.astype(np.float64).reshape(4, 3)
    rays = rays_of(camera, 64)  # directions all over the image; what is held against 1/32 pixel is their rounding
    assert (rays[:, :3] == eye.astype(np.float32)).all()
    depth, x, y = np.linalg.solve(np.array([forward, right, up]).T, rays[:, 3:].astype(np.float64).T)
    row, column = np.divmod(np.arange(64 * 64), 64)
    off_x = x / depth - (2 * column + 1 - 64) / 64
    off_y = y / depth - (64 - 2 * row - 1) / 64
    assert np.abs([off_x, off_y]).max() * size / 2.0 < 1.0 / 32.0
