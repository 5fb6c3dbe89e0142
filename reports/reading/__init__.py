"""Run folders → rows, arrays and plans; and rows → CSV and Parquet."""
