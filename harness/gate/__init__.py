"""The gate: a config's rows held against a blessed baseline, so that CI fails where a method gets worse.

The way through: a config's cells are checked and not timed (`harness.running.batch`) → `entries` (rows → what the
baseline keeps of them, by `figures`) → `judge` (against `baseline`) → `outputs`. `against` compares speed with another
revision.
"""
