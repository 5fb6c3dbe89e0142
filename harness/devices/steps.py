"""Define what runs steps of cells on devices, wherever these are: here, or on machines of a cluster."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Protocol

from harness.contract import Program
from harness.devices.interface import Timing
from harness.devices.messages import Answer, Check, Checked, Frame, Warmed

if TYPE_CHECKING:
    from harness.devices.fingerprint import Fingerprint
    from harness.devices.probes import Probes


class Executor(Protocol):
    """Run steps, each on a device that is named; `LocalExecutor` has them run on this machine.

    A step raises CellError if it fails, takes too long or too much memory, or ends the process that holds the device.
    """

    @property
    def moves(self) -> int:
        """Return how often another machine or process took over what was kept ready: times before and after differ."""

    def probe(self, device: str) -> Probes:
        """Probe a device's arithmetic and clock, as harness.devices.probes does."""

    def fingerprint(self, device: str) -> Fingerprint:
        """Take the fingerprint of a device, as harness.devices.fingerprint does."""

    def build(self, device: str, program: Program) -> float:
        """Compile a program, and return the milliseconds that it took."""

    def builds(self, device: str) -> list[str]:
        """Return a line for each program that a device has built since this was last asked."""

    def check(self, device: str, check: Check[Answer]) -> Checked[Answer]:
        """Build a check's programs and run it. Raises CellError too if two runs answer differently."""

    def warm(self, device: str, key: str, frame: Frame) -> Warmed:
        """Build a frame and keep it under `key`, ready for `sample`."""

    def expect(self, samples: Sequence[tuple[str, int]]) -> None:
        """Hear which samples are asked for next, by key and batch in this order: several may be taken at once."""

    def sample(self, device: str, key: str, frame: Frame, batch: int) -> Timing:
        """Time one repetition: `batch` runs of the frame that is kept under `key`; it is warmed again if it is lost."""

    def release(self, device: str, key: str) -> None:
        """Free what the frame under `key` holds on its device; do nothing if no frame is kept there."""

    def close(self) -> None:
        """End what this executor has started."""
