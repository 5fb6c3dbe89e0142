"""Scenes: what is in front is what the oracle says, whatever draws it; and the same seed gives the same scene."""

import dataclasses

import numpy as np
import pytest

import surfaces
from harness.accuracy.judge import judge
from harness.accuracy.scene_truth import scale_of, scene_truth
from harness.cli import main
from harness.contract import FirsthitError, View
from harness.experiment import reading
from harness.plugins import find_methods
from harness.scenes import meshes
from harness.scenes.choice import PlacedChoice, SceneChoice, cut, rotation, scenes_of
from harness.scenes.generate import GENERATORS, generate
from harness.scenes.model import Group, Scene

from .test_raster import draw, gl, variant  # noqa: F401

SIZE = 96
VIEW = View("oblique", azimuth=20, elevation=40)


def placed(*choices, **view):
    """A scene of PlacedChoices."""
    catalog = find_methods()
    (scene,) = scenes_of(
        "test",
        SceneChoice(placed=[PlacedChoice(**choice) for choice in choices], **view),
        lambda one: cut(surfaces.get(one.surface, **one.parameters), one.domain),
        lambda one: catalog.get(one.method).variant(one.knobs),
    )
    return scene


def seen(gl, scene, chosen, folder, tolerance):  # noqa: F811
    """The picture and its truth, every pixel held against the oracle but those at silhouettes and near ties."""
    picture = draw(gl, scene, chosen, SIZE)
    truth = scene_truth(scene, picture.rays, picture, folder, 1e-3 * scene.stand_in.domain.radius)
    hits, radius = picture.hits(scale_of(scene, picture)), scene.stand_in.domain.radius
    verdicts = judge(hits, truth.truth, radius, 1e-3)
    clear = ~verdicts.grazing
    assert clear.mean() > 0.7
    assert not verdicts.wrong[clear].any()
    assert np.array_equal(picture.batch[clear], truth.batch[clear])
    assert np.array_equal(picture.instance[clear & (truth.batch >= 0)], truth.instance[clear & (truth.batch >= 0)])
    assert np.nanmax(verdicts.error[clear], initial=0.0) < tolerance * radius
    return picture, truth


@pytest.mark.parametrize("mesh_at", [-1.2, 1.2], ids=["mesh behind", "mesh in front"])
def test_a_torus_and_a_mesh_hide_each_other_as_the_oracle_says(gl, tmp_path, mesh_at):  # noqa: F811
    pytest.importorskip("pyvista")
    at = mesh_at * np.array([np.cos(0.7), 0.2, np.sin(0.7)])
    scene = placed(
        {"surface": "torus", "turn": (20, 0, 10), "method": "newton"},
        {"surface": "sphere", "at": tuple(at), "scale": 0.55, "method": "polygon", "knobs": {"N": 512}},
        azimuth=10,
        elevation=40,
    )
    _, truth = seen(gl, scene, variant("newton"), tmp_path, 3e-4)
    both = truth.gap < np.inf
    assert both.sum() > 300
    assert (truth.batch[both] == (1 if mesh_at > 0 else 0)).all(), "one stands in front of the other"


def test_interpenetrating_tori_of_two_methods_part_where_the_oracle_says(gl, tmp_path):  # noqa: F811
    scene = placed(
        {"surface": "torus", "turn": (20, 0, 0), "method": "newton", "knobs": {"EPSILON": 0.00003}},
        {
            "surface": "torus",
            "parameters": {"R": 0.6, "r": 0.2},
            "at": (0.6, 0.0, 0.0),
            "turn": (90, 10, 0),
            "scale": 1.3,
            "method": "sturm",
        },
        azimuth=10,
        elevation=50,
    )
    picture, _ = seen(gl, scene, variant("newton"), tmp_path, 1e-5)
    assert all((picture.batch == k).sum() > 300 for k in (0, 1))


@pytest.mark.parametrize("method", ["newton", "interval_march", "sphere_tracing"])
def test_instances_with_radii_of_their_own(gl, tmp_path, method):  # noqa: F811
    scene = generate("scattered", 12, 3, VIEW)
    assert scene.groups[0].varies
    picture, _ = seen(gl, scene, variant(method), tmp_path, 1e-4)
    assert len(set(picture.instance[picture.batch >= 0])) > 6


def test_an_arc_is_a_torus_in_its_box_and_so_is_its_mesh(gl, tmp_path):  # noqa: F811
    pytest.importorskip("pyvista")
    quarter = {"surface": "torus", "domain": "box:0,0,-0.3:1,1,0.3", "turn": (0, 0, 30), "scale": 2.0}
    for method, knobs, tolerance in (("newton", {}, 1e-5), ("polygon", {"N": 256}, 2e-3)):
        scene = placed(quarter, azimuth=40, elevation=50)
        seen(gl, scene, find_methods().get(method).variant(knobs), tmp_path, tolerance)


def test_a_mesh_needs_one_shape_for_its_group():
    from harness.experiment.kinds.draws import refusal

    reason = refusal(generate("scattered", 5, 1, VIEW), variant("polygon"), find_methods())
    assert "differ in R, r" in reason


@pytest.mark.parametrize("kind", list(GENERATORS))
def test_generated_scenes_have_their_count_and_follow_their_seed(kind):
    one, same, other = (generate(kind, 60, seed, VIEW) for seed in (1, 1, 2))
    assert one.instances == 60
    assert one.identity == same.identity != other.identity
    for group in one.groups:
        gram = group.turn @ group.turn.transpose(0, 2, 1)
        assert np.abs(gram - np.eye(3)).max() < 1e-12
        assert (np.linalg.det(group.turn) > 0.99).all()


def test_pipes_join():
    """Each part's ends are where its neighbours' are: the ends of all pipes but plates pair up or end at a plate."""
    scene = generate("pipes", 200, 5, VIEW)
    ends, plates = [], []
    for group in scene.groups:
        kind = group.distinct[0].name
        local = {"torus": [[0.5, 0, 0], [0, 0.5, 0]], "plane": [[0, 0, 0]]}.get(kind, [[0, 0, -0.5], [0, 0, 0.5]])
        at = group.place[:, None] + np.einsum("nij,kj->nki", group.turn, np.array(local, float))
        (plates if kind == "plane" else ends).extend(np.round(2 * at.reshape(-1, 3)).astype(int).tolist())
    loose = [end for end in ends if ends.count(end) == 1 and end not in plates]
    assert len(loose) <= 2, "only where the count ran out"


def test_parametric_meshes_close_up_and_lie_on_their_surface():
    pytest.importorskip("pyvista")
    scene = generate("pipes", 300, 1, VIEW)
    for surface in {s for group in scene.groups for s in group.distinct}:
        made = meshes.mesh(surface, variant_recipe(surface))
        points = made.vertices[:, :3].astype(float)
        assert np.abs(surfaces.evaluate(surface, points)).max() < 1e-6
        assert np.abs(np.linalg.norm(made.vertices[:, 3:], axis=1) - 1.0).max() < 1e-6


def variant_recipe(surface):
    method = find_methods().get("polygon").method
    return method.mesh(surface, {"N": 16})


def test_rotations_turn_about_x_then_y_then_z():
    assert np.allclose(rotation(90, 0, 0) @ [0, 1, 0], [0, 0, 1])
    assert np.allclose(rotation(0, 90, 0) @ [0, 0, 1], [1, 0, 0])
    assert np.allclose(rotation(90, 0, 90) @ [0, 1, 0], [0, 0, 1])
    assert np.allclose(rotation(0, 0, 90) @ [1, 0, 0], [0, 1, 0])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('generate = "latice"', "generate: unknown 'latice'; did you mean 'lattice'?"),
        ("counts = [5]", "needs instances in `placed`"),
        ('placed = [{ surface = "torus", scale = 0.0 }]', "a scale is positive"),
        ('placed = [{ surface = "tours" }]', "did you mean torus"),
        ('placed = [{ surface = "torus", method = "polygno" }]', "did you mean 'polygon'"),
    ],
)
def test_a_scene_that_is_none_is_answered_with_its_line(tmp_path, text, message):
    path = tmp_path / "c.toml"
    path.write_text(f'title = "t"\n[[method]]\nname = "newton"\n[scene.mine]\n{text}\n')
    with pytest.raises(FirsthitError, match=message) as caught:
        reading.load(path, find_methods())
    assert f"{path}:" in str(caught.value)


def test_a_group_is_checked():
    torus = surfaces.get("torus")
    group = Group((torus,), np.zeros((1, 3)), np.eye(3)[None], np.ones(1), np.ones((1, 3)))
    for wrong in ({"scale": np.zeros(1)}, {"surfaces": (torus, torus)}, {"turn": np.eye(3)}):
        with pytest.raises(FirsthitError, match="group"):
            dataclasses.replace(group, **wrong)
    assert Scene("s", "s", (group,), VIEW, "s").sphere == pytest.approx([0, 0, 0, 1.0])


@pytest.mark.usefixtures("gl")
def test_a_scene_of_a_config_is_drawn(tmp_path, capsys):
    image = pytest.importorskip("PIL.Image")
    path, output = tmp_path / "c.toml", tmp_path / "s.png"
    path.write_text('title = "t"\n[[method]]\nname = "newton"\n[scene.mine]\ngenerate = "lattice"\ncounts = [8]\n')
    assert main(["scene", str(path), "--method", "newton", "--size", "48", "-o", str(output)]) == 0
    assert "8 tori on a lattice" in capsys.readouterr().out
    with image.open(output) as drawn:
        assert drawn.size == (48, 48)
        assert 0.2 < (np.asarray(drawn) < 255).any(axis=2).mean() < 0.9
    assert main(["scene", str(path), "--name", "latice 8", "--method", "newton", "-o", str(output)]) == 2
    assert "did you mean 'lattice 8'?" in capsys.readouterr().err


@pytest.mark.usefixtures("gl")
def test_a_method_that_cannot_be_loaded_costs_the_scenes_that_name_it(tmp_path, capsys):
    pytest.importorskip("PIL.Image")
    path, output, plugins = tmp_path / "c.toml", tmp_path / "s.png", tmp_path / "plugins"
    (plugins / "bad").mkdir(parents=True)
    (plugins / "bad" / "method.py").write_text("raise SystemExit(0)\n")
    (plugins / "bad" / "kernel.glsl").touch()
    path.write_text(
        'title = "t"\n[[method]]\nname = "newton"\n[[method]]\nname = "bad"\n[method.parameters]\nN = [3]\n'
        '[[scene.mine.placed]]\nsurface = "torus"\n[[scene.other.placed]]\nsurface = "torus"\nmethod = "bad"\n'
    )
    command = ["--plugins", str(plugins), "scene", str(path), "--size", "32", "-o", str(output)]
    assert main([*command, "--method", "newton"]) == 0, capsys.readouterr().err
    assert output.exists() and "'bad' cannot be loaded" in capsys.readouterr().err
    output.unlink()
    for asks in (["--method", "newton", "--name", "other"], ["--method", "bad"]):
        assert main([*command, *asks]) == 3
        told = capsys.readouterr().err.splitlines()[-1]
        assert "cannot be loaded" in told and "SystemExit" in told and not output.exists()
        assert ("scene 'other' names the method 'bad'" in told) == ("--name" in asks)
