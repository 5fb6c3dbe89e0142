"""Evaluations ray by ray."""

from reports import evaluations
from reports.content import Section
from reports.material import Material

ORDER = 27


def sections(material: Material) -> list[Section]:
    return evaluations.sections(material.shelf, material.frame, material.error_scale)
