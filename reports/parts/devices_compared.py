"""The same kernel on every device."""

from reports import across
from reports.content import Section
from reports.material import Material

ORDER = 30


def sections(material: Material) -> list[Section]:
    return across.sections(material.listed)
