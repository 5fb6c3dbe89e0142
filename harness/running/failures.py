"""Tell what failed, each mistake once: where it is, what to do, and on which devices and surfaces it was met."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from harness.contract import CellStatus
from harness.kernels.complaints import KERNEL, Complaint, complaints_in, unknown_names
from harness.results.store import Row

WIDTH = 100  # characters of a line
MOST = 4  # further lines of a kernel that are told beneath the first one
ADVICE = {
    CellStatus.TIMEOUT: "look for a loop in the kernel that does not end; if it only needs longer, give it a longer "
    "timeout (--timeout, or budget.timeout of a config)",
    CellStatus.CRASHED: "look for an array that is read or written past its end, or a division of an int by 0; if the "
    "kernel runs on other devices, the driver may be at fault",
}
TOO_MUCH = (
    "take a smaller size, fewer samples a pixel or a smaller table; if the machine has the memory to spare, raise "
    "[budget] memory of the config"
)
COMPILER_DIED = (
    "look for a function that calls itself, which no kernel may, or a very large array; if the kernel compiles on "
    "other devices, the driver may be at fault"
)


@dataclass(frozen=True)
class Failure:
    """Hold one program, cell or check that failed.

    program: what it shares with the same one on other devices
    text: why it failed, as a row's `reason` says it
    """

    method: str
    program: str
    device: str
    precision: str
    surface: str
    text: str
    status: CellStatus = CellStatus.FAILED


def failure_of(row: Row) -> Failure:
    """Return the failure of a row that failed, timed out or crashed."""
    return Failure(
        row["method"],
        str(row["slot"]).removesuffix(f" {row['device']}"),
        row["device"],
        row["precision"],
        row["surface"],
        row["reason"] or "",
        CellStatus(row["status"]),
    )


def first_line(text: str) -> str:
    """Return what a reason says in one line."""
    return text.split("\n", 1)[0]


def mistakes(failures: Iterable[Failure], what: str) -> list[str]:
    """Return a paragraph for each mistake among the failures, in the order of the first; `what` counts them: programs.

    Failures are of one mistake where they say the same or, in a method's kernel, name the same line first. So are those
    of one program on several devices whose compilers refuse it, since each words and places a mistake otherwise.
    """
    groups: list[tuple[set[tuple[str, ...]], list[Failure]]] = []
    for failure in failures:
        keys = _keys(failure)
        joined = [group for group in groups if group[0] & keys]
        if not joined:
            groups.append((keys, [failure]))
            continue
        first = joined[0]
        for other in joined[1:]:
            groups.remove(other)
            first[0].update(other[0])
            first[1].extend(other[1])
        first[0].update(keys)
        first[1].append(failure)
    return [_paragraph(members, what) for _, members in groups]


def _keys(failure: Failure) -> set[tuple[str, ...]]:
    """Return what failures of one mistake share at least one of."""
    if found := complaints_in(failure.text):
        program = ("program", failure.method, failure.program)
        return {("place", failure.method, found[0].file, str(found[0].line)), program}
    return {("text", failure.method, failure.status, _plain(failure))}


def _plain(failure: Failure) -> str:
    """Return a reason without what differs from device to device or from program to program."""
    text = first_line(failure.text).replace(failure.device, "the device")
    return re.sub(r"\d+", "0", text)


def _paragraph(members: Sequence[Failure], what: str) -> str:
    told = [(failure.device, complaint) for failure in members for complaint in complaints_in(failure.text)]
    parts: list[tuple[str, str]]
    if told:
        head, parts = _compilers(told)
    else:
        texts = list(dict.fromkeys(failure.text.strip() for failure in members))
        subject = members[0].method + ("/kernel.glsl" if members[0].status in ADVICE else "")
        head, parts = [f"{subject}: {texts[0]}"], [("also", first_line(text)) for text in texts[1 : MOST + 1]]
        if len(texts) > MOST + 1:
            parts.append(("also", f"{len(texts) - MOST - 1} more that differ in numbers only"))
        if advice := _advice(members[0].status, texts[0]):
            parts.append(("do", advice))
    parts.append(("where", _places(members, what)))
    lines = [_wrapped("", head[0]), *head[1:]]
    return "\n".join([*lines, *(_wrapped(f"    {word:<7}", text) for word, text in parts)])


def _advice(status: CellStatus, text: str) -> str | None:
    """Return what may be done about a failure that no compiler tells of; None where nothing general can be said."""
    if status is CellStatus.CRASHED and " of memory, the limit" in text:
        return TOO_MUCH
    if status is CellStatus.CRASHED and "during build" in text:
        return COMPILER_DIED
    return ADVICE.get(status)


def _compilers(told: Sequence[tuple[str, Complaint]]) -> tuple[list[str], list[tuple[str, str]]]:
    """Return the lines that tell of a kernel's first mistake, and what the compilers say besides."""
    # The earliest line comes first: what follows is mostly its consequence. A column comes with the clearer words.
    device, first = min(told, key=lambda one: (not one[1].file.endswith(KERNEL), one[1].line, one[1].column is None))
    head = [f"{first.place}: {first.words}", *(f"    | {line}" for line in first.shown)]
    seen, also, unknown = {(first.line, _family(device))}, [], unknown_names(first.words)
    for other, complaint in sorted(told, key=lambda one: one[1].line):
        key = (complaint.line, _family(other) if complaint.line == first.line else "")
        new = unknown_names(complaint.words) - unknown  # two names that are unknown in one line are two mistakes
        if (key in seen and not new) or complaint.words == first.words:
            continue
        seen.add(key)
        unknown |= new
        also.append(
            textwrap.shorten(f"line {complaint.line}, {other}: {complaint.words}", WIDTH - 11, placeholder=" …")
        )
    parts = [("also", text) for text in also[:MOST]]
    if len(also) > MOST:
        parts.append(("also", f"{len(also) - MOST} more, in lines that follow"))
    advice = next((complaint.advice for _, complaint in told if complaint.advice), "")
    return head, [*parts, *([("do", advice)] if advice else [])]


def _family(device: str) -> str:
    """Return the language that a device's compiler reads: compilers of one language mostly say the same."""
    return device.partition(":")[0]


def _places(members: Sequence[Failure], what: str) -> str:
    """Say on which devices, in which precisions and on which surfaces something failed, and how often."""
    lists = ([getattr(m, name) for m in members] for name in ("device", "precision", "surface"))
    places = "; ".join(filter(None, (_listed(list(dict.fromkeys(filter(None, values)))) for values in lists)))
    return f"{places}: {len(members)} {what}" if len(members) > 1 else places


def _listed(names: Sequence[str]) -> str:
    """Write names in a row; of many only the first."""
    more = f" and {len(names) - MOST} more" if len(names) > MOST + 1 else ""
    return ", ".join(names[:MOST] if more else names) + more


def _wrapped(head: str, text: str) -> str:
    """Break a text into lines, which are indented as far as `head` reaches."""
    indent = " " * (len(head) or 4)
    return "\n".join(
        textwrap.fill(
            line,
            WIDTH,
            initial_indent=head if i == 0 else indent,
            subsequent_indent=indent,
            break_long_words=False,
            break_on_hyphens=False,
        )
        for i, line in enumerate(text.splitlines() or [""])
    )
