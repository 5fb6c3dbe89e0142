"""Read and write the blessed baseline: a TOML file that is made to be read in a diff, one figure a line, sorted.

    [device."opencl:pocl 1f3a6c"]   one device of one machine: what it is, and who blessed it, when and why
    [device."opencl:pocl 1f3a6c".arithmetic.float32]   its fingerprint (harness/devices/fingerprint.py), a part a line
    [row."opencl:pocl 1f3a6c"."newton torus …"]   what one cell gave there

A device's key is its name and a short hash of its fingerprint. A baseline may hold several devices and machines;
blessing replaces only those that it ran on. Files of format 1, whose devices have no fingerprint, can be read too.
"""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NotRequired, TypedDict

from harness.contract import FirsthitError, digest
from harness.results import declared, entry, sealed
from harness.results.writing import write_atomically

FORMAT = 2
READ = (1, FORMAT)
ARITHMETIC = "arithmetic"  # of a device's facts: its fingerprint
LAST_BIT = "last_bit"  # of an entry: kinds.comparing.last_bit of its cell
Entry = dict[str, Any]  # what entries.asked_of names, program (its hash), and the figures
BARE = re.compile(r"[A-Za-z0-9_-]+")  # keys that TOML needs no quotes for


@dataclass(frozen=True)
class Baseline:
    """Hold the entries of rows by the device's key and by slot, and each device's facts by its key.

    A slot is that of `entries.slot_of`, without the device.
    """

    config: str = ""
    devices: dict[str, dict[str, Any]] = field(default_factory=dict)
    rows: dict[str, dict[str, Entry]] = field(default_factory=dict)


def device_key(facts: Mapping[str, Any]) -> str:
    """Return a device's name and a short hash of its fingerprint."""
    return f"{facts['name']} {digest(facts.get(ARITHMETIC, {}))[:6]}"


def read(path: Path) -> Baseline:
    """Read a baseline. Raises FirsthitError where there is none, or it is damaged or of another format."""
    try:
        document = tomllib.loads(sealed.content(path).decode())
    except FileNotFoundError:
        raise FirsthitError(
            f"there is no baseline {path}; `firsthit bless` makes one, and --against REV needs none"
        ) from None
    except (OSError, ValueError, RecursionError) as error:
        raise FirsthitError(f"cannot read the baseline {path}: {sealed.problem(error):.200}") from None
    if type(document.get("format")) is not int or document["format"] not in READ:
        found = f"format {document.get('format')!r:.40}"
        raise FirsthitError(f"{path} is no baseline of this version ({found}); bless anew")
    try:
        return _held(document)
    except ValueError as error:
        raise FirsthitError(f"{path} is damaged: {error}; restore it, or bless anew") from None


class _File(TypedDict):
    """Declare what a baseline's file holds."""

    config: NotRequired[str]
    device: NotRequired[dict[str, dict[str, Any]]]
    row: NotRequired[dict[str, dict[str, Entry]]]


_CHECK = declared.checker(_File)


def _held(document: dict[str, Any]) -> Baseline:
    """Make a baseline of what its file says. Raises ValueError where it says what a baseline cannot."""
    _CHECK(document, "")
    devices, rows = document.get("device", {}), document.get("row", {})
    if unknown := next(iter(rows.keys() - devices.keys()), None):
        raise ValueError(f"it has rows of {unknown!r:.60} and does not say what that is")
    for key, facts in devices.items():
        entry.device(facts, f"device {key}")
    for one in rows.values():
        for slot, held in one.items():
            entry.check(held, f"row {slot}")
    return Baseline(document.get("config", ""), devices, rows)


def write(path: Path, baseline: Baseline) -> None:
    """Write a baseline whole or not at all. Raises FirsthitError where it cannot be written."""
    lines = [
        "# Made by `firsthit bless`; held against by `firsthit gate`. Do not edit: bless with a reason.",
        f"format = {FORMAT}",
        f"config = {_value(baseline.config)}",
    ]
    for key in sorted(baseline.devices):
        facts = dict(baseline.devices[key])
        arithmetic = facts.pop(ARITHMETIC, {})
        lines += ["", f"[device.{_value(key)}]", *_pairs(facts)]
        for of in sorted(arithmetic):
            lines += ["", f"[device.{_value(key)}.{ARITHMETIC}.{_key(of)}]", *_pairs(arithmetic[of])]
    for key in sorted(baseline.rows):
        for slot in sorted(baseline.rows[key]):
            lines += ["", f"[row.{_value(key)}.{_value(slot)}]", *_pairs(baseline.rows[key][slot])]
    write_atomically(path, ("\n".join(lines) + "\n").encode())


def merged(old: Baseline, new: Baseline) -> Baseline:
    """Return the baseline `new` together with those devices of `old`, and their rows, that `new` did not run on.

    A device of the same name is the same one if it has the same key, so that it computes the same, or if the processor
    is the same, so that the driver is another.
    """

    def place(facts: Mapping[str, Any]) -> tuple[Any, Any]:
        """Return what tells one device of one machine from others."""
        return facts.get("name"), facts.get("processor")

    replaced = {place(facts) for facts in new.devices.values()}
    kept = {key: facts for key, facts in old.devices.items() if key not in new.devices and place(facts) not in replaced}
    rows = {key: old.rows[key] for key in kept if key in old.rows}
    return Baseline(new.config, kept | new.devices, rows | new.rows)


def _pairs(table: Mapping[str, Any]) -> list[str]:
    return [f"{_key(name)} = {_value(table[name])}" for name in sorted(table)]


def _key(name: str) -> str:
    """Write a key, in quotes if TOML needs them."""
    return name if BARE.fullmatch(name) else _value(name)


def _value(value: Any) -> str:
    """Write a value as TOML, floats with every digit."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        text = repr(value)
        return re.sub(r"^(-?\d+)e", r"\1.0e", text)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(name)} = {_value(item)}" for name, item in sorted(value.items())) + " }"
    return json.dumps(str(value), ensure_ascii=False).replace("\x7f", "\\u007f")
