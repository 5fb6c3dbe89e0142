"""Frames → figures, pictures and tables of a report."""
