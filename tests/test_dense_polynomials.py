"""Methods on dense random polynomials of every degree that they accept (harness/conformance/dense.py), held
against the oracle.

By default every method is tried at a few degrees, each on one device in one precision, in turn. FIRSTHIT_RAYS asks for
more: every method at every degree, and bernstein on each device in both precisions, with so many of its rays in all.
"""

from __future__ import annotations

import os
from functools import cache

import pytest

from harness import cli, conformance
from harness.conformance import dense
from harness.contract import PRECISIONS, TruthStatus
from harness.plugins import find_methods

from .conftest import opened, rotation, usable_devices
from .test_conformance import bench_on, hold
from .test_method_bernstein_claims import hold_promise

WANTED = int(os.environ.get("FIRSTHIT_RAYS", "0"))
EVERY = 1 if WANTED else 5  # degree of a method, and its last
COUNT = 300  # rays of one polynomial
MOST = 3000  # of one polynomial, where many rays are asked for: then there are more polynomials
PLACES = [(info.name, precision) for precision in PRECISIONS for info in usable_devices()]
METHODS = [n for n, plugin in find_methods().plugins.items() if plugin.method.answers and plugin.method.casts == "rays"]
ALL_DEGREES = [degree for degree in dense.DEGREES if degree > 1]
SEEDS = max(1, -(-WANTED // (MOST * len(ALL_DEGREES) * max(1, len(PLACES)))))


@cache
def accepted(method):
    accepts = find_methods().get(method).method.accepts
    return [degree for degree in dense.DEGREES if accepts(dense.surface_of(degree, dense.seed_of(degree))) is None]


@cache
def pairs():
    """(method, degree): every EVERY-th degree, shifted from method to method, and each method's last."""
    return [
        (method, degree)
        for i, method in enumerate(METHODS)
        for degree in accepted(method)
        if (degree + i) % EVERY == 0 or degree == accepted(method)[-1]
    ]


@pytest.mark.one_in(6)
@pytest.mark.parametrize(
    ("method", "degree", "device_name", "precision"),
    [(*pair, *place) for pair, place in rotation(pairs(), PLACES)],
)
def test_method_conforms_on_a_dense_polynomial(method, degree, device_name, precision):
    bench, plugin = bench_on(opened(device_name)), find_methods().get(method)
    case = dense.case_of(degree, dense.seed_of(degree), COUNT)
    if reason := conformance.refusal(plugin, case.surface, precision, bench):
        pytest.skip(reason)
    hold(conformance.examine(bench, plugin, case, precision))


def _held():
    everywhere = [(degree, *place) for degree in ALL_DEGREES for place in PLACES]
    in_turn = [(degree, *PLACES[i % len(PLACES)]) for i, degree in enumerate(ALL_DEGREES)] if PLACES else []
    return everywhere if WANTED else in_turn


@pytest.mark.one_in(5)
@pytest.mark.parametrize(("degree", "device_name", "precision"), _held())
def test_no_answer_of_bernstein_is_outside_its_promise(degree, device_name, precision):
    bench, plugin = bench_on(opened(device_name)), find_methods().get("bernstein")
    if precision == "float64" and not bench.float64:
        pytest.skip("the device has no float64")
    for k in range(SEEDS):
        case = dense.case_of(degree, dense.seed_of(degree) + k, MOST if WANTED else COUNT)
        assert hold_promise(bench.cast(plugin, case, precision), case, precision) > 0.3


@pytest.mark.parametrize("degree", dense.DEGREES)
def test_a_dense_polynomial_has_its_degree_and_is_met(degree):
    surface = dense.surface_of(degree, dense.seed_of(degree))
    assert surface.degree == degree
    case = dense.case_of(degree, dense.seed_of(degree), COUNT)
    crossing = case.truth.status == TruthStatus.CROSSING
    assert not (case.truth.status == TruthStatus.UNDECIDED).any()
    assert 0.3 < crossing.mean() < 0.95


def test_conform_is_offered_every_degree_in_both_precisions():
    """With few rays, since `firsthit conform` takes them from here."""
    plugin = find_methods().get("analytic")
    bench = bench_on(opened(next(name for name, precision in PLACES if precision == "float64")))
    offered = [(case.surface.degree, precision) for _, case, precision in dense.cases(bench, plugin, 10)]
    assert offered == [(degree, precision) for degree in accepted("analytic") for precision in PRECISIONS]


@pytest.mark.usefixtures("devices_found_once")
def test_conform_tells_what_a_method_does_on_dense_polynomials(tmp_path, capsys, monkeypatch):
    """A method that is right but for degree 17, where it answers nothing but misses."""
    monkeypatch.setattr(dense, "DEGREES", (16, 17))
    mine = tmp_path / "mine"
    mine.mkdir()
    newton = find_methods().get("newton").folder
    (mine / "method.py").write_text((newton / "method.py").read_text().replace('"newton"', '"mine"'))
    kernel = (newton / "kernel.glsl").read_text().replace("Hit first_hit(", "Hit right_hit(")
    (mine / "kernel.glsl").write_text(
        f"{kernel}\nHit first_hit(Ray ray, real t0, real t1) {{\n"
        "    Hit hit = right_hit(ray, t0, t1);\n    if (SURFACE_DEGREE == 17) return missed(hit);\n    return hit;\n}\n"
    )
    where = ["--surface", "sphere", "--device", PLACES[0][0]]
    assert cli.main(["--plugins", str(tmp_path), "conform", "--method", "mine", *where]) == 1
    told = [line for line in capsys.readouterr().out.splitlines() if "FAILS" in line]
    assert any("dense degree 17 float32" in line for line in told)
    assert not any("dense degree 16" in line for line in told)
