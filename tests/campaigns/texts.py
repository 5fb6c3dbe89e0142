"""Put hostile texts into every field, write every output, and read it as those read it who would obey it."""

from __future__ import annotations

import csv
import io
import json
import random
import re
import subprocess
import tomllib
from collections import Counter

from harness import console, escaping, terminal
from harness.commands import machine
from harness.gate import outputs, servers
from harness.gate.about import About
from harness.gate.judge import Change, Judged, Verdict
from reports.for_papers import latex
from surfaces.files import own
from surfaces.visible import joined
from tests import hostile_texts as hostile
from tests.campaigns.frame import Campaign, Fell, Place
from tests.hostile_texts import same

EACH = 25  # texts of a trial
VERDICTS = (Verdict.REGRESSED, Verdict.MISSING, Verdict.INCOMPARABLE)


def _trial(dice: random.Random, place: Place) -> Counter[str]:
    del place
    texts = [hostile.text(dice) for _ in range(EACH)]
    for text in texts:
        for place_of in (_terminal, _server, _xml, _html, _markdown, _csv, _latex, _toml, _json):
            place_of(text)
    _shell(texts)
    _gate(dice, texts)
    return Counter({"read back from every place": EACH})


def _terminal(text: str) -> None:
    table = console.table(("a", text), [(text, "b")])
    if len(table.split("\n")) != 2:
        raise Fell(f"a table of two rows has other lines: {table!r}")
    for told in (escaping.lines(text), escaping.harmless(table), escaping.harmless(text)):
        if found := hostile.commands(told):
            raise Fell(f"a command: {found[0]!r}")
    same(escaping.one_line(text), joined(text), "one_line")
    same(escaping.visible(text), text, "visible")
    same(escaping.lines(text), text.replace("\r\n", "\n"), "lines")
    written = io.StringIO()
    guard = terminal.Guarded(written)
    for piece in (text[: len(text) // 2], text[len(text) // 2 :], "\n"):
        guard.write(piece)
    if found := hostile.commands(written.getvalue()):
        raise Fell(f"the guard lets through {found[0]!r}")
    if found := hostile.commands(escaping.output(text.encode("utf-8", "surrogatepass")).decode()):
        raise Fell(f"a process's line is {found[0]!r}")


def _server(text: str) -> None:
    line = f"::error file={escaping.property_(text)},title={escaping.property_(text)}::{escaping.message(text)}"
    name, properties, message = hostile.command(line)
    if name != "error" or list(properties) != ["file", "title"]:
        raise Fell(f"another command: {line!r}")
    same(properties["title"], text, "property")
    same(message, text.replace("\r\n", "\n"), "message")


def _xml(text: str) -> None:
    element = hostile.read_xml(f"<a b={escaping.attribute(text)}>{escaping.xml(text)}</a>")
    if list(element):
        raise Fell(f"{text!r} made an element")
    same(element.get("b", ""), text, "attribute")
    same(element.text or "", text, "xml")


def _html(text: str) -> None:
    written = f'<p title="{escaping.html(text)}">{escaping.html(text)}</p>{escaping.data(text, [text])}<i></i>'
    page = hostile.Page(written)
    if [tag for tag, _ in page.elements] != ["p", "script", "i"] or page.comments:
        raise Fell(f"{text!r} made elements: {page.elements}")
    same(page.elements[0][1]["title"] or "", text, "title")
    same(page.elements[1][1]["id"] or "", text, "id")
    same("".join(page.texts), text, "html")
    (read,) = json.loads("".join(page.scripts))
    same(read, text, "script")


def _markdown(text: str) -> None:
    shown = escaping.markdown(text)
    kinds, found = hostile.read_markdown(f"## Gate {shown}: x\n\n| a | b |\n| --- | --- |\n| y{shown}z | w |\n")
    if kinds.count("td_open") != 2 or kinds.count("tr_open") != 2 or len(found) != 5:
        raise Fell(f"{text!r} made other cells")
    same(found[3][0], f"y{joined(text)}z".replace("\u00a0", "\u00a0"), "a cell")
    same(found[0][0], f"Gate {joined(text)}: x", "a heading")
    kinds, found = hostile.read_markdown(f"held {escaping.code(text)}.\n\n{escaping.fenced(text)}\n")
    if kinds != ["paragraph_open", "inline", "paragraph_close", "fence"]:
        raise Fell(f"{text!r} made other blocks: {kinds}")
    same(found[1][0], text.replace("\r\n", "\n") + "\n", "a block of code")
    same(found[0][0].removeprefix("held ").removesuffix("."), joined(text) or "  ", "code")


def _csv(text: str) -> None:
    held = io.StringIO()
    csv.writer(held, lineterminator="\n").writerow([escaping.cell(text), "b"])
    (cells,) = csv.reader(io.StringIO(held.getvalue(), newline=""))
    if cells[0][:1] in ("=", "+", "-", "@", "\t", "\r") and not re.fullmatch(
        r"[+-]?[\d.]+(e[+-]?\d+)?|.?inf|.*%", cells[0]
    ):
        raise Fell(f"{text!r} is a formula: {cells[0]!r}")
    same(re.sub("^'(?='*[=+@＝＋－＠-])", "", cells[0]), text, "CSV")


def _latex(text: str) -> None:
    wanted = escaping.one_line(text)
    if re.fullmatch(r"(.*[\s=(\[,])?[+−-]?[0-9][0-9.,]*e[−-]?[0-9]+", wanted, re.DOTALL):  # a number is set as such
        wanted = "×10".join(wanted.rsplit("e", 1))
    read = hostile.read_latex(latex.escaped(text))
    if hostile.typeset(read) != hostile.typeset(wanted):
        raise Fell(f"LaTeX prints {read[:200]!r} for {wanted[:200]!r}")


def _toml(text: str) -> None:
    if any("\ud800" <= c <= "\udfff" for c in text) or ("\r" in text and "\n" in text):
        return  # no TOML holds the one, and a file's own line ends are LF
    if tomllib.loads(f"a = {own._quoted(text)}\nb = 1\n") != {"a": text, "b": 1}:
        raise Fell(f"{text!r} is another in TOML")


def _json(text: str) -> None:
    held = io.StringIO()
    machine._write(held, "plan", 0, None, {"cells": [text]})
    if json.loads(held.getvalue())["cells"] != [text] or hostile.commands(held.getvalue()):
        raise Fell(f"{text!r} is another in JSON, or a command")


def _shell(texts: list[str]) -> None:
    """Let bash read a command of these words; it knows no NUL."""
    words = [text.encode("utf-8", "replace").decode() for text in texts if "\0" not in text]
    command = escaping.shell(words)
    if found := hostile.commands(command.removeprefix("::")):
        raise Fell(f"a printed command has {found[0]!r}")
    ran = subprocess.run(["bash", "-c", f"printf '%s\\0' {command}"], capture_output=True, check=True)
    if ran.stdout.decode().split("\0")[:-1] != words:
        raise Fell(f"bash reads other words of {command!r}")


def _gate(dice: random.Random, texts: list[str]) -> None:
    """Write what a gate found, all of whose texts are hostile."""
    pick = lambda: dice.choice(texts)  # noqa: E731
    change = Change("error_max", pick(), pick(), 1.0, Verdict.REGRESSED)
    rows = [Judged(pick(), pick(), pick(), verdict, pick(), (change,), rule=pick()) for verdict in VERDICTS]
    about = {(row.slot, row.device): About(escaping.shell(["firsthit", pick()]), 1.0, pick()) for row in rows}
    title = pick()
    suite = hostile.read_xml(servers.junit(rows, title, about)).find("testsuite")
    if suite is None or [case.get("name") for case in suite] != [escaping.visible(row.slot) for row in rows]:
        raise Fell("JUnit has other cases")
    for line, row in zip(servers.github(rows, {}, about).split("\n"), rows, strict=True):
        name, properties, message = hostile.command(line)
        same(properties["title"], f"{row.verdict}: {row.slot}", "an annotation's title")
        if name not in ("error", "warning") or escaping.visible(row.slot.replace("\r\n", "\n"), "\n") not in message:
            raise Fell(f"another annotation: {line!r}")
    for width in (None, 70):
        if found := hostile.commands(escaping.harmless(outputs.table(rows, width))):
            raise Fell(f"the table holds a command: {found[0]!r}")
    cleaned = re.sub(r"</?(details|summary)>", "", outputs.markdown(rows, title, pick(), 1, about))
    cleaned = cleaned.replace("**failed**", "failed")
    kinds, found_lines = hostile.read_markdown(cleaned)
    if kinds.count("tr_open") != 1 + len(rows) or "html_block" in kinds or kinds.count("heading_open") != 1:
        raise Fell(f"the summary has other parts: {Counter(kinds)}")
    if f"Gate {escaping.one_line(title)}: failed" not in found_lines[0][0]:
        raise Fell(f"the summary has another title: {found_lines[0]}")


CAMPAIGN = Campaign(
    name="texts",
    tries="puts a hostile text into every place where a text may go",
    promise="no text that becomes markup, code or a command, and none that is lost",
    trial=_trial,
    small=500,
    whole=100_000,
    each=EACH,
    block=20,
    limit=120,
)
