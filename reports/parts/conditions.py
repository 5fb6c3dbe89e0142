"""Error against condition."""

from reports import condition
from reports.analysis import forms
from reports.content import Section
from reports.material import Material

ORDER = 40


def sections(material: Material) -> list[Section]:
    return condition.sections(material.shelf, forms.printed_alone(material.frame), material.marks)
