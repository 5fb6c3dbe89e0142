"""Read a cell's answers ray by ray, as a run stores them on the grid of its accuracy check."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from harness.contract import FirsthitError
from harness.results import pictures_file
from harness.results.sealed import problem
from reports.reading.run import Unreadable
from reports.reading.tuples import tuples


@dataclass(frozen=True, eq=False)
class Arrays:
    """Hold one cell's answers; every array is [h, w] with row 0 at the top, unless it says otherwise."""

    truth: NDArray[np.uint8]  # TruthStatus
    error: NDArray[np.float32]  # |t − t*| in scene units; NaN where not both hit
    wrong: NDArray[np.uint8]  # 0 right, else the code of a style.Kind
    grazing: NDArray[np.bool_]
    shade: NDArray[np.float32]  # cosine towards the camera; NaN on background
    condition: NDArray[np.float32] | None = None  # of the first root; NaN without one; None in older runs
    evaluations: NDArray[np.int32] | None = None  # of f, spent on the ray; None in older runs
    status: NDArray[np.uint8] | None = None  # RayStatus, what can be no answer among it
    level: NDArray[np.uint8] | None = None  # of the quadtree, at which the pixel's box was decided; of beams only
    stage: NDArray[np.uint8] | None = None  # of the frame, which answered the pixel; of tiles only
    drowned: NDArray[np.bool_] | None = None  # None in older runs
    samples: NDArray[np.float32] | None = None  # shade of each pixel's samples, [s h, s w]; None where there is one

    @property
    def apart(self) -> NDArray[np.bool_]:
        """Return bool[h, w]: the rays whose wrong answers are counted apart."""
        return self.grazing if self.drowned is None else self.grazing | self.drowned

    def cropped(self, down: slice, across: slice) -> Arrays:
        """Return these rows and columns of every array; slices have both ends."""
        kept = {
            one.name: array[down, across]
            for one in fields(self)
            if one.name != "samples" and (array := getattr(self, one.name)) is not None
        }
        if self.samples is None:
            return replace(self, **kept)
        times = len(self.samples) // len(self.truth)
        finer = (slice(times * s.start, times * s.stop) for s in (down, across))
        return replace(self, **kept, samples=self.samples[tuple(finer)])


def read(path: Path) -> Arrays:
    """Read the arrays of one cell. Raises ValueError or OSError where the file is damaged or not of this kind."""
    return Arrays(**pictures_file.read(path))


@dataclass(frozen=True)
class Shelf:
    """Read the arrays of one run or several, and note the files that could not be used."""

    folders: Mapping[str, Path]  # by the name of the run
    damaged: dict[str, Unreadable] = field(default_factory=dict)  # by file

    def together(self, rows: pd.DataFrame) -> list[tuple[Any, Arrays]]:
        """Return those rows of the frame whose arrays can be read, with these, as `get` returns them.

        Raises FirsthitError, with exit code 3, where this machine's memory does not hold them together.
        """
        stored = rows[rows["arrays"].notna()]
        if reason := pictures_file.refusal([int(rays) for rays in stored["accuracy_rays"].dropna()]):
            raise FirsthitError(reason, exit_code=3)
        return [(row, arrays) for row in tuples(rows) if (arrays := self.get(row)) is not None]

    def get(self, row: Any) -> Arrays | None:
        """Return the arrays of a row of the frame.

        None where its file is damaged or missing, which `damaged` then notes.
        """
        file = f"arrays/{row.key}.npz"
        try:
            return read(self.folders[row.run] / file)
        except (OSError, ValueError) as error:
            self.damaged[file] = Unreadable(file, f"{problem(error)} ({row.slot})")
            return None
