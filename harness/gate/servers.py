"""Write what a gate found for CI servers: JUnit XML, and annotations and the step summary of GitHub Actions."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping, Sequence
from pathlib import Path

from harness import escaping
from harness.contract import FirsthitError
from harness.gate.about import About, Place
from harness.gate.judge import Judged, Verdict
from harness.gate.outputs import BAD, changed, number

SHOWN = 10  # annotations of one kind that GitHub shows of one step
MESSAGE = 4000  # characters of an annotation's message
SUMMARY_FILE = "GITHUB_STEP_SUMMARY"  # the variable that names the file of a step's summary
SUMMARY_BYTES = 2**20  # of a step's summary, above which GitHub shows nothing of it
NOTHING = About("")


def junit(judged: Sequence[Judged], title: str, about: Mapping[Place, About]) -> str:
    """Write JUnit XML with a test case for each row.

    Regressed and missing rows are failures, and incomparable ones are errors. A case's time is what checking its cell
    took, in seconds, now or in the earlier run that its property `earlier` tells; its property `command` gets it again.
    """
    failures = sum(j.verdict in (Verdict.REGRESSED, Verdict.MISSING) for j in judged)
    errors = sum(j.verdict is Verdict.INCOMPARABLE for j in judged)
    seconds = sum(about.get((j.slot, j.device), NOTHING).seconds or 0.0 for j in judged)
    counts = f'tests="{len(judged)}" failures="{failures}" errors="{errors}" time="{seconds:.3f}"'
    text = ['<?xml version="1.0" encoding="UTF-8"?>', f"<testsuites {counts}>"]
    text.append(f"<testsuite name={escaping.attribute(title)} {counts}>")
    text += [_case(j, title, about.get((j.slot, j.device), NOTHING)) for j in judged]
    return "\n".join([*text, "</testsuite>", "</testsuites>"]) + "\n"


def _case(judged: Judged, title: str, about: About) -> str:
    """Write the test case of one row."""
    named = f"classname={escaping.attribute(f'{title}.{judged.device}')} name={escaping.attribute(judged.slot)}"
    time = "" if about.seconds is None else f' time="{about.seconds:.3f}"'
    told = {"verdict": str(judged.verdict), "rule": judged.rule, "command": about.command}
    told |= {"earlier": about.earlier or "", "picture": about.picture.as_posix() if about.picture else ""}
    properties = "".join(
        f"<property name={escaping.attribute(name)} value={escaping.attribute(value)}/>"
        for name, value in told.items()
        if value
    )
    text = f"<testcase {named}{time}><properties>{properties}</properties>"
    if judged.verdict in BAD:
        kind = "error" if judged.verdict is Verdict.INCOMPARABLE else "failure"
        message = escaping.attribute(escaping.joined(f"{judged.verdict}: {_headline(judged)}"))
        text += f"<{kind} message={message}>{escaping.xml(_told(judged, about))}</{kind}>"
    if about.picture:  # as GitLab and Jenkins look for files that belong to a test case
        text += f"<system-out>{escaping.xml(f'[[ATTACHMENT|{about.picture.as_posix()}]]')}</system-out>"
    return f"{text}</testcase>"


def github(judged: Sequence[Judged], kernels: Mapping[str, Path], about: Mapping[Place, About]) -> str:
    """Write a workflow command of GitHub for each bad row: a warning where it is incomparable, else an error.

    It is shown at the method's kernel, which `kernels` names, where that lies in the repository, at the line that a
    reason names. GitHub shows SHOWN of each kind; one notice counts the others.
    """
    bad = [j for j in judged if j.verdict in BAD]
    kinds = {
        "error": [j for j in bad if j.verdict is not Verdict.INCOMPARABLE],
        "warning": [j for j in bad if j.verdict is Verdict.INCOMPARABLE],
    }
    written = [
        _annotation(kind, j, kernels.get(j.method), about.get((j.slot, j.device), NOTHING))
        for kind, rows in kinds.items()
        for j in rows[:SHOWN]
    ]
    left = [f"{len(rows) - SHOWN} more {kind}s" for kind, rows in kinds.items() if len(rows) > SHOWN]
    if left:
        written.append(f"::notice title=Gate::{' and '.join(left)} are in the step's log and in its summary")
    return "\n".join(written)


def _annotation(kind: str, judged: Judged, kernel: Path | None, about: About) -> str:
    """Write one workflow command."""
    title = escaping.property_(f"{judged.verdict}: {judged.slot}")
    message = escaping.message(_told(judged, about)[:MESSAGE])
    return f"::{kind} {_where(kernel, judged.reason)}title={title}::{message}"


def _where(kernel: Path | None, reason: str) -> str:
    """Return the properties that name a kernel, and the line where the reason names one; "" outside the repository."""
    top = Path(os.environ.get("GITHUB_WORKSPACE") or Path.cwd()).resolve()
    if kernel is None or not kernel.resolve().is_relative_to(top):
        return ""
    line = re.search(re.escape(f"{kernel.parent.name}/{kernel.name}") + r":(\d+)", reason)
    at = f"line={line.group(1)}," if line else ""
    return f"file={escaping.property_(kernel.resolve().relative_to(top).as_posix())},{at}"


def summarize(markdown: str) -> None:
    """Append Markdown to the summary of the step, where GitHub Actions names a file for it.

    Of a text that is too long for GitHub its first lines are taken, and one more line says so. Raises FirsthitError
    where the file cannot be written.
    """
    name = os.environ.get(SUMMARY_FILE)
    if not name:
        return
    path = Path(name)
    try:
        with path.open("ab") as file:
            held = file.tell()  # what the step's earlier commands wrote
            file.write(_fitting("\n" * bool(held) + markdown, SUMMARY_BYTES - held))
    except OSError as error:
        message = f"cannot write {path}, which {SUMMARY_FILE} names: {error.strerror or error}"
        raise FirsthitError(message, exit_code=3) from None


def _fitting(text: str, most: int) -> bytes:
    """Return the lines of a text that fit into `most` bytes as UTF-8, with a line that says what is left out."""
    whole = text.encode()
    if len(whole) <= most:
        return whole
    told = b"\nThe rest is too long for a step's summary; the step's log has the table.\n"
    kept = whole[: max(most - len(told), 0)]
    kept = kept[: kept.rfind(b"\n") + 1]
    return kept + told if len(kept) + len(told) <= most else b""


def _headline(judged: Judged) -> str:
    """Say in one line what is worst of a row."""
    worst = judged.worst
    if worst is None or worst.verdict is Verdict.PASS:
        return judged.reason
    return f"{worst.figure} {number(worst.before)} → {number(worst.now)}, allowed {number(worst.allowed)}"


def _told(judged: Judged, about: About) -> str:
    """Say all that was found of a row: a line for each figure that does not pass, and how to get the row again."""
    rule = f" (rule: {judged.rule})" if judged.rule else ""
    figures = [
        f"{c.figure}: {number(c.before)} → {number(c.now)}, allowed {number(c.allowed)}" for c in changed(judged)
    ]
    earlier = f"checked in an earlier run, {about.earlier}" if about.earlier else ""
    picture = f"wrong rays: {about.picture.as_posix()}" if about.picture else ""
    again = f"again: {about.command}" if about.command else ""
    head = f"{judged.slot} on {judged.device}: {judged.verdict}{rule}"
    return "\n".join(filter(None, (head, judged.reason, *figures, earlier, picture, again)))
