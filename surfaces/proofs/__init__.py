"""Prove what a formula alone does not show: where it is defined, how fast it grows, and how it lies in its domain.

Three questions are answered, each by one module, in interval arithmetic or by structure. No proof rests on samples.

    validity    is f defined all over its domain?
    lipschitz   is |f| nowhere greater than the distance to the surface?
    extent      does the domain cut the surface, or miss it; which box holds it?

The others are what these stand on. `signs` bounds every operation by the tape's structure, `ranges` on many boxes at
once, with which `boxes` covers a domain. `guards` finds where an operation needs a value, `blending` recognises smooth
minima, and `search` looks for the zeros in a box. `slopes` bounds the gradient over one box in ball arithmetic, as
methods ask for it.
"""
