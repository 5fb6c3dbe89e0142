"""Answers "miss" at once.

**Source** none: the harness's own floor.

**Theory** What this costs is what every method pays before it starts: making the ray, moving its origin, clipping it
against the domain and writing the answer. A method's time is to be read against it.

**Changes against the paper** none.
"""

from harness.contract import Method

METHOD = Method(name="null", source="harness", answers=False)
