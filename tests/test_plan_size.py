"""A plan of many cells holds once what its cells have in common, and its size is told before they are made."""

from collections import Counter

from harness.cli import main
from harness.contract import DeviceInfo
from harness.experiment import kinds, plan, reading, size
from harness.plugins import Plugin, find_methods

CONFIG = """
title = "views"
surfaces = ["sphere"]
sizes = [16, 32, 64]
prepass = ["none", "beams"]
stages = ["compute", "rays", "raster"]
devices = ["opengl:one", "opencl:one"]
method = [{ name = "newton" }, { name = "sphere_tracing" }]
view = [{ name = "front" }, { name = "side", azimuth = 90 }]
"""


def test_views_of_a_surface_share_programs_and_what_identities_say(tmp_path):
    path = tmp_path / "views.toml"
    path.write_text(CONFIG)
    catalog = find_methods()
    devices = [DeviceInfo(n, n, "d", "c", 4, True, "wall", ()) for n in ("opengl:one", "opencl:one")]
    planned = [p for p in plan.plan(reading.load(path, catalog), catalog, devices) if p.casting]
    assert {p.cell.stage for p in planned} == {"compute", "rays", "raster"} and len(planned) > 40
    programs = [q for p in planned for q in (*p.checks, p.timed, *p.casting.others) if q]
    assert len({id(q) for q in programs}) == len(set(programs)) < len(programs) / 4
    sections = [s for q in programs for s in (*q.sections, *q.vertex)]
    assert len({id(s) for s in sections}) == len(set(sections))
    for part in ("program", "program order", "methodology", "method", "device", "accuracy", "surface"):
        said = [p.identity[part] for p in planned]
        assert len({id(one) for one in said}) == len({str(one) for one in said}), part
    assert len({p.key for p in planned}) == len(planned)


def test_many_values_of_a_knob_are_bound_and_counted_once(tmp_path, monkeypatch):
    """Whatever is slow about a variant is done once for each value, or for all variants together."""
    asked: Counter[str] = Counter()

    def counted(place, name):
        function = getattr(place, name)
        monkeypatch.setattr(place, name, lambda *given: [asked.update([name]), function(*given)][1])

    path, catalog = tmp_path / "values.toml", find_methods()
    values = ", ".join(f"{1 + i / 1000}" for i in range(200))
    path.write_text(f"""
        title = "values"
        surfaces = ["sphere"]
        devices = ["opencl:one"]
        method = [{{ name = "newton", parameters = {{ EPSILON = [{values}] }} }}]
    """)
    counted(Plugin, "variant")
    counted(kinds, "rasterings")
    experiment = reading.load(path, catalog)
    device = DeviceInfo("opencl:one", "opencl:one", "d", "c", 4, True, "wall", ())
    assert size.cells_of(experiment, catalog, [device]) == 200 and len(experiment.variants) == 200
    assert asked == {"variant": 200, "rasterings": 1}


def test_plan_says_how_many_cells_it_prepares(tmp_path, capsys, monkeypatch):
    path = tmp_path / "values.toml"
    path.write_text(CONFIG.replace('devices = ["opengl:one", "opencl:one"]', 'devices = ["opencl:one"]'))
    device = DeviceInfo("opencl:one", "opencl:one", "d", "c", 4, True, "wall", ())
    monkeypatch.setattr("harness.running.run.discover_devices", lambda _: [device])
    assert main(["plan", str(path), "--runs", str(tmp_path)]) == 0
    told = capsys.readouterr()
    assert f"{path}: {len(told.out.splitlines()) - 2} cells; preparing them" in told.err
