"""Keep once what the cells of a plan have in common: the programs of a surface's views, and these programs' texts.

A plan of 20,000 cells may have a few thousand programs. Made and kept for each cell, they take a gigabyte.
"""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Callable, Hashable
from typing import Any, TypeVar

from harness.contract import Program, Section

Made = TypeVar("Made")


class Shared:
    """Hold what was made for the cells of one plan.

    It is given up once the plan is made, since a method's files may change until the next.
    """

    def __init__(self) -> None:
        self._made: dict[Hashable, Any] = {}
        self._sections: dict[Section, Section] = {}

    def once(self, what: Hashable, make: Callable[[], Made]) -> Made:
        """Return what `make` made when it was first asked for under the name `what`. Raises what `make` raises."""
        if what not in self._made:
            self._made[what] = make()
        made: Made = self._made[what]
        return made

    def program(self, program: Program) -> Program:
        """Return the program that is equal to `program` and was seen first; it shares equal sections with others."""
        alike = self._of_sections(program)
        return self.once(("program", alike), lambda: alike)

    def facts(self, stated: Any) -> Any:
        """Return the JSON-able value that is equal to `stated` and was seen first; nobody may change it."""
        return self.once(("facts", json.dumps(stated)), lambda: stated)

    def _of_sections(self, program: Program) -> Program:
        sections, vertex = (
            tuple(self._sections.setdefault(section, section) for section in part)
            for part in (program.sections, program.vertex)
        )
        return dataclasses.replace(program, sections=sections, vertex=vertex)
