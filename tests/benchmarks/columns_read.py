"""Measure how long columns of Parquet parts take to read, by pyarrow as reports read them and by DuckDB.

`python -m tests.benchmarks.columns_read RUN` prints the seconds of processor time and of waiting, and the memory that
each took in a process of its own. DuckDB is no dependency: `pip install duckdb` for this one. Nothing here fails for
being slow.
"""

from __future__ import annotations

import resource
import subprocess
import sys
import time
from pathlib import Path

COLUMNS = ("slot", "surface", "variant", "device", "precision", "median_ms", "error_max", "misses", "samples_ms")


def by_pyarrow(parts: list[Path]) -> int:
    """Read the columns of all parts as a table, each text once; return how many rows there are."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    texts = list(COLUMNS[1:5])
    read = [pq.read_table(part, columns=list(COLUMNS), read_dictionary=texts) for part in parts]
    return pa.concat_tables(read).num_rows


def by_duckdb(parts: list[Path]) -> int:
    """Read the same columns into an Arrow table; return how many rows there are."""
    import duckdb

    files = [str(part) for part in parts]
    return duckdb.sql(f"SELECT {', '.join(COLUMNS)} FROM read_parquet($1)", params=[files]).to_arrow_table().num_rows


def _one(name: str, parts: list[Path]) -> None:
    """Measure one of them in this process."""
    wall, cpu = time.perf_counter(), time.process_time()
    rows = {"pyarrow": by_pyarrow, "duckdb": by_duckdb}[name](parts)
    told = time.process_time() - cpu, time.perf_counter() - wall
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6
    print(f"{name:10} {rows:10,} rows {told[0]:8.2f} s of a core {told[1]:8.2f} s {memory:6.2f} GB", flush=True)


if __name__ == "__main__":
    if len(sys.argv) == 3:
        _one(sys.argv[2], sorted(Path(sys.argv[1], "parts").glob("*.parquet")))
    else:
        for reader in ("pyarrow", "duckdb"):
            subprocess.run([sys.executable, "-m", "tests.benchmarks.columns_read", sys.argv[1], reader], check=False)
