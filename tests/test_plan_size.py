"""A plan of many cells holds once what its cells have in common."""

from harness.contract import DeviceInfo
from harness.experiment import plan, reading
from harness.plugins import find_methods

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
