"""What compilers do wrong, and how it is found out: functions not inlined, and first answers held against f."""

import dataclasses
import re

import numpy as np
import pytest

import surfaces
from harness import cli, conformance
from harness.accuracy import compilers
from harness.conformance import dense
from harness.contract import Hits, RayStatus, Section
from harness.devices.interface import BuildError, hits_from, launch_rays, map_rows
from harness.kernels import sections
from harness.kernels.assemble import map_program, method_program
from harness.oracle import first_hits
from harness.plugins import find_methods
from harness.results.store import Store

from .conftest import opened, usable_devices
from .test_devices import cast

FUNCTION = re.compile(r"(?m)^(?!STRUCT|__kernel|typedef)(?=[A-Za-z_]\w* \w+\([^;]*\) \{$)")
OPENCL = [info.name for info in usable_devices() if info.name.startswith("opencl:")]
CASTING = [name for name, plugin in find_methods().plugins.items() if plugin.method.casts == "rays"]
ACCEPTED = ("barth_decic", "torus")  # a method is tried on the first that it accepts


def apart(program):
    """An OpenCL program none of whose functions is inlined."""

    def edited(text):
        return FUNCTION.sub("__attribute__((noinline)) ", text)

    return dataclasses.replace(program, sections=tuple(Section(s.origin, edited(s.text)) for s in program.sections))


def answers(device, program, rays):
    launch = launch_rays(device, program, device.build(program), rays)
    launch.run()
    hits = hits_from(launch.read())
    launch.release()
    return hits


def same_answers(one, other):
    return np.mean((one.status == other.status) & ~(np.abs(one.t - other.t) > 1e-3))


SIGNATURES = {
    "a vector": ("real g(vec3 p) {\n return p.x + 2.0 * p.y + 4.0 * p.z;\n}", "y[0] = g(vec3(x[0], x[1], x[2]));"),
    "a vector's result": (
        "vec3 g(real a, real b, real c) {\n return vec3(a, 2.0 * b, 4.0 * c);\n}",
        "vec3 v = g(x[0], x[1], x[2]); y[0] = v.x + v.y + v.z;",
    ),
    "a ray": (
        "real g(Ray ray, real t) {\n return ray.origin.x + t * ray.origin.y + 4.0 * ray.direction.z;\n}",
        "y[0] = g(make_ray(vec3(x[0], x[1], 0.0), vec3(0.0, 0.0, x[2])), 2.0);",
    ),
    "an array": (
        "real g(IN real c[3]) {\n return c[0] + 2.0 * c[1] + 4.0 * c[2];\n}",
        "real c[3]; for (int i = 0; i < 3; i++) c[i] = x[i]; y[0] = g(c);",
    ),
}


@pytest.mark.parametrize("precision", ["float32", "float64"])
@pytest.mark.parametrize("what", SIGNATURES)
@pytest.mark.parametrize("name", OPENCL)
def test_what_is_handed_to_a_function_that_is_not_inlined_arrives(name, what, precision, rng):
    function, call = SIGNATURES[what]
    text = f"#define INPUTS 3\n#define OUTPUTS 1\n{function}\nvoid map_item(IN real x[3], OUT real y[1]) {{ {call} }}\n"
    rows = rng.normal(size=(512, 3))
    got = map_rows(opened(name), apart(map_program(Section("test", text), precision, "cl")), rows, 1)[:, 0]
    assert np.abs(got - rows @ [1.0, 2.0, 4.0]).max() < 1e-4


@pytest.mark.one_in(4)
@pytest.mark.parametrize("method", CASTING)
@pytest.mark.parametrize("name", OPENCL)
def test_every_method_answers_alike_where_none_of_its_functions_is_inlined(name, method):
    plugin, device = find_methods().get(method), opened(name)
    surface = next(s for s in map(surfaces.get, ACCEPTED) if plugin.method.accepts(s) is None)
    case = conformance.view_case(surface)
    program = method_program(
        plugin.method, plugin.folder, plugin.variant({}), surface, plugin.method.precisions[0], "cl", "rays"
    )
    some = case.rays[::7]
    assert same_answers(answers(device, program, some), answers(device, apart(program), some)) == 1.0


def degree_18():
    """The polynomial on which bernstein was found wrong on opencl:intel: some calls of f were not inlined there."""
    surface = surfaces.from_formula(dense.formula(18, np.random.default_rng(1801)), dense.DOMAIN)
    return surface, dense.aimed_rays(surface, 2000, np.random.default_rng(18))


@pytest.mark.one_in(2)
@pytest.mark.parametrize("precision", ["float32", "float64"])
def test_bernstein_answers_a_dense_polynomial_of_degree_18_alike_on_every_device(precision):
    surface, rays = degree_18()
    case = conformance.Case(surface, rays, first_hits(surface, rays))
    for info in usable_devices():
        if precision == "float32" or info.float64:
            verdicts = case.judged(cast(opened(info.name), "bernstein", surface, precision, rays), precision)
            assert not verdicts.wrong[verdicts.clear].any(), info.name


# The host's check of first answers


def doubts_of(plugin, surface, rays, name, precision="float32", **knobs):
    """What is found of a method's first answers on a device, in this process."""
    variant = plugin.variant(knobs)

    def programs(language):
        return (method_program(plugin.method, plugin.folder, variant, surface, precision, language, "rays"),)

    def run(name, programs, index):
        return answers(opened(name), *programs, rays[index])

    second = compilers.SecondBuild(name, precision, programs, run)
    hits = answers(opened(name), *programs(opened(name).language), rays)
    return compilers.doubts_about(surface, rays, hits, second)


@pytest.fixture
def vectors_of_three(monkeypatch):
    """Programs are written as they were, with vectors of three in OpenCL."""
    real = sections.file_section

    def narrow(path):
        section = real(path)
        text = re.sub(r"(float|double)4\)\(x, y, z, 0\.0f?\)", r"\g<1>3)(x, y, z)", section.text)
        return Section(section.origin, re.sub(r"typedef (float|double)4 vec3", r"typedef \g<1>3 vec3", text))

    monkeypatch.setattr(sections, "file_section", narrow)


@pytest.mark.skipif("opencl:intel" not in OPENCL, reason="only Intel's compiler is known to fail so")
@pytest.mark.parametrize("precision", ["float32", "float64"])
@pytest.mark.usefixtures("vectors_of_three")
def test_the_compiler_that_miscompiled_bernstein_is_found_out(precision):
    doubts = doubts_of(find_methods().get("bernstein"), *degree_18(), "opencl:intel", precision)
    assert doubts.fault is not None
    assert doubts.contradicted > 0.2 * doubts.rays


PLANTED = {
    "misses where it should hit": "if (hit.status == HIT) return missed(hit);",
    "hits where there is nothing": "if (hit.status == MISS) return hit_at(hit, 0.5 * (t0 + t1));",
    "hits behind the first root": "if (hit.status == HIT) return hit_at(hit, hit.t + 0.9 * (t1 - hit.t));",
}


def planted(folder, fault, always=""):
    """Newton's method with a fault that only optimising compilers build: OpenGL's, and OpenCL's unless told not to.

    The fault `always` is built by all.
    """
    newton = find_methods().get("newton").folder
    mine = folder / "planted"
    mine.mkdir()
    (mine / "method.py").write_text((newton / "method.py").read_text().replace('"newton"', '"planted"'))
    kernel = (newton / "kernel.glsl").read_text().replace("Hit first_hit(", "Hit right_hit(")
    (mine / "kernel.glsl").write_text(
        f"{kernel}\nHit first_hit(Ray ray, real t0, real t1) {{\n    Hit hit = right_hit(ray, t0, t1);\n"
        f"#if defined(__OPTIMIZE__) || !defined(__OPENCL_VERSION__)\n    {fault}\n#endif\n    {always}\n"
        "    return hit;\n}\n"
    )
    return folder


def rows_of_planted(folder, more=""):
    """Run the planted method and newton, with further lines of a config: their rows by the methods' names."""
    config = folder / "t.toml"
    config.write_text(
        f'title = "t"\nsurfaces = ["torus"]\nsizes = [256]\ndevices = ["{OPENCL[0]}"]\nprecisions = ["float32"]\n'
        f"{more}\n"
        '[[method]]\nname = "planted"\n[[method]]\nname = "newton"\n'
        "[accuracy]\nsize = 32\n[budget]\nseconds = 0.05\nrepetitions = 3\ninterval = 0.0\n"
        '[surface.torus]\ndomain = "sphere:1.5"\n'
    )
    cli.main(["--plugins", str(folder), "run", str(config), "--runs", str(folder / "runs")])
    return {row["method"]: row for row in Store(folder / "runs" / "t").rows()}


@pytest.mark.parametrize("fault", PLANTED.values(), ids=PLANTED.keys())
@pytest.mark.parametrize("name", [info.name for info in usable_devices()])
@pytest.mark.skipif(not OPENCL, reason="no OpenCL device, which OpenGL's programs are held against")
def test_a_planted_mistake_is_told_from_a_weak_method(tmp_path, name, fault):
    surface = surfaces.get("torus")
    rays = conformance.view_case(surface).rays
    catalog = find_methods(planted(tmp_path, fault))
    assert doubts_of(catalog.get("planted"), surface, rays, name).fault
    assert doubts_of(catalog.get("newton"), surface, rays, name).fault is None


@pytest.mark.usefixtures("devices_found_once")
@pytest.mark.skipif(not OPENCL, reason="no OpenCL device")
def test_nothing_is_drawn_that_was_built_wrongly(tmp_path, capsys):
    folder, output = planted(tmp_path, PLANTED["misses where it should hit"]), tmp_path / "a.png"
    show = ["show", "--surface", "torus", "--size", "16", "--device", OPENCL[0], "-o", str(output)]
    assert cli.main(["--plugins", str(folder), *show, "--method", "planted"]) == 3
    assert "this device's compiler is at fault" in capsys.readouterr().err
    assert not output.exists()


@pytest.mark.usefixtures("devices_found_once")
@pytest.mark.skipif(not OPENCL, reason="no OpenCL device")
def test_a_row_of_a_program_that_was_built_wrongly_has_failed(tmp_path):
    rows = rows_of_planted(planted(tmp_path, PLANTED["misses where it should hit"]))
    assert rows["newton"]["status"] == "ok"
    assert rows["planted"]["status"] == "failed"
    assert rows["planted"]["reason"].startswith("this device's compiler is at fault")


@pytest.mark.usefixtures("devices_found_once")
@pytest.mark.skipif(not OPENCL, reason="no OpenCL device")
def test_behind_a_prepass_the_second_build_begins_where_the_first_did(tmp_path):
    """A method whose answers depend on where it begins goes wrong in both builds, and no compiler is named for it."""
    place = "vec3 begin = difference(ray_point(ray, t0), DOMAIN_CENTER);"
    inside = "inner_product(begin, begin) < 0.9 * DOMAIN_RADIUS * DOMAIN_RADIUS"
    folder = planted(tmp_path, "", f"{place} if ({inside}) return missed(hit);")
    row = rows_of_planted(folder, 'prepass = ["beams"]')["planted"]
    assert row["status"] == "ok" and row["accuracy"]["misses"] > 0.05 * row["accuracy"]["rays"]


@pytest.mark.parametrize("name", [info.name for info in usable_devices()])
def test_a_weak_method_and_its_second_build_are_wrong_alike(name):
    """ray_march in four steps passes most roots; the note says so, and nothing is said of the compiler."""
    surface = surfaces.get("torus")
    rays = conformance.view_case(surface).rays
    doubts = doubts_of(find_methods().get("ray_march"), surface, rays, name, STEPS=4)
    assert doubts.note
    assert doubts.fault is None


def test_f_contradicts_what_is_wrong_and_nothing_that_is_right():
    surface = surfaces.get("torus")
    case = conformance.view_case(surface)
    right = (case.truth.lower + case.truth.upper) / 2
    status = np.where(np.isfinite(right), RayStatus.HIT, RayStatus.MISS).astype(np.uint8)
    clear = np.flatnonzero(~(case.truth.margin < 0.1) & (status == RayStatus.HIT))
    hits = Hits(right, status, np.ones(len(right), np.int32))
    assert compilers.contradicted(surface, case.rays, hits).sum() == 0
    for t, answer in (
        (np.nan, RayStatus.MISS),
        (right[clear] - 0.3, RayStatus.HIT),
        (case.truth.following[clear], RayStatus.HIT),
        (right[clear] + 1e3, RayStatus.HIT),
        (np.nan, RayStatus.HIT),
        (-np.inf, RayStatus.HIT),
    ):
        wrong = dataclasses.replace(hits, t=hits.t.copy(), status=hits.status.copy())
        wrong.t[clear], wrong.status[clear] = t, answer
        found = np.flatnonzero(compilers.contradicted(surface, case.rays, wrong))
        expected = clear[np.isfinite(case.truth.following[clear])] if t is case.truth.following[clear] else clear
        assert set(found) <= set(clear)
        assert len(found) > 0.9 * len(expected), (t, answer)
    given_up = dataclasses.replace(hits, status=np.full(len(right), RayStatus.EXHAUSTED, np.uint8))
    assert not compilers.contradicted(surface, case.rays, given_up).any()


def test_a_program_built_without_optimisation_is_another_program(device):
    program = map_program(
        Section(
            "t", "#define INPUTS 1\n#define OUTPUTS 1\nvoid map_item(IN real x[1], OUT real y[1]) { y[0] = x[0]; }\n"
        ),
        "float32",
        device.language,
    )
    plain = dataclasses.replace(program, optimised=False)
    assert plain.hash != program.hash
    if device.language == "cl":
        assert map_rows(device, plain, np.ones((4, 1)), 1).tolist() == [[1.0]] * 4
    else:
        with pytest.raises(BuildError, match="cannot be told"):
            device.build(plain)
