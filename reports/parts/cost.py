"""How cost grows with pixels, degree and instances."""

from reports import growth
from reports.content import Section
from reports.material import Material

ORDER = 26


def sections(material: Material) -> list[Section]:
    return growth.sections(material.listed, material.marks)
