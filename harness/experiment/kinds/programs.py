"""Hold a cell's programs with all that belongs to them, so that another revision's can be run in their place."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import zip_longest
from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness.contract import Program, digest
from harness.devices.raster import Batch

_COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
_SPACE = re.compile(r" ?(\W) ?")  # beside a sign
_STARTED = {  # what the host binds: a kernel's parameters in OpenCL C, and declarations in GLSL
    "cl": re.compile(r"\b(?:__)?kernel\s+void\s+\w+\s*\([^)]*\)"),
    "glsl": re.compile(r"^[ \t]*(?:layout\s*\(|uniform\b|in\b)[^;{]*(?:\{[^}]*\}[^;]*)?;", re.MULTILINE),
}


@dataclass(frozen=True, eq=False)
class Programs:
    """Hold what a cell is cast by.

    checks, timed, others: as in harness.experiment.kinds.model.Casting
    parameters: the knobs' values, since some of them say how the host launches a program
    batches: in stage raster the draw calls with the programs that report what they answer, else nothing
    second: the same kernel as an OpenCL program of listed rays, for a second build of it; None if there is none
    tables: what the host computes of the surface and hands to the programs in buffers, by name
    """

    checks: tuple[Program, ...]
    timed: Program | None
    others: tuple[Program, ...]
    parameters: Mapping[str, float | int]
    batches: tuple[Batch, ...] = ()
    second: Program | None = None
    tables: Mapping[str, NDArray[np.float64]] = field(default_factory=dict)

    @property
    def hash(self) -> str:
        """Return a hash of all that the answers of a check depend on, so that equal ones need not run twice."""
        programs = [[program.hash for program in part] for part in (self.checks, self.others)]
        handed = {name: _bytes_hash(table) for name, table in self.tables.items()}
        return digest(programs, dict(self.parameters), [_hash(batch) for batch in self.batches], handed)

    @property
    def frame_hash(self) -> str | None:
        """Return a hash of all that the time of a frame depends on; None if nothing is timed."""
        if self.timed is None:
            return None
        handed = {name: _bytes_hash(table) for name, table in self.tables.items()}
        return digest([program.hash for program in (self.timed, *self.others)], handed)

    def launched_as(self, other: Programs) -> bool:
        """Tell whether the host can launch these in the place of `other`.

        That is so if they are as many, of the same languages and precisions, and are handed the same buffers and
        numbers.
        """
        pairs = [*zip_longest(self.checks, other.checks), *zip_longest(self.others, other.others)]
        pairs += [(self.timed, other.timed)] if self.timed and other.timed else []
        return all(mine and theirs and _launch(mine) == _launch(theirs) for mine, theirs in pairs)


def _launch(program: Program) -> tuple[str, str, str, list[str]]:
    """Return what the host must know of a program: language, precision, entry, and what is handed to it."""
    text = _COMMENT.sub("", "\n".join([program.text, *(section.text for section in program.vertex)]))
    told = (_SPACE.sub(r"\1", " ".join(found.split())) for found in _STARTED[program.language].findall(text))
    return program.language, program.precision, program.entry, sorted(told)


def _hash(batch: Batch) -> list[object]:
    """Return what decides a draw call's picture, JSON-able."""
    arrays = (batch.instances, batch.triangles, batch.vertices)
    hashes = [None if array is None else _bytes_hash(array) for array in arrays]
    return [batch.program.hash, *hashes, batch.closed]


def _bytes_hash(array: NDArray[Any]) -> str:
    return hashlib.sha256(array.tobytes()).hexdigest()
