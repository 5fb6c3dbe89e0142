"""Read a config's TOML into dataclasses, hold each field to its limits, and answer every mistake with its line."""

from __future__ import annotations

import dataclasses
import itertools
import types
import typing
from pathlib import Path
from typing import Any

from harness.experiment import toml_file
from harness.experiment.config import GONE, Config, Experiment
from harness.experiment.resolving import resolve
from harness.experiment.toml_file import ConfigFile, Where, gathered
from harness.limits import Limit, hints_of, is_finite, is_required, shown
from harness.plugins import Catalog
from surfaces.words import suggestion

WORDS = {float: "a number", int: "a whole number", str: "a text in quotes", bool: "true or false"}


def load(path: Path, catalog: Catalog) -> Experiment:
    """Read a config and resolve its names. Raises FirsthitError with file and line for each thing wrong in it.

    Names are resolved once all values can be read.
    """
    file = toml_file.read(path)
    return resolve(config_of(file), file, catalog)


def load_all(path: Path, catalog: Catalog) -> tuple[Experiment, list[Experiment]]:
    """Read a config as `load` does, and those that it includes; one that includes none is its only part.

    Raises FirsthitError, with file and line, where a config that it includes includes others.
    """
    whole = load(path, catalog)
    parts = [load(included, catalog) for included in whole.included] or [whole]
    for i, part in enumerate(parts):
        if part is not whole and part.included:
            message = f"include: {part.path} includes configs itself; name them here instead"
            raise ConfigFile(path, whole.text, {}).error(("include", i), message)
    return whole, parts


def load_one(path: Path, catalog: Catalog) -> Experiment:
    """Read a config as `load` does. Raises FirsthitError, with file and line, for one that only includes others too."""
    one = load(path, catalog)
    if one.included:
        message = f"include: this command takes one config; name one of {', '.join(map(str, one.included))}"
        raise ConfigFile(path, one.text, {}).error(("include",), message)
    return one


def config_of(file: ConfigFile) -> Config:
    """Return what a config file states, without resolving names. Raises FirsthitError as `load`."""
    config: Config = _table(Config, file.table, (), file)
    return config


def _value(kind: Any, value: Any, where: Where, source: ConfigFile) -> Any:
    """Return `value` as `kind` states it.

    A kind is a dataclass, str, float, int, bool, a Literal of words, a list, tuple or dict of kinds, a union of one
    with None or with str, or any of these Annotated with limits. Raises FirsthitError for a value of another kind or
    past its limits.
    """
    origin = typing.get_origin(kind)
    if origin is typing.Annotated:
        return _limited(typing.get_args(kind), value, where, source)
    if origin in (types.UnionType, typing.Union):
        kinds = [kind for kind in typing.get_args(kind) if kind is not type(None)]
        texts = [kind for kind in kinds if _is_text(kind)] if isinstance(value, str) else []
        return _value((texts or kinds)[0], value, where, source)
    if origin is typing.Literal:
        return _word(typing.get_args(kind), value, where, source)
    if origin is list:
        return _list(typing.get_args(kind)[0], value, where, source)
    if origin is tuple:
        return _tuple(typing.get_args(kind), value, where, source)
    if origin is dict:
        return _names(typing.get_args(kind)[1], value, where, source)
    if isinstance(kind, type) and dataclasses.is_dataclass(kind):
        return _table(kind, value, where, source)
    return _scalar(kind, value, where, source)


def _limited(stated: tuple[Any, ...], value: Any, where: Where, source: ConfigFile) -> Any:
    """Read the value of an Annotated kind.

    Raises FirsthitError for a value outside its limits. The message names a single value by its whole path, and a
    collection by its own name.
    """
    kind, limits = stated[0], typing.cast(tuple[Limit, ...], stated[1:])
    read = _value(kind, value, where, source)
    name = _path(where) if isinstance(read, int | float | str) else str(where[-1])
    for limit in limits:
        if problem := limit.broken(read):
            keys = (key for key in read if limit.broken([key])) if isinstance(read, dict) else iter(())
            raise source.error((*where, *itertools.islice(keys, 1)), f"{name}: {problem}")
    return read


def _is_text(kind: Any) -> bool:
    """Tell whether a kind is a text, within limits or not."""
    return (typing.get_args(kind)[0] if typing.get_origin(kind) is typing.Annotated else kind) is str


def _word(known: tuple[str, ...], value: Any, where: Where, source: ConfigFile) -> str:
    """Read one of the `known` words.

    Raises FirsthitError for an unknown one. If it is an item of a list, the message names the list.
    """
    word: str = _scalar(str, value, where, source)
    if word not in known:
        place = where[:-1] if isinstance(where[-1], int) else where
        raise source.error(place, f"{place[-1]}: unknown {shown(word)}; {suggestion(word, known)}")
    return word


def _list(kind: Any, value: Any, where: Where, source: ConfigFile) -> list[Any]:
    """Read a list. One item may stand without brackets. Raises FirsthitError for an empty list."""
    items = value if isinstance(value, list) else [value]
    if not items:
        raise source.error(where, f"{_path(where)} is empty; give at least one")
    return gathered(enumerate(items), lambda one: _value(kind, one[1], (*where, one[0]), source))


def _tuple(kinds: tuple[Any, ...], value: Any, where: Where, source: ConfigFile) -> tuple[Any, ...]:
    """Read a fixed number of values. Raises FirsthitError for any other number."""
    if not isinstance(value, list) or len(value) != len(kinds):
        raise source.error(where, f"{_path(where)} needs {len(kinds)} numbers, not {shown(value)}")
    parts = enumerate(zip(kinds, value, strict=True))
    return tuple(gathered(parts, lambda one: _value(*one[1], (*where, one[0]), source)))


def _names(kind: Any, value: Any, where: Where, source: ConfigFile) -> dict[str, Any]:
    """Read a table whose keys are names that the writer chose. Raises FirsthitError for anything but a table."""
    if not isinstance(value, dict):
        raise source.error(where, f"{_path(where)} is a table of names, not {shown(value)}")
    return dict(gathered(value.items(), lambda one: (one[0], _value(kind, one[1], (*where, one[0]), source))))


def _table(kind: type[Any], value: Any, where: Where, source: ConfigFile) -> Any:
    """Read a table as the dataclass `kind`, whose fields are its keys.

    Raises FirsthitError for anything but a table, for unknown and missing keys, and for values that cannot be read.
    """
    if not isinstance(value, dict):
        raise source.error(where, f"{_path(where)} is a table, not {shown(value)}")
    hints = hints_of(kind)
    place = _path(where) or "the top level"

    def of(key: str) -> tuple[str, Any]:
        there: Where = (*where, key)
        if gone := GONE.get(there):
            raise source.error(there, f"{_path(there)} {gone}")
        if key not in hints:
            raise source.error(there, f"unknown key {shown(key)} in {place}; {suggestion(key, hints)}")
        if key not in value:
            raise source.error(where, f"{place} lacks {key!r}")
        return key, _value(hints[key], value[key], there, source)

    required = [spec.name for spec in dataclasses.fields(kind) if is_required(spec)]
    return kind(**dict(gathered(dict.fromkeys([*required, *value]), of)))


def _scalar(kind: type, value: Any, where: Where, source: ConfigFile) -> Any:
    """Read a text, a switch or a finite number. Parameters keep whole numbers as they are written.

    Raises FirsthitError for a value of another kind, and for a number that is not finite.
    """
    whole = isinstance(value, int) and not isinstance(value, bool)
    number = isinstance(value, float) or (kind is float and whole)
    if number and not is_finite(value):
        raise source.error(where, f"{_path(where)} is a finite number, not {shown(value)}")
    if kind is float and whole:
        return value if "parameters" in where else float(value)
    if not isinstance(value, kind) or isinstance(value, bool) != (kind is bool):
        raise source.error(where, f"{_path(where)} is {WORDS[kind]}, not {shown(value)}")
    return value


def _path(where: Where) -> str:
    return ".".join(str(part) if len(str(part)) < 100 else shown(part) for part in where)
