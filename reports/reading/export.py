"""Make tables of rows: the pandas frame that a report works on, and its CSV and Parquet files."""

from __future__ import annotations

import itertools
import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pandas as pd
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.csv as pa_csv
import pyarrow.parquet as pq

from harness.escaping import cell
from harness.results import compaction
from harness.results.schema import DERIVED, SCHEMA, Field, Kind
from reports.reading.columns import BATCH, Columns

ACCURACY = frozenset(field.name for field in SCHEMA if field.path[0] == "accuracy")

ALIKE = (1e-4, 1e9)  # between these Arrow writes a number as Python does, but for whole ones
PLAIN = r"^([ -&(-*,./0-9:-<>?A-Z\[\]-`a-z{-~][ -\[\]-~]*)?$"  # a text that CSV holds as it is
_DTYPES: dict[Kind, str] = {
    "text": "object",
    "real": "float64",
    "whole": "Int64",
    "flag": "boolean",
    "json": "object",
    "reals": "object",
}
_ARROW = compaction.arrow_types()


def frame(fields: Sequence[Field], rows: Sequence[tuple[Any, ...]]) -> pd.DataFrame:
    """Make a frame of rows, whose values are in the order of `fields`.

    Its columns keep their kind even where every value is missing.
    """
    columns = zip(*rows, strict=True) if rows else [()] * len(fields)
    return pd.DataFrame({f.name: pd.Series(c, dtype=_DTYPES[f.kind]) for f, c in zip(fields, columns, strict=True)})


def write(
    frame: pd.DataFrame,
    csv: Path,
    parquet: Path,
    more: Sequence[Field] = (),
    bare: Sequence[str] = (),
    rest: Columns | None = None,
) -> None:
    """Write every column of every cell, as CSV and as Parquet. Raises OSError where a file cannot be written.

    The columns are those of SCHEMA and DERIVED, and then `more`; CSV has all but `bare`. Those that `frame` lacks, and
    samples, are read of `rest`, which has the same rows; accuracy is null there where a method does not answer. In
    Parquet time samples are a list and missing values are nulls. In CSV lists and objects are JSON, missing values are
    empty, and no text is a formula of a spreadsheet (harness.escaping.cell).
    """
    schema = pa.schema([(field.name, _ARROW[field.kind]) for field in (*SCHEMA, *DERIVED, *more)])
    lacking = [name for name in schema.names if name not in frame.columns or name == "samples_ms"]
    names = lacking if rest is not None else []
    own = pa.schema([field for field in schema if field.name not in names])
    flat = pa.schema(
        [(f.name, f.type if f.name != "samples_ms" else pa.string()) for f in schema if f.name not in bare]
    )
    told = pa_csv.WriteOptions(quoting_style="needed")
    others = rest.batches(names) if rest is not None and names else itertools.repeat(None)
    with (
        pq.ParquetWriter(parquet, schema, compression="zstd") as packed,
        pa_csv.CSVWriter(csv, flat, write_options=told) as plain,
    ):
        for start, more_of in zip(range(0, max(len(frame), 1), BATCH), others, strict=False):
            part = frame.iloc[start : start + BATCH]
            table = pa.Table.from_pandas(part, schema=own, preserve_index=False).replace_schema_metadata(None)
            answers = pa.array(part["answers"], pa.bool_()) if names else None
            for name in names:
                values = more_of.column(name)
                if name in ACCURACY:
                    values = pc.if_else(answers, values, pa.scalar(None, values.type))
                table = table.append_column(name, values)
            table = table.select(schema.names)
            packed.write_table(table, row_group_size=BATCH)
            plain.write_table(_flat(table, flat))


def _flat(table: pa.Table, schema: pa.Schema) -> pa.Table:
    """Return a table as CSV holds it, with the columns of `schema`."""
    samples = _json(table.column("samples_ms").combine_chunks())
    table = table.set_column(table.schema.get_field_index("samples_ms"), "samples_ms", samples)
    table = table.select(schema.names)
    for place, field in enumerate(table.schema):
        if field.type == pa.string():
            table = table.set_column(place, field.name, _no_formulas(table.column(place)))
    return table


def _json(lists: pa.Array) -> pa.Array:
    """Write lists of numbers as json.dumps does."""
    ends = pc.min_max(lists.values).as_py()
    if ends["min"] is None or not ALIKE[0] <= ends["min"] <= ends["max"] < ALIKE[1]:
        told = [None if value is None else json.dumps(value) for value in lists.to_pylist()]
        return pa.array(told, pa.string())
    numbers = lists.values.cast(pa.string())
    whole = pc.binary_join_element_wise(numbers, ".0", "")
    texts = pa.ListArray.from_arrays(lists.offsets, pc.if_else(pc.match_substring(numbers, "."), numbers, whole))
    written = pc.binary_join_element_wise("[", pc.binary_join(texts, ", "), "]", "")
    return pc.if_else(lists.is_valid(), written, pa.scalar(None, pa.string()))


def without_formulas(frame: pd.DataFrame) -> pd.DataFrame:
    """Return a frame of whose texts, in CSV, a spreadsheet makes no formula."""
    texts = frame.select_dtypes(include=["object", "string"])
    told = {name: [cell(value) if isinstance(value, str) else value for value in texts[name]] for name in texts}
    return frame.assign(**told)


def _no_formulas(texts: pa.ChunkedArray) -> pa.Array:
    """Return a column of texts as CSV holds it. Each text is looked at once, since most repeat."""
    coded = texts.combine_chunks().dictionary_encode()
    if pc.all(pc.match_substring_regex(coded.dictionary, PLAIN), min_count=0).as_py():
        return texts
    told = pa.array([None if text is None else cell(text) for text in coded.dictionary.to_pylist()], pa.string())
    return pa.DictionaryArray.from_arrays(coded.indices, told).dictionary_decode()
