"""The papers' tables and figures beside ours."""

from reports import reproductions
from reports.content import Section
from reports.material import Material

ORDER = 65
LEADS = True


def sections(material: Material) -> list[Section]:
    return reproductions.sections(material)
