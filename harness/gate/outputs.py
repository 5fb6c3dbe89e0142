"""Write what a gate found for people: a table for the terminal, and Markdown. `servers` writes it for CI servers."""

from __future__ import annotations

import re
import textwrap
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import astuple, dataclass

from harness import console, escaping
from harness.gate.about import About, Place
from harness.gate.comparable import Rule
from harness.gate.judge import ORDER, Change, Judged, Value, Verdict

BAD = (Verdict.REGRESSED, Verdict.MISSING, Verdict.INCOMPARABLE)
HEADER = ("verdict", "cell", "device", "rule", "figure", "before", "now", "allowed", "reason")
SHOWN = 40  # rows of one kind that a table lists
REASON = 160  # characters of a reason
INDENT = " " * 4  # of what stands below a cell's name


@dataclass(frozen=True)
class Line:
    """Hold one line of a table, under HEADER: one figure of a row, or a row without one."""

    verdict: str
    cell: str
    device: str = ""
    rule: str = ""
    figure: str = ""
    baseline: str = ""
    now: str = ""
    allowed: str = ""
    reason: str = ""


def number(value: Value) -> str:
    """Write a figure with six digits at most; a text stays as it is."""
    if isinstance(value, float):
        return f"{value:.6g}"
    return str(value)


def counted(judged: Sequence[Judged]) -> str:
    """Count the rows of each verdict, the worst first, and those held by last bits: `1 regressed, 12 pass`."""
    counts = Counter(j.verdict for j in judged)
    told = ", ".join(f"{counts[verdict]} {verdict}" for verdict in ORDER if counts[verdict]) or "nothing to judge"
    loosely = sum(j.rule == Rule.LAST_BITS for j in judged)
    return told + f" ({loosely} of {len(judged)} held by {Rule.LAST_BITS})" * bool(loosely)


def changed(judged: Judged) -> list[Change]:
    """Return the changes of a row that do not pass, the worst first."""
    found = [c for c in judged.changes if c.verdict is not Verdict.PASS]
    return sorted(found, key=lambda c: (ORDER.index(c.verdict), -c.size))


def lines(judged: Sequence[Judged]) -> list[Line]:
    """List what a table says, the worst first.

    Every figure that does not pass has a line; the row's reason stands in its first one. A row that does not pass
    although all of its figures do has a line too. Of each verdict SHOWN rows are listed; one more line counts the
    others.
    """
    listed: list[Line] = []
    for verdict in ORDER[:-1]:
        rows = [j for j in judged if j.verdict is verdict]
        for j in rows[:SHOWN]:
            head, reason = (str(verdict), j.slot, j.device, j.rule), _short(j.reason)
            for i, change in enumerate(changed(j)):
                better = " (improved)" if change.verdict is Verdict.IMPROVED is not verdict else ""
                told = (change.figure + better, number(change.before), number(change.now), number(change.allowed))
                listed.append(Line(*head, *told, reason if i == 0 else ""))
            if not changed(j):
                listed.append(Line(*head, reason=reason))
        if len(rows) > SHOWN:
            listed.append(Line(str(verdict), f"and {len(rows) - SHOWN} more"))
    return listed


def _short(reason: str) -> str:
    """Shorten a reason to one line of at most REASON characters.

    A compiler's log begins at the first place that it names in a kernel, and lines of the kernel itself, which it
    quotes behind a bar, are left out.
    """
    kept = [line for line in reason.split("\n") if not line.lstrip().startswith("|")]
    text = " ".join(word for line in kept for word in line.strip("\r").split(" ") if word)
    place = re.search(r"\S+\.glsl:\d+", text)
    text = text[place.start() :] if place else text
    return text if len(text) <= REASON else text[: REASON - 2] + " …"


def table(judged: Sequence[Judged], width: int | None = None) -> str:
    """Write the lines of every row that does not simply pass, and the count of each verdict.

    They are an aligned table, a line for each figure. Where that is wider than `width` columns, each row has its name
    on a line of its own, and below it its figures; None: any width will do.
    """
    listed = lines(judged)
    text = console.table(HEADER, [astuple(line) for line in listed]) if listed else ""
    if width is not None and any(len(line) > width for line in text.splitlines()):
        text = _stacked(listed, width)
    return "\n".join(filter(None, (text, counted(judged))))


def _stacked(listed: Sequence[Line], width: int) -> str:
    """Write each row's verdict, cell, device and rule, and below them its figures and the reason."""
    text: list[str] = []
    for (verdict, cell, device, rule), own in _rows(listed).items():
        reason = own[0].reason
        figures = [
            (line.figure, line.baseline, "→", line.now, f"allowed {line.allowed}") for line in own if line.figure
        ]
        head = f"{verdict}  {cell}" + f" on {device}" * bool(device) + f" (rule: {rule})" * bool(rule)
        text += wrapped(escaping.one_line(head), width, "")
        if figures:
            text += [f"{INDENT}{line}" for line in console.table(figures[0], figures[1:]).splitlines()]
        text += wrapped(escaping.one_line(reason), width, INDENT)
    return "\n".join(text)


def _rows(listed: Sequence[Line]) -> dict[tuple[str, str, str, str], list[Line]]:
    """Gather the lines of each row, by its verdict, cell, device and rule."""
    rows: dict[tuple[str, str, str, str], list[Line]] = {}
    for line in listed:
        rows.setdefault((line.verdict, line.cell, line.device, line.rule), []).append(line)
    return rows


def wrapped(text: str, width: int, indent: str) -> list[str]:
    """Break a text into lines of at most `width` columns; "" has none."""
    return textwrap.wrap(text, max(width, 40), initial_indent=indent, subsequent_indent=indent + INDENT)


def markdown(judged: Sequence[Judged], title: str, held: str, code: int, about: Mapping[Place, About]) -> str:
    """Write a heading with the outcome, which follows from the exit code `code`, and the table, in Markdown.

    `held` names what the rows are held against. Below the table stands how to get each bad row again, and the picture
    of its wrong rays.
    """
    outcome = {0: "passed", 1: "**failed**"}.get(code, "**could not judge everything**")
    told = f"{counted(judged)}; held against {escaping.code(held)}."
    text = [f"## Gate {escaping.markdown(title)}: {outcome}", "", told, ""]
    listed = lines(judged)
    if listed:
        text += ["| " + " | ".join(HEADER) + " |", "|" + " --- |" * len(HEADER)]
        text += ["| " + " | ".join(escaping.markdown(part) for part in astuple(line)) + " |" for line in listed]
        text += ["", *_again([j for j in judged if j.verdict in BAD], about)]
    return "\n".join(text).rstrip("\n") + "\n"


def _again(bad: Sequence[Judged], about: Mapping[Place, About]) -> list[str]:
    """Write the command of each bad row, and where its picture lies, in a part that a reader unfolds."""
    told = [(j, about[j.slot, j.device]) for j in bad[:SHOWN] if (j.slot, j.device) in about]
    if not told:
        return []
    text = ["<details><summary>Run one row again</summary>", ""]
    for j, own in told:
        text.append(f"- {j.verdict}: {escaping.markdown(j.slot)} on {escaping.markdown(j.device)}  ")
        text.append(f"  {escaping.code(own.command)}" + ("  " if own.picture else ""))
        if own.picture:
            text.append(f"  wrong rays: {escaping.code(own.picture.as_posix())}")
    return [*text, "", "</details>"]
