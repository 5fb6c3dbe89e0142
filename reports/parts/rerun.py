"""How to have the same again."""

from __future__ import annotations

from reports.content import Code, Section, Text
from reports.material import Material

ORDER = 95


def sections(material: Material) -> list[Section]:
    plan = material.run.plan
    commit = str(plan.environment.get("commit") or "")
    lines = [f"git checkout {commit}"] if commit else []
    lines += ["make .venv/ready", plan.command, f"firsthit report runs/{plan.name}"]
    told = (
        "Finished cells are reused, so that the second command goes on where the run stopped; `--force` runs all "
        "again. Times differ from machine to machine; answers on one device do not."
    )
    dirty = (
        "The run was made with uncommitted changes, which the commit does not hold."
        if plan.environment.get("dirty")
        else ""
    )
    return [Section("How to run it again", (Code("\n".join(lines)), Text(" ".join(filter(None, (told, dirty))))))]
