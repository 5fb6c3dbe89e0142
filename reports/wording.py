"""Write values the way people read them: numbers, shares, counts and lists as text.

Every formatter takes None or NaN as "there is no value" and then returns the dash NONE.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import Any

import pandas as pd

from harness.contract import plural as plural

NONE = "–"
REFUSED = "·"  # in a matrix: the method refuses it
WRONG_RAYS = {  # what a sentence calls wrong rays, by their kind
    "misses": "misses",
    "false_hits": "false hits",
    "exhausted": "rays given up",
    "wrong_root": "wrong roots",
    "invalid": "invalid answers",
}


def absent(value: Any) -> bool:
    """Tell whether a cell of a frame holds no value: None, NaN or pd.NA."""
    return bool(pd.isna(value))


def text(value: Any) -> str:
    """Write any value as str() does."""
    return NONE if absent(value) else str(value)


def number(value: Any) -> str:
    """Write three significant digits and no exponent: 0.0123, 1.23, 123, 1,230."""
    if absent(value):
        return NONE
    if value == 0 or math.isinf(value):
        return "0" if value == 0 else "∞"
    digits = 2 - math.floor(math.log10(abs(float(f"{value:.2e}"))))
    return f"{value:,.{max(digits, 0)}f}"


def factor(value: Any) -> str:
    """Write a ratio as `number` does, with a multiplication sign: 1.23×."""
    return NONE if absent(value) else f"{number(value)}×"


def error(value: Any) -> str:
    """Write two significant digits with an exponent, 1.2e−7; zero is a plain 0."""
    if absent(value):
        return NONE
    if value == 0 or math.isinf(value):
        return "0" if value == 0 else "∞"
    mantissa, exponent = f"{value:.1e}".split("e")
    return minus(f"{mantissa}e{int(exponent)}")


def short(value: Any) -> str:
    """Write at least two significant digits, and an exponent only for numbers far from 1: 0.12, 57, 1,234, 1.2e−7."""
    if absent(value) or not 0.0095 <= value < 9950:
        return error(value)
    return f"{value:#.2g}".rstrip(".") if value < 99.5 else f"{value:,.0f}"


def level(value: float) -> str:
    """Write a parameter of a family of hard rays: 10⁻⁶, 0.01, 3.5, 1792, 9.5e−7."""
    exponent = math.log10(value) if value > 0 else 0.5
    if abs(exponent) > 2.5 and abs(exponent - round(exponent)) < 1e-9:
        return power_of_ten(round(exponent))
    return f"{value:.{5 if value >= 1 else 2}g}" if 0.001 <= value < 1e5 else error(value)


def square(side: Any) -> str:
    """Write the size of a square picture by its side: 512 × 512."""
    return NONE if absent(side) else f"{side} × {side}"


def hundredths(value: Any) -> str:
    """Write two decimals: −0.25."""
    return NONE if absent(value) else minus(f"{value:.2f}")


def count(value: Any) -> str:
    """Write a whole number with commas: 1,234."""
    return NONE if absent(value) else f"{int(value):,}"


def share(value: Any) -> str:
    """Write a share of one as per cent, with one decimal below 10 %."""
    if absent(value):
        return NONE
    return "< 0.1 %" if 0.0 < value < 0.0005 else f"{100 * value:.{0 if value >= 0.1 else 1}f} %"


def rough(value: Any) -> str:
    """Write a share of one as per cent with one digit, for what is known no better: ≈ 20 %."""
    if absent(value):
        return NONE
    return "< 0.1 %" if 0.0 < value < 0.0005 else f"≈ {100 * float(f'{value:.0e}'):g} %"


def percentage(value: Any) -> str:
    """Write a share of one as per cent with two decimals, as in the papers' tables."""
    return NONE if absent(value) else f"{100 * value:.2f} %"


def whole_percentage(value: Any) -> str:
    """Write a share of one, which may be negative, as per cent without decimals: −8 %."""
    return NONE if absent(value) else minus(f"{100 * value:.0f} %")


def portion(value: Any) -> str:
    """Write a share of one as per cent, rounded down, so that only the whole is 100 %."""
    return NONE if absent(value) else "100 %" if value == 1 else f"{math.floor(1000 * value) / 10:.1f} %"


ZERO = "An error of 0 is of a t within the oracle's certified interval of the root."


def zeros(*columns: Any) -> str:
    """Return the sentence ZERO, with a space before it, where one of these columns of errors holds a 0; else ""."""
    return f" {ZERO}" if any((pd.Series(column).astype("float64") == 0.0).any() for column in columns) else ""


def minus(number: str) -> str:
    """Replace the hyphens of a written number by minus signs."""
    return number.replace("-", "−")


def power_of_ten(exponent: int) -> str:
    """Write 10 with a raised exponent: 10⁻⁶."""
    return raised(10, exponent)


def raised(base: int, exponent: int) -> str:
    """Write a number with a raised exponent: 2⁻¹⁸."""
    return str(base) + str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def listed(names: Sequence[str]) -> str:
    """Join names as a sentence does: a, b and c."""
    return " and ".join(filter(None, (", ".join(names[:-1]), *names[-1:])))


def few(names: Sequence[str], most: int) -> str:
    """Join names as `listed` does: at most so many, and how many more there are."""
    rest = [f"{len(names) - most} more"] if len(names) > most else []
    return listed([*names[:most], *rest])


def first_of(shown: int, total: int) -> str:
    """Return a sentence, with a space before it, that a list is cut to `shown` of `total` rows; "" if it is not."""
    return f" The first {shown:,} of {total:,}; results.csv has all." if shown < total else ""


def excerpt(value: str, limit: int) -> str:
    """Fold a text into one paragraph of at most `limit` characters, without colours and control characters."""
    plain = re.sub(r"\x1b\[[0-9;]*[A-Za-z]", "", value)
    folded = " ".join("".join(c if c.isprintable() else " " for c in plain).split())
    return folded if len(folded) <= limit else folded[: limit - 2].rstrip() + " …"
