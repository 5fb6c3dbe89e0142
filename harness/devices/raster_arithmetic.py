"""Hash what a device rasterises: which pixels fixed proxies and a mesh cover, at which depths, and with which rays."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness.contract import Proxy
from harness.devices.bits import hash_of
from harness.devices.interface import Device
from harness.devices.raster import RECORD, Batch, RasterCheck, RasterFrame, corners
from harness.kernels.raster import fill_program, mesh_program, proof_program
from harness.kernels.sections import KERNELS

SIZE = 150  # pixels a side: no multiple of any tile's
INSTANCES = 16  # of each proxy, and of the mesh
NEAR, FAR = 2.0, 10.0
PROXIES: tuple[Proxy, ...] = ("box", "tetrahedron", "sphere")
TURNS = ((0.6, 0.8), (0.8, -0.6), (0.28, 0.96), (-0.96, 0.28))  # cosines and sines; numpy's would differ by host
# From the direction (2, -2, 1) / 3 at an angle of view of about 53 degrees, so that depths vary with perspective
CAMERA = ((4.0, -4.0, 2.0), (-2 / 3, 2 / 3, -1 / 3), (1 / 3, 1 / 3, 0.0), (-1 / 8, 1 / 8, 1 / 2))


def raster_arithmetic(device: Device) -> dict[str, str]:
    """Return part → hash of what the device, which draws triangles, makes of one frame with perspective.

    Raises BuildError where a program does not compile, and FirsthitError where two frames differ.
    """
    check = _check()
    picture = check.run(device, [device.build(program) for program in check.programs])
    parts: dict[str, list[NDArray[Any]]] = {
        "coverage": [picture.fragments],
        "what is seen": [picture.batch, picture.instance, picture.in_world],
        "rays": [picture.rays, picture.local_rays],
        "depths": [picture.t],
        "searches": [picture.fragment_hits, picture.exhausted, picture.evaluations, picture.invalid],
        "colours": [picture.colours],
    }
    return {part: hash_of(*values) for part, values in parts.items()}


def _check() -> RasterCheck:
    """Return the check of a frame of all proxies and the mesh, overlapping, that is drawn twice."""
    batches = [
        Batch(proof_program(proxy), _instances(seed), corners(proxy), None, True) for seed, proxy in enumerate(PROXIES)
    ]
    mesh = mesh_program(KERNELS / "map/mesh", reports=True)
    batches.append(Batch(mesh, _instances(len(PROXIES)), *_octahedron(), True))
    camera = np.array(CAMERA, np.float32).ravel()
    depth_map = FAR / (FAR - NEAR), -FAR * NEAR / (FAR - NEAR)
    return RasterCheck(RasterFrame(tuple(batches), camera, depth_map, SIZE), fill_program())


def _instances(seed: int) -> NDArray[np.float32]:
    """Return records float32[INSTANCES, RECORD] on a grid about the origin, each turned and scaled in its own way.

    They are made of sums, products and quotients alone, which are the same on every host.
    """
    records = np.zeros((INSTANCES, RECORD), np.float64)
    for k, record in enumerate(records):
        (ca, sa), (cb, sb) = TURNS[k % 4], TURNS[(k // 4 + seed) % 4]
        turn = ((ca * cb, -sa, ca * sb), (sa * cb, ca, sa * sb), (-sb, 0.0, cb))
        place = (k % 4 - 1.5 + seed / 8, k // 4 - 1.5 - seed / 16, (k * 5 % 7 - 3) / 4)
        scale = 0.25 + (k + seed) % 5 / 16
        for row in range(3):
            axis = [turn[column][row] / scale for column in range(3)]
            record[4 * row : 4 * row + 3] = axis
            record[4 * row + 3] = -(axis[0] * place[0] + axis[1] * place[1] + axis[2] * place[2])
        record[12:16] = -1.0, -1.0, -0.25, scale
        record[16:20] = 1.0, 1.0, 0.25, 1.0
        record[20:28] = 0.5, 0.75, 1.0, 1.0, 0.25 + k / 32, 0.75 - k / 32, 0.5, 0.25
    return records.astype(np.float32)


def _octahedron() -> tuple[NDArray[np.uint32], NDArray[np.float32]]:
    """Return triangles uint32[24], counterclockwise from outside, and vertices float32[6, 6] with slanted normals."""
    points = np.array([(1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)], np.float32)
    around = [(0, 1), (1, 2), (2, 3), (3, 0)]
    triangles = [(a, b, 4) for a, b in around] + [(b, a, 5) for a, b in around]
    slanted = points + np.float32(0.125)
    return np.array(triangles, np.uint32).ravel(), np.concatenate([points, slanted], axis=1)
