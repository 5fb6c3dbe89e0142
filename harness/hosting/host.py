"""Ask a plugin's process, and give up on one that ends, takes too long or holds too much memory."""

from __future__ import annotations

import contextlib
import json
import os
import pickle
import selectors
import signal
import subprocess
import sys
import time
import weakref
from collections.abc import Callable
from dataclasses import replace
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

from harness import escaping
from harness.contract import FirsthitError, MeshRecipe, Method, Parameter
from harness.hosting import process
from harness.memory import WATCHED_SECONDS, TooMuch, Watch
from harness.stated import ENDING, MOST_SHOWN, line_of, plain_answer

LOAD_SECONDS = 30.0  # for a process to start and to run a method.py, with what that imports
CALL_SECONDS = 60.0  # for one call of a method's function, as a step on a device has by default
STOP_SECONDS = 0.5  # for a process that closed its connection to end
MOST_ENDS = 3  # how often a process may end before nothing more is asked of its plugin
MOST_BYTES = 16 * 2**20  # of one answer
MOST_SAID = 64 * 2**10  # bytes that a process may print; what comes after is thrown away
STREAMS: dict[str, Any] = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}


class _Gone(Exception):
    """Say why a process does not answer; `last`: nothing more is to be asked of its plugin."""

    def __init__(self, why: str, last: bool) -> None:
        super().__init__(why)
        self.last = last


class _Process:
    """Hold a plugin's process, which runs until this object goes away or the process itself ends."""

    def __init__(self, about: str) -> None:
        own = STREAMS if sys.platform == "win32" else {**STREAMS, "process_group": 0}
        self._process, self._pipe = process.start("harness.hosting.guest", [], f"the process of {about}", own)
        self._about, self._said = about, 0
        self._watch, self._line = Watch(self._process.pid), b""
        self._output: int = self._process.stdout.fileno()
        for handle in (self._pipe.fileno(), self._output):
            os.set_blocking(handle, False)
        self.end: Callable[[], object] = weakref.finalize(self, _end, self._process, self._pipe)

    def ask(self, operation: str, arguments: tuple[Any, ...], seconds: float) -> Any:
        """Return the answer to a request. Raises FirsthitError where it says what is wrong, and _Gone without one."""
        request, reply, pipe = pickle.dumps((operation, arguments)), bytearray(), self._pipe.fileno()
        end = time.monotonic() + seconds
        while not reply.endswith(b"\n"):
            readable, writable = _ready(pipe, self._output, bool(request))
            self._hand_on()
            try:
                if writable:
                    request = request[os.write(pipe, request[: 2**16]) :]
                if pipe in readable:
                    part = os.read(pipe, 2**16)
                    if not part:
                        raise _Gone(self._how_it_ended(), last=False)
                    reply += part
            except BlockingIOError:
                pass
            except OSError:
                raise _Gone(self._how_it_ended(), last=False) from None
            if len(reply) > MOST_BYTES:
                raise _Gone(f"answered with more than {MOST_BYTES // 2**20} MB", last=True)
            if not readable and self._process.poll() is not None:  # a process that it forked holds the connection
                raise _Gone(self._how_it_ended(), last=False)
            if time.monotonic() > end:
                raise _Gone(f"took longer than {seconds:g} s", last=True)
            try:
                self._watch.look()
            except TooMuch:
                told = f"held more than {self._watch.share:g} of this machine's memory"
                raise _Gone(told, last=True) from None
        self._hand_on(last=True)
        return _read(bytes(reply))

    def _how_it_ended(self) -> str:
        """Say how the process ended, which closed the connection."""
        try:
            code = self._process.wait(STOP_SECONDS)
        except subprocess.TimeoutExpired:
            return "closed the connection to firsthit"
        how = f"signal {signal.Signals(-code).name}" if code < 0 else f"exit code {code}"
        return f"ended its process, with {how}"

    def _hand_on(self, last: bool = False) -> None:
        """Write on standard error the lines that the process has printed so far, escaped; of very much the beginning.

        With `last` a line that has no end yet is written too.
        """
        with contextlib.suppress(OSError):  # nothing more is there
            while part := os.read(self._output, 2**16):
                self._line += part[: max(0, MOST_SAID - self._said)]
                if self._said < MOST_SAID <= self._said + len(part):
                    self._line += f"\nfirsthit: {self._about} prints more, which is left out\n".encode()
                self._said += len(part)
        *whole, self._line = self._line.split(b"\n")
        if last and self._line:
            whole, self._line = [*whole, self._line], b""
        for line in whole:
            print(escaping.output(line).decode(), end="", file=sys.stderr)


def _ready(pipe: int, output: int, asks: bool) -> tuple[set[int], bool]:
    """Wait a moment for what can be read, and tell whether `pipe` can be written to, if that is asked."""
    with selectors.DefaultSelector() as selector:  # select.select takes no file numbers above 1023
        selector.register(pipe, selectors.EVENT_READ | (selectors.EVENT_WRITE if asks else 0))
        selector.register(output, selectors.EVENT_READ)
        found = {key.fd: events for key, events in selector.select(WATCHED_SECONDS)}
    readable = {file for file, events in found.items() if events & selectors.EVENT_READ}
    return readable, bool(found.get(pipe, 0) & selectors.EVENT_WRITE)


def _end(started: subprocess.Popen[bytes], pipe: Connection) -> None:
    """Kill a plugin's process, with those that it started in its group."""
    pipe.close()
    with contextlib.suppress(OSError):
        if sys.platform == "win32":
            started.kill()
        else:
            os.killpg(started.pid, signal.SIGKILL)
    started.wait()
    if started.stdout:
        started.stdout.close()


def _read(reply: bytes) -> Any:
    """Return what a line of JSON answers. Raises FirsthitError with what it says is wrong, or where it is none."""
    try:
        told = json.loads(reply)
        if b"\\ud" in reply:
            told = _encodable(told)
        if "wrong" in told:
            wrong = FirsthitError(str(told["wrong"])[: 2 * MOST_SHOWN], 2 if told["code"] == 2 else 3)
        else:
            return told["answer"]
    except (ValueError, TypeError, KeyError, RecursionError):
        raise FirsthitError("its process answered what is no answer", exit_code=3) from None
    raise wrong


def _encodable(value: Any) -> Any:
    """Return a value of JSON without halves of characters, which cannot be written."""
    if isinstance(value, str):
        return value.encode("utf-8", "backslashreplace").decode()
    if isinstance(value, list):
        return list(map(_encodable, value))
    return {_encodable(k): _encodable(v) for k, v in value.items()} if isinstance(value, dict) else value


class Host:
    """Hold the process of one method.py, or of one entry point's package, and start it again where it ended.

    about: what the process is of, as people are told
    """

    def __init__(self, about: str) -> None:
        self._about, self._path = about, Path()
        self._ends, self._given_up = 0, ""
        self._process: _Process | None = None
        self._fresh = True

    def begin(self) -> None:
        """Start the process, so that it is ready when it is asked. Raises FirsthitError if it cannot be started."""
        self._process = _Process(self._about)

    def close(self) -> None:
        """End the process; it is started again where something more is asked."""
        if self._process:
            self._process.end()
        self._process, self._fresh = None, True

    def places(self, module: str) -> list[Path]:
        """Return the folders of a package. Raises FirsthitError where looking for it goes wrong."""
        found = self._ask("places", (module,), LOAD_SECONDS, lambda why: f"it {why} while it was looked for")
        return [Path(place) for place in found] if isinstance(found, list) else []

    def load(self, path: Path) -> Method:
        """Return the METHOD that a method.py states, whose functions are called in the process.

        The process ends at once where there are none. Raises FirsthitError, with file and line, for any mistake.
        """
        self._path = path
        plain = self._load()
        try:
            functions: dict[str, Any] = {str(n): self._function(str(n)) for n in plain.pop("functions")}
            knobs = [Parameter(**knob | {"sweep": tuple(knob["sweep"])}) for knob in plain.pop("parameters")]
            tuples = {name: tuple(plain.pop(name)) for name in ("needs", "libraries", "precisions")}
            stated: dict[str, Any] = {**plain, **tuples, "claims": frozenset(plain.pop("claims"))}
            made = Method(**stated, parameters=tuple(knobs))
            made = replace(made, **functions)
        except (KeyError, TypeError, AttributeError):
            raise FirsthitError(f"{path}: its process answered what is no method") from None
        if not functions:
            self.close()
        return made

    def _load(self) -> Any:
        def said(why: str) -> str:
            return f"{self._path}: it {why}{ENDING if why.startswith('ended') else ''}"

        found = self._ask("load", (self._path,), LOAD_SECONDS, said)
        self._fresh = False
        return found

    def _function(self, name: str) -> Callable[..., Any]:
        """Return the function that calls one of the method's in its process."""

        def said(words: str) -> str:
            return f"{self._path}:{line_of(self._path, name)}: {words}"

        def call(*given: Any) -> Any:
            if self._process is None or self._fresh:
                self._load()
            answer = self._ask("call", (name, given), CALL_SECONDS, lambda why: said(f"{name}=... {why}"))
            if name == "mesh" and isinstance(answer, dict):
                answer = MeshRecipe(answer.get("kind"), answer.get("resolution"))  # type: ignore[arg-type]
            answer, wrong = plain_answer(name, answer)  # as in the process, whose checks the plugin may have changed
            if wrong:
                raise FirsthitError(said(f"{name} returned {wrong}"), exit_code=3)
            return answer

        return call

    def _ask(self, operation: str, arguments: tuple[Any, ...], seconds: float, said: Callable[[str], str]) -> Any:
        """Ask the process, which is started if none runs. `said` makes a reason of how it went wrong.

        Raises FirsthitError with exit code 3 if there is no answer, and what the answer says is wrong. Of a plugin
        whose process took too long or ended MOST_ENDS times nothing more is asked.
        """
        if self._given_up:
            raise FirsthitError(self._given_up, exit_code=3)
        if self._process is None:
            self.begin()
        assert self._process
        try:
            return self._process.ask(operation, arguments, seconds)
        except _Gone as gone:
            self.close()
            self._ends += 1
            reason = said(str(gone))
            if gone.last or self._ends >= MOST_ENDS:
                self._given_up = f"{reason}; nothing more is asked of it"
            raise FirsthitError(self._given_up or reason, exit_code=3) from None
