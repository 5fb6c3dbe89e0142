"""Open OpenCL devices through pyopencl: every platform and device that the loader finds."""

from __future__ import annotations

import contextlib
import ctypes
import os
import shutil
import sys
import time
import warnings
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from harness.contract import DeviceInfo, Program
from harness.devices.interface import GPU_RESIDENT, Array, BuildError, Built, Device, Reserved, Step, StepLaunch, Timing
from harness.kernels.complaints import explained
from harness.results.writing import temporary_folder

SHORT = {"intel": "intel", "portable": "pocl", "nvidia": "nvidia", "amd": "amd", "rusticl": "rusticl", "apple": "apple"}
INTEL_LIBRARIES = ("libintlc.so.5", "libimf.so", "libsvml.so", "libirng.so", "libtbb.so.12")
SYSTEM_VENDORS = Path("/etc/OpenCL/vendors")
OPTIONS = {"float32": ["-cl-single-precision-constant"], "float64": []}
UNOPTIMISED = ["-cl-opt-disable"]
ROUNDED_DIVISION = "-cl-fp32-correctly-rounded-divide-sqrt"  # without it 2.5 ulp may be lost; some devices lack it
GROUP = 64
# A processor spends 60 ns on starting a group: with groups of 64 that is a fifth of the null method's time
PROCESSOR_GROUP = 256


def _switch_off_caches() -> None:
    """Switch off what would hide compile times, and ask for the widest vectors, unless the user says otherwise."""
    os.environ.setdefault("PYOPENCL_NO_CACHE", "1")
    os.environ.setdefault("POCL_KERNEL_CACHE", "0")
    if _has_sixteen_lanes():
        os.environ.setdefault("CL_CONFIG_CPU_VECTORIZER_MODE", "16")  # else Intel's compiler chooses 8 for some kernels


@contextlib.contextmanager
def _all_drivers_listed() -> Iterator[None]:
    """Make every installed driver visible to the loader, which reads the list once, when it is first asked.

    The Intel wheel's own .icd file names a folder that does not exist and its libraries are not on the loader's path,
    so they are loaded here and the driver is named in a vendors folder of ours, beside the system's own. A user's own
    list is left as it is.
    """
    driver = Path(sys.prefix) / "lib" / "libintelocl.so"
    if "OCL_ICD_VENDORS" in os.environ or not driver.exists():
        yield
        return
    for name in INTEL_LIBRARIES:
        with contextlib.suppress(OSError):  # the driver itself reports what it misses
            ctypes.CDLL(str(driver.parent / name), mode=ctypes.RTLD_GLOBAL)
    with temporary_folder("firsthit-vendors") as vendors:
        (vendors / "intel.icd").write_text(f"{driver}\n")
        if SYSTEM_VENDORS.is_dir():
            for icd in SYSTEM_VENDORS.glob("*.icd"):
                shutil.copy(icd, vendors / icd.name)
        os.environ["OCL_ICD_VENDORS"] = str(vendors)
        try:
            yield
        finally:
            del os.environ["OCL_ICD_VENDORS"]


def _has_sixteen_lanes() -> bool:
    """Tell whether the processor's vectors hold 16 float32; False if it does not say so."""
    try:
        return " avx512f " in Path("/proc/cpuinfo").read_text(encoding="utf-8")
    except OSError:
        return False


@cache
def _binding() -> Any:
    _switch_off_caches()
    import pyopencl

    return pyopencl


@cache
def _named_devices() -> dict[str, Any]:
    """Return devices by short name; a second one of the same kind of platform gets a number."""
    cl = _binding()
    try:
        with _all_drivers_listed():
            platforms = cl.get_platforms()
    except cl.Error:
        return {}
    named: dict[str, Any] = {}
    for platform in platforms:
        words = f"{platform.name} {platform.vendor}".lower()
        short = next((short for word, short in SHORT.items() if word in words), words.split()[0])
        try:
            devices = platform.get_devices()
        except cl.Error:
            continue
        for device in devices:
            name = base = f"opencl:{short}"
            number = 2
            while name in named:
                name = f"{base}-{number}"
                number += 1
            named[name] = device
    return named


def _problem(device: Any) -> str | None:
    """Say why the device cannot run even an empty kernel; None if it can.

    Some drivers' compilers do not know newer processors.
    """
    cl = _binding()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", cl.CompilerWarning)
            cl.Program(cl.Context([device]), "__kernel void nothing(__global int *a) { a[0] = 1; }").build()
    except cl.Error as error:
        lines = [line.strip() for line in str(error).splitlines() if "error" in line.lower()]
        return f"its compiler fails: {(lines or ['no message'])[-1]}"
    return None


def names() -> list[str]:
    """List the names of all OpenCL devices, in the loader's order, whether they work or not."""
    return list(_named_devices())


def find() -> list[DeviceInfo]:
    """Find every OpenCL device, in the loader's order."""
    return [info(name) for name in names()]


@cache
def info(name: str) -> DeviceInfo:
    """Describe one device of `names`; whether it has a problem is found by compiling for it."""
    cl, device = _binding(), _named_devices()[name]
    return DeviceInfo(
        name=name,
        title=device.name.strip(),
        driver=f"{device.platform.name} {device.driver_version}".strip(),
        compiler=device.version.strip(),
        compute_units=int(device.max_compute_units),
        float64=bool(device.double_fp_config),
        clock="device",
        versions=(("pyopencl", cl.VERSION_TEXT),),
        problem=_problem(device),
        resident=GPU_RESIDENT if device.type & cl.device_type.GPU else None,
    )


def open(name: str) -> OpenCLDevice:
    """Open the device of that name, which is one of `names`."""
    return OpenCLDevice(name)


class OpenCLDevice(Device):
    """Hold an OpenCL device, its context and a queue that times what runs."""

    language = "cl"

    def __init__(self, name: str) -> None:
        cl, device = _binding(), _named_devices()[name]
        self.info = info(name)
        self._context = cl.Context([device])
        rounds = device.single_fp_config & cl.device_fp_config.CORRECTLY_ROUNDED_DIVIDE_SQRT
        self._options = {**OPTIONS, "float32": [*OPTIONS["float32"], *([ROUNDED_DIVISION] if rounds else [])]}
        self._queue = cl.CommandQueue(self._context, properties=cl.command_queue_properties.PROFILING_ENABLE)

    def build(self, program: Program) -> Built:
        """Compile a program, for launches of this device only. Raises BuildError if the driver's compiler refuses."""
        cl = _binding()
        source = cl.Program(self._context, program.text)
        options = [*self._options[program.precision], *([] if program.optimised else UNOPTIMISED)]
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", cl.CompilerWarning)  # some drivers print a greeting, which is no error
                return source.build(options=options), program.entry
        except cl.Error as error:
            raise BuildError(explained(program, str(error))) from None

    def said(self, built: Built) -> str:
        source, _ = built
        told: str = source.get_build_info(self._context.devices[0], _binding().program_build_info.LOG)
        return told

    def launch_steps(
        self, buffers: Sequence[Array | Reserved], outputs: Sequence[int], steps: Sequence[Step]
    ) -> StepLaunch:
        return OpenCLLaunch(self._context, self._queue, buffers, outputs, steps)


class OpenCLLaunch(StepLaunch):
    """Hold built kernels and their buffers in an OpenCL context. Outputs must be Reserved buffers."""

    def __init__(
        self,
        context: Any,
        queue: Any,
        buffers: Sequence[Array | Reserved],
        outputs: Sequence[int],
        steps: Sequence[Step],
    ) -> None:
        cl = _binding()
        self._queue = queue
        start = time.perf_counter()
        flags = cl.mem_flags

        def buffer(of: Array | Reserved) -> Any:
            if not isinstance(of, Reserved):
                return cl.Buffer(context, flags.READ_ONLY | flags.COPY_HOST_PTR, hostbuf=of)
            if of.fill is not None:
                return cl.Buffer(context, flags.READ_WRITE | flags.COPY_HOST_PTR, hostbuf=of.filled())
            return cl.Buffer(context, flags.READ_WRITE, max(1, of.count) * np.dtype(of.kind).itemsize)

        self._buffers = [buffer(b) for b in buffers]
        queue.finish()
        self.upload_ms = (time.perf_counter() - start) * 1e3
        results: dict[int, Array] = {
            i: np.empty(b.count, b.kind) for i, b in enumerate(buffers) if isinstance(b, Reserved)
        }
        self._outputs = [(self._buffers[place], results[place]) for place in outputs]
        on_processor = bool(queue.device.type & cl.device_type.CPU)
        self._steps = []
        for step in steps:
            free = PROCESSOR_GROUP if on_processor and step.grid[0] % PROCESSOR_GROUP == 0 else GROUP
            group = step.group or free
            items = (-(-step.grid[0] // group) * group, step.grid[1])
            self._steps.append((self._kernel(step), items, (group, 1)))

    def _kernel(self, step: Step) -> Any:
        built, entry = step.built
        kernel = _binding().Kernel(built, entry)
        numbers = (np.int32(value) for value in (*step.grid, *step.numbers.values()))
        kernel.set_args(*(self._buffers[place] for place in step.buffers), *numbers)
        return kernel

    def run(self, times: int = 1) -> Timing:
        cl = _binding()
        start = time.perf_counter()
        runs = [
            [cl.enqueue_nd_range_kernel(self._queue, kernel, items, group) for kernel, items, group in self._steps]
            for _ in range(times)
        ]
        self._queue.finish()
        wall = time.perf_counter() - start
        return Timing(wall * 1e3, sum(events[-1].profile.end - events[0].profile.start for events in runs) * 1e-6)

    def write(self, place: int, values: Array) -> None:
        _binding().enqueue_copy(self._queue, self._buffers[place], values)

    def read(self) -> list[Array]:
        cl = _binding()
        for buffer, result in self._outputs:
            cl.enqueue_copy(self._queue, result, buffer)
        return [result for _, result in self._outputs]

    def release(self) -> None:
        for buffer in self._buffers:
            buffer.release()
