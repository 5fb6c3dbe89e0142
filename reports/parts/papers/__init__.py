"""Compare the papers' tables and figures with ours. Every module in this folder makes some, and no list names them.

Such a module is made like a part of the report. Each section ends with the verdicts on the claims that the rows of its
config decide.
"""

from __future__ import annotations

from reports.content import Section
from reports.material import Material
from reports.parts import found

ORDER = 65
LEADS = True


def sections(material: Material) -> list[Section]:
    """Return the sections of every module of this folder."""
    return [section for part in found(__name__, __path__) for section in part.sections(material)]
