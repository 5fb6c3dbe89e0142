"""Tell whether a kernel ends only because its device's compiler removes loops that do not end.

A compiler may remove a loop that nothing depends on, whether it ends or not: Mesa's does. The programs that are checked
keep all loops (harness/kernels/glsl/kept_loops.glsl), and those that are timed do not. If a checked program gives rays
up, the same program with its loops left to the compiler casts them again. If that one answers more than DOUBTFUL of
them, the program that would be timed does not do what its kernel says. OpenCL C compilers are left alone: they keep
such loops, and the step times out.

**What this cannot see** It does not see such a loop on DOUBTFUL of the rays or fewer, which are told as exhausted; one
that no checked ray enters; and one whose condition is an undefined value, since the compiler may take it as ended.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

from harness.accuracy.compilers import DOUBTFUL
from harness.contract import Hits, Program, RayStatus, plural
from harness.kernels.sections import with_free_loops


def removed(programs: Iterable[Program], kept: Hits, cast: Callable[[], Hits]) -> str | None:
    """Say what is wrong with the loops of checked `programs`, whose answers are `kept`; None if nothing is found.

    `cast` casts the same rays by the same programs with free loops.
    """
    gave_up = kept.status == RayStatus.EXHAUSTED
    alike = all(with_free_loops(program) == program for program in programs)
    if alike or gave_up.sum() <= DOUBTFUL * len(gave_up):
        return None
    count = int((gave_up & (cast().status != RayStatus.EXHAUSTED)).sum())
    if count <= DOUBTFUL * len(gave_up):
        return None
    return (
        f"on {count} of {plural(len(gave_up), 'ray')} the kernel ends only because this device's compiler removes a "
        "loop whose result is not used; the check keeps this loop, and it turns until the driver ends it"
    )
