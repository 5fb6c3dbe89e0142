"""What a report says of a method: its docstring's parts, its knobs and claims."""

from __future__ import annotations

import ast
import re
from typing import Any

from harness.plugins import BUILT_IN, Plugin

_PART = re.compile(r"^\*\*(.+?)\*\*", re.MULTILINE)


def card(plugin: Plugin) -> dict[str, Any]:
    """JSON-able: title, source, doc (the docstring's bold parts but Source, by name; a line for each of its points),
    parameters, claims, and of a method from outside the project the folder."""
    method = plugin.method
    text = ast.get_docstring(ast.parse((plugin.folder / "method.py").read_text(encoding="utf-8"))) or ""
    title, *_ = text.split("\n", 1)
    pieces = _PART.split(text)
    doc = {name: _folded(body) for name, body in zip(pieces[1::2], pieces[2::2], strict=True)}
    return {
        "title": title,
        "source": doc.pop("Source", method.source),
        "doc": doc,
        "parameters": [
            {"name": p.name, "default": p.default, "meaning": p.meaning, "printed": p.printed}
            for p in method.parameters
        ],
        "claims": sorted(method.claims),
        "outside": None if plugin.folder.is_relative_to(BUILT_IN) else str(plugin.folder),
    }


def _folded(text: str) -> str:
    """One line for the text and one for each point of its list, which start with "- "."""
    return "\n- ".join(" ".join(part.split()) for part in re.split(r"(?:^|\n)- ", text)).lstrip(" ,.:;\n")
