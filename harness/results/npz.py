"""Read arrays of an .npz file that may be damaged: only those that are declared, and never more than was stated.

What a file claims is held against what its reader expects before anything is allocated: a header of 10^10 numbers, an
array of another type, and a few bytes that unpack to gigabytes are refused.
"""

from __future__ import annotations

import io
import math
import os
import struct
import tokenize
import zipfile
import zlib
from collections.abc import Callable, Mapping
from functools import lru_cache
from pathlib import Path
from typing import IO, Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from harness.results import sealed

Shape = tuple[int, ...]
Fits = Callable[[str, Shape], bool]  # tells whether the array of a name may have a shape
LARGEST = 2**31  # bytes of a file
MOST = 2**27  # numbers of an array
MEMBERS = 64
# What zipfile, zlib and NumPy's reader of headers raise for bytes that are none of theirs
DAMAGE: tuple[type[Exception], ...] = (
    *(ValueError, TypeError, LookupError, ArithmeticError, SyntaxError, EOFError, OSError, RuntimeError, MemoryError),
    *(struct.error, tokenize.TokenError, zipfile.BadZipFile, zlib.error),
)
_PLAIN = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)
_HEADERS = {(1, 0): np.lib.format.read_array_header_1_0, (2, 0): np.lib.format.read_array_header_2_0}
_LENGTHS = {(1, 0): "<H", (2, 0): "<I"}  # of the length of a header


def read(path: Path, kinds: Mapping[str, Any], fits: Fits, optional: frozenset[str] = frozenset()) -> dict[str, Any]:
    """Read the arrays that `kinds` names with their types; those that are `optional` may be missing.

    Other members of the file are ignored, if their names are whole. Raises OSError where the file cannot be read, and
    ValueError where it is damaged, or an array has another type or a shape that does not fit.
    """
    with sealed.opened(path, LARGEST) as packed:
        return _read(packed, kinds, fits, optional)


def _read(packed: BinaryIO, kinds: Mapping[str, Any], fits: Fits, optional: frozenset[str]) -> dict[str, Any]:
    """Read the arrays of an open file. Raises ValueError where it is damaged."""
    try:
        with zipfile.ZipFile(packed) as file:
            members = {info.filename: info for info in file.infolist()}
            if len(members) > MEMBERS or len(members) != len(file.infolist()):
                raise ValueError("it has too many members, or two of one name")
            there = [name for name in kinds if f"{name}.npy" in members or name not in optional]
            lacking = next((name for name in there if f"{name}.npy" not in members), None)
            if lacking is not None:
                raise ValueError(f"it has no {lacking}")
            for info in file.infolist():  # a member whose name was damaged would pass for one of another version
                file.open(info).close()  # zipfile holds the name in the directory against that of the member
            return {name: _member(file, members[f"{name}.npy"], name, np.dtype(kinds[name]), fits) for name in there}
    except DAMAGE as error:
        raise ValueError(f"damaged: {sealed.problem(error) or type(error).__name__}") from None


def read_alone(path: Path) -> NDArray[Any]:
    """Read the array of a .npy file. Raises OSError or ValueError where there is none."""
    with sealed.opened(path, LARGEST) as file:
        try:
            return _array(file, os.fstat(file.fileno()).st_size, _no_numbers)
        except DAMAGE as error:
            raise ValueError(sealed.problem(error) or type(error).__name__) from None


def _no_numbers(kind: np.dtype[Any], shape: Shape) -> str:
    """Say that an array of any shape holds objects; "" where it does not."""
    del shape
    return "it holds objects" if kind.hasobject else ""


def _member(file: zipfile.ZipFile, info: zipfile.ZipInfo, name: str, kind: np.dtype[Any], fits: Fits) -> NDArray[Any]:
    """Read one array. Raises one of DAMAGE where the member is damaged."""

    def wrong(found: np.dtype[Any], shape: Shape) -> str:
        if found != kind:
            return f"{name} is of {found}, not {kind}"
        return "" if fits(name, shape) else f"{name} has the shape {shape}"

    if info.compress_type not in _PLAIN or info.flag_bits & 1:
        raise ValueError(f"{name} is packed in another way than NumPy does")
    with file.open(info) as member:
        return _array(member, info.file_size, wrong)


def _header(file: IO[bytes]) -> tuple[Shape, bool, np.dtype[Any]]:
    """Read the header of an array: its shape, whether it lies by columns, and its type. Raises one of DAMAGE."""
    version = np.lib.format.read_magic(file)
    length = file.read(struct.calcsize(_LENGTHS[version]))
    return _parsed(version, length + file.read(*struct.unpack(_LENGTHS[version], length)))


@lru_cache(maxsize=64)  # NumPy compiles the text of a header, and those of one run are few
def _parsed(version: tuple[int, int], header: bytes) -> tuple[Shape, bool, np.dtype[Any]]:
    """Parse a header, from the bytes of its length on. Raises one of DAMAGE."""
    return _HEADERS[version](io.BytesIO(header))


def _array(file: IO[bytes], size: int, wrong: Callable[[np.dtype[Any], Shape], str]) -> NDArray[Any]:
    """Read an array of a file of `size` bytes. Raises one of DAMAGE where it is damaged, or `wrong` says what is."""
    shape, by_columns, kind = _header(file)
    count = math.prod(shape)
    if not 0 <= count <= MOST or not all(0 <= side <= MOST for side in shape):
        raise ValueError(f"it claims the shape {shape}")
    if reason := wrong(kind, shape):
        raise ValueError(reason)
    if size != file.tell() + count * kind.itemsize:
        raise ValueError(f"it has not as many numbers as it claims, {count:,}")
    numbers = file.read(count * kind.itemsize)
    if len(numbers) != count * kind.itemsize or file.read(1):
        raise ValueError("it is cut short")
    made = np.frombuffer(numbers, kind)
    return made.reshape(shape[::-1]).T.copy() if by_columns else made.reshape(shape).copy()
