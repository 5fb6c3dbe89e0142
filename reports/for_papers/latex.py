"""Write tables as LaTeX with booktabs, for any engine: what LaTeX would read as a command is escaped.

A numeric column takes two of LaTeX's, one that ends at the decimal point and one that begins there, so that points
stand below each other without a package for it.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Mapping

from harness.escaping import one_line
from reports.content import Column, Table
from reports.for_papers.model import Plate, Tabled

COLUMN = 62  # letters of a line of one column

_SPECIAL = {
    "\\": r"\textbackslash{}",
    "{": r"\{",
    "}": r"\}",
    "$": r"\$",
    "&": r"\&",
    "#": r"\#",
    "%": r"\%",
    "_": r"\_",
    "^": r"\textasciicircum{}",
    "~": r"\textasciitilde{}",
    "<": r"\textless{}",
    ">": r"\textgreater{}",
    "|": r"\textbar{}",
    '"': r"\textquotedbl{}",
    "–": "--",
    "—": "---",
    "…": r"\dots{}",
    "“": "``",
    "”": "''",
    "‘": "`",
    "’": "'",
    "°": r"\textdegree{}",
    "\u00a0": "~",
}
_MATH = {
    "−": "-",
    "×": r"\times",
    "·": r"\cdot",
    "≈": r"\approx",
    "≤": r"\le",
    "≥": r"\ge",
    "±": r"\pm",
    "∞": r"\infty",
    "√": r"\surd",
    "→": r"\to",
    "∇": r"\nabla",
    "∂": r"\partial",
    "✓": r"\surd",
    "α": r"\alpha",
    "β": r"\beta",
    "γ": r"\gamma",
    "δ": r"\delta",
    "ε": r"\varepsilon",
    "θ": r"\theta",
    "λ": r"\lambda",
    "µ": r"\mu",
    "μ": r"\mu",
    "π": r"\pi",
    "ρ": r"\rho",
    "σ": r"\sigma",
    "τ": r"\tau",
    "φ": r"\varphi",
    "ω": r"\omega",
    "Δ": r"\Delta",
}
_RAISED = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹ⁿᵏ", "-0123456789nk")
_LOWERED = str.maketrans("₋₀₁₂₃₄₅₆₇₈₉ₙ", "-0123456789n")
_TOKEN = re.compile("([⁻⁰¹²³⁴⁵⁶⁷⁸⁹ⁿᵏ]+)|([₋₀₁₂₃₄₅₆₇₈₉ₙ]+)|(e[−-]?[0-9]+$)|([-'`,?!–—“”‘’]{2,})|(.)", re.DOTALL)
_NUMBER = re.compile(r"[+−-]?[0-9][0-9,]*")
_EXPONENT = re.compile(r"(?:^|(?<=[\s=(\[,]))([+−-]?[0-9][0-9.,]*)e([−-]?)([0-9]+)$")


def escaped(text: str) -> str:
    """Return `text` as LaTeX that prints it; characters beyond the tables here stay as they are, in UTF-8.

    Signs that cannot be seen are shown, and signs that fonts join, such as --, stay apart.
    """
    return "".join(_one(*found.groups()) for found in _TOKEN.finditer(_scientific(one_line(text))))


def _scientific(text: str) -> str:
    """Write the exponent at the end of a number, 1.2e−7, by a power of ten, 1.2×10⁻⁷."""
    raised = str.maketrans("−-0123456789", "⁻⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
    return _EXPONENT.sub(lambda found: f"{found[1]}×10" + (found[2] + found[3]).translate(raised), text)


def _one(raised: str | None, lowered: str | None, plain: str | None, joined: str | None, character: str | None) -> str:
    """Return what prints one token of a text."""
    if raised:
        return f"$^{{{raised.translate(_RAISED)}}}$"
    if lowered:
        return f"$_{{{lowered.translate(_LOWERED)}}}$"
    if plain:
        return plain.replace("−", "-")
    if joined:
        return "{}".join(_SPECIAL.get(sign, sign) for sign in joined)
    assert character is not None
    if character in _MATH:
        return f"${_MATH[character]}$"
    return " " if character.isspace() and character != "\u00a0" else _SPECIAL.get(character, character)


def aligned(text: str) -> tuple[str, str]:
    """Return the parts of a number's text before and from its decimal point, or what stands in a point's place.

    What is no number, as the dash for a missing one, is all before the point.
    """
    whole = _scientific(text)
    found = _NUMBER.match(whole)
    if found is None:
        return escaped(whole), ""
    return escaped(whole[: found.end()]), escaped(whole[found.end() :])


def table(tabled: Tabled) -> str:
    """Return the tabular of a table, to be \\input into a float; it needs the package booktabs."""
    of = tabled.table
    spec = "".join("r@{}l" if column.numeric else "l" for column in of.columns)
    lines = [rf"\begin{{tabular}}{{@{{}}{spec}@{{}}}}", r"\toprule"]
    lines += _headings(of)
    lines += [r"\midrule"]
    before: tuple[object, ...] | None = None
    for i, row in enumerate(of.rows):
        group = tuple(row[: max(of.group - 1, 1)]) if of.group else None
        if before is not None and group != before:
            lines.append(r"\addlinespace")
        repeated = of.group and group == before
        before = group
        cells = [
            _cell(column, "" if repeated and at < of.group - 1 else value, i in tabled.strong)
            for at, (column, value) in enumerate(zip(of.columns, row, strict=True))
        ]
        opened = "{}" if cells[0][:1] in ("[", "*") else ""  # else the line break before would take it for its own
        lines.append(opened + " & ".join(cells) + r" \\")
    return "\n".join([*lines, r"\bottomrule", r"\end{tabular}", ""])


def _cell(column: Column, value: object, strong: bool) -> str:
    """Write a cell, or the two cells of a number."""
    text = _text(column, value)
    parts = aligned(text) if column.numeric else (escaped(text),)
    return " & ".join(rf"\textbf{{\boldmath {part}}}" if strong and part else part for part in parts)


def _headings(of: Table) -> list[str]:
    """Write the heads of the columns, below those that several share."""
    lines = []
    if any(column.over for column in of.columns):
        cells, rules, at = [], [], 1
        for over, own in itertools.groupby(of.columns, key=lambda column: column.over):
            span = sum(2 if column.numeric else 1 for column in own)
            cells.append(rf"\multicolumn{{{span}}}{{c}}{{{escaped(over)}}}" if over else " & " * (span - 1))
            rules += [rf"\cmidrule(lr){{{at}-{at + span - 1}}}"] if over else []
            at += span
        lines += [" & ".join(cells) + r" \\", " ".join(rules)]
    upright = "\\rotatebox{{90}}{{{}}}" if _rotated(of) else "{}"
    titles = [
        rf"\multicolumn{{2}}{{c}}{{{upright.format(escaped(column.title))}}}"
        if column.numeric
        else escaped(column.title)
        for column in of.columns
    ]
    return [*lines, " & ".join(titles) + r" \\"]


def columns(of: Table) -> int:
    """Return how many columns of LaTeX a table has."""
    return sum(2 if column.numeric else 1 for column in of.columns)


def table_float(of: Tabled, folder: str) -> str:
    """Return the float of a table whose tabular is the file of its name in `folder`; a wide one takes both columns."""
    star = "*" if _width(of.table) > COLUMN else ""
    inside = ["\\centering", "\\footnotesize\\setlength{\\tabcolsep}{4pt}", _caption("tab", of)]
    shown = f"\\input{{{folder}/{of.name}.tex}}"
    return "\n".join([f"\\begin{{table{star}}}[t]", *inside, shown, f"\\end{{table{star}}}", ""])


def figure_float(of: Plate, folder: str) -> str:
    """Return the float of a figure or picture; LaTeX finds the ending of its file in `folder`."""
    shown = f"\\includegraphics[width=\\columnwidth]{{{folder}/{of.name}}}"
    return "\n".join(["\\begin{figure}[t]", "\\centering", shown, _caption("fig", of), "\\end{figure}", ""])


def _caption(kind: str, of: Plate | Tabled) -> str:
    """Return the caption and the label of a float."""
    return f"\\caption{{\\textbf{{{escaped(of.title)}}} {escaped(of.caption)}}}\n\\label{{{kind}:{of.name}}}"


def _width(of: Table) -> int:
    """Return about how many letters a line of a table has."""
    rotated = _rotated(of)
    widths = [
        max([0 if rotated and c.numeric else len(c.title), *(len(str(_text(c, row[at]))) for row in of.rows)])
        for at, c in enumerate(of.columns)
    ]
    return sum(widths) + 2 * len(widths)


def _text(column: Column, value: object) -> str:
    """Return what stands in a cell."""
    return value if isinstance(value, str) else column.show(value)


def _rotated(of: Table) -> bool:
    """Tell whether the titles of numeric columns stand upright, since there are many long ones."""
    titles = [column.title for column in of.columns if column.numeric]
    return len(titles) > 3 and max(map(len, titles)) > 10


EXAMPLE: Mapping[str, str] = {
    "head": (
        "% An example of a paper that takes them in; copy the floats that you need.\n"
        "\\documentclass[twocolumn]{article}\n\\usepackage[T1]{fontenc}\n\\usepackage{textcomp,booktabs,graphicx}\n"
        "\\begin{document}\n"
    ),
    "tail": "\\end{document}\n",
}


def example(floats: list[str]) -> str:
    """Return a document that sets these floats, a page for each few, so that LaTeX does not hold too many at once."""
    pages = ["\n".join(floats[at : at + 4]) + "\\clearpage\n" for at in range(0, len(floats), 4)]
    return EXAMPLE["head"] + "\n".join(pages) + EXAMPLE["tail"]
