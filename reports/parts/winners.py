"""Who wins in every group."""

from reports.analysis import derive, ties
from reports.content import Section, Text
from reports.drawing import tables
from reports.material import Material

ORDER = 10
ONE_BY_ONE = 20  # groups whose winners need not be counted as well


def sections(material: Material) -> list[Section]:
    rows = derive.contenders(material.listed)
    if rows.empty:
        return []
    leading = ties.leaders(material.listed)
    several = len(rows.drop_duplicates(derive.GROUP)) > ONE_BY_ONE
    counted = (tables.wins(leading),) if several and len(leading) else ()
    return [Section("Winners", (Text(f"{ties.RULE}."), *counted, tables.winners(material.listed, leading)))]
