"""Make the JSON schema of configs, by which editors complete, explain and check them: `firsthit schema`.

configs/schema.json is this schema; a test fails where it is not up to date. It is made from the dataclasses that
harness.experiment.reading reads, and refuses nothing that a config may hold. What it cannot say is left to the reader:
whether a name stands for something, whether a formula can be read, that a number is finite.
"""

from __future__ import annotations

from typing import Any

from harness import schemas
from harness.experiment.config import ASKED, BESIDE_INCLUDE, DRAWN, Config


def schema() -> dict[str, Any]:
    """Return the schema of a config, of draft 2020-12."""
    made = schemas.of_input(Config)
    return {"$schema": made.pop("$schema"), "title": "A config of firsthit", **made, **_whole()}


def _whole() -> dict[str, Any]:
    """Return what harness.experiment.resolving asks of a whole config: what is drawn, or else included."""
    return {
        "if": {"required": ["include"]},
        "then": {"propertyNames": {"enum": list(BESIDE_INCLUDE)}},
        "else": {
            "anyOf": [{"required": [name]} for name in ASKED],
            "if": {"anyOf": [{"required": [name]} for name in DRAWN]},
            "then": {"required": ["method"]},
        },
    }
