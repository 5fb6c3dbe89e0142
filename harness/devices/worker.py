"""Do the work of the process that holds a device. It knows programs and buffers only, no plugins, surfaces or files.

Whatever a driver does to this process, the runner at the other end of the pipe sees an answer, a closed pipe or
silence.
"""

from __future__ import annotations

import time
from collections import OrderedDict
from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING

from harness.contract import DeviceInfo, Program
from harness.devices.interface import Built, Device, Launch, Timing, find_devices, open_device
from harness.devices.messages import Answer, Check, Checked, Frame, Warmed
from harness.devices.trial_launch import trial_launch

if TYPE_CHECKING:
    from harness.devices.fingerprint import Fingerprint
    from harness.devices.probes import Probes

ENOUGH_MS = 2.0  # a sample lasts at least about this long; shorter launches are repeated within it
MOST_REPEATS = 64
WARM_MS = 200.0  # a launch that takes longer has warmed the device up by itself
KEPT_PROGRAMS = 128  # built programs: the views of a surface run the same ones, one view after the other


class Worker:
    """Hold a device, the programs that were built for it, and the frames that are kept ready.

    `name` is a device's; for `find` it is a backend's. The device is opened when it is first needed.
    """

    def __init__(self, name: str) -> None:
        self._name = name
        self._frames: dict[str, Launch] = {}
        self._builds: list[str] = []
        self._built: OrderedDict[str, tuple[Built, float]] = OrderedDict()  # by hash; the first was used longest ago

    @cached_property
    def _device(self) -> Device:
        return open_device(self._name)

    def find(self) -> list[DeviceInfo]:
        """Find the devices of the backend that this worker is named after."""
        return find_devices(self._name)

    def reopen(self) -> None:
        """Open the device, since another worker has lost it. Raises FirsthitError where it is not there any more."""
        _ = self._device

    def probe(self) -> Probes:
        """Probe the device's arithmetic and clock."""
        from harness.devices.probes import probe

        return probe(self._device)

    def fingerprint(self) -> Fingerprint:
        """Take the fingerprint of the device's arithmetic and of this host's."""
        from harness.devices.fingerprint import fingerprint

        return fingerprint(self._device)

    def build(self, program: Program) -> float:
        """Compile a program; return the milliseconds that it took, with what the driver leaves to the first launch."""
        return self._build(program)[1]

    def builds(self) -> list[str]:
        """Return a line for each program that was built since this was last asked."""
        told, self._builds = self._builds, []
        return told

    def _build(self, program: Program) -> tuple[Built, float]:
        """Return the built program, and the milliseconds that compiling took, now or when this worker first did it."""
        if program.hash not in self._built:
            start = time.perf_counter()
            built = self._device.build(program)
            compile_ms = (time.perf_counter() - start) * 1e3
            if not program.vertex:  # a rasterised program is drawn, not launched
                trial = trial_launch(self._device, program, built)
                compile_ms += trial.run().wall_ms
                trial.release()
            said = " ".join(self._device.said(built).split())
            self._builds.append(
                f"built {program.entry} in {compile_ms / 1e3:.2f} s; {said or 'the compiler says nothing'}"
            )
            self._built[program.hash] = built, compile_ms
            if len(self._built) > KEPT_PROGRAMS:
                self._built.popitem(last=False)
        self._built.move_to_end(program.hash)
        return self._built[program.hash]

    def _build_all(self, programs: Sequence[Program]) -> tuple[list[Built], float]:
        """Build programs; return all of them, and the milliseconds that compiling took, each program counted once."""
        built = [self._build(program) for program in programs]
        taken = {program.hash: compile_ms for program, (_, compile_ms) in zip(programs, built, strict=True)}
        return [one for one, _ in built], sum(taken.values())

    def check(self, check: Check[Answer]) -> Checked[Answer]:
        """Build a check's programs and run it. Raises FirsthitError where two runs answer differently."""
        built, compile_ms = self._build_all(check.programs)
        return Checked(check.run(self._device, built), compile_ms)

    def warm(self, key: str, frame: Frame) -> Warmed:
        """Build and upload a frame, run it until warm, read it back once, and keep it ready under `key`."""
        built, compile_ms = self._build_all(frame.programs)
        launch = frame.launch(self._device, built)
        duration = launch.run().wall_ms
        if duration < WARM_MS:
            duration = launch.run().wall_ms
        start = time.perf_counter()
        launch.read()
        readback_ms = (time.perf_counter() - start) * 1e3
        self._frames[key] = launch
        batch = min(MOST_REPEATS, max(1, round(ENOUGH_MS / max(duration, 1e-6))))
        return Warmed(compile_ms, launch.upload_ms, readback_ms, batch, getattr(launch, "bytes", None))

    def sample(self, key: str, batch: int) -> Timing:
        """Run the frame that is kept under `key` `batch` times, and time it by all clocks."""
        start = time.process_time()
        timing = self._frames[key].run(batch)
        return replace(timing, processor_ms=(time.process_time() - start) * 1e3)

    def release(self, key: str) -> None:
        """Free what the frame under `key` holds on the device; do nothing if no frame is kept there."""
        if frame := self._frames.pop(key, None):
            frame.release()
