"""x"""

from harness.contract import Method, Parameter

METHOD = Method(
    name="interval_uniform",
    source="beamcasting",
    needs=("surface_range",),
    parameters=(Parameter("BISECTIONS", 1, "ε: the final piece is the domain's depth / 2^(pixels' level + BISECTIONS)"),),
    claims=frozenset({"no_missed_root", "finds_touch"}),
    casts="beams",
)
