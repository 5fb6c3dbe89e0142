"""Hold a config file: its text, its TOML, and the line on which a value stands."""

from __future__ import annotations

import contextlib
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from harness.contract import FirsthitError

Where = tuple[str | int, ...]  # keys and places that lead to a value: ("view", 1, "fov")


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
        lines = self.text.splitlines()
        for depth in range(len(where), 0, -1):
            for count in range(1, len(lines) + 1):
                with contextlib.suppress(ValueError):
                    if _has(tomllib.loads("\n".join(lines[:count])), where[:depth]):
                        return count
        return 1


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
