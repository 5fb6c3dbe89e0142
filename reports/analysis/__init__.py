"""Compute what follows from a run's rows: speed-ups, fronts, ties, fits and exact tests. Nothing here draws."""
