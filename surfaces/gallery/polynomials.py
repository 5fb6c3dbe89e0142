"""Write the families of polynomials that several surfaces are made of, as texts of the formula language.

Chebyshev polynomials fold the line onto itself, the folding polynomials of A2 fold the plane over a deltoid. Their
critical values are few, so that sums of them have many singular points.
"""

from __future__ import annotations


def chebyshev(degree: int, t: str) -> str:
    """Return the Chebyshev polynomial T_degree of the text `t`, nested in t^2 by Horner's rule."""
    before, now = [1], [0, 1]  # coefficients, the lowest power first
    for _ in range(degree - 1):
        twice = [0, *(2 * c for c in now)]
        before, now = now, [c - (before[i] if i < len(before) else 0) for i, c in enumerate(twice)]
    text = f"{now[degree]}*{t}^2"
    for power in range(degree - 2, -1, -2):
        text = f"{text} {'-' if now[power] < 0 else '+'} {abs(now[power])}"
        text = f"{t}^2*({text})" if power > 1 else text
    return f"{t}*({text})" if degree % 2 else text


def doubled(degree: int, t: str) -> str:
    """Return the same polynomial as `chebyshev`, with the angle halved as often as it goes.

    Of degree 20 its values between -1 and 1 keep most of their digits, while nested coefficients of 10^7 cancel.
    """
    if degree % 2 or degree == 2:
        return chebyshev(degree, t)
    return f"2*({doubled(degree // 2, t)})^2 - 1"


def folding(degree: int) -> tuple[str, str]:
    """Return the real and the imaginary part of the folding polynomial of A2 at x + i y.

    It maps e^(ia) + e^(ib) + e^(-i(a+b)) to the same sum of `degree` times the angles, so that those of composed
    degrees are composed. `degree` is a product of twos and threes; raises ValueError for any other.
    """
    real, imaginary = "x", "y"
    while degree % 3 == 0:
        a, b, degree = f"({real})", f"({imaginary})", degree // 3
        real = f"{a}^3 - 3*{a}*{b}^2 - 3*({a}^2 + {b}^2) + 3"
        imaginary = f"3*{a}^2*{b} - {b}^3"
    while degree % 2 == 0:
        a, b, degree = f"({real})", f"({imaginary})", degree // 2
        real, imaginary = f"{a}^2 - {b}^2 - 2*{a}", f"2*{a}*{b} + 2*{b}"
    if degree != 1:
        raise ValueError(f"a folding polynomial is composed of degrees 2 and 3, which leaves {degree}")
    return real, imaginary


def folded(degree: int) -> str:
    """Return Chmutov's surface of A2: twice the folding polynomial's real part, and a Chebyshev polynomial of z.

    The first has the critical values -2 and -3 (and 6 at its corners), the second -1 and 1; the sum is shifted such
    that saddles meet minima, and minima maxima.
    """
    return f"2*({folding(degree)[0]}) + 2 + ({chebyshev(degree, 'z')} + 1)/2"


def folded_nodes(degree: int) -> int:
    """Return the number of nodes of `folded(degree)`, all of them real (Breske, Labs and van Straten)."""
    saddles = degree * (degree - 1) // 2
    minima = degree * (degree - 3) // 3 if degree % 3 == 0 else (degree * (degree - 3) + 2) // 3
    return saddles * (degree // 2) + minima * ((degree - 1) // 2)
