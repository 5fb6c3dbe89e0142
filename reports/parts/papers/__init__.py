"""Compare the papers' tables and figures with ours. Every module in this folder makes some, and no list names them.

Such a module is made like a part of the report. Each section says how many of the claims hold that the rows of its
config decide; the verdicts are among its details.
"""

from __future__ import annotations

from dataclasses import replace

from reports.content import Section
from reports.material import Material
from reports.parts import found

ORDER = 65
LEADS = True
_SHORT = (  # of sections' titles in the contents
    ("Figures", "Figs."),
    ("Figure", "Fig."),
    ("what our changes are worth", "changes"),
    ("piece by piece", "pieces"),
)
PAPERS = ("toledo2007", "szente", "beamcasting")  # as the sections' titles begin, in the order of the report


def sections(material: Material) -> list[Section]:
    """Return the sections of every module of this folder, paper by paper."""
    made = [section for part in found(__name__, __path__) for section in part.sections(material)]
    made.sort(key=lambda section: PAPERS.index(section.title.partition(",")[0]))
    return [_named(section, before) for section, before in zip(made, [None, *made], strict=False)]


def _named(section: Section, before: Section | None) -> Section:
    """Give a section its name in the contents, which says the paper only where the section `before` is of another."""
    paper, _, part = section.title.partition(", ")
    for long, short in _SHORT:
        part = part.replace(long, short)
    same = before is not None and before.title.startswith(paper)
    return replace(section, name=part if same else f"{paper}: {part}")
