"""Hold a config file: its text, its TOML, and the line on which a value stands. Gather the mistakes in it."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, TypeVar

from harness.contract import FirsthitError

Where = tuple[str | int, ...]  # keys and places that lead to a value: ("view", 1, "fov")
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
        return FirsthitError(f"{self.path}:{self._line(where)}: {message}", exit_code)

    def _line(self, where: Where) -> int:
        """Find the line that sets the value at `where`; if nothing does, the line of its nearest ancestor, or 1.

        tomllib keeps no positions, so the shortest beginning of the file that sets the value is looked for.
        """
        for depth in range(len(where), 0, -1):
            for count, table in self._beginnings:
                if _has(table, where[:depth]):
                    return count
        return 1

    @cached_property
    def _beginnings(self) -> list[tuple[int, dict[str, Any]]]:
        """Return each number of lines that are TOML by themselves, and what they set."""
        lines, found = self.text.splitlines(), list[tuple[int, dict[str, Any]]]()
        for count in range(1, len(lines) + 1):
            try:
                found.append((count, tomllib.loads("\n".join(lines[:count]))))
            except ValueError:
                continue
        return found


def read(path: Path) -> ConfigFile:
    """Read a file. Raises FirsthitError where it cannot be read or is not TOML."""
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "it is not UTF-8 text"
        raise FirsthitError(f"cannot read {path}: {reason}; see `firsthit list configs`") from None
    try:
        return ConfigFile(path, text, tomllib.loads(text))
    except ValueError as error:  # a TOMLDecodeError, or a number with more digits than Python reads
        raise FirsthitError(f"{path}: not valid TOML: {error}") from None


def _has(table: Any, where: Where) -> bool:
    try:
        for part in where:
            table = table[part]
    except (KeyError, IndexError, TypeError):
        return False
    return True
