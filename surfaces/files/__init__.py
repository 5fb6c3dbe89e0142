"""Bring surfaces from other programs' files, and write surfaces as other programs read them.

    imported = surfaces.files.load("cayley.jsurf")      # .surface, .remarks: what was left out, .form
    text = surfaces.files.export(surface, "pov")        # one of FORMS

A module for each format has `read`, which makes a formula in our language from a file's text. `syntax` parses
expressions, each format's by its own Dialect; `expressions` writes them in our language. `writing` and its neighbours
write surfaces for others. Files are text that is read: nothing in them is run, and no other file is opened.
"""

from __future__ import annotations

import re
from codecs import BOM_UTF16_BE, BOM_UTF16_LE
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import Any

from surfaces.files.source import DEFAULT_DOMAIN, FORMS, MAX_BYTES, MAX_FORMULA, PART, Imported, Reading, Source
from surfaces.model import Domain, FirsthitError, Surface
from surfaces.visible import one_line
from surfaces.words import title_problem

__all__ = ["FORMS", "SUFFIXES", "Imported", "export", "is_file", "load"]

SUFFIXES = {  # the module that reads a file, by how its name ends
    ".jsurf": "jsurf",
    ".pic": "surf",
    ".surf": "surf",
    ".pov": "povray",
    ".inc": "povray",
    ".vm": "vm",
    ".json": "isosurface",
    ".js": "isosurface",
    ".mathmod": "isosurface",
    ".toml": "own",
}


def is_file(text: str) -> bool:
    """Return whether a text names a file and not a surface of the catalog: it ends as one does, or is there."""
    from surfaces import get
    from surfaces.files.meshes import SUFFIXES as MESHES

    path = text.partition(PART)[0]
    if Path(path).suffix.lower() in (*SUFFIXES, *MESHES) or "/" in path:
        return True
    if not _is_there(path):
        return False
    try:
        get(path)  # a surface's name means the surface, whatever lies in the folder
    except FirsthitError:
        return True
    return False


def load(
    path: str | Path,
    domain: str | Domain | None = None,
    parameters: dict[str, str | float] | None = None,
    distance: str | None = None,
) -> Imported:
    """Read a surface from a file; `FILE#NAME` or `FILE#2` names one of several.

    `domain`, `parameters` and `distance` replace the file's own. Raises FirsthitError where the file cannot be
    read, holds no surface, or the surface cannot be made.
    """
    name, _, part = (str(path), "", "") if _is_there(path) else str(path).partition(PART)
    source, form = _opened(Path(name), part)
    reader: Any = import_module(f"surfaces.files.{form}")
    reading = _read(source, reader)
    if unknown := [key for key in parameters or {} if key not in reading.parameters]:
        source.fail(f"there is no parameter {unknown[0]!r}; it has {', '.join(reading.parameters) or 'none'}")
    given = {**reading.parameters, **(parameters or {})}
    return Imported(
        _surface(source, replace(reading, distance=distance or reading.distance), domain, given),
        tuple(source.remarks),
        reader.NAME,
    )


def _read(source: Source, reader: Any) -> Reading:
    """Read what a file holds. Raises FirsthitError, which names the file, where that is no surface."""
    try:
        reading: Reading = reader.read(source)
    except FirsthitError as error:
        told = str(error)
        raise FirsthitError(told if told.startswith(str(source.path)) else f"{source.path}: {told}") from None
    if source.part and not source.chosen:
        source.fail(f"it has one surface; leave out {PART}{source.part[:40]}")
    return reading


def _is_there(path: str | Path) -> bool:
    """Return whether there is a file of this name; a text that can be no name is none."""
    try:
        return Path(path).is_file()
    except (OSError, ValueError):
        return False


def _opened(path: Path, part: str) -> tuple[Source, str]:
    """Open a file, and return it with the name of its reader. Raises FirsthitError where it cannot be read."""
    from surfaces.files import meshes

    try:
        if path.exists() and not path.is_file():
            raise FirsthitError(f"cannot read {path}: it is {'a folder' if path.is_dir() else 'no regular file'}")
        with path.open("rb") as file:
            content = file.read(MAX_BYTES + 1)
    except (OSError, ValueError) as error:
        raise FirsthitError(f"cannot read {path}: {getattr(error, 'strerror', None) or error}") from None
    suffix = path.suffix.lower()
    if kind := meshes.kind_of(content, suffix):
        raise FirsthitError(f"{path} is {meshes.refusal(kind)}")
    if len(content) > MAX_BYTES:
        raise FirsthitError(f"{path} has more than {MAX_BYTES} bytes, the most that is read")
    text = _decoded(content)
    if "\0" in text:
        raise FirsthitError(f"{path} is no text; {_known()}")
    if not text.strip():
        raise FirsthitError(f"{path} is empty")
    text = text.replace("\r\n", "\n").replace("\r", "\n")
    form = SUFFIXES.get(suffix) or _guessed(text)
    if form is None:
        raise FirsthitError(f"{path} is no file that is read; {_known()}")
    return Source(path, text, part), form


def _decoded(content: bytes) -> str:
    """Return the text of a file: UTF-16 where its first two bytes say so, else UTF-8, else Latin-1."""
    encodings = ("utf-16",) if content.startswith((BOM_UTF16_LE, BOM_UTF16_BE)) else ()
    for encoding in (*encodings, "utf-8-sig"):
        with suppress(UnicodeDecodeError):
            return content.decode(encoding)
    return content.decode("latin-1")


def _known() -> str:
    """Return what is read, in words."""
    return f"read are {', '.join(SUFFIXES)}, and other text that is written as these are"


def _guessed(text: str) -> str | None:
    """Return the name of the reader of a text, by how it is written; None where it looks like none."""
    body = re.sub(r"^(?:\s|[#!][^\n]*\n|//[^\n]*\n)+", "", text)
    if body.startswith(("{", "[{")):
        return "isosurface"
    if re.search(r"^surface_equation\s*[=:]", text, re.MULTILINE):
        return "jsurf"
    if re.match(r"\S+ (?:var-[xyz]|const \S+)\s*$", body, re.MULTILINE):
        return "vm"
    if re.search(r"\b(?:cubic|quartic|poly|polynomial|quadric|isosurface)\s*\{", text):
        return "povray"
    if re.search(r"^\s*surface[2-9]?\s*=[^;\"]*;", text, re.MULTILINE):
        return "surf"
    return "own" if re.search(r"^formula\s*=", text, re.MULTILINE) else None


def _surface(source: Source, reading: Reading, domain: str | Domain | None, parameters: dict[str, Any]) -> Surface:
    """Make the surface of what was read. Raises FirsthitError, which names the file, where it cannot be made."""
    import surfaces
    from surfaces import formula

    if (length := len(reading.formula)) > MAX_FORMULA:
        source.fail(f"its formula has {length} characters; at most {MAX_FORMULA} are read from a file")
    for what, text in (("name", reading.name), ("title", reading.title), ("source", reading.source)):
        if problem := title_problem(text):
            source.fail(f"its {what}: {problem}", source.line_of(what))
    stem = re.sub(r"[^A-Za-z_0-9-]+", "_", reading.name or source.path.stem).strip("_")[:40] or "surface"

    def made_in(place: str | Domain) -> Surface:
        return surfaces.from_formula(reading.formula, place, stem, parameters, distance=reading.distance or None)

    try:
        formula.parse(reading.formula, {name: str(value) for name, value in parameters.items()})
        place = domain or reading.domain
        made = made_in(place) if place else _found(source, made_in)
    except FirsthitError as error:
        raise FirsthitError(f"{source.path}: {error}", error.exit_code) from None
    title = reading.title or (stem if "\n" in reading.formula else made.title)
    told = reading.source or f"read from {one_line(source.path.name)}"
    return replace(made, title=title, source=told)


def _found(source: Source, made_in: Callable[[str], Surface]) -> Surface:
    """Make a surface whose file says no domain: in a box that holds it, where one is found, else in a sphere."""
    try:
        surface = made_in("auto")
    except FirsthitError:
        surface = made_in(DEFAULT_DOMAIN)
        source.remark(
            f"the file says no domain, and no box that holds the surface was found: {DEFAULT_DOMAIN} is taken"
        )
        return surface
    source.remark("the file says no domain: a box that holds the surface is taken")
    return surface


def export(surface: Surface, form: str) -> str:
    """Return the text of a surface in another program's language, one of FORMS.

    Raises FirsthitError for an unknown form, and where the surface has what the language cannot say, which is named.
    """
    from surfaces.files import writing

    return writing.export(surface, form)
