"""Read run folders as rows, arrays and plans, and write rows as CSV and Parquet."""
