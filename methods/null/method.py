"""Answers "miss" at once, and so measures what the harness itself costs.

**Source** none: it is the harness's own floor.

**Theory** Its time is what every method pays before it starts: making the ray, moving its origin, clipping it against
the domain and writing the answer. Compare a method's time with this one.

**Changes against the paper** none.
"""

from harness.contract import Method

METHOD = Method(name="null", source="harness", label="No method", answers=False)
