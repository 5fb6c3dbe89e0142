"""Make reports: from a run folder's rows to tables, plots and pictures, one PDF, one HTML page, and CSV and Parquet.

Reports read run folders and run nothing. A room may import only the rooms before it: `wording` and `content` (what a
report consists of) and `published` (the papers' tables); `reading` (a folder's files as rows and arrays); `analysis`
(what follows from rows); `drawing` (figures and pictures); `claims` (what the papers say, and what decides it);
`sentences` (those of the first page); `material` (what all parts share); `parts` (the sections); `rendering` (PDF and
HTML); then `first_page`, `report` and `compare`, which make the report on one run and on two, and `history`, which
draws gated figures over commits.
"""
