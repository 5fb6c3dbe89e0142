"""Write reports/claims/settings.csv anew from the methods: `python -m tests.stated_settings`.

This module imports no claims, because they cannot be imported while the file lacks a setting that they name.
"""

from __future__ import annotations

import csv
import io
from pathlib import Path

from harness.plugins import find_methods

FILE = Path(__file__).parents[1] / "reports" / "claims" / "settings.csv"


def text() -> str:
    """Return the file's text: the defaults of every method and the knobs of each of its papers' settings."""
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(("method", "setting", "knob", "value"))  # an empty setting stands for the defaults
    for name, plugin in sorted(find_methods().plugins.items()):
        settings = {"": {knob.name: knob.default for knob in plugin.method.parameters}, **plugin.method.settings}
        for setting, knobs in settings.items():
            writer.writerows((name, setting, knob, repr(value)) for knob, value in sorted(knobs.items()))
    return file.getvalue()


if __name__ == "__main__":
    FILE.write_text(text(), encoding="utf-8")
