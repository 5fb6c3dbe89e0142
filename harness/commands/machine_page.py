"""Print docs/machine.md, which lists every field of what commands answer with --json:

python -m harness.commands.machine_page > docs/machine.md
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from harness import schemas
from harness.commands.answers.table import ANSWERS, Every

_HEAD = """# Output for scripts

Commands that have `--json` print one JSON object on standard output:

    $ firsthit plan quick --json | jq -r '.parts[].cells[] | select(.state == "to run") | .slot'
    $ firsthit gate mine.toml --json | jq '.rows[] | select(.verdict == "regressed") | {slot, reason}'
    $ firsthit list methods --json | jq '.methods[] | {name, knobs: [.knobs[].name]}'

The rules are the same for every command:

- Standard output holds this one object and nothing else, whatever happens, unless it cannot be written at all.
  Progress, remarks, warnings and annotations go to standard error.
- A command that could not do its work (usage, config, something that failed, Ctrl-C) says why on standard error as
  ever, and as `error` in the object, which then has no content. Where there is content, `error` is null; the exit code
  may still be 1 or 3 for what was found. Exit codes are those of `firsthit --help`.
- Numbers are written in full: reading one gives the same float64. null says that there is no such value. A number that
  is infinite or not a number is a text, `"Infinity"`, `"-Infinity"` or `"NaN"`, which `float()` of Python and
  `Number()` of JavaScript read.
- Names and meanings of the fields below are stable. New ones may come; where one is taken away or changes its meaning,
  `format` rises.
- Everything outside ASCII is escaped, and so is the second sign of `##`: no line is a command of a CI server, whatever
  a config, a plugin or a driver says. A JSON reader gives the texts as they are.

`firsthit schema --of COMMAND` prints the same as a JSON schema (draft 2020-12).

In the tables, `[]` stands for every item of a list, and `*` for every name of an object whose keys are names. Lengths
are in scene units, the surface's own coordinates, unless a line says otherwise.

This page is printed from `harness/commands/answers/` by `python -m harness.commands.machine_page > docs/machine.md`.
"""
_TYPES = {
    "string": "text",
    "number": "number",
    "integer": "whole number",
    "boolean": "true or false",
    "null": "null",
    "array": "list",
    "object": "object",
}


def page() -> str:
    """Return the page, in Markdown."""
    parts = [_HEAD, "## Every object", "", *_table(schemas.of_output(Every))]
    for command, kind in ANSWERS.items():
        made = schemas.of_output(kind)
        parts += ["", f"## `firsthit {command} --json`", "", made["description"], "", *_table(made)]
    return "\n".join([*parts, ""])


def _table(made: Mapping[str, Any]) -> list[str]:
    """Write a table of all fields of a schema, each followed by those within it."""
    lines = (f"| `{place}` | {kind} | {_cell(meaning)} |" for place, kind, meaning in _fields(made, made, ""))
    return ["| field | type | meaning |", "| --- | --- | --- |", *lines]


def _fields(top: Mapping[str, Any], made: Mapping[str, Any], path: str) -> Iterator[tuple[str, str, str]]:
    """Yield place, type and meaning of the fields of an object's schema, depth first."""
    for name, field in made["properties"].items():
        yield f"{path}{name}", _type(field), field["description"]
        yield from _within(top, field, f"{path}{name}")


def _within(top: Mapping[str, Any], field: Mapping[str, Any], path: str) -> Iterator[tuple[str, str, str]]:
    """Yield the fields below one field: of the object that it is, of its items, or of what its names stand for."""
    if "$ref" in field:
        yield from _fields(top, top["$defs"][field["$ref"].rpartition("/")[2]], f"{path}.")
    for one in field.get("anyOf", ()):
        yield from _within(top, one, path)
    if "items" in field:
        yield from _within(top, field["items"], f"{path}[]")
    if isinstance(field.get("additionalProperties"), Mapping):
        yield from _within(top, field["additionalProperties"], f"{path}.*")


def _type(field: Mapping[str, Any]) -> str:
    """Say in words of which type a field is."""
    if "anyOf" in field:
        return " or ".join(dict.fromkeys(_type(one) for one in field["anyOf"]))
    if "enum" in field:
        return " or ".join(f"`{word}`" for word in field["enum"])
    if "$ref" in field:
        return "object"
    kind = _TYPES[field["type"]] if "type" in field else "any JSON"
    if kind == "list":
        count = f"{field['minItems']} × " if "minItems" in field else ""
        return f"list of {count}{_type(field['items'])}"
    return f"object of {_type(field['additionalProperties'])}" if kind == "object" else kind


def _cell(text: str) -> str:
    return text.replace("|", "\\|")


if __name__ == "__main__":
    print(page(), end="")
