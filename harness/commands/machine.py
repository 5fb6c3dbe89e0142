"""Print what a command found as one JSON object for scripts: `--json`, described in docs/machine.md.

A command that offers it calls `add_json` for its parser and, where `options.json` is set, returns an Answer in place of
an exit code. `harness.cli` runs it by `run` and writes the object:

    {"format": 1, "firsthit": "0.1.0", "command": "plan", "exit_code": 0, "error": null, …the answer's content}

The rules are the same for every command:

- Standard output holds this one object and nothing else, whatever happens, unless it cannot be written at all. What a
  command prints besides goes to standard error, and so do progress and remarks.
- A command that could not do its work writes its message to standard error as ever, and the object has it as `error`,
  without any content. Where there is content, `error` is null, whatever the exit code says of what was found.
- Numbers are written in full: reading them gives the same float64. null says that there is no such value. A number that
  is infinite or not a number is a text, "Infinity", "-Infinity" or "NaN", which float() of Python and Number() of
  JavaScript read.
- Everything outside ASCII is escaped, so that the object does not depend on the terminal's encoding, and so is the
  second sign of ##, so that no line is a command of a CI server.
"""

from __future__ import annotations

import argparse
import contextlib
import dataclasses
import json
import math
import sys
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from enum import Enum
from numbers import Integral, Real
from pathlib import Path
from typing import Any, TextIO

from harness import __version__

FORMAT = 1  # rises where a field is taken away or changes its meaning; new fields leave it
OWN = ("format", "firsthit", "command", "exit_code", "error")  # fields of every object; no content may be named so


@dataclass(frozen=True)
class Answer:
    """Hold what a command found, and its exit code.

    content: a mapping by field names, or a dataclass; its values are what `plain` takes
    """

    content: object
    exit_code: int = 0


def add_json(parser: argparse.ArgumentParser) -> None:
    """Add the option `--json`."""
    help_ = "print one JSON object on standard output and nothing else there; docs/machine.md lists its fields"
    parser.add_argument("--json", action="store_true", help=help_)


def run(command: Callable[[argparse.Namespace], int | Answer], options: argparse.Namespace) -> int:
    """Run a command with --json, write its answer to standard output, and return its exit code."""
    out = sys.stdout
    with contextlib.redirect_stdout(sys.stderr):
        answer = command(options)
    if not isinstance(answer, Answer):
        raise TypeError(f"`firsthit {options.command}` offers --json, and returned {answer!r} in place of an Answer")
    _write(out, options.command, answer.exit_code, None, plain(answer.content))
    return answer.exit_code


def write_error(command: str | None, exit_code: int, message: str) -> None:
    """Write the object of a command that could not do its work; `command` is None where none could be read."""
    _write(sys.stdout, command, exit_code, message, {})


def _write(out: TextIO, command: str | None, exit_code: int, error: str | None, content: Mapping[str, Any]) -> None:
    """Write one object and a line's end. Raises ValueError where the content has a field of OWN."""
    if taken := [name for name in content if name in OWN]:
        raise ValueError(f"content may not have a field {taken[0]!r}")
    values = (FORMAT, __version__, command, exit_code, error)
    text = json.dumps({**dict(zip(OWN, values, strict=True)), **content}, indent=2, allow_nan=False)
    out.write(text.replace("##", "#\\u0023") + "\n")  # ##[error] would be a command of a CI server


def plain(value: Any) -> Any:
    """Return a value as `json` writes it.

    Takes None, texts, switches, numbers of Python and numpy, enumerations, paths, mappings by texts, dataclasses and
    any iterable; sets are sorted. Raises TypeError for anything else, so that nothing is written as a repr that no
    script can read.
    """
    if isinstance(value, Enum):
        value = value.value
    if getattr(value, "ndim", None) == 0:  # a number or switch of numpy
        value = value.item()
    if value is None or isinstance(value, str | bool):
        return value
    if isinstance(value, Integral):
        return int(value)
    if isinstance(value, Real):
        return _number(float(value))
    if isinstance(value, Path):
        return str(value)
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return {field.name: plain(getattr(value, field.name)) for field in dataclasses.fields(value)}
    if isinstance(value, Mapping):
        if wrong := [key for key in value if not isinstance(key, str)]:
            raise TypeError(f"a key of a JSON object is a text, not {wrong[0]!r}")
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, set | frozenset):
        return sorted(plain(item) for item in value)
    if isinstance(value, Iterable) and not isinstance(value, bytes):
        return [plain(item) for item in value]
    raise TypeError(f"{value!r} has no form in JSON")


def _number(value: float) -> float | str:
    """Return a number, or the text that stands for one that JSON cannot hold."""
    if math.isfinite(value):
        return value
    return "NaN" if math.isnan(value) else "Infinity" if value > 0.0 else "-Infinity"
