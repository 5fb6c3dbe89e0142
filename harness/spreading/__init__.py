"""Spread work that needs no device over processes or machines: chunks go out, and their answers come back in order.

A caller such as the oracle cuts its work into chunks and calls `answers`. A command says once, by `over`, who takes
them: processes of this machine (`pool`), or a cluster. Without that they are answered in this process. How a chunk is
answered never depends on where, so that neither a row nor a truth file says anything of it.

Nothing goes on behind a caller's back: `answers` returns when all chunks are answered, and while it does not run, no
worker does anything. So a timed sample, which is taken between two calls, has no work of ours beside it.
"""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable, Iterator, Sequence
from typing import Protocol, TypeVar

C = TypeVar("C")
A = TypeVar("A")


class Spread(Protocol):
    """Define who takes chunks of work. Threads may call it side by side."""

    @property
    def worth_seconds(self) -> float:
        """Return how many seconds of one process's work are the least that is worth handing out now."""

    def map(self, function: Callable[[C], A], chunks: Sequence[C]) -> list[A]:
        """Return what `function` makes of each chunk, in the chunks' order.

        The function is one of a module's, which workers import by its name; chunks and answers are pickled. When this
        returns or raises, no chunk is being worked on. What the function raises is raised, for the first chunk that
        failed; FirsthitError where a chunk cannot be answered anywhere.
        """


_TAKER: Spread | None = None


@contextlib.contextmanager
def over(spread: Spread | None) -> Iterator[None]:
    """Let `spread` take the chunks of this process, in all of its threads, while the block runs; None: nobody."""
    global _TAKER
    before, _TAKER = _TAKER, spread
    try:
        yield
    finally:
        _TAKER = before


def taker() -> Spread | None:
    """Return who takes the chunks of this process now; None: nobody."""
    return _TAKER


def answers(function: Callable[[C], A], chunks: Sequence[C], setup_seconds: float = 0.0) -> list[A]:
    """Return what `function` makes of each chunk, in the chunks' order.

    Chunks are answered here, one after the other, until what is left is worth handing out by the time that those took.
    Whoever is handed chunks for the first time needs `setup_seconds` more. Raises what the function and Spread.map do.
    """
    found: list[A] = []
    began = time.perf_counter()
    while len(found) < len(chunks):
        left, spread = len(chunks) - len(found), _TAKER
        if spread is not None and found and left > 1:
            expected = (time.perf_counter() - began) / len(found) * left
            if expected > spread.worth_seconds + setup_seconds:
                return found + spread.map(function, chunks[len(found) :])
        found.append(function(chunks[len(found)]))
    return found
