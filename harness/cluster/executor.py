"""Take the steps of cells to a worker of a cluster, and to another one where it was lost."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, Any

from harness.cluster import admission
from harness.cluster.engine import Engine
from harness.cluster.places import Cold, Hold, Lost, Place
from harness.contract import CellStatus, Program
from harness.devices.executor import CellError
from harness.devices.interface import Timing
from harness.devices.messages import Answer, Check, Checked, Frame, Warmed

if TYPE_CHECKING:
    from harness.devices.fingerprint import Fingerprint
    from harness.devices.probes import Probes

LOSSES = 3  # workers that may be lost with a step, after which it counts as what ends them
AHEAD_SECONDS = 0.5  # of samples that are taken with one message: so much may be lost, and a stop waits so long
TRIES = 10  # to give a step to a worker, of which some may be lost before they have it


class ClusterExecutor:
    """Run steps on a device of a cluster: on the `place` that was taken for it, then on others that are `wanted`.

    `name` is the device's in cells; `place` is None where there is none yet. Steps may take `timeout` seconds, and the
    process that holds the device may hold `share` of its machine's memory. Where the worker is lost, the step is taken
    again by another one with that device; where none comes within the engine's patience, this step and further ones
    raise CellError until one is there.

    While no step is under way, the thread counts as working on this machine; the caller is within admission.beside().
    """

    def __init__(
        self,
        engine: Engine,
        name: str,
        place: Place | None,
        wanted: Callable[[Place], bool],
        timeout: float,
        share: float,
    ) -> None:
        self._engine, self._name, self._wanted = engine, name, wanted
        self._limits = timeout, share
        self._hold = self._held(place) if place else None
        self._ready: dict[str, float] = {}  # by key, seconds of the frame's last sample; infinity before the first
        self._expected: deque[tuple[str, int]] = deque()
        self._ahead: deque[tuple[str, Timing | CellError]] = deque()  # samples that were taken and not asked for yet
        self._released: list[str] = []
        self._gave_up = False
        self._moves = 0
        self._came = False  # to a place that has not answered yet
        # what rows say of where steps run; it changes with the place
        self.where: dict[str, Any] = {"machine": place.machine} if place else {}

    @property
    def moves(self) -> int:
        return self._moves

    def probe(self, device: str) -> Probes:
        probes: Probes = self._ask(device, "probe")
        return probes

    def fingerprint(self, device: str) -> Fingerprint:
        found: Fingerprint = self._ask(device, "fingerprint")
        return found

    def build(self, device: str, program: Program) -> float:
        compile_ms: float = self._ask(device, "build", program)
        return compile_ms

    def builds(self, device: str) -> list[str]:
        found: list[str] = self._ask(device, "builds") if self._hold else []
        return found

    def check(self, device: str, check: Check[Answer]) -> Checked[Answer]:
        checked: Checked[Answer] = self._ask(device, "check", check)
        return checked

    def warm(self, device: str, key: str, frame: Frame) -> Warmed:
        warmed: Warmed = self._ask(device, "warm", key, frame)
        self._ready[key] = math.inf
        return warmed

    def expect(self, samples: Sequence[tuple[str, int]]) -> None:
        self._expected = deque(samples)
        if any(key != expected for (key, _), (expected, _) in zip(self._ahead, samples, strict=False)):
            self._ahead.clear()

    def sample(self, device: str, key: str, frame: Frame, batch: int) -> Timing:
        if not self._ahead or self._ahead[0][0] != key:
            self._ahead = deque(self._samples(device, key, frame, batch))
        if self._expected and self._expected[0][0] == key:
            self._expected.popleft()
        _, timing = self._ahead.popleft()
        if isinstance(timing, CellError):
            raise timing
        return timing

    def _samples(self, device: str, key: str, frame: Frame, batch: int) -> Iterable[tuple[str, Timing | CellError]]:
        """Take a sample, and those that are expected to follow with the same message; by key, one of them at least."""
        for _ in range(LOSSES + 1):
            if key not in self._ready:
                self.warm(device, key, frame)
            wanted = self._wanted_now(key, batch)
            try:
                timings, failed = self._ask(device, "samples", wanted)
            except Cold:  # another worker has taken over, or that of the device was started anew
                self._ready.pop(key, None)
                continue
            for (one, _), timing in zip(wanted, timings, strict=False):
                self._ready[one] = timing.wall_ms / 1e3
            told = [*timings, CellError(*failed)] if failed else timings
            return [(one, timing) for (one, _), timing in zip(wanted, told, strict=False)]
        raise CellError(CellStatus.CRASHED, f"sample: its frame was lost {LOSSES + 1} times in a row")

    def _wanted_now(self, key: str, batch: int) -> list[tuple[str, int]]:
        """List a sample and those that are to follow, as far as all take AHEAD_SECONDS, as their last ones did."""
        wanted, seconds = [(key, batch)], self._ready[key]
        following = list(self._expected)[1:] if self._expected and self._expected[0][0] == key else []
        for one in following:
            seconds += self._ready.get(one[0], math.inf)
            if not seconds <= AHEAD_SECONDS:
                break
            wanted.append(one)
        return wanted

    def release(self, device: str, key: str) -> None:
        del device
        if key in self._ready:  # the next step frees it
            del self._ready[key]
            self._released.append(key)

    def close(self) -> None:
        if self._hold:
            hold, self._hold = self._hold, None
            with admission.away():
                hold.close()
            self._engine.give_back(hold.place)

    def _held(self, place: Place) -> Hold:
        return Hold(place, *self._limits, lambda: self._engine.client, self._engine.check)

    def _ask(self, device: str, operation: str, *arguments: Any) -> Any:
        """Take a step to the worker, or to the one that takes over. Raises CellError, and Cold."""
        losses, lost = 0, ""
        for _ in range(TRIES):
            with admission.away():
                hold = self._hold or self._taken()
                released, self._released = self._released, []
                try:
                    plain = hold.place.device if device == self._name else device
                    answer = hold.step(operation, plain, arguments, released)
                except Lost as error:
                    losses, lost = losses + hold.sent, str(error)
                    self._engine.look_again(hold.place)
                    self._drop()
                    if losses == LOSSES:
                        told = f"{operation} lost its worker {LOSSES} times; the last time: {lost}"
                        raise CellError(CellStatus.CRASHED, told) from None
                else:  # a place that was lost before it answered anything is no move
                    self._moves, self._came = self._moves + self._came, False
                    return answer
        told = f"no worker stayed long enough to take {operation}, in {TRIES} tries; the last time: {lost}"
        raise CellError(CellStatus.FAILED, f"{told}; `--retry failed` runs the cell again")

    def _drop(self) -> None:
        assert self._hold
        self._engine.give_back(self._hold.place)
        self._hold = None
        self._ready.clear()
        self._ahead.clear()
        self._released.clear()

    def _taken(self) -> Hold:
        """Take another place for the device. Raises CellError where none comes."""
        seconds = 0.0 if self._gave_up else None
        place = self._engine.waited(lambda: self._engine.take(self._wanted), seconds)
        self._gave_up = place is None
        if place is None:
            waited = f"none came back within {self._engine.patience:.0f} s"
            told = f"the worker of {self._name} was lost, and {waited}; `--retry failed` runs the cell again"
            raise CellError(CellStatus.FAILED, told)
        self._hold = self._held(place)
        self._came = True
        self.where["machine"] = place.machine
        return self._hold
