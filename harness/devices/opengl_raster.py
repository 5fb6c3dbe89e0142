"""Draw frames of triangles through moderngl: colour and depth and, if their programs report, what they answered."""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness.devices.interface import Array, Built, Timing
from harness.devices.raster import Batch, Picture, RasterLaunch

GL_DEPTH_CLAMP = 0x864F  # a proxy may reach in front of the near plane, though the surface in it does not


class OpenGLRasterLaunch(RasterLaunch):
    """Draw batches in order into one target with a depth buffer.

    `built` holds a program for each batch; with `fill` these programs report.
    """

    def __init__(
        self,
        context: Any,
        batches: Sequence[Batch],
        built: Sequence[Built],
        camera: NDArray[np.float32],
        depth_map: tuple[float, float],
        size: int,
        fill: Built | None = None,
    ) -> None:
        self._context, self._size, reports = context, size, fill is not None
        start = time.perf_counter()
        self._held: list[Any] = []
        self._timer = context.query(time=True)
        side = (size, size)
        self._colour = self._keep(context.texture(side, 4))
        floats = [self._keep(context.texture(side, 4, dtype="f4")) for _ in range(3 if reports else 0)]
        depth = self._keep(context.depth_renderbuffer(side))
        self._target = self._keep(context.framebuffer([self._colour, *floats], depth))
        self._seen = floats
        self._rays = self._keep(context.buffer(reserve=size * size * 24)) if reports else None
        self._counts = self._keep(context.buffer(np.zeros(5 * size * size, np.int32).tobytes())) if reports else None
        eye, forward, right, up = (tuple(map(float, part)) for part in camera.reshape(4, 3))
        self._uniforms = {
            "eye": eye,
            "forward": forward,
            "right": right,
            "up": up,
            "depth_map": depth_map,
            "size": size,
        }
        self.bytes = 0
        self._fill = None if fill is None else (fill, self._keep(context.vertex_array(fill, [])))
        self._calls = [self._call(batch, program) for batch, program in zip(batches, built, strict=True)]
        context.finish()
        self.upload_ms = (time.perf_counter() - start) * 1e3

    def _keep(self, held: Any) -> Any:
        self._held.append(held)
        return held

    def _buffer(self, values: Array) -> Any:
        self.bytes += values.nbytes
        return self._keep(self._context.buffer(np.ascontiguousarray(values).tobytes()))

    def _call(self, batch: Batch, program: Built) -> tuple[Built, Any, Any, int, bool]:
        instances, triangles = self._buffer(batch.instances), self._buffer(batch.triangles)
        content = []
        if batch.vertices is not None:
            content = [(self._buffer(batch.vertices), "3f 3f", "vertex_position", "vertex_normal")]
        array = self._keep(self._context.vertex_array(program, content, index_buffer=triangles, index_element_size=4))
        return program, instances, array, len(batch.instances), batch.closed

    def run(self, times: int = 1) -> Timing:
        start = time.perf_counter()
        with self._timer:
            for _ in range(times):
                self._draw()
        self._context.finish()
        return Timing((time.perf_counter() - start) * 1e3, self._timer.elapsed / 1e6)

    def _draw(self) -> None:
        import moderngl

        context = self._context
        self._target.use()
        context.viewport = (0, 0, self._size, self._size)
        self._target.clear(0.0, 0.0, 0.0, 0.0, depth=1.0)
        context.enable_only(moderngl.DEPTH_TEST)
        context.enable_direct(GL_DEPTH_CLAMP)
        if self._rays is not None and self._counts is not None:
            self._rays.bind_to_storage_buffer(1)
            self._counts.bind_to_storage_buffer(2)
        if self._fill:
            program, array = self._fill
            self._set(program, 0)
            array.render(moderngl.TRIANGLES, vertices=3)
            context.memory_barrier()
        for number, (program, instances, array, count, closed) in enumerate(self._calls):
            instances.bind_to_storage_buffer(0)
            self._set(program, number)
            if closed:
                context.enable(moderngl.CULL_FACE)
            else:
                context.disable(moderngl.CULL_FACE)
            array.render(moderngl.TRIANGLES, instances=count)
        context.disable_direct(GL_DEPTH_CLAMP)

    def _set(self, program: Built, batch: int) -> None:
        for name, value in {**self._uniforms, "batch": batch}.items():
            if name in program:
                program[name] = value

    def read(self) -> list[Array]:
        """Read the picture, uint8[size, size, 4], row 0 at the top."""
        return [self._flipped(np.frombuffer(self._colour.read(), np.uint8), 4)]

    def _flipped(self, values: Array, width: int) -> Array:
        rows = values.reshape(self._size, self._size, width)[::-1]
        return np.ascontiguousarray(rows)

    def picture(self) -> Picture:
        """Read what a frame with reporting programs answered; it must have been run once."""
        assert self._rays is not None and self._counts is not None
        count = self._size**2
        (colours,) = self.read()
        origin, direction, by = (
            self._flipped(np.frombuffer(texture.read(), np.float32), 4).reshape(count, 4) for texture in self._seen
        )
        rays = self._flipped(np.frombuffer(self._rays.read(), np.float32), 6).reshape(count, 6)
        counts = self._flipped(np.frombuffer(self._counts.read(), np.int32), 5).reshape(count, 5)
        seen = by[:, 0] > 0.0
        t = origin[:, 3].astype(np.float64) + direction[:, 3].astype(np.float64)
        return Picture(
            colours.reshape(count, 4),
            rays,
            np.concatenate([origin[:, :3], direction[:, :3]], axis=1),
            np.where(seen, t, np.nan),
            np.where(seen, by[:, 1], -1.0).astype(np.int32),
            by[:, 2].astype(np.int32),
            seen & (by[:, 3] > 0.0),
            counts[:, 0],
            counts[:, 2],
            counts[:, 3],
            counts[:, 1],
            counts[:, 4],
        )

    def release(self) -> None:
        for held in reversed(self._held):
            held.release()
