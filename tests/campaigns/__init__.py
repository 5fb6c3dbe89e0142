"""Attack what firsthit promises at random, many times over, and count what happened: `make campaign`.

Each module beside `frame`, `table` and `__main__` states one campaign. What may not happen is in docs/reliability.md.
"""
