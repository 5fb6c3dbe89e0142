"""Find the fastest variant that draws a surface on a device within an error.

`candidates` lists the variants and views to try; `search` tries them, and says why each of the others fell.
"""
