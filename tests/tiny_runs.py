"""Run small configs with every kind of cell: each way of casting, families, what is skipped and what fails.

The configs are named after those of the papers, so that the parts of a report that read only those read these.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

UNCOMPILED = '''"""A method whose kernel does not compile."""

from harness.contract import Method

METHOD = Method(name="uncompiled", source="a test", needs=("surface_value",))
'''
KERNEL = "Hit first_hit(Ray ray, real t0, real t1) { return no_such_function(t0); }"

CAST = """title = "Every way of casting"
surfaces = ["octdong"]
sizes = [24]
prepass = ["none", "beams"]
devices = {devices}
stages = ["compute", "rays"]
baseline = "newton"
studies = ["torus_along_rays"]

[[method]]
name = "newton"

[[method]]
name = "interval_adaptive"
deviations = true

[[method]]
name = "interval_uniform"

[[method]]
name = "tiles"

[[method]]
name = "uncompiled"

[[method]]
name = "null"

[surface.octdong]
domain = "sphere:0.9"

[accuracy]
size = 12

[budget]
seconds = 0.002
rounds = 1
"""

SEEN = """title = "Forms, origins, directions and hard rays"
surfaces = ["torus", "torus:nested"]
sizes = [24]
origins = ["nearest", "eye"]
devices = {devices}
families = ["grazing"]

[[method]]
name = "newton"
settings = ["Newton 0.001"]
parameters = {{ EPSILON = 0.001 }}

[[method]]
name = "bernstein"

[[method]]
name = "null"

[directions]
count = 3
seed = 1

[accuracy]
size = 12
max_wrong_share = 1.0

[budget]
seconds = 0.002
rounds = 6
"""

DRAWN = """title = "Rasterised"
surfaces = ["torus"]
sizes = [24]
samples_per_pixel = [4]
stages = ["raster"]
devices = {devices}

[[method]]
name = "newton"
settings = ["Newton 0.001"]

[[method]]
name = "sturm"
settings = ["Sturm"]

[[method]]
name = "polygon"
parameters = {{ N = [32] }}

[[method]]
name = "null"

[angles]
values = [0.0, 36.0]
distance = 5.584

[scene.lattice]
generate = "lattice"
counts = [1, 2, 4]

[accuracy]
size = 12
max_wrong_share = 1.0

[budget]
seconds = 0.002
rounds = 1
"""
MOVED = """title = "A camera's path"
surfaces = ["kiss"]
sizes = [16]
devices = {devices}

[[method]]
name = "newton"

[path]
frames = 3
azimuth = 30
elevation = 35
turn = 90

[accuracy]
size = 4

[budget]
seconds = 0.002
rounds = 1
"""
PARTS = {"beamcasting-tables": CAST, "szente-table5": SEEN, "toledo-table1": DRAWN, "a-path": MOVED}


def make(folder: Path, opencl: str, opengl: str) -> Path:
    """Run all configs on two devices, families, origins and paths on the first alone.

    Returns the folder of the run that collects them.

    Cells fail on purpose, so that the command ends with 3. Fails where the command ends otherwise.
    """
    method = folder / "plugins" / "uncompiled"
    method.mkdir(parents=True)
    (method / "method.py").write_text(UNCOMPILED)
    (method / "kernel.glsl").write_text(KERNEL)
    for name, text in PARTS.items():
        devices = [opencl] if text in (SEEN, MOVED) else [opencl, opengl]
        (folder / f"{name}.toml").write_text(text.format(devices=str(devices).replace("'", '"')))
    names = ", ".join(f'"{name}.toml"' for name in PARTS)
    (folder / "all.toml").write_text(f'title = "Every kind"\ninclude = [{names}]\n')
    command = ["--plugins", method.parent, "run", folder / "all.toml", "--runs", folder / "runs"]
    done = subprocess.run(
        [sys.executable, "-m", "harness.cli", *map(str, command)], capture_output=True, text=True, check=False
    )
    assert done.returncode == 3, done.stderr
    return folder / "runs" / "all"
