"""Random formulas: tests/fuzz_formulas.py runs longer when asked, and finds what is planted."""

from __future__ import annotations

import os
import random
import subprocess
import sys
from collections import Counter
from pathlib import Path

import mpmath
import pytest

from surfaces import formula
from surfaces.tape import Tape
from tests import fuzz_path
from tests.fuzz_formulas import fuzz, wrong
from tests.made_formulas import Maker

FUZZ = int(os.environ.get("FIRSTHIT_FUZZ", "1"))  # times as many formulas
ROOT = Path(__file__).parent.parent


@pytest.mark.timeout(120 + 60 * FUZZ)
def test_random_formulas_are_read_or_refused() -> None:
    command = [sys.executable, "-m", "tests.fuzz_formulas", "--count", str(3000 * FUZZ), "--seed", "7"]
    command += ["--limit", "60"]  # a hang; how long formulas take says the script, on a machine that does nothing else
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "with the right value" in done.stdout


@pytest.mark.timeout(120 + 60 * FUZZ)
def test_random_formulas_go_all_the_way_to_kernel_text_and_certified_hits() -> None:
    command = [sys.executable, "-m", "tests.fuzz_path", "--count", str(60 * FUZZ), "--seed", "7"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "taken all the way" in done.stdout


def test_the_fuzz_of_the_way_sees_what_it_looks_for(monkeypatch: pytest.MonkeyPatch) -> None:
    def found(planted: str) -> str:
        return str(fuzz_path.wrong(planted, "sphere:1.5", random.Random(1), Counter(), Counter()))

    assert found("x^2 + y^2 + z^2 - 1") == found("x +") == "None"
    monkeypatch.setattr(formula, "canonical", lambda _tape: "x + 1")
    assert "canonical ended in AssertionError" in found("x + 2")
    monkeypatch.undo()
    monkeypatch.setattr(fuzz_path, "domain_text", lambda _domain: "sphere:1.25")
    assert "sphere:1.25 is not its domain" in found("x + 2*y")
    monkeypatch.undo()
    monkeypatch.setattr(fuzz_path, "remark", lambda _surface: 1 / 0)
    assert "extent ended in ZeroDivisionError" in found("x + 2*y")
    monkeypatch.undo()
    monkeypatch.setattr(fuzz_path, "LIMIT", -1.0)
    assert "from_formula took" in found("x + 2*y")


def test_the_fuzz_sees_what_it_looks_for(monkeypatch: pytest.MonkeyPatch) -> None:
    pick = random.Random(1)
    with mpmath.workdps(45):
        made = [Maker(pick).formula() for _ in range(300)]
        seen = Counter[str]()
        assert not [one.text for one in made if wrong(one.text, one, seen)] and seen["with the right value"] > 100
        one = next(
            one for one in made if seen.clear() or (not wrong(one.text, one, seen) and seen["with the right value"])
        )
        one.value += mpmath.mpf(10) ** -10
        assert "has the value" in str(wrong(one.text, one, seen))
    parse = formula.parse

    def planted(text: str, parameters: dict[str, str] | None = None) -> Tape:
        eval("1 + 1")
        return parse(text, parameters)

    monkeypatch.setattr(formula, "parse", planted)
    assert "ran code: ['compile', 'exec']" in fuzz(1, 1, 60.0)[1][0]
    monkeypatch.undo()
    monkeypatch.setattr(formula, "canonical", lambda _tape: "x + 1")
    assert "reads as another graph" in str(wrong("x + 2", None, Counter()))
