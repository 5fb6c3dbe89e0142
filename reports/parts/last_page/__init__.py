"""Make the last page: what failed and why, what the run was made with, and how to run it again."""

from __future__ import annotations

from reports.content import Block, Section, Table
from reports.material import Material
from reports.parts.last_page import environment, failures, rerun

ORDER = 95
TITLE = "Failures, environment and how to run it again"
SHORT = 20  # lines of tables; with more the section has a page of its own, on which it stays in one piece


def sections(material: Material) -> list[Section]:
    """Make the section, which every report has.

    The PDF has what fits on a page. Every cell without a result, all that is known of the devices and the machine, and
    the config's text are among the details.
    """
    blocks: tuple[Block, ...] = (
        *failures.blocks(material),
        *environment.blocks(material.run.plan),
        *rerun.blocks(material),
    )
    details = (*failures.details(material), *environment.details(material.run.plan))
    lines = sum(len(block.rows) for block in blocks if isinstance(block, Table))
    return [Section(TITLE, blocks, details, own_page=lines > SHORT, name="Failures, rerun")]
