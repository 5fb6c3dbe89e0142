"""Runs what a plan names, and casts single sets of rays. Knows no command line."""
