"""Devices, machine, software and config."""

from reports import machine
from reports.content import Code, Section
from reports.material import Material

ORDER = 80


def sections(material: Material) -> list[Section]:
    plan = material.run.plan
    tabled = (machine.devices(plan), machine.environment(plan))
    return [Section("Devices, environment, config", (*tabled, Code(plan.config_text, "toml")), wide=True)]
