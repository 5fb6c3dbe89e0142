"""The raster stage: the paper's pixels, the oracle's answers on the fragments' own rays, and the compute stage's."""

from functools import cache

import numpy as np
import pytest

import surfaces
from harness.accuracy.judge import judge
from harness.contract import NORMALS, PROXIES, FirsthitError, RayStatus, View
from harness.devices.raster import Rasteriser
from harness.experiment.kinds import draws
from harness.kernels.raster import fill_program
from harness.oracle import first_hits
from harness.plugins import find_methods
from harness.scenes.camera import camera_for, pixel_footprint, rays_of, scene_radius
from harness.scenes.model import single
from harness.scenes.records import depth_map
from harness.scenes.views import AngleChoice, by_angle
from reports import published

from .conftest import opened, usable_devices
from .test_devices import SAME_T, cast

VIEW = View("oblique", azimuth=30, elevation=35)
SIZE = 90


@cache
def drawing_device():
    for info in usable_devices():
        if isinstance(opened(info.name), Rasteriser):
            return opened(info.name)
    return None


@pytest.fixture
def gl():
    return drawing_device() or pytest.skip("no device that rasterises")


def variant(method, **knobs):
    return find_methods().get(method).variant(knobs)


def draw(gl, scene, chosen, size, proxy="box", reports=True, pixels=0.0, normal="distance"):
    """The picture of a scene by a variant; without reports, its colours alone."""
    camera = camera_for(scene.view, scene.stand_in if scene.instances > 1 else scene.groups[0].distinct[0])
    batches = [d.batch(reports) for d in draws.draws(scene, chosen, proxy, find_methods(), pixels, normal=normal)]
    built = [gl.build(batch.program) for batch in batches]
    fill = gl.build(fill_program()) if reports else None
    launch = gl.launch_raster(batches, built, camera, depth_map(scene, camera), size, fill)
    launch.run()
    result = launch.picture() if reports else launch.read()[0]
    launch.release()
    return result


@pytest.mark.parametrize("view", by_angle(AngleChoice(distance=5.584)), ids=lambda view: view.name)
def test_pixels_and_fragment_waste_of_toledo_table_1(gl, view):
    """Within 1.5 % and one point, at every angle; the paper prints whole kilopixels."""
    picture = draw(gl, single(surfaces.get("torus"), view), variant("newton"), 1024)
    fragments, drawn = int(picture.fragments.sum()), int((picture.batch >= 0).sum())
    paper = published.table("toledo2007_table1_pixels")
    box, torus, waste = (
        paper.number(view.name.replace("angle ", "angle_"), quantity=quantity)
        for quantity in ("bbox_kpixels", "torus_kpixels", "fragment_waste_percent")
    )
    assert fragments == pytest.approx(1e3 * box, rel=0.015)
    assert drawn == pytest.approx(1e3 * torus, rel=0.015)
    assert 100.0 * (1.0 - picture.fragment_hits.sum() / fragments) == pytest.approx(waste, abs=1.0)


@pytest.mark.parametrize("proxy", PROXIES)
@pytest.mark.parametrize("name", ["torus", "barth_sextic"])
def test_fragments_answer_as_the_compute_stage_does_and_as_the_oracle_says(gl, name, proxy):
    surface = surfaces.get(name)
    method = "newton" if name == "torus" else "interval_march"
    picture = draw(gl, single(surface, VIEW), variant(method), SIZE, proxy)
    assert np.abs(picture.rays - rays_of(camera_for(VIEW, surface), SIZE)).max() < 2e-7
    seen = picture.batch >= 0
    assert np.array_equal(picture.local_rays[seen], picture.rays[seen])
    hits, listed = picture.hits(np.ones(SIZE**2)), cast(gl, method, surface, "float32", picture.rays)
    assert np.array_equal(hits.status, listed.status)
    if gl.info.name == "opengl:llvmpipe":
        assert np.array_equal(hits.t[seen], listed.t[seen])
    gap = np.abs(hits.t[seen] - listed.t[seen])  # a GPU may round some sums differently in its two kinds of shaders
    assert np.nanmax(gap) <= 10 * SAME_T * np.nanmax(listed.t)
    truth = first_hits(surface, picture.rays)
    verdicts = judge(hits, truth, scene_radius(surface), 1e-3)
    assert not verdicts.wrong[~verdicts.grazing].any()
    assert np.nanmax(verdicts.error) < 1e-3


def test_the_timed_picture_is_the_checked_one_and_proxies_differ_in_waste_alone(gl):
    scene, pictures = single(surfaces.get("torus"), VIEW), {}
    for proxy in PROXIES:
        pictures[proxy] = draw(gl, scene, variant("newton"), SIZE, proxy)
        timed = draw(gl, scene, variant("newton"), SIZE, proxy, reports=False).reshape(-1, 4)
        assert np.array_equal(timed, pictures[proxy].colours)
        assert np.array_equal(pictures[proxy].colours, pictures["box"].colours)
        assert np.array_equal(timed[:, 3] > 0, pictures[proxy].batch >= 0)
    fragments = {proxy: int(picture.fragments.sum()) for proxy, picture in pictures.items()}
    assert all((picture.fragments <= 1).all() for picture in pictures.values())
    assert fragments["box"] < fragments["sphere"] < fragments["tetrahedron"]


def test_three_normals_shade_the_torus_alike_and_by_programs_of_their_own(gl):
    """toledo2007, equation 6: the core circle's normal is the gradient's, where the point lies on the torus."""
    scene, chosen = single(surfaces.get("torus"), VIEW), variant("newton", EPSILON=0.00003)
    pictures = {name: draw(gl, scene, chosen, SIZE, reports=False, normal=name).astype(int) for name in NORMALS}
    for name in NORMALS:
        assert np.abs(pictures[name] - pictures["distance"]).max() <= 1
    (texts,) = {len({draws.draws(scene, chosen, "box", find_methods(), 0.0, normal=n)[0].timed.hash for n in NORMALS})}
    assert texts == len(NORMALS)
    assert len(np.unique(pictures["core_circle"])) > 50


@pytest.mark.parametrize("name", ["sphere", "spindle_torus", "barth_sextic"])
def test_only_a_torus_is_shaded_by_its_core_circle(name):
    with pytest.raises(FirsthitError, match="core circle"):
        draws.draws(
            single(surfaces.get(name), VIEW),
            variant("interval_march"),
            "box",
            find_methods(),
            0.0,
            normal="core_circle",
        )


def test_rays_that_give_up_are_exhausted_and_not_missed(gl):
    picture = draw(gl, single(surfaces.get("torus"), VIEW), variant("newton", MAX_EVALUATIONS=1), SIZE)
    status = picture.hits(np.ones(SIZE**2)).status
    assert np.array_equal(status == RayStatus.EXHAUSTED, picture.exhausted > 0)
    assert (status == RayStatus.EXHAUSTED).any()


def test_an_eye_among_the_proxies_is_refused():
    surface = surfaces.get("torus")
    with pytest.raises(FirsthitError, match="inside the bounding spheres of 1 instances"):
        depth_map(single(surface, VIEW), camera_for(View("inside", distance=0.5), surface))


@pytest.mark.parametrize("method", ["newton", "sturm", "sphere_tracing", "interval_march"])
def test_a_tolerance_in_pixels_saves_evaluations_and_costs_an_error_of_its_size(gl, method):
    surface, chosen = surfaces.get("torus"), variant(method)
    scene, camera = single(surface, VIEW), camera_for(VIEW, surface)
    exact, loose = (draw(gl, scene, chosen, SIZE, pixels=pixels) for pixels in (0.0, 0.5))
    assert loose.evaluations.sum() < 0.97 * exact.evaluations.sum()
    both = (exact.batch >= 0) & (loose.batch >= 0)
    assert both.sum() > 0.97 * (exact.batch >= 0).sum()
    footprint = pixel_footprint(camera, SIZE) * exact.t[both]
    assert 0.001 < np.quantile(np.abs(loose.t - exact.t)[both] / footprint, 0.9) < 4 * 0.5
