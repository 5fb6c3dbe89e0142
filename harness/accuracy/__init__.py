"""Hold answers against the oracle: which are wrong, how far off the others are, and whether a compiler is at fault."""
