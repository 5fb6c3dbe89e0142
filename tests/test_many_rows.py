"""What makes reports of very many rows fast gives the same as what is plain."""

from __future__ import annotations

import json

import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.compute as pc
import pytest

from harness import escaping
from harness.results import schema
from reports.analysis import rounds
from reports.reading import export
from reports.reading.taking import taken
from reports.reading.tuples import tuples
from tests.benchmarks import report_speed


@pytest.mark.parametrize(
    "lists",
    [
        [[1.0, 2.5], None, [], [export.ALIKE[0], 12.0, 999_999_999.0, 0.1 + 0.2, 123456.789012345, 1 / 3]],
        [[export.ALIKE[1], 1e12], None],
        [[9e-5], [2.5e-300, 1e22]],
        [[-1.0, 0.0]],
        [[], None],
        [],
    ],
)
def test_lists_of_numbers_are_written_as_json(lists):
    told = [None if one is None else json.dumps(one) for one in lists]
    array = pa.array(lists, pa.list_(pa.float64()))
    assert export._json(array).to_pylist() == told
    assert export._json(array.slice(1)).to_pylist() == told[1:]


def test_what_is_taken_for_a_plain_text_stays_as_it_is_in_csv():
    signs = [chr(code) for code in range(0x180)] + ["\u202e", "＝", "−"]
    texts = [text for sign in signs for text in (sign, f"{sign}1", f"{sign}a", f"a{sign}", f"a{sign}b", f"'{sign}a")]
    plain = pc.match_substring_regex(pa.array(texts), export.PLAIN).to_pylist()
    assert 300 < sum(plain) < len(texts) / 2
    assert all(escaping.cell(text) == text for text, is_plain in zip(texts, plain, strict=True) if is_plain)


def test_named_tuples_are_those_of_pandas():
    frame = pd.DataFrame(
        {"key": ["a", None], "size": pd.array([1, None], "Int64"), "ms": [1.5, float("nan")], "a b": [True, False]},
        index=[7, 3],
    )
    frame["times"] = pd.Series([[1.0], None], frame.index, dtype=object)
    for own, theirs in zip(tuples(frame), frame.itertuples(), strict=True):
        assert repr(tuple(own)) == repr(tuple(theirs)) and own._fields == theirs._fields
        assert list(map(type, own)) == list(map(type, theirs))
    assert type(next(tuples(frame))) is type(next(tuples(frame.head(1)))) and not list(tuples(frame.head(0)))


def test_json_of_a_column_tells_values_apart():
    (field,) = (field for field in schema.SCHEMA if field.name == "parameters")
    flatten = schema.flattener([field])
    values = [{"A": 1}, {"A": 1.0}, {"A": True}, {"A": -0.0}, {"A": 0.0}, {"B": 2, "A": [None]}, {"A": 1}]
    assert [flatten({"parameters": value}) for value in values] == [(json.dumps(v, sort_keys=True),) for v in values]


def test_the_benchmark_tells_how_time_grows():
    told = report_speed.growth({1_000: 12.0, 10_000: 30.0, 100_000: 210.0})
    assert told.startswith("storing and reporting take of a core 10 s and 2.000 ms a row, within 0% of each; ")
    assert told.endswith("from 10,000 to 100,000 rows it grows as the rows to the power of 0.85")


@pytest.mark.parametrize("places", [[3, 4, 5], [5, 3, 4], [0, 9, 4, 4], [7], []])
def test_rows_that_lie_together_are_taken_as_pandas_takes_them(places):
    frame = pd.DataFrame({"key": list("abcdefghij"), "ms": np.arange(10.0), "n": pd.array(range(10), "Int64")})
    frame.index = pd.Index(range(20, 30))
    at = np.array(places, np.intp)
    pd.testing.assert_frame_equal(taken(frame, at), frame.take(at))
    pd.testing.assert_frame_equal(taken(frame, at, ["n", "key"]), frame.take(at)[["n", "key"]])


@pytest.mark.parametrize("count", [1, 2, 7, 8])
def test_no_row_with_a_smaller_median_ratio_is_left_out_as_slower(count):
    rng = np.random.default_rng(count)
    times = [list(rng.choice([0.5, 0.9, 1.0, 1.1], count)) for _ in range(200)]
    told = {"session": ["s"] * 200, "rounds": [json.dumps(list(range(count)))] * 199 + ["[99]"], "samples_ms": times}
    rows = pd.DataFrame(told)
    medians = {first.Index: rounds.medians_over(rows, first) for first in list(tuples(rows))[:5]}
    for place, own in medians.items():
        first = next(tuples(rows.loc[[place]]))
        assert rounds.maybe_faster(rows, first).tolist() == (~(own >= 1.0)).tolist()
        assert np.isnan(own[-1]), "it shares no round with the first"
    assert any((own < 1.0).any() for own in medians.values())
