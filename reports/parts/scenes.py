"""Scenes of many instances: ray cast and tessellated, and tolerances in pixels."""

from reports import scenes
from reports.content import Section
from reports.material import Material

ORDER = 29


def sections(material: Material) -> list[Section]:
    return scenes.sections(material.listed)
