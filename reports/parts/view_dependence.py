"""How speed and error depend on the view."""

from reports import views
from reports.content import Section
from reports.material import Material

ORDER = 25


def sections(material: Material) -> list[Section]:
    return views.sections(material.frame, material.marks, material.error_scale)
