"""Labels: variants as people write them."""

import pandas as pd
import pytest

from reports import labels

METHODS = {"eft_yuksel": {"label": "EFT Yuksel"}, "null": {"label": "No method"}}


@pytest.mark.parametrize(
    ("variant", "method", "label"),
    [
        ("newton[EPSILON=0.001]", "newton", "Newton, ε = 0.001"),
        ("newton[EPSILON=3e-05]", "newton", "Newton, ε = 3e−5"),
        (
            "eft_yuksel[TOLERANCE=3.8147e-06,LAST=0]+beams",
            "eft_yuksel",
            "EFT Yuksel, tolerance = 2⁻¹⁸, last = 0, behind beams",
        ),
        ("ray_march[STEPS=1000] from the eye", "ray_march", "Ray march, steps = 1,000, from the eye"),
        ("mine[SHIFT=-2]", "mine", "Mine, shift = −2"),
        ("mine[GARBLED]", "mine", "Mine, garbled = "),
        ("Newton 0.001 from the entry", "newton", "Newton 0.001, from the entry"),
        ("null", "null", "No method"),
    ],
)
def test_a_variant_is_written_as_people_write_it(variant: str, method: str, label: str) -> None:
    assert labels.label(variant, method, METHODS) == label


def test_what_all_rays_have_in_common_is_left_out() -> None:
    rows = [
        ("newton", "newton[EPSILON=0.1] from the entry shaded by core_circle", "rays", "entry", "core_circle", True),
        ("polygon", "Polygon 32*32", "mesh", None, "distance", True),
        ("null", "null from the entry", "rays", "entry", "distance", False),
    ]
    frame = pd.DataFrame(rows, columns=["method", "variant", "casts", "origin", "normal", "answers"])
    assert list(labels.labelled(frame, METHODS)["label"]) == ["Newton, ε = 0.1", "Polygon 32*32", "No method"]
    more = [("sturm", "sturm from the eye", "rays", "eye", None, True)]
    frame = pd.concat([frame, pd.DataFrame(more, columns=list(frame))], ignore_index=True)
    assert labels.labelled(frame, METHODS)["label"][0] == "Newton, ε = 0.1, from the entry"
