"""Make tables of rows: the pandas frame that a report works on, and its CSV and Parquet files."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pandas as pd
import pyarrow as pa
import pyarrow.csv as pa_csv
import pyarrow.parquet as pq

from harness.escaping import cell
from harness.results.schema import DERIVED, SCHEMA, Field, Kind

_DTYPES: dict[Kind, str] = {
    "text": "object",
    "real": "float64",
    "whole": "Int64",
    "flag": "boolean",
    "json": "object",
    "reals": "object",
}
_ARROW: dict[Kind, pa.DataType] = {
    "text": pa.string(),
    "real": pa.float64(),
    "whole": pa.int64(),
    "flag": pa.bool_(),
    "json": pa.string(),
    "reals": pa.list_(pa.float64()),
}


def frame(fields: Sequence[Field], rows: Sequence[tuple[Any, ...]]) -> pd.DataFrame:
    """Make a frame of rows, whose values are in the order of `fields`.

    Its columns keep their kind even where every value is missing.
    """
    columns = zip(*rows, strict=True) if rows else [()] * len(fields)
    return pd.DataFrame({f.name: pd.Series(c, dtype=_DTYPES[f.kind]) for f, c in zip(fields, columns, strict=True)})


def write(frame: pd.DataFrame, csv: Path, parquet: Path, more: Sequence[Field] = (), bare: Sequence[str] = ()) -> None:
    """Write every column of every cell, as CSV and as Parquet. Raises OSError where a file cannot be written.

    The columns are those of SCHEMA and DERIVED, and then `more`; CSV has all but `bare`. In Parquet time samples are a
    list and missing values are nulls. In CSV lists and objects are JSON, missing values are empty, and no text is a
    formula of a spreadsheet (harness.escaping.cell).
    """
    schema = pa.schema([(field.name, _ARROW[field.kind]) for field in (*SCHEMA, *DERIVED, *more)])
    table = pa.Table.from_pandas(frame, schema=schema, preserve_index=False).replace_schema_metadata(None)
    pq.write_table(table, parquet, compression="zstd")
    samples = pa.array([None if value is None else json.dumps(value) for value in frame["samples_ms"]], pa.string())
    at = schema.get_field_index("samples_ms")
    flat = table.set_column(at, "samples_ms", samples).drop_columns(list(bare))
    for place, field in enumerate(flat.schema):
        if field.type == pa.string():
            flat = flat.set_column(place, field.name, _no_formulas(flat.column(place)))
    pa_csv.write_csv(flat, csv, pa_csv.WriteOptions(quoting_style="needed"))


def without_formulas(frame: pd.DataFrame) -> pd.DataFrame:
    """Return a frame of whose texts, in CSV, a spreadsheet makes no formula."""
    texts = frame.select_dtypes(include=["object", "string"])
    told = {name: [cell(value) if isinstance(value, str) else value for value in texts[name]] for name in texts}
    return frame.assign(**told)


def _no_formulas(texts: pa.ChunkedArray) -> pa.Array:
    """Return a column of texts as CSV holds it. Each text is looked at once, since most repeat."""
    coded = texts.combine_chunks().dictionary_encode()
    told = pa.array([None if text is None else cell(text) for text in coded.dictionary.to_pylist()], pa.string())
    return pa.DictionaryArray.from_arrays(coded.indices, told).dictionary_decode()
