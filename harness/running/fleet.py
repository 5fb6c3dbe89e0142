"""Define what offers devices of other machines to a run, as harness.cluster does."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Any, Protocol

from harness.contract import DeviceInfo
from harness.devices.host import Host
from harness.devices.steps import Executor
from harness.experiment.config import BudgetChoice
from harness.experiment.plan import Planned
from harness.running.fastest import Tried

# Runs cells by an executor; the mapping is what rows say of where they ran, at the time when they end
Work = Callable[[Executor, Sequence[Planned], dict[str, Any]], None]


class Fleet(Protocol):
    """Offer the devices of other machines.

    hosts: the machines of the devices that were found, by the devices' names
    tried: the devices themselves with what their probes found, by their names
    """

    @property
    def hosts(self) -> Mapping[str, Host]: ...

    @property
    def tried(self) -> Mapping[str, Tried]: ...

    def devices(self, wanted: Collection[str]) -> list[DeviceInfo]:
        """Find the devices there; `wanted` are the words by which configs name them. Raises FirsthitError."""

    def run(self, planned: Sequence[Planned], budget: BudgetChoice, work: Work) -> None:
        """Let `work` run cells on their devices, side by side in threads, and return when all have ended.

        Raises what `work` raises, and FirsthitError where the machines cannot be reached any more.
        """
