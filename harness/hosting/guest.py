"""Run a plugin's process: `python -m harness.hosting.guest HANDLE`, which only harness.hosting.host starts.

It reads pickled requests from the connection, and answers each with one line of JSON: {"answer": …}, or {"wrong":
reason, "code": exit code} where the plugin went wrong. Here the plugin's code runs, which may do to this process what
it likes.
"""

from __future__ import annotations

import contextlib
import importlib.util
import json
import os
import pickle
import signal
import sys
from collections.abc import Callable
from dataclasses import asdict, is_dataclass
from pathlib import Path
from typing import Any

from harness.contract import FirsthitError, Method, Parameter
from harness.hosting.process import die_with_parent
from harness.stated import FUNCTIONS, answered, line_of, plain_number, problem_of, shown, stated, told

NO_FUNCTION = Method.__dataclass_fields__["accepts"].default  # what a method has that states none


class Guest:
    """Hold the method that a method.py states, and do what the host asks for."""

    def __init__(self) -> None:
        self._method: Method | None = None
        self._path, self._full = Path(), Path()

    def load(self, path: Path) -> dict[str, Any]:
        """Run a method.py, and return what its METHOD states. Raises FirsthitError, with its line, for any mistake."""
        self._path, self._full = path, path.absolute()
        method = stated(path)
        if not isinstance(method, Method):
            raise FirsthitError(f"{path} does not define METHOD = Method(...)")
        try:
            problem, made = problem_of(method), None
            if problem is None:
                made = _plain(method)
        except BaseException as error:  # a subclass's, or a value's that is compared or shown
            raise FirsthitError(f"{told(path, self._full, error)}, where METHOD is read") from None
        if made is None:
            line = line_of(self._full, str(problem).split()[0].rstrip(":"))
            raise FirsthitError(f"{path}:{line}: {problem}")
        self._method = method
        return made

    def call(self, name: str, given: tuple[Any, ...]) -> Any:
        """Call one of the method's functions. Raises FirsthitError where it goes wrong."""
        function: Callable[..., Any] = getattr(self._method, name)
        return answered(function, name, self._path, self._full, given)

    def places(self, module: str) -> list[str]:
        """Return the folders of a package, which may import those that hold it. Raises whatever these raise."""
        spec = importlib.util.find_spec(module)
        return [str(place) for place in (spec.submodule_search_locations if spec else None) or ()]


def _plain(method: Method) -> dict[str, Any]:
    """Return what a method states as texts, numbers, lists and dicts. Of functions only the names are returned."""
    return {
        **{name: str.__str__(getattr(method, name)) for name in ("name", "source", "label", "casts", "rest")},
        **{name: list(map(str.__str__, getattr(method, name))) for name in ("needs", "libraries", "precisions")},
        "parameters": list(map(_knob, method.parameters)),
        "settings": {
            str.__str__(name): {str.__str__(knob): plain_number(value) for knob, value in values.items()}
            for name, values in method.settings.items()
        },
        "claims": sorted(map(str.__str__, method.claims)),
        "answers": method.answers,
        "functions": [n for n in FUNCTIONS if getattr(method, n) is not None and getattr(method, n) is not NO_FUNCTION],
    }


def _knob(knob: Parameter) -> dict[str, Any]:
    texts = {name: None if (text := getattr(knob, name)) is None else str.__str__(text) for name in ("per", "finer")}
    return {
        "name": str.__str__(knob.name),
        "default": plain_number(knob.default),
        "meaning": str.__str__(knob.meaning),
        "sweep": list(map(plain_number, knob.sweep)),
        "printed": None if knob.printed is None else plain_number(knob.printed),
        **texts,
    }


def _reply(guest: Guest, operation: str, arguments: tuple[Any, ...]) -> bytes:
    """Do what is asked for, and return the line that answers it, whatever happens."""
    try:
        try:
            answer = getattr(guest, operation)(*arguments)
            reply = {"answer": asdict(answer) if is_dataclass(answer) and not isinstance(answer, type) else answer}
        except FirsthitError as error:
            reply = {"wrong": shown(error, 4000, str), "code": 2 if error.exit_code == 2 else 3}
        except BaseException as error:
            reply = {"wrong": f"{type(error).__name__}: {shown(error, 2000, str)}", "code": 3}
        return json.dumps(reply).encode() + b"\n"
    except BaseException:
        return b'{"wrong": "it went wrong in a way that cannot be told", "code": 3}\n'


def serve(handle: int) -> None:
    """Answer requests until the connection closes. A process that the plugin forked ends where it would answer."""
    guest, owner, here = Guest(), os.getpid(), Path.cwd()
    requests = os.fdopen(handle, "rb", closefd=False)
    while True:
        try:
            operation, arguments = pickle.load(requests)
        except (EOFError, OSError):
            return
        reply = _reply(guest, operation, arguments)
        if os.getpid() != owner:
            return
        with contextlib.suppress(BaseException):
            os.chdir(here)
        for stream in (sys.stdout, sys.stderr):
            with contextlib.suppress(BaseException):  # the plugin may have closed it
                stream.flush()
        while reply:
            reply = reply[os.write(handle, reply) :]


def main(handle: str) -> None:
    """Serve the connection whose end this process was given as `handle`, then end at once, whatever is left to do."""
    die_with_parent()
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # who asked decides when to stop
    os.set_inheritable(int(handle), False)
    try:
        serve(int(handle))
    finally:
        os._exit(0)


if __name__ == "__main__":
    main(*sys.argv[1:])
