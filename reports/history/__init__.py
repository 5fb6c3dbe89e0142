"""Draw the gated figures of a config over the commits whose runs are kept (`firsthit gate --keep`).

`series` makes graphs of the kept files and finds their steps. `page` writes them as HTML, `multiples` as PNG, and
`build` makes all of it.
"""
