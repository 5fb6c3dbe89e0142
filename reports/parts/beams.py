"""Methods that cast beams: what their hits mean, and the level at which each box was eliminated."""

from reports import beams
from reports.analysis import forms
from reports.content import Section
from reports.material import Material

ORDER = 28


def sections(material: Material) -> list[Section]:
    frame = forms.printed_alone(material.frame)
    return [*beams.sections(material.shelf, frame), *beams.prepass_sections(frame)]
