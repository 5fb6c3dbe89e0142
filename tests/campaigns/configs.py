"""Read and plan hostile configs: shipped ones that were changed, others made by chance, and damaged texts."""

from __future__ import annotations

import copy
import dataclasses
import functools
import itertools
import json
import random
import re
import tomllib
import types
import typing
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from harness.contract import DeviceInfo, FirsthitError
from harness.experiment import plan, reading, shipped
from harness.experiment.config import FASTEST, Config, Experiment
from harness.experiment.size import check_size
from harness.experiment.toml_file import one_line
from harness.limits import Known, Named, Offered, OneOf, Within, hints_of, is_required
from harness.plugins import Catalog, find_methods
from surfaces.visible import shown
from tests.campaigns.frame import Campaign, Fell, Place

Key = str | int
Holder = Any  # a table or a list that holds a value
EACH = 20  # configs of a trial
FEW = 6  # cells of a plan that are planned whole; of a larger one only the first names are looked at
LOOKED_AT = 300

DEVICES = [
    DeviceInfo("opencl:pocl", "a made-up one", "1", "1", 4, True, "wall", ()),
    DeviceInfo("opengl:llvmpipe", "another", "1", "1", 4, False, "wall", ()),
    DeviceInfo("opencl:lost", "a third", "1", "1", 4, False, "wall", (), problem="its driver is gone"),
]


class Raw(str):
    """Hold what is written into a config as it is."""


def _hostile_text(dice: random.Random) -> str:
    letters = (
        "\n",
        "\r",
        "\0",
        "\x1b[31m",
        "\x7f",
        "\u202e",
        "\u200b",
        "\ud800",
        "\u2028",
        "/",
        "\\",
        "..",
        "::error::",
        '"',
    )
    return dice.choice(
        (
            "",
            " ",
            "a" * dice.choice((101, 301, 10_000)),
            "../" * 9 + "etc",
            "nan",
            "all",
            f"a{dice.choice(letters)}b",
            dice.choice(letters) * dice.choice((1, 2, 200)),
        )
    )


def _hostile(dice: random.Random) -> Any:
    """Return a value that a field may hardly hold."""
    kinds = (
        lambda: dice.choice((float("nan"), float("inf"), -float("inf"), -0.0, 1e308, 5e-324, -1.5, 0.1 + 0.2)),
        lambda: dice.choice((-1, 0, 1, 2, 7, 2**31, 2**32 + 1, 2**63, -(2**63) - 1, 10**25, 10**400)),
        lambda: Raw(dice.choice(("", "-", "0x")) + "9" * dice.choice((999, 1001, 4301, 5000, 20_000))),
        lambda: dice.choice((True, False, Raw("1979-05-27"), Raw("1979-05-27T07:32:00Z"), Raw("07:32:00"))),
        lambda: _hostile_text(dice),
        lambda: dice.choice(([], {}, [[]], [{}], [[1], 2], {"": 1}, {"a": {"b": []}}, [1, 1.0], ["x", "x"], [True, 1])),
        lambda: Raw("[" * (depth := dice.choice((3, 49, 51, 2000))) + "]" * depth),
        lambda: Raw("{a=" * (depth := dice.choice((3, 51, 2000))) + "1" + "}" * depth),
        lambda: [_hostile(dice) for _ in range(dice.randrange(4))],
    )
    return dice.choice(kinds)()


def _made(kind: Any, dice: random.Random, limits: tuple[Any, ...] = ()) -> Any:
    """Return a value that a field of this kind may hold, as far as its limits say."""
    origin, parts = typing.get_origin(kind), typing.get_args(kind)
    if origin is typing.Annotated:
        return _made(parts[0], dice, parts[1:])
    if origin in (types.UnionType, typing.Union):
        return _made(dice.choice([part for part in parts if part is not type(None)]), dice, limits)
    if origin is typing.Literal:
        return dice.choice(parts)
    if origin is list:
        items = [_made(parts[0], dice, limits) for _ in range(dice.choice((1, 1, 2)))]
        return items if dice.random() < 0.1 else [item for i, item in enumerate(items) if item not in items[:i]]
    if origin is tuple:
        return [_made(part, dice) for part in parts]
    if origin is dict:
        names = [*limits[0].names()] if limits and isinstance(limits[0], Known) else NAMES
        return {dice.choice(names): _made(parts[1], dice) for _ in range(dice.randrange(3))}
    if dataclasses.is_dataclass(kind):
        hints = hints_of(typing.cast(type, kind))
        chosen = [field for field in dataclasses.fields(kind) if is_required(field) or dice.random() < 0.2]
        return {field.name: _made(hints[field.name], dice) for field in chosen}
    for limit in limits:
        if isinstance(limit, Within) and kind in (int, float):
            low, high = max(limit.low, -1e3), min(limit.high, 1e3)
            return kind(dice.choice((low, high, dice.uniform(low, high))))
        if isinstance(limit, OneOf):
            return dice.choice(limit.values)
        if isinstance(limit, Known | Named | Offered):
            return dice.choice([*limit.names()])
    plain = {bool: dice.random() < 0.5, int: dice.randrange(9), float: dice.choice((0.5, 1, 1e-3))}
    return plain.get(kind, dice.choice((*NAMES, *FORMULAS)))


NAMES = ("EPSILON", "STEPS", "MAX_EVALUATIONS", "R", "a", "torus", "mine", "sphere", "a b", "newton")
FORMULAS = ("x^2 + y^2 + z^2 - 1", "x^2 + a*y - z", "sphere:1.5", "box:1,1,1", "auto", "x +", "as printed", "7")


def _places(value: Any) -> Iterator[tuple[Holder, Key]]:
    """Go through every place of a table where a value stands."""
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, inner in items:
        yield value, key
        yield from _places(inner)


def _change(table: dict[str, Any], dice: random.Random) -> None:
    """Change a table in one place."""
    places = [*_places(table)]
    if not places:
        return
    holder, key = dice.choice(places)
    value, change = holder[key], dice.randrange(8)
    if change < 3:
        holder[key] = _hostile(dice)
    elif change == 3:
        del holder[key]
    elif change == 4:
        holder[key] = [
            value,
            copy.deepcopy(value),
            float(value) if isinstance(value, int) and abs(value) < 1e9 else value,
        ]
    elif change == 5:
        other, at = dice.choice(places)
        holder[key] = copy.deepcopy(other[at]) if at in (other if isinstance(other, dict) else range(len(other))) else 0
    elif isinstance(holder, dict):
        fields = [name for kind in (Config,) for name in hints_of(kind)]
        name = dice.choice((_hostile_text(dice), dice.choice(fields), f"{key} "))
        holder[name] = holder.pop(key) if change == 6 else _hostile(dice)
    else:
        holder.append(copy.deepcopy(value))


@functools.cache
def _shipped() -> list[dict[str, Any]]:
    return [tomllib.loads(shipped.located(name).read_text(encoding="utf-8")) for name in shipped.names()]


def _smaller(table: dict[str, Any], dice: random.Random) -> dict[str, Any]:
    """Return a config with one or two of each thing that a shipped one lists, so that its cells can be planned."""
    made = copy.deepcopy(table)
    for name, value in made.items():
        if isinstance(value, list) and value and name != "include":
            made[name] = dice.sample(value, min(len(value), dice.choice((1, 1, 2))))
    if "directions" in made:
        made["directions"]["count"] = 2
    if "path" in made:
        made["path"]["frames"] = 2
    for scene in made.get("scene", {}).values():
        if "counts" in scene:
            scene["counts"] = [2]
    return made


def _text(table: dict[str, Any], dice: random.Random) -> str:
    """Write a table as TOML, its tables under headers or inline."""
    lines, headed = list[str](), list[str]()
    for key, value in table.items():
        if isinstance(value, dict) and dice.random() < 0.7:
            headed += [f"[{_written(key)}]", *(f"{_written(name)} = {_toml(item)}" for name, item in value.items())]
        elif isinstance(value, list) and value and all(isinstance(v, dict) for v in value) and dice.random() < 0.7:
            for one in value:
                headed += [f"[[{_written(key)}]]", *(f"{_written(name)} = {_toml(item)}" for name, item in one.items())]
        else:
            lines.append(f"{_written(key)} = {_toml(value)}")
    return "\n".join([*lines, *headed]) + "\n"


def _written(text: str) -> str:
    return json.dumps(text, ensure_ascii=dice_free(text)).replace("\x7f", "\\u007f")


def dice_free(text: str) -> bool:
    """Tell whether a text is to be written in escapes: every other one, by its length."""
    return len(text) % 2 == 0


def _toml(value: Any) -> str:
    if isinstance(value, Raw):
        return str(value)
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_written(key)} = {_toml(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_toml, value)) + "]"
    return _written(value) if isinstance(value, str) else repr(value)


def _damaged(text: str, dice: random.Random) -> bytes:
    """Return the bytes of a text in which something is cut, doubled, put in or turned."""
    content = text.encode("utf-8", "surrogatepass")
    a, b = sorted(dice.randrange(len(content) + 1) for _ in range(2))
    b = min(b, a + dice.choice((1, 9, 200)))
    noise = (
        b'"""',
        b"'''",
        b"[[",
        b"]]",
        b"{",
        b"=",
        b"\xff\xfe",
        b"\0",
        b"\r",
        b"#",
        b"." * 99,
        b"\xef\xbb\xbf",
        b"=nan",
    )
    return (
        content[:a]
        + dice.choice((b"", content[a:b] * 2, dice.choice(noise), bytes(reversed(content[a:b]))))
        + content[b:]
    )


def _content(dice: random.Random) -> bytes:
    made = dice.random()
    table = _made(Config, dice) if made < 0.4 else _smaller(dice.choice(_shipped()), dice)
    if made < 0.4 and dice.random() < 0.8:  # what nothing can be planned without
        table |= {"surfaces": [dice.choice(("sphere", "torus", "flirt"))], "devices": ["all"]}
        table["method"] = table.get("method") or [{"name": dice.choice(("newton", "ray_march", "polygon"))}]
        for name in ("include", "baseline", "focus", "surface", "scene"):
            if name == "include" or dice.random() < 0.7:
                table.pop(name, None)
    for _ in range(dice.choice((0, 0, 1, 1, 1, 2, 3))):
        _change(table, dice)
    text = _text(table, dice)
    return _damaged(text, dice) if dice.random() < 0.15 else text.encode("utf-8", "surrogatepass")


@functools.cache
def _methods() -> Catalog:
    return find_methods()


def _trial(dice: random.Random, place: Place) -> Counter[str]:
    seen = Counter[str]()
    for _ in range(EACH):
        content = _content(dice)
        try:
            seen[_read(content, dice, place.own)] += 1
        except Exception as error:
            raise Fell(f"{type(error).__name__}: {error}, of {content[:2000]!r}") from error
    return seen


def _read(content: bytes, dice: random.Random, folder: Path) -> str:
    """Read and plan a config, and return what came of it. Raises Fell, or any other error, where that may not be."""
    name = dice.choice(
        ("c.toml",) * 9 + ("a\nb.toml", "..toml", "a" * 110 + ".toml", "\u202e.toml", "no", "c.toml.toml")
    )
    path = folder / name
    path.write_bytes(content)
    try:
        _, parts = reading.load_all(path, _methods())
    except FirsthitError as error:
        return _refused(str(error), path)
    outcomes = {_planned(part.on(_named(part)), dice) for part in parts[:2]}
    return max(outcomes)


def _refused(told: str, path: Path) -> str:
    """Hold that each line of what is told names a file and a line, or belongs to the one before."""
    begins = (rf"{re.escape(one_line(path))}:[1-9]\d*: ", r"    ", rf"{re.escape(str(shipped.FOLDER))}/\S*:[1-9]\d*: ")
    for line in told.split("\n"):
        if not any(re.match(begin, line) for begin in begins):
            raise Fell(f"no file and line: {line[:300]!r}")
        if shown(line) != line or len(line) > 2500:
            raise Fell(f"a line that is not one: {line[:300]!r}, {len(line)} letters")
    return "refused"


def _named(part: Experiment) -> list[str]:
    """Return devices in place of the fastest, which only a probe finds."""
    return ["any"] if FASTEST in part.wanted_devices() else []


def _planned(part: Experiment, dice: random.Random) -> str:
    try:
        json.dumps(dataclasses.asdict(part.config), allow_nan=False)
        check_size(part, _methods(), DEVICES)
        cells = plan.grid(part, _methods(), DEVICES) if part.variants else iter(())
        first = [*itertools.islice(cells, LOOKED_AT)]
        _once("slot", [cell.slot for cell, _ in first])
        if len(first) > FEW or dice.random() < 0.8:
            return "cells listed"
        planned = plan.plan(part, _methods(), DEVICES, timed=dice.random() < 0.5) if first else []
    except FirsthitError as error:
        if shown(str(error)) != str(error) or "\n" in str(error):
            raise Fell(f"not one line: {str(error)[:300]!r}") from None
        return "planned, and refused"
    except ValueError as error:
        raise Fell(f"a number that JSON refuses: {error}") from None
    _once("key", [p.key for p in planned])
    for p in planned:
        json.dumps(p.identity, allow_nan=False)
        if shown(p.cell.slot) != p.cell.slot:
            raise Fell(f"a cell's name that cannot be seen: {p.cell.slot!r}")
    return "planned"


def _once(what: str, names: list[str]) -> None:
    if twice := {name for name in names if names.count(name) > 1}:
        raise Fell(f"{what} planned twice: {sorted(twice)[:3]}")


CAMPAIGN = Campaign(
    name="configs",
    tries="reads and plans a hostile config: a shipped one that was changed, one made by chance, or a damaged text",
    promise="no traceback, no mistake without file and line, no hang, no cell planned twice, no number not finite",
    trial=_trial,
    small=100,
    whole=100_000,
    each=EACH,
    block=10,
    limit=300,
)
