"""Make JSON schemas (draft 2020-12) of dataclasses: of what a config may hold, and of what a command answers.

Types, limits and defaults come from the fields, descriptions from the dataclass's docstring: its text, and the lines
`field: meaning` or `field, other: meaning` in it, whose further lines are indented.
"""

from __future__ import annotations

import dataclasses
import inspect
import re
import types
import typing
from collections.abc import Mapping, Sequence
from enum import StrEnum
from typing import Any

from harness.limits import Distinct, Limit, hints_of, is_required

DRAFT = "https://json-schema.org/draft/2020-12/schema"
PLAIN = {float: "number", int: "integer", str: "string", bool: "boolean"}
Schema = dict[str, Any]


def of_input(kind: type[Any]) -> Schema:
    """Return the schema of what harness.experiment.reading takes for a dataclass.

    Fields with a default may be left out, others not; no other key is taken. A list is not empty, and its only item may
    stand without brackets. What a schema cannot say of a limit is left out.
    """
    return _Maker(is_input=True).whole(kind)


def of_output(kind: type[Any]) -> Schema:
    """Return the schema of what harness.commands.machine writes of a dataclass: each of its fields, always."""
    return _Maker(is_input=False).whole(kind)


def descriptions(kind: type[Any]) -> tuple[str, dict[str, str]]:
    """Return what a dataclass's docstring says: its text without fields, and the meaning of each field that it names.

    The fields of a dataclass that it inherits from are described there.
    """
    inherited = [descriptions(base)[1] for base in kind.__bases__ if dataclasses.is_dataclass(base)]
    about, meanings = _described(kind)
    return about, {name: text for own in (*inherited, meanings) for name, text in own.items()}


def _described(kind: type[Any]) -> tuple[str, dict[str, str]]:
    """Return what a dataclass's own docstring says, as `descriptions` does."""
    fields = {field.name for field in dataclasses.fields(kind)}
    about, meanings, names = list[str](), dict[str, str](), list[str]()
    for line in inspect.cleandoc(kind.__doc__ or "").splitlines():
        told = re.match(r"(\w+(?:, \w+)*): (.+)", line)
        if told and fields >= {*told[1].split(", ")}:
            names = told[1].split(", ")
            meanings |= dict.fromkeys(names, told[2])
        elif names and line.startswith(" "):
            meanings |= {name: f"{meanings[name]} {line.strip()}" for name in names}
        else:
            names = []
            about.append(line or "\n")
    paragraphs = re.sub(" (?=- )", "\n", " ".join(about)).split("\n")
    whole = "\n".join(text.strip() for text in paragraphs if text.strip() and not text.strip().startswith("Raises "))
    return whole, meanings


class _Maker:
    """Make schemas of kinds, and keep those of dataclasses by their names, to which the others refer."""

    def __init__(self, is_input: bool) -> None:
        self._is_input = is_input
        self._tables: dict[str, Schema] = {}

    def whole(self, kind: type[Any]) -> Schema:
        top = self._table(kind)
        return {"$schema": DRAFT, **top, "$defs": dict(sorted(self._tables.items()))}

    def _of(self, kind: Any) -> Schema:
        origin, parts = typing.get_origin(kind), typing.get_args(kind)
        if origin is typing.Annotated:
            return self._limited(parts[0], parts[1:])
        if origin in (types.UnionType, typing.Union):
            return self._union(parts)
        if origin is typing.Literal:
            return {"enum": list(parts)}
        if origin in (list, Sequence):
            return self._list(self._of(parts[0]), {})
        if origin is tuple:
            assert len(set(parts)) == 1, "editors read older drafts too, which write items of several kinds otherwise"
            return {"type": "array", "items": self._of(parts[0]), "minItems": len(parts), "maxItems": len(parts)}
        if origin in (dict, Mapping):
            return {"type": "object", "additionalProperties": self._of(parts[1])}
        if isinstance(kind, type) and issubclass(kind, StrEnum):
            return {"enum": [str(word) for word in kind]}
        if isinstance(kind, type) and dataclasses.is_dataclass(kind):
            if kind.__name__ not in self._tables:
                self._tables[kind.__name__] = {}  # a table that holds itself ends here
                self._tables[kind.__name__] = self._table(kind)
            return {"$ref": f"#/$defs/{kind.__name__}"}
        return {} if kind is Any else {"type": PLAIN[kind]}

    def _union(self, parts: tuple[Any, ...]) -> Schema:
        """Return the schema of one of several kinds. TOML has no null: None says there that a key is left out."""
        kinds = [self._of(part) for part in parts if part is not type(None)]
        if type(None) in parts and not self._is_input:
            kinds.append({"type": "null"})
        return kinds[0] if len(kinds) == 1 else {"anyOf": kinds}

    def _limited(self, kind: Any, limits: tuple[Limit, ...]) -> Schema:
        """Return the schema of a kind within limits, each of which is for a value, a list's items or a table's keys."""
        origin = typing.get_origin(kind)
        stated: Schema = {}
        for limit in limits:
            stated |= limit.keywords()
        if origin is list:
            unique = {"uniqueItems": True} if any(isinstance(limit, Distinct) for limit in limits) else {}
            return self._list(self._of(typing.get_args(kind)[0]) | stated, unique)
        made = self._of(kind)
        return made | ({"propertyNames": stated} if origin is dict and stated else stated)

    def _list(self, item: Schema, more: Schema) -> Schema:
        if not self._is_input:
            return {"type": "array", "items": item}
        return {"anyOf": [{"type": "array", "items": item, "minItems": 1, **more}, item]}

    def _table(self, kind: type[Any]) -> Schema:
        """Return the schema of a dataclass."""
        about, meanings = descriptions(kind)
        hints = hints_of(kind)
        properties, required = dict[str, Schema](), list[str]()
        for field in dataclasses.fields(kind):
            made = self._of(hints[field.name])
            if field.name in meanings:
                made = {"description": meanings[field.name], **made}
            if self._is_input and (default := _default(field)):
                made["default"] = default[0]
            properties[field.name] = made
            if not self._is_input or is_required(field):
                required.append(field.name)
        table: Schema = {"description": about, "type": "object", "properties": properties}
        if required:
            table["required"] = required
        return table | ({"additionalProperties": False} if self._is_input else {})


def _default(field: dataclasses.Field[Any]) -> list[Any]:
    """Return a list of a field's default, empty where it says no more than that the key is left out."""
    if is_required(field):
        return []
    value = field.default if field.default_factory is dataclasses.MISSING else field.default_factory()
    if dataclasses.is_dataclass(value) or value in (None, "", [], {}):
        return []
    return [list(value) if isinstance(value, tuple) else value]
