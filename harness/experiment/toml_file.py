"""Hold a config file: its text, its TOML, and the line on which a value stands. Gather the mistakes in it."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, TypeVar

from harness.contract import FirsthitError
from harness.experiment.lines import Where as Where
from harness.experiment.lines import excess, lines_of

LONGEST = 2_000_000  # bytes of a config
LONGEST_MESSAGE = 2_000  # letters of one line
Part = TypeVar("Part")
Read = TypeVar("Read")


class Mistakes(FirsthitError):
    """Report several mistakes, a line each.

    The exit code is 2 where one of them is the user's: the least of all.
    """

    def __init__(self, each: list[FirsthitError]) -> None:
        super().__init__("\n".join(map(str, each)), min(error.exit_code for error in each))
        self.each = each


def gathered(parts: Iterable[Part], read: Callable[[Part], Read]) -> list[Read]:
    """Read each part, whether the others can be read or not. Raises FirsthitError, which tells all mistakes."""
    values, mistakes = list[Read](), list[FirsthitError]()
    for part in parts:
        try:
            values.append(read(part))
        except Mistakes as error:
            mistakes += error.each
        except FirsthitError as error:
            mistakes.append(error)
    if mistakes:
        raise mistakes[0] if len(mistakes) == 1 else Mistakes(mistakes)
    return values


@dataclass(frozen=True)
class ConfigFile:
    """Hold a config as it was read. Errors about it name its path and a line.

    table: what tomllib reads from `text`
    """

    path: Path
    text: str
    table: dict[str, Any]

    def error(self, where: Where, message: str, exit_code: int = 2) -> FirsthitError:
        """Make the error that says `message` of the value at `where`, with file and line."""
        return _mistake(self.path, self._line(where), message, exit_code)

    def _line(self, where: Where) -> int:
        """Find the line where the value at `where` begins; if there is none, that of its nearest ancestor, or 1."""
        places = (where[:depth] for depth in range(len(where), 0, -1))
        return next((self._lines[place] for place in places if place in self._lines), 1)

    @cached_property
    def _lines(self) -> dict[Where, int]:
        return lines_of(self.text)


def read(path: Path) -> ConfigFile:
    """Read a file. Raises FirsthitError where it cannot be read, is not TOML, or is past what a config can be."""
    text = _text(path)
    if beyond := excess(text):
        raise _mistake(path, *beyond)
    try:
        return ConfigFile(path, text, tomllib.loads(text))
    except ValueError as error:  # a TOMLDecodeError
        told = re.fullmatch(r"(.*) \(at (?:line (\d+), column (\d+)|end of document)\)", str(error), re.DOTALL)
        line = int(told[2]) if told and told[2] else text.rstrip().count("\n") + 1
        column = f", column {told[3]}" if told and told[3] else ""
        raise _mistake(path, line, f"not valid TOML{column}: {told[1] if told else error}") from None


def _text(path: Path) -> str:
    """Return the text of a file. Raises FirsthitError for what is no file of a config's size, or no UTF-8."""
    try:
        if not (path.is_file() or path.is_dir()) and path.exists():
            raise FirsthitError(f"cannot read {one_line(path)}: it is no regular file")  # a pipe may never end
        with path.open("rb") as file:
            content = file.read(LONGEST + 1)
        if len(content) > LONGEST:
            raise FirsthitError(f"cannot read {one_line(path)}: a config has {LONGEST:,} bytes at most")
        return content.decode("utf-8").replace("\r\n", "\n")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        raise _mistake(path, line, "it is not UTF-8 text") from None
    except (OSError, ValueError) as error:  # ValueError: a path with a zero
        reason = (isinstance(error, OSError) and error.strerror) or "there can be no such file"
        raise FirsthitError(f"cannot read {one_line(path)}: {reason}; see `firsthit list configs`") from None


def _mistake(path: Path, line: int, message: str, exit_code: int = 2) -> FirsthitError:
    """Make the error that says `message` of a line, in one line; what shows a place in a formula follows, indented."""
    first, *shown = message.split("\n    ")
    lines = [f"{one_line(path)}:{line}: {one_line(first)}", *(f"    {one_line(more)}" for more in shown)]
    return FirsthitError("\n".join(lines), exit_code)


def one_line(value: object) -> str:
    """Return the text of a value in one line that shows all its letters, without its middle where it is long."""
    text = str(value)
    if len(text) > LONGEST_MESSAGE:
        text = f"{text[: LONGEST_MESSAGE - 300]} … {text[-300:]}"
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)
