"""Who wins in every group."""

from reports import derive, tables
from reports.content import Section
from reports.material import Material

ORDER = 10
ONE_BY_ONE = 20  # groups whose winners need not be counted as well


def sections(material: Material) -> list[Section]:
    rows = derive.contenders(material.listed)
    if rows.empty:
        return []
    counted = (tables.wins(material.listed),) if len(rows.drop_duplicates(derive.GROUP)) > ONE_BY_ONE else ()
    return [Section("Winners", (*counted, tables.winners(material.listed)))]
