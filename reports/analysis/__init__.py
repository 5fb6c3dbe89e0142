"""Rows → what follows from them: speed-ups, fronts, ties, fits, exact tests. Nothing here draws."""
