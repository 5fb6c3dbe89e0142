"""Run a method.py, and hold what it states: every mistake in it is answered with its line and what to write."""

from __future__ import annotations

import contextlib
import dataclasses
import importlib.util
import io
import itertools
import math
import re
import signal
import stat
import sys
import tokenize
import traceback
import typing
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from numbers import Integral
from pathlib import Path
from typing import Any

from harness import ROOT
from harness.contract import GENERATED, PRECISIONS, Casts, FirsthitError, MeshRecipe, Method, Parameter
from harness.limits import Distinct, is_finite
from harness.stopping import Stopped
from surfaces.model import is_number
from surfaces.words import name_problem, suggestion, title_problem

NAME = re.compile("[A-Za-z][A-Za-z0-9_]*")  # of a method: a Python module's, and a part of files' names
KNOB = re.compile("[A-Z][A-Z0-9_]*")  # a constant's name in GLSL and in OpenCL C
CASTS = typing.get_args(Casts)
LIBRARIES = ROOT / "harness" / "kernels" / "glsl" / "lib"
METHODS = sorted(path.parent.name for path in (ROOT / "methods").glob("*/kernel.glsl"))

# What the fields of a Method are, and what to write where they are something else.
FUNCTIONS = ("accepts", "tolerance", "tables", "mesh")
TEXTS = {
    "name": 'name="mine"',
    "source": 'source="where it was published"',
    "label": 'label="Mine"',
    "rest": 'rest="bernstein"',
}
LISTS = {
    "needs": 'needs=("surface_value",)',
    "libraries": 'libraries=("interval",)',
    "parameters": 'parameters=(Parameter("STEPS", 200, "steps along the ray"),)',
    "precisions": 'precisions=("float32",)',
}
ENDING = "; a method.py states METHOD, and does not end the program"  # what is said of one that tries to
MOST_BYTES = 4 * 2**20  # of a kernel.glsl or a method.py, more than any compiler takes
MOST_SHOWN = 2000  # letters of a text that a method.py answers with; of a value that makes no sense a tenth of that
MOST_NUMBERS = 100_000  # of all tables of a program together; compilers give up sooner
MOST_COMBINATIONS = 10_000  # of the sweeps of a method's knobs, each of which `recommend` tries
FINEST: dict[str, int] = {"parametric": 4096, "contour": 1024}  # a mesh's resolution; 2^24 squares, 2^30 cells


def stated(path: Path) -> object:
    """Run a method.py, and return what it calls METHOD. Raises FirsthitError, with its line, whatever goes wrong.

    Nothing that a method.py does may end the command: it costs its own rows only. Ctrl-C ends it all the same.
    """
    full = path.absolute()  # before it goes to another folder
    spec = importlib.util.spec_from_file_location(f"firsthit_method_{path.parent.name}", full)
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    writes_bytecode, sys.dont_write_bytecode = sys.dont_write_bytecode, True
    with contextlib.redirect_stdout(sys.stderr):  # what it prints is no result of the command
        try:
            spec.loader.exec_module(module)
        except BaseException as error:
            if _ends_command(error):
                raise
            raise FirsthitError(f"{told(path, full, error)}{_ending(error)}") from error
        finally:
            sys.dont_write_bytecode = writes_bytecode
    return getattr(module, "METHOD", None)


def _ends_command(error: BaseException) -> bool:
    """Tell whether somebody stops the command; in a plugin's process, which ignores Ctrl-C, only the plugin raises."""
    ignored = signal.getsignal(signal.SIGINT) is signal.SIG_IGN
    return isinstance(error, Stopped) or (isinstance(error, KeyboardInterrupt) and not ignored)


def _ending(error: BaseException) -> str:
    """Say of what would end the command that it may not."""
    return "" if isinstance(error, Exception) else ENDING


def told(path: Path, full: Path, error: BaseException) -> str:
    """Say with file and line of a method.py what was raised in it; `full` is its absolute path, `path` as it is told.

    Whatever the error itself does when it is shown, this raises nothing.
    """
    try:
        frames = traceback.extract_tb(error.__traceback__)
        lines = [frame.lineno for frame in frames if frame.filename == str(full)]
        if isinstance(error, SyntaxError) and error.filename == str(full):
            lines, error = [error.lineno], SyntaxError(error.msg)
        place = f"{path}:{lines[-1]}" if lines and lines[-1] else str(path)
    except BaseException:
        place = str(path)
    name = type(error).__name__
    text = shown(error, MOST_SHOWN, str)
    return f"{place}: {name}{f': {text}' if text else ''}"


def shown(value: object, most: int = MOST_SHOWN // 10, how: Callable[[Any], str] = repr) -> str:
    """Write a value of somebody's, whatever that does, in at most about `most` letters."""
    try:
        text = str.__str__(how(value))
    except BaseException:
        return "what cannot be shown"
    return text if len(text) <= most else f"{text[:most]}… ({len(text):,} letters)"


def read_file(path: Path) -> bytes:
    """Return what a file of a method holds.

    Raises FirsthitError, with exit code 3, if it cannot be read, is a pipe or is huge.
    """
    try:
        facts = path.stat()  # before it is opened: a pipe that nobody writes into never ends
        if not (stat.S_ISREG(facts.st_mode) or stat.S_ISDIR(facts.st_mode)):
            raise FirsthitError(f"{path}: it is no regular file", exit_code=3)
        if facts.st_size > MOST_BYTES:
            raise FirsthitError(f"{path}: it has {facts.st_size:,} bytes; at most {MOST_BYTES:,} are read", exit_code=3)
        return path.read_bytes()
    except OSError as error:
        raise FirsthitError(f"{path}: {error.strerror or error}", exit_code=3) from None


def line_of(path: Path, name: str) -> int:
    """Return the line of a method.py that gives METHOD its field `name`; without one, that of METHOD, or 1."""
    try:
        read = read_file(path)
        encoding, _ = tokenize.detect_encoding(io.BytesIO(read).readline)  # the one that it states
        lines = read.decode(encoding, "replace").splitlines()
    except (FirsthitError, SyntaxError):  # it has gone since, or was never Python
        return 1
    begins = next((i for i, line in enumerate(lines) if re.match(r"METHOD\b", line)), 0)
    named = re.compile(rf"\b{re.escape(name)}\s*=[^=]")
    return next((i for i in range(begins, len(lines)) if named.search(lines[i])), begins) + 1


def guarded(method: Method, path: Path) -> Method:
    """Return the method with its functions guarded: what goes wrong in them is a FirsthitError with file and line."""

    def one(name: str) -> Callable[..., Any] | None:
        function: Callable[..., Any] | None = getattr(method, name)
        return None if function is None else lambda *given: answered(function, name, path, path.absolute(), given)

    functions: dict[str, Any] = {name: one(name) for name in FUNCTIONS}
    return dataclasses.replace(method, **functions)


def answered(function: Callable[..., Any], name: str, path: Path, full: Path, given: Sequence[Any]) -> Any:
    """Call one of a method's FUNCTIONS, and return its answer made of plain numbers, texts and lists.

    Raises FirsthitError, with exit code 3 and with file and line, where it goes wrong or answers what makes no sense.
    """
    with contextlib.redirect_stdout(sys.stderr):
        try:
            answer, wrong = plain_answer(name, function(*given))
        except FirsthitError:
            raise
        except BaseException as error:  # a plugin may fail in any way
            if _ends_command(error):
                raise
            raise FirsthitError(f"{told(path, full, error)}, in {name}=...{_ending(error)}", exit_code=3) from error
    if wrong:
        raise FirsthitError(f"{path}:{line_of(full, name)}: {name} returned {wrong}", exit_code=3)
    return answer


def plain_number(value: Any) -> float | int:
    """Return a number of any kind as one of Python's own; a whole number stays whole."""
    return int(value) if isinstance(value, Integral) else float(value)


def plain_answer(name: str, answer: Any) -> tuple[Any, str | None]:
    """Return what a method's function answered, made of Python's own numbers, texts, lists and dicts, or a MeshRecipe.

    Where it makes no sense, the second part says what was answered, and what to return.
    """
    if name == "accepts":
        if not isinstance(answer, str | None):
            return (
                None,
                f"{shown(answer)}; return None for a surface that it can be used on, else a text that says why not",
            )
        return (None if answer is None else shown(answer, MOST_SHOWN, str.__str__)), None
    if name == "tolerance":
        if not (is_number(answer) and is_finite(answer)):
            return None, f"{shown(answer)}; return the largest error, a finite number of scene units"
        return float(answer), None
    if name == "mesh":
        return _plain_mesh(answer)
    if not isinstance(answer, Mapping):
        return None, f"{shown(answer)}; return tables by name, as in {{'NODES': [0.0, 0.5, 1.0]}}"
    tables: dict[str, list[float | int]] = {}
    for table, values in answer.items():
        if not isinstance(table, str) or not NAME.fullmatch(table):
            return None, f"a table {shown(table)}; name it by letters, digits and _, as kernels read it"
        if not isinstance(values, Collection) or len(values) == 0:
            return None, f"a table {table} that is empty or no list: {shown(values)}"
        room = MOST_NUMBERS - sum(map(len, tables.values()))
        numbers = list(itertools.islice(values, room + 1))
        if len(numbers) > room:
            return None, f"tables of over {MOST_NUMBERS:,} numbers, which no compiler takes"
        if not numbers or not all(is_number(value) and is_finite(value) for value in numbers):
            return None, f"a table {table} that holds what is no finite number"
        tables[str.__str__(table)] = [plain_number(value) for value in numbers]
    return tables, None


def _plain_mesh(answer: Any) -> tuple[MeshRecipe | None, str | None]:
    """Return what a method's function `mesh` answered, as `plain_answer` does."""
    if not isinstance(answer, MeshRecipe):
        return None, f"{shown(answer)}; return MeshRecipe('contour', 64)"
    kind, resolution = answer.kind, answer.resolution
    if not isinstance(kind, str) or kind not in FINEST:
        return None, f"a mesh of the kind {shown(kind)}; it is one of {', '.join(FINEST)}"
    if not is_number(resolution) or not is_finite(resolution) or resolution != math.floor(resolution):
        return None, f"a mesh whose resolution is {shown(resolution)}; give it a whole number"
    if not 3 <= resolution <= FINEST[kind]:
        return None, f"a mesh whose resolution is {shown(resolution)}; {kind} meshes have from 3 to {FINEST[kind]}"
    return MeshRecipe("parametric" if kind == "parametric" else "contour", int(resolution)), None


def problem_of(method: Method) -> str | None:
    """Say what in a method's statement can mean nothing, and what to write; None where all of it makes sense.

    The first word of the answer is the field's name.
    """
    if problem := _wrong_kind(method):
        return problem
    if not NAME.fullmatch(method.name):
        return (
            f"name {shown(method.name)} must be letters, digits and _, and begin with a letter; rename the folder too"
        )
    if problem := _text_problem(method):
        return problem
    libraries = tuple(sorted(path.stem for path in LIBRARIES.glob("*.glsl")))
    named: tuple[tuple[str, str, Sequence[str], Iterable[str]], ...] = (
        ("casts", "way of casting", (method.casts,), CASTS),
        ("precisions", "precision", method.precisions, PRECISIONS),
        ("needs", "generated function", method.needs, GENERATED),
        ("libraries", "kernel library", method.libraries, libraries),
        ("rest", "method of this project", (method.rest,) if method.rest else (), METHODS),
    )
    for field, what, names, known in named:
        for name in names:
            if name not in known:
                return f"{field}: there is no {what} {name!r}; {suggestion(name, known)}"
    if not method.precisions:
        return f"precisions is empty; write {LISTS['precisions']}, or leave it out for both"
    knobs = [parameter.name for parameter in method.parameters if isinstance(parameter, Parameter)]
    if twice := Distinct().broken(knobs):
        return f"parameters: the knob {twice}; keep one of the two"
    if problem := _setting_problem(method):
        return problem
    problems = (_knob_problem(parameter) for parameter in method.parameters)
    if problem := next((f"parameters: {problem}" for problem in problems if problem), None):
        return problem
    tried = math.prod(1 + len(parameter.sweep) for parameter in method.parameters)
    return f"parameters: sweeps have {tried:,} combinations; shorten them" if tried > MOST_COMBINATIONS else None


def _setting_problem(method: Method) -> str | None:
    """Say which setting gives a knob what is no finite number, and what to write; None where none does."""
    for name, values in method.settings.items():
        if not isinstance(values, Mapping) or not all(isinstance(knob, str) for knob in values):
            return f"settings: {name!r} is {shown(values)}; write values of knobs by name, as in {{'STEPS': 100}}"
        for knob, value in values.items():
            if not is_number(value) or not is_finite(value):
                return f"settings: {name!r} gives {knob} the value {shown(value)}; give it a finite number"
    return None


def _text_problem(method: Method) -> str | None:
    """Say which text of a method cannot be printed in a line, and what it may hold; None where each can."""
    names = [("name", method.name), *(("settings", name) for name in method.settings)]
    names += [("claims", claim) for claim in sorted(method.claims)]
    for field, name in names:
        if problem := name_problem(name):
            return f"{field}: {problem}"
    return (problem := title_problem(method.source)) and f"source: {problem}"


def _wrong_kind(method: Method) -> str | None:
    """Say which field of a method is of another kind than it must be, and what to write; None where none is."""
    for name, example in TEXTS.items():
        if not isinstance(getattr(method, name), str):
            return f"{name} is {shown(getattr(method, name))}; write a text, as in {example}"
    for name, example in LISTS.items():
        value = getattr(method, name)
        if isinstance(value, str | Parameter):
            written = f"({shown(value)},)" if isinstance(value, str) else "(Parameter(...),)"
            return f"{name} is {shown(value)}, which is no tuple; write {name}={written}, with the comma"
        if not isinstance(value, tuple | list):
            return f"{name} is {shown(value)}; write a tuple, as in {example}"
        if name != "parameters" and (other := next((item for item in value if not isinstance(item, str)), None)):
            return f"{name} holds {shown(other)}; write texts, as in {example}"
    if not isinstance(method.claims, set | frozenset) or not all(isinstance(claim, str) for claim in method.claims):
        return f"claims is {shown(method.claims)}; write claims=frozenset({{'no_false_hit'}})"
    if not isinstance(method.settings, Mapping) or not all(isinstance(name, str) for name in method.settings):
        return f"settings is {shown(method.settings)}; write settings={{'its name': {{'STEPS': 100}}}}"
    if not isinstance(method.answers, bool):
        return f"answers is {shown(method.answers)}; write True or False"
    for name in FUNCTIONS:
        value = getattr(method, name)
        if not callable(value) and (value is not None or name == "accepts"):
            return f"{name} is {shown(value)}; give it a function, see class Method in harness/contract.py"
    return None


def _knob_problem(knob: object) -> str | None:
    """Say what in the statement of a knob can mean nothing, and what to write; None where all of it makes sense."""
    if not isinstance(knob, Parameter):
        return f"it holds {shown(knob)}; give it Parameter(...)"
    if not isinstance(knob.name, str) or not KNOB.fullmatch(knob.name) or name_problem(knob.name):
        name = shown(knob.name)
        return f"the knob {name} must be capitals, digits and _, and begin with a capital, since kernels read it"
    for name, value in (("meaning", knob.meaning), ("per", "" if knob.per is None else knob.per)):
        if not isinstance(value, str):
            return f"the knob {knob.name} has {name}={shown(value)}; write a text"
        if problem := title_problem(value):
            return f"the knob {knob.name} has a {name}: {problem}"
    if knob.finer not in (None, "up", "down"):
        return f"the knob {knob.name} is finer {shown(knob.finer)}; write up, down or None"
    if not isinstance(knob.sweep, tuple | list):
        return f"the knob {knob.name} has sweep={shown(knob.sweep)}; write a tuple, as in sweep=({shown(knob.sweep)},)"
    for number in (knob.default, *knob.sweep, *([] if knob.printed is None else [knob.printed])):
        if not is_number(number) or not is_finite(number):
            return f"the knob {knob.name} has the value {shown(number)}; give it a finite number"
        if isinstance(knob.default, int) and number != int(number):
            return f"the knob {knob.name} is a whole number, as its default is, and has the value {shown(number)}"
    return None
