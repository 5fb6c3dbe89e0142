"""Damage files at random, knowing how they are made: values of JSON and TOML, members of archives, and plain bytes."""

from __future__ import annotations

import copy
import io
import json
import os
import random
import socket
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

Value = Any
ODD: tuple[Value, ...] = (
    *(None, True, False, 0, -1, 1, 2**31, 2**63, 2**64, -(2**63), 10**400, 0.0, -0.0, 1.5, -1e-300, 5e-324),
    *(1e308, -1e308, float("nan"), float("inf"), -float("inf"), "", " ", "x" * 300, "a\n::error::x", "\x1b[31m"),
    *("\ud800", "é", "../../etc", "\0", "ok", "failed", "nan", "1", [], {}, [None], [[]], [1.0], {"": {}}, {"a": 1}),
)


def places(document: Value) -> list[tuple[Any, Any]]:
    """List every value within a document by what holds it and the key or index there."""
    found, stack = [], [document]
    while stack:
        holder = stack.pop()
        inner = list(holder.items()) if isinstance(holder, dict) else list(enumerate(holder))
        for at, value in inner:
            found.append((holder, at))
            if isinstance(value, (dict, list)):
                stack.append(value)
    return found


def number(dice: random.Random, value: Value) -> Value:
    """Return a number near or far from another one."""
    if isinstance(value, bool) or not isinstance(value, (int, float)) or abs(value) > 2**64:
        return copy.deepcopy(dice.choice(ODD))
    return dice.choice((value + 1, value - 1, -value, value * 2, value * 0.999, value / 1e9, value * 1e9, value * 1e30))


def changed(dice: random.Random, document: dict[str, Any]) -> dict[str, Any]:
    """Return a copy of a document, damaged at a few places."""
    made = copy.deepcopy(document)
    for _ in range(dice.choice((1, 1, 1, 2, 5))):
        every = places(made)
        if not every:
            break
        dice.choice(_OPERATIONS)(dice, *dice.choice(every), every)
    return made


def _delete(dice: random.Random, holder: Any, at: Any, every: list[Any]) -> None:
    del dice, every, holder[at]


def _retype(dice: random.Random, holder: Any, at: Any, every: list[Any]) -> None:
    del every
    holder[at] = copy.deepcopy(dice.choice(ODD))


def _renumber(dice: random.Random, holder: Any, at: Any, every: list[Any]) -> None:
    del every
    holder[at] = number(dice, holder[at])


def _nest(dice: random.Random, holder: Any, at: Any, every: list[Any]) -> None:
    del every
    for _ in range(dice.choice((1, 2, 70))):
        holder[at] = dice.choice((lambda v: [v], lambda v: {"a": v}))(holder[at])


def _swap(dice: random.Random, holder: Any, at: Any, every: list[Any]) -> None:
    other, there = dice.choice(every)
    mine, theirs = copy.deepcopy(holder[at]), copy.deepcopy(other[there])
    other[there] = mine
    if isinstance(holder, dict) or at < len(holder):
        holder[at] = theirs


def _cut(dice: random.Random, holder: Any, at: Any, every: list[Any]) -> None:
    del every
    value = holder[at]
    if isinstance(value, (list, str)) and value:
        holder[at] = value[: dice.randrange(len(value))]
    elif isinstance(value, dict) and value:
        value.pop(dice.choice(list(value)))


def _insert(dice: random.Random, holder: Any, at: Any, every: list[Any]) -> None:
    del every
    value = holder[at]
    if isinstance(value, list):
        value.insert(dice.randrange(len(value) + 1), copy.deepcopy(dice.choice([*ODD, *value])))
    elif isinstance(holder, dict):
        holder[f"{at}_"] = copy.deepcopy(value)


def _rename(dice: random.Random, holder: Any, at: Any, every: list[Any]) -> None:
    del every
    if isinstance(holder, dict):
        holder[dice.choice((f"{at}x", str(at)[:-1], str(at).upper()))] = holder.pop(at)


_OPERATIONS: tuple[Callable[..., None], ...] = (
    *(_delete, _retype, _retype, _renumber, _renumber, _renumber, _nest, _swap, _cut, _insert, _rename),
)


def text(document: dict[str, Any]) -> str:
    """Write a document as a run does, with whatever is in it: NaN, and half letters."""
    return json.dumps(document, indent=1)


def scribbled(dice: random.Random, content: bytes) -> bytes:
    """Return bytes that were damaged without regard to what they mean."""
    at, made = dice.randrange(len(content)), bytearray(content)
    match dice.randrange(12):
        case 0:
            return content[:at]
        case 1:
            made[at] ^= 1 << dice.randrange(8)
        case 2:
            made[at:at] = dice.randbytes(dice.randrange(1, 9))
        case 3:
            del made[at : at + dice.randrange(1, 400)]
        case 4:
            return b"\xef\xbb\xbf" + content
        case 5:
            return content.decode("utf-8", "replace").encode(dice.choice(("utf-16", "utf-32", "latin-1")), "replace")
        case 6:
            lines = content.split(b"\n")
            lines.insert(dice.randrange(len(lines)), dice.choice(lines))
            return b"\n".join(lines)
        case 7:
            digits = dice.choice((b"9" * 5000, b"1e999", b"-1e999", b"0" * 50, b"NaN", b"1e-999", b"9" * 400))
            found = [i for i, c in enumerate(content) if 48 <= c <= 57]
            if found:
                spot = dice.choice(found)
                made[spot : spot + 1] = digits
        case 8:
            made[at:at] = dice.choice((b"[", b'{"a":')) * 3000
        case 9:
            return bytes(len(content)) if dice.random() < 0.5 else b""
        case 10:
            made[at : at + 512] = bytes(min(512, len(content) - at))  # a block that a disk lost
        case _:
            return content.replace(b"\n", b"\r\n")
    return bytes(made)


def in_place_of(dice: random.Random, path: Path) -> None:
    """Put something that is no file where a file is expected."""
    path.unlink(missing_ok=True)
    match dice.randrange(5):
        case 0:
            path.mkdir()
        case 1:
            os.mkfifo(path)
        case 2:
            path.symlink_to(path.name)
        case 3:
            path.symlink_to("/nowhere/at/all")
        case _:
            with socket.socket(socket.AF_UNIX) as made:
                made.bind(str(path))


def repacked(dice: random.Random, arrays: dict[str, np.ndarray]) -> bytes:
    """Write arrays as an archive whose checks hold, and in which something else is wrong."""
    made = dict(arrays)
    name = dice.choice(list(made))
    array, what = made[name], dice.randrange(9)
    if what == 0:
        del made[name]
    elif what == 1:
        with np.errstate(all="ignore"):
            made[name] = array.astype(
                dice.choice((np.float64, np.float16, np.int64, np.uint8, np.complex64, "U3", ">f4"))
            )
    elif what == 2:
        made[name] = np.array([{"a": 1}], object)
    elif what == 3:
        shape = tuple(side + dice.choice((-1, 0, 1)) for side in array.shape)
        made[name] = np.resize(array, dice.choice((shape, (*array.shape, 1), array.shape[:1], (0,) * array.ndim)))
    elif what == 4 and array.size:
        flat = array.copy().reshape(-1)
        top = 255 if array.dtype.kind == "u" else 2
        flat[dice.randrange(array.size)] = dice.randrange(top) if array.dtype.kind in "ub" else dice.choice((-1, 1e9))
        made[name] = flat.reshape(array.shape)
    elif what == 5 and array.dtype.kind == "f" and array.size:
        flat = array.copy().reshape(-1)
        flat[dice.randrange(array.size)] = dice.choice((np.nan, np.inf, -np.inf, -1.0))
        made[name] = flat.reshape(array.shape)
    elif what == 6:
        made[f"{name}2"] = array
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", 0 if dice.random() < 0.4 else dice.choice((8,) * 10 + (12, 14))) as file:
        for one, values in made.items():
            body = _npy(values)
            if one == name and what == 7:
                body = claimed(dice, body)
            file.writestr(f"{one}.npy", body)
            if one == name and what == 8:
                file.writestr(f"{one}x", b"\0" * dice.choice((10, 30_000_000 if dice.random() < 0.02 else 1000)))
    return packed.getvalue()


def _npy(values: np.ndarray) -> bytes:
    written = io.BytesIO()
    np.lib.format.write_array(written, values, allow_pickle=True)
    return written.getvalue()


def claimed(dice: random.Random, body: bytes) -> bytes:
    """Change the header of an array: what it claims of shape and type."""
    end = body.index(b"\n")
    claims = (
        b"(10000000000,)",
        b"(100000, 100000)",
        b"(-1,)",
        b"(1.5,)",
        b"((((1,),),),)",
        b"()",
        b"(2**99,)",
        b"None",
    )
    header = dice.choice(
        (
            b"{'descr': '<f8', 'fortran_order': False, 'shape': %s, }" % dice.choice(claims),
            b"{'descr': '|O', 'fortran_order': False, 'shape': (1,), }",
            b"{'descr': [('a', '<f4')], 'fortran_order': True, 'shape': (1,), }",
            b"[" * 900,
            b"__import__('os').system('false')",
            dice.randbytes(40),
        )
    )
    return body[:10] + header[: end - 10].ljust(end - 10) + body[end:]
