"""Put texts and values into HTML so that nothing in them is taken for markup."""

from __future__ import annotations

import html
import json
from typing import Any


def escaped(text: str) -> str:
    """Escape a text for HTML, between tags or between quotes."""
    return html.escape(text, quote=True)


def in_script(value: Any) -> str:
    """Write a value as JSON that can stand between script tags, whatever its texts are; it has ASCII letters alone.

    Raises ValueError where a number is not finite.
    """
    text = json.dumps(value, allow_nan=False, separators=(",", ":"))
    for letter in "<>&":
        text = text.replace(letter, f"\\u{ord(letter):04x}")
    return text


def data(name: str, value: Any) -> str:
    """Return a script element with the id `name` that holds `value` as JSON, for the page's scripts to read."""
    return f'<script type="application/json" id="{escaped(name)}">{in_script(value)}</script>'
