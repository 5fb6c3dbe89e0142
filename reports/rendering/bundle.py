"""Give the JavaScript library that draws charts in a page without network: Vega-Lite, with all that it needs.

vl-convert-python has the library's modules, and joins them into one script in two to three seconds. So the script is
kept in the user's cache folder, below $FIRSTHIT_CACHE or $XDG_CACHE_HOME, for each version of that package.
"""

from __future__ import annotations

import contextlib
import os
import re
from functools import cache
from importlib.metadata import version
from pathlib import Path

import vl_convert

from harness.contract import FirsthitError
from harness.results.writing import write_atomically

_GLOBAL = "window.vegaEmbed=vegaEmbed;"
_END = re.compile(r"window\.vegaEmbed=[\w$]+;$")  # joining the modules shortens their names


@cache
def library() -> str:
    """Return one script that defines the global function vegaEmbed, to be put into a page between script tags.

    It is about 0.9 MB, and the same each time for one version of vl-convert-python.
    """
    kept = _place()
    with contextlib.suppress(OSError, UnicodeDecodeError):
        script = kept.read_text(encoding="utf-8")
        if _END.search(script[-80:]):
            return script
    script = str(vl_convert.javascript_bundle(_GLOBAL)).strip()
    with contextlib.suppress(FirsthitError, OSError):  # it is made again next time
        write_atomically(kept, script.encode())
    return script


def versions() -> str:
    """Name the library and its version, for readers."""
    return f"Vega-Lite {vl_convert.get_vegalite_versions()[-1]}"


def _place() -> Path:
    """Return the file that keeps the script."""
    base = os.environ.get("FIRSTHIT_CACHE") or os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(base) / "firsthit" / f"vega-{version('vl-convert-python')}.js"
