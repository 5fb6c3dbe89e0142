"""Run a method.py, and hold what it states: every mistake in it is answered with its line and what to write."""

from __future__ import annotations

import contextlib
import dataclasses
import importlib.util
import re
import signal
import sys
import threading
import tokenize
import traceback
import typing
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from harness import ROOT
from harness.contract import GENERATED, PRECISIONS, Casts, FirsthitError, Method, Parameter
from harness.limits import Distinct, is_finite
from surfaces.model import is_number
from surfaces.words import name_problem, suggestion, title_problem

NAME = re.compile("[A-Za-z][A-Za-z0-9_]*")  # of a method: a Python module's, and a part of files' names
KNOB = re.compile("[A-Z][A-Z0-9_]*")  # a constant's name in GLSL and in OpenCL C
CASTS = typing.get_args(Casts)
LIBRARIES = ROOT / "harness" / "kernels" / "glsl" / "lib"

# What the fields of a Method are, and what to write where they are something else.
FUNCTIONS = ("accepts", "tolerance", "tables", "mesh")
TEXTS = {"name": 'name="mine"', "source": 'source="where it was published"'}
LISTS = {
    "needs": 'needs=("surface_value",)',
    "libraries": 'libraries=("interval",)',
    "parameters": 'parameters=(Parameter("STEPS", 200, "steps along the ray"),)',
    "precisions": 'precisions=("float32",)',
}


def stated(path: Path) -> object:
    """Run a method.py, and return what it calls METHOD. Raises FirsthitError, with its line, whatever goes wrong.

    Nothing that a method.py does may end the command: it costs its own rows only. Ctrl-C ends it all the same.
    """
    spec = importlib.util.spec_from_file_location(f"firsthit_method_{path.parent.name}", path)
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    writes_bytecode, sys.dont_write_bytecode = sys.dont_write_bytecode, True
    with _pressed() as pressed, contextlib.redirect_stdout(sys.stderr):  # what it prints is no result of the command
        try:
            spec.loader.exec_module(module)
        except BaseException as error:
            if isinstance(error, KeyboardInterrupt) and pressed:
                raise
            raise FirsthitError(f"{_told(path, error)}{_ending(error)}") from error
        finally:
            sys.dont_write_bytecode = writes_bytecode
    return getattr(module, "METHOD", None)


@contextlib.contextmanager
def _pressed() -> Iterator[list[int]]:
    """Give a list that is empty until Ctrl-C is pressed, which then interrupts as ever."""
    pressed: list[int] = []
    before = signal.getsignal(signal.SIGINT)
    if threading.current_thread() is not threading.main_thread() or not callable(before):
        yield pressed
        return

    def note(number: int, frame: Any) -> None:
        pressed.append(number)
        before(number, frame)

    signal.signal(signal.SIGINT, note)
    try:
        yield pressed
    finally:
        signal.signal(signal.SIGINT, before)


def _ending(error: BaseException) -> str:
    """Say of what would end the command that it may not."""
    return "" if isinstance(error, Exception) else "; a method.py states METHOD, and does not end the program"


def _told(path: Path, error: BaseException) -> str:
    """Say with file and line of a method.py what was raised in it."""
    frames = traceback.extract_tb(error.__traceback__)
    lines = [frame.lineno for frame in frames if Path(frame.filename) == path.absolute()]
    if isinstance(error, SyntaxError) and error.filename == str(path.absolute()):
        lines, error = [error.lineno], SyntaxError(error.msg)
    place = f"{path}:{lines[-1]}" if lines and lines[-1] else str(path)
    return f"{place}: {type(error).__name__}{f': {error}' if str(error) else ''}"


def line_of(path: Path, name: str) -> int:
    """Return the line of a method.py that gives METHOD its field `name`; without one, that of METHOD, or 1."""
    with tokenize.open(path) as file:  # in the encoding that it states
        lines = file.read().splitlines()
    begins = next((i for i, line in enumerate(lines) if re.match(r"METHOD\b", line)), 0)
    named = re.compile(rf"\b{re.escape(name)}\s*=[^=]")
    return next((i for i in range(begins, len(lines)) if named.search(lines[i])), begins) + 1


def guarded(method: Method, path: Path) -> Method:
    """Return the method with its functions guarded: what goes wrong in them is a FirsthitError with file and line."""

    def one(name: str) -> Callable[..., Any] | None:
        function: Callable[..., Any] | None = getattr(method, name)
        if function is None:
            return None

        def call(*given: Any) -> Any:
            with _pressed() as pressed:
                try:
                    answer = function(*given)
                except FirsthitError:
                    raise
                except BaseException as error:  # a plugin may fail in any way
                    if isinstance(error, KeyboardInterrupt) and pressed:
                        raise
                    raise FirsthitError(f"{_told(path, error)}, in {name}=...{_ending(error)}", exit_code=3) from error
            if wrong := _wrong_answer(name, answer):
                raise FirsthitError(f"{path}:{line_of(path, name)}: {name} returned {wrong}", exit_code=3)
            return answer

        return call

    functions: dict[str, Any] = {name: one(name) for name in FUNCTIONS}
    return dataclasses.replace(method, **functions)


def _wrong_answer(name: str, answer: Any) -> str | None:
    """Say what a method's function answered that it may not, and what it returns; None where its answer makes sense."""
    if name == "accepts" and not isinstance(answer, str | None):
        return f"{answer!r}; return None for a surface that it can be used on, else a text that says why not"
    if name == "tolerance" and not (is_number(answer) and is_finite(answer)):
        return f"{answer!r}; return the largest error, a finite number of scene units"
    if name == "tables":
        if not isinstance(answer, Mapping):
            return f"{answer!r}; return tables by name, as in {{'NODES': [0.0, 0.5, 1.0]}}"
        for table, values in answer.items():
            if not isinstance(table, str) or not NAME.fullmatch(table):
                return f"a table {table!r}; name it by letters, digits and _, as kernels read it"
            if not isinstance(values, Collection) or len(values) == 0:
                return f"a table {table} that is empty or no list: {values!r}"
            if not all(is_number(value) and is_finite(value) for value in values):
                return f"a table {table} that holds what is no finite number"
    return None


def problem_of(method: Method) -> str | None:
    """Say what in a method's statement can mean nothing, and what to write; None where all of it makes sense.

    The first word of the answer is the field's name.
    """
    if problem := _wrong_kind(method):
        return problem
    if not NAME.fullmatch(method.name):
        return f"name {method.name!r} must be letters, digits and _, and begin with a letter; rename the folder too"
    if problem := _text_problem(method):
        return problem
    libraries = tuple(sorted(path.stem for path in LIBRARIES.glob("*.glsl")))
    named: tuple[tuple[str, str, Sequence[str], Iterable[str]], ...] = (
        ("casts", "way of casting", (method.casts,), CASTS),
        ("precisions", "precision", method.precisions, PRECISIONS),
        ("needs", "generated function", method.needs, GENERATED),
        ("libraries", "kernel library", method.libraries, libraries),
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
    problems = (_knob_problem(parameter) for parameter in method.parameters)
    return next((f"parameters: {problem}" for problem in problems if problem), None)


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
            return f"{name} is {getattr(method, name)!r}; write a text, as in {example}"
    for name, example in LISTS.items():
        value = getattr(method, name)
        if isinstance(value, str | Parameter):
            written = f"({value!r},)" if isinstance(value, str) else "(Parameter(...),)"
            return f"{name} is {value!r}, which is no tuple; write {name}={written}, with the comma"
        if not isinstance(value, tuple | list):
            return f"{name} is {value!r}; write a tuple, as in {example}"
        if name != "parameters" and (other := next((item for item in value if not isinstance(item, str)), None)):
            return f"{name} holds {other!r}; write texts, as in {example}"
    if not isinstance(method.claims, set | frozenset) or not all(isinstance(claim, str) for claim in method.claims):
        return f"claims is {method.claims!r}; write claims=frozenset({{'no_false_hit'}})"
    if not isinstance(method.settings, Mapping) or not all(isinstance(name, str) for name in method.settings):
        return f"settings is {method.settings!r}; write settings={{'its name': {{'STEPS': 100}}}}"
    if not isinstance(method.answers, bool):
        return f"answers is {method.answers!r}; write True or False"
    for name in FUNCTIONS:
        value = getattr(method, name)
        if not callable(value) and (value is not None or name == "accepts"):
            return f"{name} is {value!r}; give it a function, see class Method in harness/contract.py"
    return None


def _knob_problem(knob: object) -> str | None:
    """Say what in the statement of a knob can mean nothing, and what to write; None where all of it makes sense."""
    if not isinstance(knob, Parameter):
        return f"it holds {knob!r}; give it Parameter(...)"
    if not isinstance(knob.name, str) or not KNOB.fullmatch(knob.name) or name_problem(knob.name):
        return f"the knob {knob.name!r} must be capitals, digits and _, and begin with a capital, since kernels read it"
    for name, value in (("meaning", knob.meaning), ("per", "" if knob.per is None else knob.per)):
        if not isinstance(value, str):
            return f"the knob {knob.name} has {name}={value!r}; write a text"
        if problem := title_problem(value):
            return f"the knob {knob.name} has a {name}: {problem}"
    if knob.finer not in (None, "up", "down"):
        return f"the knob {knob.name} is finer {knob.finer!r}; write up, down or None"
    if not isinstance(knob.sweep, tuple | list):
        return f"the knob {knob.name} has sweep={knob.sweep!r}; write a tuple, as in sweep=({knob.sweep!r},)"
    for number in (knob.default, *knob.sweep, *([] if knob.printed is None else [knob.printed])):
        if not is_number(number) or not is_finite(number):
            return f"the knob {knob.name} has the value {number!r}; give it a finite number"
        if isinstance(knob.default, int) and number != int(number):
            return f"the knob {knob.name} is a whole number, as its default is, and has the value {number!r}"
    return None
