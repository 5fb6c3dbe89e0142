"""Open the OpenGL device through moderngl, without a window (EGL), and run compute shaders on it.

harness.devices.opengl_raster draws its frames of triangles.
"""

from __future__ import annotations

import dataclasses
import os
import re
import time
from collections.abc import Sequence
from functools import cache
from importlib.metadata import version
from typing import Any

import numpy as np

from harness.contract import DeviceInfo, FirsthitError, Program, source
from harness.devices.interface import GPU_RESIDENT, Array, BuildError, Built, Device, Reserved, Step, StepLaunch, Timing
from harness.devices.opengl_raster import OpenGLRasterLaunch
from harness.devices.raster import Batch, Rasteriser, RasterLaunch
from harness.kernels.complaints import explained

SHORT = ("llvmpipe", "softpipe", "nvidia", "geforce", "radeon", "intel", "apple")
SOFTWARE = ("llvmpipe", "softpipe")
GROUP = 64
REQUIRED = 430
DOUBLES = """#version 430
layout(local_size_x = 1) in;
layout(std430, binding = 0) buffer Kept { double x[]; };
void main() {
    double a[4];
    for (int k = 0; k < 4; k++) a[k] = x[k];
    x[4] = a[int(x[0])];
}
"""


@cache
def _context() -> Any:
    """Create the process's one context. Raises what the platform's EGL raises if there is none."""
    os.environ.setdefault("MESA_SHADER_CACHE_DISABLE", "true")  # a cache would hide compile times
    import moderngl

    create: Any = moderngl.create_standalone_context
    return create(backend="egl", require=REQUIRED)  # some drivers give no more than the version that is asked for


@cache
def find() -> list[DeviceInfo]:
    """Find the OpenGL device that EGL gives.

    A device that cannot be used says so in its problem. If there is none, a stand-in's problem says why.
    """
    versions = (("moderngl", version("moderngl")),)
    try:
        context = _context()
    except Exception as error:  # glcontext raises bare Exception
        reason = f"no OpenGL through EGL ({error}): install libegl1, libgl1 and libgl1-mesa-dri, or a GPU driver"
        return [DeviceInfo("opengl:none", "none", "none", "none", None, False, "wall", versions, reason)]
    info = context.info
    words = f"{info['GL_RENDERER']} {info['GL_VENDOR']}".lower()
    short = next((name for name in SHORT if name in words), words.split()[0])
    problem = None if context.version_code >= REQUIRED else f"OpenGL {context.version_code / 100}, 4.3 is needed"
    return [
        DeviceInfo(
            name=f"opengl:{'nvidia' if short == 'geforce' else short}",
            title=info["GL_RENDERER"],
            driver=info["GL_VERSION"],
            compiler=_compiler(info["GL_RENDERER"], info["GL_VERSION"]),
            compute_units=None,
            float64=problem is None and _keeps_doubles(context),
            clock="device",
            versions=versions,
            problem=problem,
            resident=None if short in SOFTWARE else GPU_RESIDENT,
        )
    ]


def names() -> list[str]:
    """List the names of what `find` finds, which may have problems."""
    return [found.name for found in find()]


def info(name: str) -> DeviceInfo:
    """Describe one device of `names`."""
    return next(found for found in find() if found.name == name)


def _keeps_doubles(context: Any) -> bool:
    """Tell whether an array of doubles that is indexed at run time keeps them.

    NVIDIA's driver 580 rounds them to float32.
    """
    kept = np.array([3.0, 0.0, 0.0, 1.0 / 3.0, 0.0])
    buffer = context.buffer(kept.tobytes())
    buffer.bind_to_storage_buffer(0)
    try:
        context.compute_shader(DOUBLES).run(1)
    except Exception:  # moderngl.Error: the compiler knows no doubles
        return False
    context.finish()
    return bool(np.frombuffer(buffer.read())[4] == kept[3])


def _compiler(renderer: str, version: str) -> str:
    llvm = re.search(r"LLVM [\d.]+", renderer)
    return llvm[0] if llvm else version


def open(_name: str) -> OpenGLDevice:
    """Open the OpenGL device; there is one, whatever the name."""
    return OpenGLDevice()


class OpenGLDevice(Device, Rasteriser):
    """Hold the OpenGL device: the process's context."""

    language = "glsl"

    def __init__(self) -> None:
        self.info = find()[0]
        self._context = _context()
        self.most_groups = _most_groups(self._context)  # of one launch

    def build(self, program: Program) -> Built:
        """Compile a program, for launches of this device only.

        Raises BuildError if the driver's compiler refuses, or if the program is to be built without optimisation.
        """
        import moderngl

        if not program.optimised:
            raise BuildError(f"{self.info.name}: OpenGL compilers cannot be told not to optimise")
        try:
            if program.vertex:
                vertex = source(program.vertex)
                return self._context.program(vertex_shader=vertex, fragment_shader=program.text)
            return self._context.compute_shader(program.text)
        except moderngl.Error as error:
            log = str(error)
            at = dataclasses.replace(program, sections=program.vertex) if "vertex_shader" in log else program
            raise BuildError(explained(at, log)) from None

    def launch_raster(
        self,
        batches: Sequence[Batch],
        built: Sequence[Built],
        camera: Array,
        depth_map: tuple[float, float],
        size: int,
        fill: Built | None = None,
    ) -> RasterLaunch:
        return OpenGLRasterLaunch(self._context, batches, built, camera, depth_map, size, fill)

    def launch_steps(
        self, buffers: Sequence[Array | Reserved], outputs: Sequence[int], steps: Sequence[Step]
    ) -> StepLaunch:
        return OpenGLLaunch(self._context, buffers, outputs, steps)


def _most_groups(context: Any) -> int:
    return int(context.info["GL_MAX_COMPUTE_WORK_GROUP_COUNT"][0])


def _groups(step: Step) -> int:
    return -(-step.grid[0] // (step.group or GROUP))


class OpenGLLaunch(StepLaunch):
    """Hold built compute shaders and their buffers.

    Raises FirsthitError if a step needs more work groups than the device runs at once.
    """

    def __init__(
        self, context: Any, buffers: Sequence[Array | Reserved], outputs: Sequence[int], steps: Sequence[Step]
    ) -> None:
        self._context, self._steps = context, steps
        groups, most = max(_groups(step) for step in steps), _most_groups(context)
        if groups > most:
            raise FirsthitError(
                f"{groups} work groups are needed, and this device runs {most} at once: take a smaller size"
            )
        start = time.perf_counter()

        def buffer(of: Array | Reserved) -> Any:
            if isinstance(of, Reserved) and of.fill is None:
                return context.buffer(reserve=max(1, of.count) * np.dtype(of.kind).itemsize)
            return context.buffer((of.filled() if isinstance(of, Reserved) else of).tobytes())

        self._buffers = [buffer(b) for b in buffers]
        self._timer = context.query(time=True)
        context.finish()
        self.upload_ms = (time.perf_counter() - start) * 1e3
        kinds = [b.kind if isinstance(b, Reserved) else b.dtype for b in buffers]
        self._outputs = [(self._buffers[place], kinds[place]) for place in outputs]

    def run(self, times: int = 1) -> Timing:
        start = time.perf_counter()
        with self._timer:
            for _ in range(times):
                for step in self._steps:
                    self._take(step)
        self._context.finish()
        return Timing((time.perf_counter() - start) * 1e3, self._timer.elapsed / 1e6)

    def _take(self, step: Step) -> None:
        for binding, place in enumerate(step.buffers):
            self._buffers[place].bind_to_storage_buffer(binding)
        for name, value in {"nx": step.grid[0], "ny": step.grid[1], **step.numbers}.items():
            if name in step.built:
                step.built[name] = value
        step.built.run(_groups(step), step.grid[1])
        if len(self._steps) > 1:
            self._context.memory_barrier()

    def write(self, place: int, values: Array) -> None:
        self._buffers[place].write(values.tobytes())

    def read(self) -> list[Array]:
        return [np.frombuffer(buffer.read(), kind) for buffer, kind in self._outputs]

    def release(self) -> None:
        for buffer in self._buffers:
            buffer.release()
