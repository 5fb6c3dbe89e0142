"""Read formulas: `grammar` parses text into postfix code, `reading` runs it on a Builder, `canonical` writes tapes.

`tokens` splits text and points at mistakes, `names` says what names mean, and `prelude` defines functions in the
language itself.
"""
