"""Hold other ways to write surfaces of the catalog: `surfaces.get("chmutov:nested")`.

The catalog writes a surface as the paper that it is from prints it. A form is the same polynomial written in another
way. Exact arithmetic cannot tell them apart; rounding and interval extensions can. Name, domain, parameters and facts
are the surface's own. tests/test_forms.py expands every form and compares.

    nested       by Horner's rule, as far as it can be applied
    expanded     as a sum of monomials
    factored     with the common factor of all terms of a variable taken out, and powers kept
    squares      with squares completed, so that each variable occurs once
    toledo2007   as that paper's Equation 1 prints it; the catalog has the form of szente's Table 3
"""

from __future__ import annotations

from surfaces.entries import sum_over_axes

SEPARATOR = ":"  # between a surface's name and a form's

FORMS: dict[str, dict[str, str]] = {
    "chmutov": {
        "nested": sum_over_axes("t*(t^2*(t^2*(64*t^2 - 112) + 56) - 7)", "+ 1"),
        "factored": sum_over_axes("t*(64*t^6 - 112*t^4 + 56*t^2 - 7)", "+ 1"),
    },
    "torus": {
        "toledo2007": "(x^2 + y^2 + z^2 - (r^2 + R^2))^2 - 4*R^2*(r^2 - z^2)",
        "expanded": "x^4 + y^4 + z^4 + 2*x^2*y^2 + 2*x^2*z^2 + 2*y^2*z^2"
        " - 2*(R^2 + r^2)*x^2 - 2*(R^2 + r^2)*y^2 + 2*(R^2 - r^2)*z^2 + (R^2 - r^2)^2",
        "nested": "x^2*(x^2 + 2*(y^2 + z^2 - R^2 - r^2)) + y^2*(y^2 + 2*(z^2 - R^2 - r^2))"
        " + z^2*(z^2 + 2*(R^2 - r^2)) + (R^2 - r^2)^2",
    },
    "tangle": {
        "nested": sum_over_axes("t^2*(t^2 - 5)", "+ 11.8"),
        "squares": sum_over_axes("(t^2 - 2.5)^2", "- 6.95"),
    },
    "klein": {
        "expanded": "x^6 + 3*x^4*y^2 - 2*x^4*y + 3*x^4*z^2 - 3*x^4 + 16*x^3*z + 3*x^2*y^4 - 4*x^2*y^3 + 6*x^2*y^2*z^2"
        " - 10*x^2*y^2 - 4*x^2*y*z^2 + 4*x^2*y + 3*x^2*z^4 - 14*x^2*z^2 + 3*x^2 + 16*x*y^2*z - 32*x*y*z + 16*x*z^3"
        " - 16*x*z + y^6 - 2*y^5 + 3*y^4*z^2 - 7*y^4 - 4*y^3*z^2 + 12*y^3 + 3*y^2*z^4 - 18*y^2*z^2 + 7*y^2 - 2*y*z^4"
        " - 12*y*z^2 - 2*y + z^6 - 11*z^4 + 11*z^2 - 1",
        "nested": "x*(x*(x*(x*(x^2 + y*(3*y - 2) + 3*z^2 - 3) + 16*z) + y*(y*(y*(3*y - 4) - 10) + 4)"
        " + z^2*(y*(6*y - 4) + 3*z^2 - 14) + 3) + z*(y*(16*y - 32) + 16*z^2 - 16))"
        " + y*(y*(y*(y*(y*(y - 2) - 7) + 12) + 7) - 2)"
        " + z^2*(y*(y*(y*(3*y - 4) - 18) - 12) + z^2*(y*(3*y - 2) + z^2 - 11) + 11) - 1",
    },
}
