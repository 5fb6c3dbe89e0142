"""Every cell that has no result, and why."""

from reports.content import Section, Text
from reports.drawing import tables
from reports.material import Material

ORDER = 90


def sections(material: Material) -> list[Section]:
    run = material.run
    ended = tables.troubles(material.frame, run.families, run.plan.facts)
    files = tables.unreadable([*run.unreadable, *material.shelf.damaged.values()])
    blocks = tuple(filter(None, (ended, files, tables.not_run(run.not_run))))
    nothing = Text("Nothing: every planned cell ran and gave a result.")
    return [Section("Skipped, failed and missing", blocks or (nothing,), wide=True)]
