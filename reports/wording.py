"""Numbers as people read them. Every formatter takes None or NaN as "there is none" and prints a dash."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import Any

import pandas as pd

NONE = "–"


def absent(value: Any) -> bool:
    """Whether a cell of a frame holds nothing."""
    return bool(pd.isna(value))


def text(value: Any) -> str:
    return NONE if absent(value) else str(value)


def number(value: Any) -> str:
    """Three significant digits, no exponent: 0.0123, 1.23, 123, 1,230."""
    if absent(value):
        return NONE
    if value == 0 or math.isinf(value):
        return "0" if value == 0 else "∞"
    digits = 2 - math.floor(math.log10(abs(float(f"{value:.2e}"))))
    return f"{value:,.{max(digits, 0)}f}"


def factor(value: Any) -> str:
    return NONE if absent(value) else f"{number(value)}×"


def error(value: Any) -> str:
    """Two significant digits: 1.2e-7; a zero is a plain 0."""
    if absent(value):
        return NONE
    if value == 0 or math.isinf(value):
        return "0" if value == 0 else "∞"
    mantissa, exponent = f"{value:.1e}".split("e")
    return f"{mantissa}e{int(exponent)}".replace("-", "−")


def short(value: Any) -> str:
    """Two significant digits or more of a number of unknown size, with an exponent only far from 1: 0.12, 57, 1,234."""
    if absent(value) or not 0.0095 <= value < 9950:
        return error(value)
    return f"{value:#.2g}".rstrip(".") if value < 99.5 else f"{value:,.0f}"


def level(value: float) -> str:
    """A parameter on a ladder: 10⁻⁶, 0.01, 3.5, 1792, 9.5e−7."""
    exponent = math.log10(value) if value > 0 else 0.5
    if abs(exponent) > 2.5 and abs(exponent - round(exponent)) < 1e-9:
        return power_of_ten(round(exponent))
    return f"{value:.{5 if value >= 1 else 2}g}" if 0.001 <= value < 1e5 else error(value)


def hundredths(value: Any) -> str:
    """Two decimals: −0.25."""
    return NONE if absent(value) else f"{value:.2f}".replace("-", "−")


def count(value: Any) -> str:
    return NONE if absent(value) else f"{int(value):,}"


def share(value: Any) -> str:
    """A share of one as per cent."""
    if absent(value):
        return NONE
    return "< 0.1 %" if 0.0 < value < 0.0005 else f"{100 * value:.{0 if value >= 0.1 else 1}f} %"


def rough(value: Any) -> str:
    """A share of one as per cent that is known to one digit at most: ≈ 20 %."""
    if absent(value):
        return NONE
    return "< 0.1 %" if 0.0 < value < 0.0005 else f"≈ {100 * float(f'{value:.0e}'):g} %"


def percentage(value: Any) -> str:
    """A share of one as per cent with two decimals, as in the papers' tables."""
    return NONE if absent(value) else f"{100 * value:.2f} %"


def portion(value: Any) -> str:
    """A share of one as per cent, rounded down: only what is whole is 100 %."""
    return NONE if absent(value) else "100 %" if value == 1 else f"{math.floor(1000 * value) / 10:.1f} %"


ZERO = "An error of 0 is of a t within the oracle's certified interval of the root."


def zeros(*columns: Any) -> str:
    """What an error of 0 is, as a further sentence, where a value of these columns is one."""
    return f" {ZERO}" if any((pd.Series(column).astype("float64") == 0.0).any() for column in columns) else ""


def power_of_ten(exponent: int) -> str:
    return "10" + str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def plural(n: int, noun: str) -> str:
    return f"{n:,} {noun}" if n == 1 else f"{n:,} {noun}s"


def listed(names: Sequence[str]) -> str:
    """a, b and c"""
    return " and ".join(filter(None, (", ".join(names[:-1]), *names[-1:])))


def excerpt(value: str, limit: int) -> str:
    """One paragraph of at most `limit` characters, without terminal colours and control characters."""
    plain = re.sub(r"\x1b\[[0-9;]*[A-Za-z]", "", value)
    folded = " ".join("".join(c if c.isprintable() else " " for c in plain).split())
    return folded if len(folded) <= limit else folded[: limit - 2].rstrip() + " …"
