"""OpenGL through moderngl, without a window (EGL): compute shaders."""

from __future__ import annotations

import os
import re
import time
from collections.abc import Sequence
from functools import cache
from importlib.metadata import version
from typing import Any

import numpy as np

from harness.assemble import explain_log
from harness.backends import Array, BuildError, Device, Launch, Timing
from harness.contract import DeviceInfo, Program

SHORT = ("llvmpipe", "softpipe", "nvidia", "geforce", "radeon", "intel", "apple")
GROUP = 64
REQUIRED = 430


@cache
def _context() -> Any:
    """The process's one context; raises whatever the platform's EGL says where there is none."""
    os.environ.setdefault("MESA_SHADER_CACHE_DISABLE", "true")  # a cache would hide compile times
    import moderngl

    create: Any = moderngl.create_standalone_context
    return create(backend="egl")


@cache
def find() -> list[DeviceInfo]:
    """The OpenGL device that EGL gives, if any; an unusable one carries its problem."""
    versions = (("moderngl", version("moderngl")),)
    try:
        context = _context()
    except Exception as error:  # glcontext raises bare Exception
        reason = f"no OpenGL through EGL ({error}): install libegl1 and libgl1-mesa-dri, or a GPU driver"
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
            float64="GL_ARB_gpu_shader_fp64" in context.extensions or context.version_code >= 400,
            clock="wall",
            versions=versions,
            problem=problem,
        )
    ]


def _compiler(renderer: str, version: str) -> str:
    llvm = re.search(r"LLVM [\d.]+", renderer)
    return llvm[0] if llvm else version


def open(_name: str) -> OpenGLDevice:
    return OpenGLDevice()


class OpenGLDevice(Device):
    language = "glsl"

    def __init__(self) -> None:
        self.info = find()[0]
        self._context = _context()

    def build(self, program: Program) -> Any:
        import moderngl

        try:
            return self._context.compute_shader(program.text)
        except moderngl.Error as error:
            raise BuildError(f"{self.info.name}: {explain_log(program, str(error))}") from None

    def launch(
        self, built: Any, inputs: Sequence[Array], outputs: Sequence[tuple[int, type]], grid: tuple[int, int]
    ) -> Launch:
        return OpenGLLaunch(self._context, built, inputs, outputs, grid)


class OpenGLLaunch(Launch):
    def __init__(
        self,
        context: Any,
        shader: Any,
        inputs: Sequence[Array],
        outputs: Sequence[tuple[int, type]],
        grid: tuple[int, int],
    ) -> None:
        self._context, self._shader, self._grid = context, shader, grid
        self._groups = (-(-grid[0] // GROUP), grid[1])
        self._kinds = [kind for _, kind in outputs]
        start = time.perf_counter()
        self._inputs = [context.buffer(array.tobytes()) for array in inputs]
        self._outputs = [context.buffer(reserve=count * np.dtype(kind).itemsize) for count, kind in outputs]
        context.finish()
        self.upload_ms = (time.perf_counter() - start) * 1e3

    def run(self, times: int = 1) -> Timing:
        for binding, buffer in enumerate((*self._inputs, *self._outputs)):
            buffer.bind_to_storage_buffer(binding)
        for name, value in zip(("nx", "ny"), self._grid, strict=True):
            if name in self._shader:
                self._shader[name] = value
        start = time.perf_counter()
        for _ in range(times):
            self._shader.run(*self._groups)
        self._context.finish()
        return Timing((time.perf_counter() - start) * 1e3, None)

    def read(self) -> list[Array]:
        return [np.frombuffer(buffer.read(), kind) for kind, buffer in zip(self._kinds, self._outputs, strict=True)]

    def release(self) -> None:
        for buffer in (*self._inputs, *self._outputs):
            buffer.release()
