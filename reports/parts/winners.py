"""Who wins in every group."""

from reports import derive, tables
from reports.content import Section
from reports.material import Material

ORDER = 10


def sections(material: Material) -> list[Section]:
    if derive.contenders(material.listed).empty:
        return []
    return [Section("Winners", (tables.winners(material.listed),))]
