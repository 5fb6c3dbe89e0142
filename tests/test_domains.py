"""Domains about other centres than the origin: oracle, views and methods there, by closed forms of the tests' own."""

from __future__ import annotations

import numpy as np
import pytest

import surfaces
from harness.accuracy.judge import judge, judged
from harness.contract import TruthStatus, View
from harness.oracle import first_hits
from harness.plugins import find_methods
from harness.running.trace import Caster, cast
from harness.scenes.camera import camera_for, rays_of

from .conftest import usable_devices

MOVED = "((x - 3)^2 + (y + 2)^2 + (z - 1)^2 + 0.4)^2 - 1.96*((x - 3)^2 + (y + 2)^2)"  # a torus, R = 0.7, r = 0.3


@pytest.mark.parametrize("domain", ["sphere:0.6,0.3,-0.2:0.9", "box:-0.2,-0.5,-0.9:1.5,0.8,0.4"])
def test_the_oracle_clips_by_a_domain_about_another_centre(domain: str) -> None:
    """The unit sphere: of its two roots on a ray the first that is in the domain, both in closed form."""
    surface = surfaces.from_formula("x^2 + y^2 + z^2 - 1", domain)
    rng = np.random.default_rng(3)
    origins = rng.uniform(-3, 3, (600, 3))
    rays = np.concatenate([origins, rng.uniform(-1, 1, (600, 3)) - origins], axis=1).astype(np.float32)
    truth = first_hits(surface, rays)
    o, d = rays[:, :3].astype(float), rays[:, 3:].astype(float)
    a, b, c = (d * d).sum(1), (o * d).sum(1), (o * o).sum(1) - 1.0
    with np.errstate(invalid="ignore"):
        root = np.sqrt(b * b - a * c)
        ts = np.stack([(-b - root) / a, (root - b) / a], axis=1)
    points = o[:, None] + ts[..., None] * d[:, None]
    if domain.startswith("sphere"):
        depth = 0.9 - np.linalg.norm(points - (0.6, 0.3, -0.2), axis=2)
    else:
        depth = np.minimum(points - (-0.2, -0.5, -0.9), np.array([1.5, 0.8, 0.4]) - points).min(axis=2)
    clear = ~(np.abs(depth) < 1e-5).any(axis=1)
    seen = (depth > 0.0) & (ts >= 0.0)
    first = np.where(seen[:, 0], ts[:, 0], np.where(seen[:, 1], ts[:, 1], np.nan))
    hit = truth.status == TruthStatus.CROSSING
    assert (hit == seen.any(axis=1))[clear].all() and hit.sum() > 30 and (~hit).sum() > 100
    both = hit & clear
    assert (truth.lower[both] <= first[both] + 1e-9).all() and (truth.upper[both] >= first[both] - 1e-9).all()


def test_views_look_at_the_domains_centre() -> None:
    surface = surfaces.from_formula(MOVED, "sphere:3,-2,1:1.1")
    camera = camera_for(View("v", azimuth=70, elevation=-20), surface)
    away = 1.1 / np.sin(np.radians(15.0))
    assert np.allclose(camera[:3] + away * camera[3:6], (3.0, -2.0, 1.0), atol=1e-5)


@pytest.mark.parametrize("method", ["ray_march", "newton", "bernstein", "analytic", "interval_march"])
def test_methods_answer_off_the_origin_as_at_it(method: str) -> None:
    surface = surfaces.from_formula(MOVED, "sphere:3,-2,1:1.1")
    views = View("far", azimuth=20, elevation=25), View("near", azimuth=5, elevation=-5, distance=0.4)
    rays = np.concatenate([rays_of(camera_for(view, surface), 32) for view in views])
    truth, found = first_hits(surface, rays), find_methods().get(method)
    hits = cast(Caster(found, found.variant({}), usable_devices()[0].name), surface, rays)
    verdicts = judge(hits, truth, 1.1, 1e-3, "float32")
    clear = judged(truth, verdicts)
    assert clear.sum() > 1900 and not verdicts.wrong[clear].any()
