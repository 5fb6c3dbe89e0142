"""Reports: a run folder's rows → tables, plots, pictures → one PDF and one HTML page, and CSV and Parquet beside them.

Reads run folders only and never runs anything. The way through, in `report`: `reading.load` (folder → rows, as
harness.results.schema names them) → `analysis.derive` (speed-ups, floors, fronts) and `analysis.breaks` (of families of
hard rays) → `summary` and every module of `parts` (what the report says, in the blocks of `content`) →
`rendering.document` (content → PDF through `report.typ`) and `rendering.html` (content → `page.html` with its style and
script). `compare` does the same for two runs. `claims` and `published` hold what the papers say.
"""
