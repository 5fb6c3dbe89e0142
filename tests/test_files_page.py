"""What docs/files.md shows is what happens: its files are written, its commands run, their output compared.

`python -m tests.test_files_page` writes the outputs anew.
"""

from __future__ import annotations

import contextlib
import io
import os
import re
import shlex
import tempfile
from pathlib import Path

from harness.cli import main

PAGE = Path(__file__).parent.parent / "docs" / "files.md"
BLOCK = re.compile(r"^```(\S+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def session(text: str) -> str:
    """Run the commands of a session in the present folder, and return it with what they print."""
    shown = []
    for line in re.findall(r"^\$ firsthit (.*)$", text, re.MULTILINE):
        out = io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
            assert main(shlex.split(line)) == 0, out.getvalue()
        shown.append(f"$ firsthit {line}\n{out.getvalue()}")
    return "\n".join(shown)


def page_as_run(page: str, folder: Path) -> str:
    """Return the page with its blocks as they are when its files are written to a folder and its commands run there."""

    def block(match: re.Match[str]) -> str:
        name, text = match.groups()
        if name == "console":
            text = session(text)
        elif name.endswith("?"):  # a file that a command wrote
            text = (folder / name[:-1]).read_text(encoding="utf-8")
        else:
            (folder / name).write_text(text, encoding="utf-8")
        return f"```{name}\n{text}```"

    here = Path.cwd()
    os.chdir(folder)
    try:
        return BLOCK.sub(block, page)
    finally:
        os.chdir(here)


def test_the_page_of_files_shows_what_happens(tmp_path):
    page = PAGE.read_text(encoding="utf-8")
    assert page_as_run(page, tmp_path) == page


def test_every_form_and_suffix_is_on_the_page():
    from surfaces.files import FORMS, SUFFIXES

    page = PAGE.read_text(encoding="utf-8")
    assert not [form for form in FORMS if f"--as {form}" not in page]
    assert not [suffix for suffix in SUFFIXES if f"`{suffix}`" not in page and suffix != ".mathmod"]


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        PAGE.write_text(page_as_run(PAGE.read_text(encoding="utf-8"), Path(name)), encoding="utf-8")
