"""Write what a gate found as a table for people, JUnit XML for CI servers, Markdown, and GitHub annotations."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from xml.sax.saxutils import escape, quoteattr

from harness import console
from harness.gate.judge import ORDER, Judged, Value, Verdict

BAD = (Verdict.REGRESSED, Verdict.MISSING, Verdict.INCOMPARABLE)
HEADER = ("verdict", "cell", "device", "figure", "baseline", "now", "allowed", "")
SHOWN = 40  # rows of one kind that a table lists
REASON = 160  # characters of a reason


def number(value: Value) -> str:
    """Write a figure with six digits at most; a text stays as it is."""
    if isinstance(value, float):
        return f"{value:.6g}"
    return str(value)


def counted(judged: Sequence[Judged]) -> str:
    """Count the rows of each verdict, the worst first: `1 regressed, 12 pass`."""
    counts = Counter(j.verdict for j in judged)
    return ", ".join(f"{counts[verdict]} {verdict}" for verdict in ORDER if counts[verdict]) or "nothing to judge"


def lines(judged: Sequence[Judged]) -> list[tuple[str, ...]]:
    """List what a table says under HEADER, the worst first.

    Every figure that does not pass has a line. So has a row that does not pass although all of its figures do. Of each
    verdict SHOWN rows are listed; one more line counts the others.
    """
    listed: list[tuple[str, ...]] = []
    for verdict in ORDER[:-1]:
        rows = [j for j in judged if j.verdict is verdict]
        for j in rows[:SHOWN]:
            head = (str(verdict), j.slot, j.device)
            changed = [c for c in j.changes if c.verdict is not Verdict.PASS]
            changed.sort(key=lambda c: (ORDER.index(c.verdict), -c.size))
            for change in changed:
                better = " (improved)" if change.verdict is Verdict.IMPROVED is not verdict else ""
                told = (change.figure + better, number(change.before), number(change.now), number(change.allowed))
                listed.append((*head, *told, _short(j.reason)))
            if not changed:
                listed.append((*head, "", "", "", "", _short(j.reason)))
        if len(rows) > SHOWN:
            listed.append((str(verdict), f"and {len(rows) - SHOWN} more", "", "", "", "", "", ""))
    return listed


def _short(reason: str) -> str:
    """Shorten a reason to one line of at most REASON characters.

    A compiler's log begins at the first place that it names in a kernel.
    """
    text = " ".join(reason.split())
    place = re.search(r"\S+\.glsl:\d+", text)
    text = text[place.start() :] if place else text
    return text if len(text) <= REASON else text[: REASON - 2] + " …"


def table(judged: Sequence[Judged]) -> str:
    """Write the lines of every row that does not simply pass as an aligned table, and the count of each verdict."""
    listed = lines(judged)
    return "\n".join(filter(None, (console.table(HEADER, listed) if listed else "", counted(judged))))


def markdown(judged: Sequence[Judged], title: str, baseline: Path | str, code: int) -> str:
    """Write a heading with the outcome, which follows from the exit code `code`, and the table, in Markdown."""

    def cell(text: str) -> str:
        """Escape a text for a cell of a table."""
        return text.replace("\\", "\\\\").replace("|", "\\|").replace("<", "&lt;")

    outcome = {0: "passed", 1: "**failed**"}.get(code, "**could not judge everything**")
    listed = lines(judged)
    text = [f"## Gate {cell(title)}: {outcome}", "", f"{counted(judged)}; baseline `{baseline}`.", ""]
    if listed:
        text += ["| " + " | ".join(HEADER) + " |", "|" + " --- |" * len(HEADER)]
        text += ["| " + " | ".join(map(cell, line)) + " |" for line in listed]
    return "\n".join(text) + "\n"


def junit(judged: Sequence[Judged], title: str) -> str:
    """Write JUnit XML with a test case for each row.

    Regressed and missing rows are failures, and incomparable ones are errors.
    """

    def attribute(text: str) -> str:
        """Quote a text as an attribute, without characters that XML cannot hold."""
        return quoteattr("".join(c if c.isprintable() else " " for c in text))

    failures = sum(j.verdict in (Verdict.REGRESSED, Verdict.MISSING) for j in judged)
    errors = sum(j.verdict is Verdict.INCOMPARABLE for j in judged)
    counts = f'tests="{len(judged)}" failures="{failures}" errors="{errors}"'
    text = ['<?xml version="1.0" encoding="UTF-8"?>', f"<testsuites {counts}>"]
    text.append(f"<testsuite name={attribute(title)} {counts}>")
    for j in judged:
        case = f"<testcase classname={attribute(f'{title}.{j.device}')} name={attribute(j.slot)}"
        if j.verdict in BAD:
            kind = "error" if j.verdict is Verdict.INCOMPARABLE else "failure"
            body = escape("".join(c if c.isprintable() or c == "\n" else " " for c in _told(j)))
            text.append(
                f"{case}><{kind} message={attribute(f'{j.verdict}: {_headline(j)}')}>{body}</{kind}></testcase>"
            )
        else:
            text.append(f"{case}/>")
    return "\n".join([*text, "</testsuite>", "</testsuites>"]) + "\n"


def github(judged: Sequence[Judged], kernels: dict[str, Path]) -> str:
    """Write a workflow command of GitHub for each bad row: a warning where it is incomparable, else an error.

    It is shown at the method's kernel, which `kernels` names, where that lies below the working folder.
    """

    def data(text: str) -> str:
        """Escape a text for a command's message."""
        return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")

    def place(text: str) -> str:
        """Escape a text for a command's property."""
        return data(text).replace(":", "%3A").replace(",", "%2C")

    written = []
    for j in judged:
        if j.verdict not in BAD:
            continue
        path = kernels.get(j.method)
        here = path is not None and path.resolve().is_relative_to(Path.cwd())
        file = f"file={place(path.resolve().relative_to(Path.cwd()).as_posix())}," if path and here else ""
        kind = "warning" if j.verdict is Verdict.INCOMPARABLE else "error"
        written.append(f"::{kind} {file}title={place(f'{j.verdict}: {j.slot}')}::{data(_told(j))}")
    return "\n".join(written)


def _headline(judged: Judged) -> str:
    """Say in one line what is worst of a row."""
    worst = judged.worst
    if worst is None or worst.verdict is Verdict.PASS:
        return judged.reason
    return f"{worst.figure} {number(worst.before)} → {number(worst.now)}, allowed {number(worst.allowed)}"


def _told(judged: Judged) -> str:
    """Say all that was found of a row, a line for each figure that does not pass."""
    changed = [c for c in judged.changes if c.verdict is not Verdict.PASS]
    figures = [f"{c.figure}: {number(c.before)} → {number(c.now)}, allowed {number(c.allowed)}" for c in changed]
    return "\n".join(filter(None, (f"{judged.slot} on {judged.device}: {judged.verdict}", judged.reason, *figures)))
