"""Reads run folders as rows, arrays and plans, and writes rows as CSV and Parquet."""
