"""Variants compared round by round."""

from reports import pairs
from reports.content import Section
from reports.material import Material

ORDER = 32


def sections(material: Material) -> list[Section]:
    return pairs.sections(material.listed)
