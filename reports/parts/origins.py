"""What it is worth that rays begin near the surface."""

from reports import origins
from reports.content import Section
from reports.material import Material

ORDER = 23


def sections(material: Material) -> list[Section]:
    return origins.sections(material.frame, material.rungs, material.run.plan.facts)
