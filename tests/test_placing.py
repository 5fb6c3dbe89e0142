"""Test the places of labels: none on another, none on a mark, none outside, and the same every time."""

from __future__ import annotations

import numpy as np
import pytest

from reports.drawing import placing

AREA = (0.0, 0.0, 240.0, 130.0)


def _overlap(a: tuple[float, ...], b: tuple[float, ...]) -> bool:
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


@pytest.mark.parametrize("seed", range(6))
def test_labels_keep_clear_of_each_other_of_marks_and_of_the_edge(seed: int) -> None:
    rng = np.random.default_rng(seed)
    at = rng.uniform((5, 5), (235, 125), (12, 2))
    at[:4] = at[0] + rng.uniform(-5, 5, (4, 2))  # a crowd, as of the settings of one method
    sizes = np.stack([rng.uniform(25, 95, 12), np.full(12, 7.0)], axis=1)
    places = placing.place(at, sizes, AREA)
    boxes = [(p.x, p.y, p.x + w, p.y + h) for p, (w, h) in zip(places, sizes, strict=True) if p is not None]
    assert len(boxes) >= 10
    for i, box in enumerate(boxes):
        assert box[0] >= 0 and box[1] >= 0 and box[2] <= 240 and box[3] <= 130
        assert not any(_overlap(box, other) for other in boxes[:i])
        assert not any(box[0] < x < box[2] and box[1] < y < box[3] for x, y in at)
    assert places == placing.place(at, sizes, AREA)


def test_the_last_labels_go_where_there_is_no_room() -> None:
    at = np.full((30, 2), 60.0) + np.arange(30)[:, None]
    places = placing.place(at, np.full((30, 2), (60.0, 8.0)), (0.0, 0.0, 130.0, 130.0))
    assert places[0] is not None
    assert None in places


def test_a_lone_label_stands_beside_its_mark_without_a_leader() -> None:
    (place,) = placing.place([(50.0, 50.0)], [(30.0, 7.0)], AREA)
    assert place is not None and place.leader is None
    assert place.x > 50.0 and place.y < 50.0 < place.y + 7.0


def test_a_label_that_must_go_far_has_a_leader() -> None:
    ring = [(50.0 + 6 * np.cos(a), 50.0 + 6 * np.sin(a)) for a in np.linspace(0, 2 * np.pi, 12, endpoint=False)]
    (place,) = placing.place([(50.0, 50.0)], [(30.0, 7.0)], AREA, marks=ring)
    assert place is not None and place.leader is not None


def test_a_longer_text_is_wider() -> None:
    assert placing.text_size("Newton, ε = 0.001", 7)[0] > placing.text_size("Newton", 7)[0] > 20
