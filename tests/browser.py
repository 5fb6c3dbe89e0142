"""Drive a real browser in tests: Debian's chromium, by its DevTools protocol over a pipe. No package is needed."""

from __future__ import annotations

import base64
import contextlib
import fcntl
import json
import os
import select
import shutil
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

NAMES = ("chromium", "chromium-browser", "google-chrome")
SECONDS = 120.0  # that one answer may take on a busy machine


def found() -> str | None:
    """Return the path of a chromium; None where there is none."""
    return next(filter(None, map(shutil.which, NAMES)), None)


def _as_pipe(to_read: int, to_write: int) -> None:
    """Give the two pipe ends, in the child process, the descriptors 3 and 4, at which chromium looks for its pipe."""
    os.dup2(to_read, 3)
    os.dup2(to_write, 4)


@contextlib.contextmanager
def opened(profile: Path) -> Iterator[Browser]:
    """Yield a browser whose folder is `profile`; skip the test where there is no chromium."""
    if found() is None:
        pytest.skip("no chromium here; install Debian's package chromium to drive the pages")
    browser = Browser(profile)
    try:
        yield browser
    finally:
        browser.close()


class Browser:
    """Hold one headless tab, and drive it.

    `problems` lists what the page's console called an error or a warning, and uncaught exceptions; `requests` lists the
    addresses that the page asked for.
    """

    def __init__(self, profile: Path) -> None:
        """Start chromium with `profile` as its folder, and open an empty page. Fails where there is no chromium."""
        command = found()
        assert command
        to_read, self._write = os.pipe()
        self._read, to_write = os.pipe()
        held = [fcntl.fcntl(fd, fcntl.F_DUPFD, 50) for fd in (to_read, to_write)]
        self._log = (profile / "chromium.log").open("wb")
        self._process = subprocess.Popen(
            [
                *(command, "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"),
                *("--no-first-run", "--disable-background-networking", "--window-size=1400,1000"),
                *(f"--user-data-dir={profile}", "--remote-debugging-pipe", "about:blank"),
            ],
            stdout=self._log,
            stderr=self._log,
            close_fds=False,
            preexec_fn=lambda: _as_pipe(*held),
        )
        for fd in (to_read, to_write, *held):
            os.close(fd)
        self._pending, self._number, self._session = b"", 0, None
        self.problems: list[str] = []
        self.requests: list[str] = []
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self._session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")

    def close(self) -> None:
        """End chromium."""
        self._process.kill()
        self._process.wait()
        os.close(self._read)
        os.close(self._write)
        self._log.close()

    def call(self, method: str, **parameters: Any) -> Any:
        """Send one command and return its answer. Fails where the answer is an error.

        Events that come before the answer are noted.
        """
        self._number += 1
        number = self._number
        message: dict[str, Any] = {"id": number, "method": method, "params": parameters}
        if self._session:
            message["sessionId"] = self._session
        os.write(self._write, json.dumps(message).encode() + b"\0")
        while True:
            answer = self._next()
            if answer.get("id") == number:
                assert "error" not in answer, answer
                return answer["result"]

    def open(self, page: Path) -> None:
        """Open a file, and wait until it is loaded. Fails after SECONDS."""
        self.call("Page.navigate", url=page.as_uri())
        end = time.monotonic() + SECONDS
        while self.run("document.readyState") != "complete" or self.run("location.protocol") != "file:":
            assert time.monotonic() < end, "the page did not load"
            time.sleep(0.05)

    def look(self, width: int, dark: bool, height: int = 900) -> None:
        """Make the window `width` × `height` CSS pixels, up to 600 wide a phone's, and its colours dark or light."""
        phone = width <= 600
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=phone)
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        self.call("Emulation.setEmulatedMedia", features=[scheme])

    def wait(self, script: str) -> None:
        """Wait until a JavaScript expression is true. Fails after SECONDS."""
        end = time.monotonic() + SECONDS
        while not self.run(script):
            assert time.monotonic() < end, f"never true: {script}"
            time.sleep(0.05)

    def picture(self, path: Path) -> None:
        """Write what the window shows as a PNG file."""
        path.write_bytes(base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"]))

    def run(self, script: str) -> Any:
        """Return the value of a JavaScript expression in the page. Fails where the page raises an exception."""
        result = self.call("Runtime.evaluate", expression=script, returnByValue=True)
        assert "exceptionDetails" not in result, result["exceptionDetails"]
        return result["result"].get("value")

    def point(self, element: str) -> tuple[float, float]:
        """Scroll an element, given as a JavaScript expression, into view; return its middle (x, y) in the window."""
        self.run(f"{element}.scrollIntoView({{block: 'center'}})")
        box = self.run(f"(b => [b.x + b.width / 2, b.y + b.height / 2])({element}.getBoundingClientRect())")
        return box[0], box[1]

    def hover(self, element: str) -> None:
        """Move the pointer onto the middle of an element."""
        x, y = self.point(element)
        self.call("Input.dispatchMouseEvent", type="mouseMoved", x=x - 1, y=y)
        self.call("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y)

    def click(self, element: str) -> None:
        """Click on the middle of an element."""
        self.hover(element)
        x, y = self.point(element)
        for kind in ("mousePressed", "mouseReleased"):
            self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)

    def type(self, element: str, text: str) -> None:
        """Click on an element, and type `text` into it."""
        self.click(element)
        self.call("Input.insertText", text=text)

    def _next(self) -> dict[str, Any]:
        """Read the next message, note it if it is an event, and return it. Fails where chromium ends or is silent."""
        while b"\0" not in self._pending:
            ready, _, _ = select.select([self._read], [], [], SECONDS)
            assert ready, "the browser does not answer"
            part = os.read(self._read, 1 << 16)
            assert part, "the browser ended"
            self._pending += part
        text, _, self._pending = self._pending.partition(b"\0")
        message: dict[str, Any] = json.loads(text)
        self._note(message.get("method", ""), message.get("params", {}))
        return message

    def _note(self, method: str, told: dict[str, Any]) -> None:
        """Keep what an event says of errors and requests."""
        if method == "Runtime.exceptionThrown":
            self.problems.append(json.dumps(told["exceptionDetails"]))
        elif method == "Runtime.consoleAPICalled" and told["type"] in ("error", "warning", "assert"):
            self.problems.append(json.dumps(told["args"]))
        elif method == "Log.entryAdded" and told["entry"]["level"] in ("error", "warning"):
            self.problems.append(told["entry"]["text"])
        elif method == "Network.requestWillBeSent":
            self.requests.append(told["request"]["url"])
