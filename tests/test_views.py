"""Sets of views in a config, and cameras at every direction, the poles too."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import surfaces
from harness.contract import FirsthitError, Sphere, View
from harness.experiment import config, reading
from harness.oracle import first_hits
from harness.plugins import find_methods
from harness.scenes import views as viewsets
from harness.scenes.camera import camera_for, distance_of, meets, rays_of
from harness.scenes.views import AngleChoice, DirectionChoice, PathChoice, along_path, by_angle, by_direction

CONFIG = """title = "t"
surfaces = ["sphere"]
[[method]]
name = "null"
"""


def _load(tmp_path: Path, text: str) -> config.Experiment:
    path = tmp_path / "c.toml"
    path.write_text(CONFIG + text)
    return reading.load(path, find_methods())


def test_a_config_names_angles_and_directions_beside_views_of_its_own(tmp_path: Path) -> None:
    text = '[[view]]\nname = "mine"\n[angles]\ndistance = 5.584\n[directions]\ncount = 12\nseed = 3\nfov = 20\n'
    views = _load(tmp_path, text).config.view
    assert [view.name for view in views[:8]] == ["mine", *(f"angle {a}" for a in range(0, 91, 18)), "direction 01"]
    assert [view.elevation for view in views[1:7]] == [90, 72, 54, 36, 18, 0], "0° looks down the axis"
    assert {(v.set, v.fov, v.distance) for v in views[1:7]} == {("angles", 30.0, 5.584)}
    assert {(v.set, v.fov, v.distance) for v in views[7:]} == {("directions", 20.0, None)} and len(views) == 19
    assert [view.name for view in _load(tmp_path, "").config.view] == ["default"]
    assert len(_load(tmp_path, "[angles]\nvalues = [0, 45]\n").config.view) == 2, "no default beside a set"


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ("[angles]\nvalues = [0, 181]\n", 6, "outside [0, 180]"),
        ("[angles]\nvalues = [0, 18, 0]\n", 5, "'0' is named twice"),
        ("[angles]\nvalues = []\n", 6, "empty"),
        ("[angles]\ndistance = 0\n", 6, "outside"),
        ("[directions]\ncount = 0\n", 6, "outside"),
        ("[directions]\nfov = 180\n", 6, "outside"),
        ("[directions]\nsed = 1\n", 6, "did you mean 'seed'"),
        ("[path]\nframes = 1\n", 6, "outside [2, 10000]"),
        ("[path]\nturn = 0\n", 5, "the camera stands still"),
        ("[path]\nrise = 90\n", 5, "the camera rises to an elevation of 91.5 degrees; it can from -90 to 90"),
        ('[[view]]\nname = "frame 01"\n[path]\n', 5, "'frame 01' is named twice"),
        ('[[view]]\nname = "a"\nelevation = 91\n', 7, "outside [-90, 90]"),
        ('[[view]]\nname = "a"\nazimuth = inf\n', 7, "finite"),
    ],
)
def test_a_mistake_in_a_set_is_answered_with_its_line(tmp_path: Path, text: str, line: int, words: str) -> None:
    with pytest.raises(FirsthitError) as caught:
        _load(tmp_path, text)
    assert words in str(caught.value)
    assert f"c.toml:{line}:" in str(caught.value)


def _direction(view: View) -> np.ndarray:
    azimuth, elevation = math.radians(view.azimuth), math.radians(view.elevation)
    return np.array(
        [math.cos(elevation) * math.cos(azimuth), math.cos(elevation) * math.sin(azimuth), math.sin(elevation)]
    )


@pytest.mark.parametrize("count", [1, 6, 24, 200])
def test_directions_are_spread_over_the_whole_sphere(count: int) -> None:
    points = np.array([_direction(view) for view in by_direction(DirectionChoice(count, seed=5))])
    assert np.allclose(np.linalg.norm(points, axis=1), 1.0)
    if count >= 6:
        apart = np.degrees(np.arccos(np.clip(points @ points.T - 2 * np.eye(count), -1, 1))).min()
        share = math.degrees(math.sqrt(4 * math.pi / count))  # the side of a square of each direction's own area
        assert apart > 0.7 * share
        rng = np.random.default_rng(1)
        probes = rng.normal(size=(2000, 3))
        nearest = (probes / np.linalg.norm(probes, axis=1, keepdims=True) @ points.T).max(axis=1)
        assert np.degrees(np.arccos(nearest)).max() < 1.3 * share, "no part of the sphere is left out"


def test_the_seed_alone_decides_the_directions() -> None:
    assert by_direction(DirectionChoice(24, 1)) == by_direction(DirectionChoice(24, 1))
    assert by_direction(DirectionChoice(24, 1)) != by_direction(DirectionChoice(24, 2))
    first = by_direction(DirectionChoice())[0]
    assert (first.azimuth, first.elevation) == (144.7452, 28.1142), "the same on every machine"
    rotation = np.array(viewsets._rotation(4))
    assert np.allclose(rotation @ rotation.T, np.eye(3)) and np.linalg.det(rotation) == pytest.approx(1.0)


def test_a_path_goes_from_its_start_to_its_end_and_shows_nothing_twice(tmp_path: Path) -> None:
    text = "[path]\nframes = 8\nazimuth = 90\nelevation = -20\nrise = 40\nfov = 20\ndistance = 4\n"
    views = _load(tmp_path, text).config.view
    assert [view.name for view in views] == [f"frame {i}" for i in range(1, 9)]
    assert [view.azimuth for view in views] == [90, 135, 180, -135, -90, -45, 0, 45]
    assert [view.elevation for view in views] == [-20, -15, -10, -5, 0, 5, 10, 15]
    assert {(view.set, view.fov, view.distance) for view in views} == {("path", 20.0, 4.0)}
    half = along_path(PathChoice(frames=3, turn=-60.0))
    assert [(view.name, view.azimuth, view.elevation) for view in half] == [
        ("frame 1", 30.0, 30.0),
        ("frame 2", 10.0, 30.0),
        ("frame 3", -10.0, 30.0),
    ]


EVERY = [
    *along_path(PathChoice(4, rise=-100.0)),
    *by_angle(AngleChoice([0, 18, 90, 180], azimuth=-70)),
    *by_direction(DirectionChoice(24, 9)),
]


@pytest.mark.parametrize("view", EVERY, ids=lambda view: view.name)
def test_every_camera_looks_at_its_target_upright(view: View) -> None:
    surface = surfaces.get("torus")
    eye, forward, right, up = camera_for(view, surface).astype(np.float64).reshape(4, 3)
    distance = distance_of(view, surface)
    assert np.allclose(eye, distance * _direction(view), atol=1e-6)
    assert np.allclose(forward, -eye / distance, atol=1e-6)
    half = math.tan(math.radians(view.fov) / 2)
    frame = np.array([right / half, up / half, -forward])
    assert np.allclose(frame @ frame.T, np.eye(3), atol=1e-6)
    assert np.linalg.det(frame) == pytest.approx(1.0, abs=1e-6), "not mirrored"
    assert right[2] == 0.0 and up[2] >= -1e-7, "z is up in the picture"


@pytest.mark.parametrize(("angle", "sign"), [(0.0, 1), (180.0, -1)])
def test_the_pole_is_where_its_neighbours_tend_to(angle: float, sign: int) -> None:
    surface = surfaces.get("torus")
    pole, near = by_angle(AngleChoice([angle, abs(angle - 1e-4)]))
    assert np.allclose(camera_for(pole, surface), camera_for(near, surface), atol=1e-5)
    eye, forward = camera_for(pole, surface)[:6].reshape(2, 3)
    assert np.allclose(eye, [0, 0, sign * distance_of(pole, surface)], atol=1e-6)
    assert np.allclose(forward, [0, 0, -sign], atol=1e-7)


def test_the_torus_seen_from_its_axis_is_a_ring_of_its_radii() -> None:
    surface, size = surfaces.get("torus"), 65
    (view,) = by_angle(AngleChoice([0.0], distance=5.584))
    rays = rays_of(camera_for(view, surface), size)
    hit = (first_hits(surface, rays).status > 0).reshape(size, size)
    assert not hit[32, 32], "the hole"
    assert (hit == hit[::-1]).all() and (hit == hit[:, ::-1]).all() and (hit == hit.T).all()
    # the silhouette's tangent passes the tube's centre, at R from the axis, at distance r
    angle = math.atan2(0.7, 5.584) + math.asin(0.3 / math.hypot(0.7, 5.584))
    pixels = math.pi * (math.tan(angle) / math.tan(math.radians(15)) * size / 2) ** 2
    inner = math.atan2(0.7, 5.584) - math.asin(0.3 / math.hypot(0.7, 5.584))
    pixels -= math.pi * (math.tan(inner) / math.tan(math.radians(15)) * size / 2) ** 2
    assert hit.sum() == pytest.approx(pixels, rel=0.02)


def test_pixels_of_box_and_torus_are_toledo2007s() -> None:
    """Table 1's two pixel rows, in thousands of its 1024 × 1024, within its own rounding of 1.5 %."""
    surface, size = surfaces.get("torus"), 64
    box, torus = [], []
    for view in by_angle(AngleChoice(distance=5.584)):
        rays = rays_of(camera_for(view, surface), 8 * size)
        box.append(meets(surface.domain, rays).sum() * (1024 / (8 * size)) ** 2 / 1000)
        rays = rays_of(camera_for(view, surface), size)
        torus.append((first_hits(surface, rays).status > 0).sum() * (1024 / size) ** 2 / 1000)
    assert box == pytest.approx([524, 516, 495, 430, 324, 209], rel=0.015)
    assert torus == pytest.approx([312, 305, 285, 256, 203, 146], rel=0.025)


def test_which_rays_meet_a_domain() -> None:
    rays = np.array(
        [[0, 0, 5, 0, 0, -1], [0, 0, 5, 0, 0, 1], [0, 0, 0, 1, 0, 0], [3, 0, 5, 0, 0, -1], [0.9, 0, 5, 0, 0, -1]],
        np.float32,
    )
    assert meets(Sphere(2.0), rays).tolist() == [True, False, True, False, True]
    assert meets(surfaces.get("torus").domain, rays).tolist() == [True, False, True, False, True]
    for name in ("torus", "sphere"):
        surface = surfaces.get(name)
        some = rays_of(camera_for(View("v", 10, 20), surface), 32)
        status = first_hits(surface, some).status
        assert meets(surface.domain, some)[status > 0].all()
