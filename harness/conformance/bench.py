"""Run a method's checks on a device, in a process of their own, so that what hangs or crashes is a finding too."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

from harness.conformance.cases import Bench, Finding, not_checked
from harness.conformance.examine import EXAMINATIONS, Located
from harness.contract import CellStatus, DeviceInfo, FirsthitError, Surface
from harness.devices.executor import CellError
from harness.devices.interface import LANGUAGES
from harness.devices.messages import Check
from harness.devices.steps import Executor
from harness.experiment.kinds import of_method
from harness.kernels.assemble import lanes_on
from harness.plugins import Catalog, Plugin


def checkable(catalog: Catalog) -> list[str]:
    """List the methods that can be checked: those that answer, and can cast given rays, listed or in frames."""
    answering = {name: plugin.method for name, plugin in catalog.plugins.items() if plugin.method.answers}
    return [name for name, method in answering.items() if of_method(method).hard_entries]


def bench_on(executor: Executor, info: DeviceInfo) -> Bench:
    """Make the bench that runs kernels in the executor's worker for a device. Its `run` raises CellError."""

    def run(check: Check[Any]) -> Any:
        """Build the programs of a check, run it, and return its answer."""
        return executor.check(info.name, check).answer

    language = LANGUAGES[info.name.partition(":")[0]]
    return Bench(info.name, language, info.float64, run, lanes_on(language, info))


def findings(bench: Bench, plugin: Plugin, chosen: Sequence[Surface]) -> Iterator[tuple[str, Finding]]:
    """Check a method on a bench, and yield what was checked in each case, and its finding.

    A step that fails, hangs or crashes is a finding that fails. After one that hangs nothing more is checked, since
    each further step would take as long.
    """
    for examination in EXAMINATIONS:
        for where, found in _parts(examination(bench, plugin, chosen)):
            try:
                if isinstance(found, FirsthitError):
                    raise found
                yield from ((where, finding) for finding in found)
            except (CellError, FirsthitError) as error:
                rule = "the program is built and runs to its end"
                ended = error.status if isinstance(error, CellError) else CellStatus.FAILED
                yield where, Finding("runs", math.nan, 0, rule, str(error), ended=ended)
                if ended is CellStatus.TIMEOUT:
                    yield "the rest", not_checked("all else", "a step before it hung")
                    return


def _parts(located: Iterator[Located]) -> Iterator[tuple[str, Iterator[Finding] | FirsthitError]]:
    """Yield the parts of an examination; last the error with which it ended, as the method's own functions may do."""
    try:
        yield from located
    except FirsthitError as error:
        yield "the method's functions", error
