"""Make the files that are shipped: the program, an example that draws it, a line how to run that, and the licence."""

from __future__ import annotations

from pathlib import Path
from string import Template

from harness.scenes.camera import scene_radius
from harness.shipping.program import LANGUAGE_TITLES, Shipment

TEMPLATES = Path(__file__).with_name("templates")
PACKAGES = {"glsl": "moderngl numpy pillow", "cl": "pyopencl numpy pillow"}
OPTIONS = {"float32": '["-cl-single-precision-constant"]  # else numbers like 0.5 are float64', "float64": "[]"}


def package(shipment: Shipment, command: str) -> dict[str, str]:
    """Return the texts of the files, by their names; `command` is the one that writes them.

    Raises FirsthitError where the kernel is mistaken.
    """
    surface, language = shipment.surface, shipment.language
    words = {
        "title": " ".join(surface.title.split()),
        "method": shipment.plugin.method.name,
        "language": LANGUAGE_TITLES[language],
        "precision": shipment.precision,
        "suffix": language,
        "center": repr(surface.domain.center),
        "radius": repr(scene_radius(surface)),
        "options": OPTIONS[shipment.precision],
        "packages": PACKAGES[language],
        "whose": f", but for the kernel of {shipment.plugin.method.name}" if shipment.foreign else "",
    }

    def filled(template: str) -> str:
        return Template((TEMPLATES / template).read_text(encoding="utf-8")).substitute(words)

    return {
        f"program.{language}": shipment.text(command),
        "draw.py": filled(f"draw_{language}.py.txt"),
        "README.txt": filled("readme.txt"),
        "LICENSE.txt": (TEMPLATES / "license.txt").read_text(encoding="utf-8"),
    }
