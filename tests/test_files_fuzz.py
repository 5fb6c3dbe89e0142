"""Readers answer any file in a sentence: no traceback, no hang, nothing that is run, no other file opened.

Files of each format are mutated: bytes, words, lines, and pieces of other formats. FIRSTHIT_FUZZ sets how many files
each reader gets; `python -m tests.test_files_fuzz 100000 [.vm …]` prints what they answered, and the slowest file.
"""

from __future__ import annotations

import builtins
import contextlib
import os
import random
import re
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

import pytest

from harness.contract import FirsthitError
from surfaces import files

from .foreign_files import OTHERS, POLYNOMIALS, WRITERS

COUNT = int(os.environ.get("FIRSTHIT_FUZZ", "150"))
PIECES = (
    *"+-*/^%()[]{}<>=,;:!&|?.#@\"'\\\n\t \0é²√π",
    *("1e999", "1e-400", "9" * 400, "x", "y", "z", "t", "e", "pi", "let ", "if(", "if ", "goto ", "poly ", "surface"),
    *('#include "/etc/passwd"\n', "#while (1)\n", "#declare A = ", "translate ", "rotate 1e9", "scale 0 ", "matrix <"),
    *("union {", "object { A }", "function {", "xyz(", "var-x", "const nan", "compare ", "square ", "DOTSYMBOL"),
    *("__import__('os').system('touch hacked')", "eval(", "exec(", "lambda: 0", "surface_parameter_x=1\n"),
    *("scale_factor=9e9\n", '"Iso3D": {', '"Funct": [', "0/0", "x/0", "2^2^2^2^2^2^99", "(" * 300, "-" * 300),
    *("x^9999", "sqrt(-1)", "log(0)"),
)
OWN = (
    'name = "a"\nformula = """\nlet d = x^2;\nd + y^2 - a"""\ndomain = "sphere:2"\nparameters = { a = 0.5 }\n',
    '[surface.one]\nformula = "x^2 + y - 1"\n[surface.two]\nformula = "x"\ndomain = "box:1,1,1"\n',
)


def seeds() -> dict[str, list[str]]:
    """Return files to begin with, by the suffix of their reader."""
    found: dict[str, list[str]] = {".toml": list(OWN)}
    for suffix, write in WRITERS.values():
        for table in (OTHERS, POLYNOMIALS):
            for name in list(table)[:6]:
                radius, equation, _ = table[name]
                polynomial = table is POLYNOMIALS
                if polynomial or write.__name__ in ("tape", "isosurface", "povray_function"):
                    found.setdefault(suffix, []).append(write(equation, radius))
    return found


def mutated(rng: random.Random, text: str, others: list[str]) -> bytes:
    """Change a text in a few places."""
    for _ in range(rng.choice((1, 1, 2, 3, 8))):
        at = rng.randrange(len(text) + 1)
        to = min(len(text), at + rng.choice((0, 1, 1, 2, 10, 100)))
        match rng.randrange(6):
            case 0:
                text = text[:at] + rng.choice(PIECES) + text[to:]
            case 1:
                text = text[:at] + text[to:]
            case 2:
                words = list(re.finditer(r"\S+", text))
                if len(words) > 1:
                    a, b = rng.sample(words, 2)
                    text = text[: a.start()] + b.group() + text[a.end() :]
            case 3:
                text = text[:to] + text[at:to] * rng.choice((1, 2, 20)) + text[to:]
            case 4:
                lines = text.split("\n")
                rng.shuffle(lines)
                text = "\n".join(lines)
            case 5:
                other = rng.choice(others)
                start = rng.randrange(len(other) + 1)
                text = text[:at] + other[start : start + 60] + text[to:]
    content = text.encode("utf-8", "surrogatepass")
    if rng.random() < 0.1:
        at = rng.randrange(len(content) + 1)
        content = content[:at] + bytes(rng.randrange(256) for _ in range(rng.randrange(1, 5))) + content[at:]
    return content


def answers(suffix: str, count: int, folder: Path, seed: int = 0) -> tuple[Counter[str], float, bytes]:
    """Read mutated files. Return how they were answered, and the slowest file with its seconds.

    Raises what is no FirsthitError.
    """
    rng = random.Random(f"{suffix} {seed}")
    known = seeds()
    everything = [text for texts in known.values() for text in texts]
    told: Counter[str] = Counter()
    slowest, which = 0.0, b""
    path = folder / f"file{suffix}"
    for _ in range(count):
        content = mutated(rng, rng.choice(known[suffix]), everything)
        path.write_bytes(content)
        begin = time.process_time()
        try:
            files.load(path)
            told["read"] += 1
        except FirsthitError as error:
            assert "\n    " not in str(error) or "formula" in str(error)
            told["refused"] += 1
        except BaseException:
            print(f"file: {content!r}", file=sys.stderr)
            raise
        if (took := time.process_time() - begin) > slowest:
            slowest, which = took, content
    return told, slowest, which


@pytest.mark.timeout(120 + COUNT)
@pytest.mark.parametrize("suffix", sorted(seeds()))
def test_no_file_brings_a_reader_down(suffix, tmp_path, monkeypatch):
    opened: list[str] = []
    real = builtins.open

    def watched(name, *rest, **named):
        opened.append(str(name))
        return real(name, *rest, **named)

    monkeypatch.chdir(tmp_path)
    files.load(_first(suffix, tmp_path))  # imports what it needs
    monkeypatch.setattr(builtins, "open", watched)
    told, _, _ = answers(suffix, COUNT, tmp_path)
    assert told["refused"] > 0.1 * COUNT
    assert not [name for name in opened if not name.startswith(str(tmp_path))]
    assert not (tmp_path / "hacked").exists()


def _first(suffix: str, folder: Path) -> Path:
    """Write the first file of a format as it is."""
    path = folder / f"first{suffix}"
    path.write_text(seeds()[suffix][0], encoding="utf-8")
    return path


@pytest.mark.timeout(60)  # each takes under 2 s, and what grows with the square of its length minutes
@pytest.mark.parametrize(
    ("content", "suffix"),
    [
        (b"(" * 1_000_000, ".pic"),
        (b"surface = " + b"x+" * 400_000 + b"x;", ".pic"),
        (b"surface_equation=" + b"-" * 100_000 + b"x", ".jsurf"),
        (b"surface_equation=x" + b"^2" * 50_000, ".jsurf"),
        (b"surface_equation=x" + b"\\\n" * 300_000, ".jsurf"),
        (b"a var-x\n" + b"".join(b"b%d mul a a\n" % i for i in range(59_000)), ".vm"),
        (b"union { " * 50_000, ".pov"),
        (b"#declare A = 1;\n" * 50_000, ".pov"),
        (b"isosurface { function { " + b"pow(" * 3_000 + b"x", ".pov"),
        (b'{"Iso3D": {"Fxyz": ["' + b"x+" * 500_000 + b'x"]}}', ".json"),
        (b'{"a": ' * 50_000, ".json"),
        (b'[{"MathModels": ' * 50_000, ".json"),
        (b"a = [" * 50_000, ".toml"),
        (b'formula = "' + b"x*" * 500_000 + b'x"', ".toml"),
        (b"\xff" * 3_000_000, ".vm"),
    ],
)
def test_large_and_deep_files_are_answered_soon(content, suffix, tmp_path):
    path = tmp_path / f"large{suffix}"
    path.write_bytes(content)
    with contextlib.suppress(FirsthitError):
        files.load(path)


def main() -> None:
    count = int(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        for suffix in sys.argv[2:] or sorted(seeds()):
            begin = time.perf_counter()
            told, slowest, which = answers(suffix, count, Path(folder), seed=1)
            print(
                f"{suffix}: {dict(told)}, {time.perf_counter() - begin:.0f} s, the slowest {slowest:.2f} s", flush=True
            )
            print(f"    {which[:200]!r}", flush=True)


if __name__ == "__main__":
    main()
