"""Read and write our own files, TOML with the keys of a config's [surface.NAME]: formula, domain, parameters, distance.

`name`, `title` and `source` may stand beside them. They stand at the top of the file, or in a table [surface.NAME] as
in a config, of which there may be several.
"""

from __future__ import annotations

import tomllib
from typing import Any

from surfaces.files.source import Reading, Source
from surfaces.model import Surface, domain_text
from surfaces.words import name_problem, suggestion, title_problem

NAME = "a surface of ours"
_TEXTS = ("name", "title", "source", "formula", "domain", "distance")


def read(source: Source) -> Reading:
    """Read a file. Raises FirsthitError where it is no TOML, or has keys that mean nothing."""
    try:
        content = tomllib.loads(source.text)
    except (tomllib.TOMLDecodeError, RecursionError, ValueError) as error:
        source.fail(f"this is no TOML: {str(error)[:120]}")
    name, table = _chosen(source, content)
    for key, value in table.items():
        if key not in (*_TEXTS, "parameters"):
            source.fail(f"unknown key {key[:40]!r}; {suggestion(key[:40], (*_TEXTS, 'parameters'))}")
        if key in _TEXTS and not isinstance(value, str):
            source.fail(f"{key} is a text, not {str(value)[:40]}")
    for key, problem in (("name", name_problem), ("title", title_problem), ("source", title_problem)):
        if key in table and (told := problem(table[key])):
            source.fail(f"{key}: {told}", source.line_of(key))
    if "formula" not in table:
        source.fail("the file has no formula = …")
    given = table.get("parameters", {})
    if not isinstance(given, dict) or not all(isinstance(v, str | int | float) for v in given.values()):
        source.fail("parameters is a table of numbers, as in { a = 0.5 }")
    parameters = {key: value if isinstance(value, str) else repr(value) for key, value in given.items()}
    return Reading(
        formula=table["formula"],
        domain=table.get("domain") or "",
        parameters=parameters,
        name=table.get("name", name),
        title=table.get("title", ""),
        source=table.get("source", ""),
        distance=table.get("distance", ""),
    )


def _chosen(source: Source, content: dict[str, Any]) -> tuple[str, dict[str, Any]]:
    """Return the table of a surface, and its name where it has one."""
    tables = content.get("surface")
    if not isinstance(tables, dict) or "formula" in content:
        return "", content
    with_formula = {name: table for name, table in tables.items() if isinstance(table, dict) and "formula" in table}
    if not with_formula:
        source.fail("no [surface.NAME] of this file has a formula")
    names = list(with_formula)
    name = names[source.choose(names, "surface")]
    return name, with_formula[name]


def text_of(surface: Surface) -> str:
    """Return the text of a file that holds a surface."""
    lines = [f"{key} = {_quoted(value)}" for key, value in (("name", surface.name), ("title", surface.title))]
    lines += [f"source = {_quoted(surface.source)}", f"domain = {_quoted(domain_text(surface.domain))}"]
    if surface.parameters:
        lines.append(
            f"parameters = {{ {', '.join(f'{key} = {_quoted(value)}' for key, value in surface.parameters)} }}"
        )
    if surface.distance is not None:
        lines.append(f"distance = {_quoted(surface.distance)}")
    lines.append(f"formula = {_quoted(surface.formula)}")
    return "\n".join(lines) + "\n"


def _quoted(text: str) -> str:
    """Return a text as a TOML string; with line ends, as one of several lines."""
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    escaped = "".join(c if c == "\n" or c.isprintable() else f"\\U{ord(c):08x}" for c in escaped)
    return f'"""\n{escaped}"""' if "\n" in text else f'"{escaped}"'
