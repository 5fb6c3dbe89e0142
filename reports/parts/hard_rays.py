"""Where each method breaks."""

from reports import stability
from reports.content import Section
from reports.material import Material

ORDER = 45


def sections(material: Material) -> list[Section]:
    return stability.sections(material.rungs, material.run.plan.facts, material.marks)
