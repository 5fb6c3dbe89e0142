"""Declare what a cell leaves behind: its row, the files that keep rows, and the figures that are read from a row."""
