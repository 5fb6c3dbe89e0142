"""Answers held against the oracle: which are wrong, how far off the right ones are, and who is at fault."""
