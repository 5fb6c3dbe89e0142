"""List what commands answer with --json, and make their schemas."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from harness import schemas
from harness.commands.answers.experiments import Plan, Why
from harness.commands.answers.gates import Gate, History
from harness.commands.answers.listed import Devices, ListedConfigs, ListedDevices, ListedMethods, ListedSurfaces
from harness.commands.answers.recommending import Recommend
from harness.commands.answers.verifying import Verify
from harness.commands.machine import OWN

ANSWERS: dict[str, type[Any]] = {  # by the command that answers it
    "list surfaces": ListedSurfaces,
    "list methods": ListedMethods,
    "list configs": ListedConfigs,
    "list devices": ListedDevices,
    "devices": Devices,
    "plan": Plan,
    "why": Why,
    "gate": Gate,
    "history": History,
    "recommend": Recommend,
    "verify": Verify,
}


@dataclass(frozen=True)
class Every:
    """State what every object has.

    format: the number of this description; it rises where a field is taken away or changes its meaning
    firsthit: the version that answers
    command: the command, such as plan; null where none could be read
    exit_code: with which the command ends
    error: why the command could not do its work; null where it did, and there is content
    """

    format: int
    firsthit: str
    command: str | None
    exit_code: int
    error: str | None


def answer_schema(command: str) -> dict[str, Any]:
    """Return the schema of the object that a command of ANSWERS prints: with its content, or with an error."""
    every, content = schemas.of_output(Every), schemas.of_output(ANSWERS[command])
    assert tuple(every["properties"]) == OWN
    failed = {"properties": {"error": {"type": "string"}}, "required": ["error"]}
    return {
        "$schema": schemas.DRAFT,
        "title": f"What `firsthit {command} --json` prints",
        "description": content["description"],
        "type": "object",
        "properties": every["properties"] | content["properties"],
        "required": every["required"],
        "if": failed,
        "then": {"maxProperties": len(OWN)},
        "else": {"required": content["required"]},
        "$defs": content["$defs"],
    }
