"""Put the parts of a stage's program in order, of whatever method casts tiles."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from harness.contract import Box, Language, Method, Precision, Program, Section, Surface, Variant
from harness.kernels.sections import (
    TileStage,
    cast_sections,
    early_libraries,
    files,
    kept_loops,
    method_sections,
    ray_sections,
    stage_sections,
)


def lists(language: Language) -> tuple[str, str]:
    """Return the files on a frame's buffers and on the lists in them."""
    return f"tiles/work.{language}", "tiles/lists.glsl"


@dataclass(frozen=True)
class StageText:
    """State what a stage's program is made for.

    `name` is the stage's. `folder` holds the method's kernel.glsl and, where a stage has a file of its own, that file,
    named as the stage. `rest` is the folder of the kernel.glsl that casts the pixels that are left in stage "rest"; it
    has the same method's knobs and tables.
    """

    method: Method
    folder: Path
    variant: Variant
    surface: Surface
    precision: Precision
    language: Language
    name: TileStage
    rest: Path

    def program(self, needs: Sequence[str], shape: Section, own: Sequence[Section]) -> Program:
        """Return the program, whose entry is named as the stage.

        `needs` are the functions of the surface that it calls, and `shape` has the constants that it shares with the
        host. `own` stands before the stage's files of the method; it has what `lists` names, except for the stage
        "rest", whose ray casting kernel comes before it.
        """
        stated = self.variant, self.surface, self.precision, self.language
        sections = ray_sections(self.surface, needs, self.precision, self.language, early_libraries(self.method))
        if self.language == "glsl":
            sections.insert(1, kept_loops())
        sections += [shape, *files("rays/camera.glsl")]
        if self.name == "rest":
            sections += [*method_sections(self.method, self.rest, *stated), *cast_sections("nearest")]
            sections += [*own, *files(*lists(self.language))]
            sections += stage_sections(self.folder, "rest") or files("tiles/rest_plain.glsl")
            sections += files("tiles/rest.glsl")
        else:
            domain = "box" if isinstance(self.surface.domain, Box) else "sphere"
            sections += [*own, *files(f"tiles/domain_{domain}.glsl", "tiles/frame.glsl")]
            sections += method_sections(self.method, self.folder, *stated, stage=self.name)
        sections += files(f"tiles/entry_{self.name}.{self.language}")
        return Program(self.language, self.precision, self.name, tuple(sections))
