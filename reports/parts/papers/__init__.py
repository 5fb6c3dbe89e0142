"""Compare the papers' tables and figures with ours. Every module in this folder makes some, and no list names them.

Such a module is made like a part of the report. Each section says how many of the claims hold that the rows of its
config decide; the verdicts are among its details.
"""

from __future__ import annotations

from reports.content import Section
from reports.material import Material
from reports.parts import found

ORDER = 65
LEADS = True
PAPERS = ("toledo2007", "szente", "beamcasting")  # as the sections' titles begin, in the order of the report


def sections(material: Material) -> list[Section]:
    """Return the sections of every module of this folder, paper by paper."""
    made = [section for part in found(__name__, __path__) for section in part.sections(material)]
    return sorted(made, key=lambda section: PAPERS.index(section.title.partition(",")[0]))
