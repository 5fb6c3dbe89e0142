"""Certify what is seen of a scene: the oracle is asked for each instance that a ray may meet, in its coordinates."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from harness.accuracy import answers
from harness.accuracy.check import Certified
from harness.contract import Hits, Origin, Surface, Truth, TruthStatus
from harness.devices.raster import Picture
from harness.oracle import cached_first_hits
from harness.scenes.model import Group, Scene
from harness.scenes.records import pack

CHUNK = 2**22  # pairs of ray and instance that are looked at together
SLACK = 1e-5  # of a bounding sphere's radius, for rounding
DEPTH_SHARE = 1e-6  # of the depth: nearer to each other, the depth buffer may confuse two instances


@dataclass(frozen=True, eq=False)
class Seen(Certified):
    """Hold the certified picture of n rays, in world units.

    batch: int32[n], number of the group of the first hit; -1 without a hit
    instance: int32[n], number of the instance within the group
    gap: float64[n], from the first hit to the next instance's; inf if there is none
    """

    batch: NDArray[np.int32]
    instance: NDArray[np.int32]
    gap: NDArray[np.float64]

    def other_instance(self, picture: Picture) -> NDArray[np.bool_]:
        """Return bool[n]: the picture shows another instance than the one that is first.

        Instances that are so close that the depth buffer may confuse them do not count.
        """
        both = (self.batch >= 0) & (picture.batch >= 0)
        other = (self.batch != picture.batch) | (self.instance != picture.instance)
        return np.asarray(both & other & (self.gap > DEPTH_SHARE * self.truth.upper))


@dataclass(frozen=True, eq=False)
class _Part:
    """Hold k pairs of a ray and an instance that it may meet.

    local: float32[k, 6], the world's ray in the instance's coordinates
    cast: float32[k, 6], the ray that the fragment cast, if the instance is seen in the picture; otherwise `local`
    """

    local: NDArray[np.float32]
    cast: NDArray[np.float32]
    pixel: NDArray[np.intp]
    batch: NDArray[np.int_]
    instance: NDArray[np.intp]
    scale: NDArray[np.float64]


def scale_of(scene: Scene, picture: Picture) -> NDArray[np.float64]:
    """Return float64[n]: the scale of the instance that is seen; 1 if none is."""
    found = np.ones(len(picture.t))
    for number, group in enumerate(scene.groups):
        mine = (picture.batch == number) & ~picture.in_world
        found[mine] = pack(group)[picture.instance[mine], 15]
    return found


def hits_of(scene: Scene, picture: Picture, origin: Origin = "nearest") -> Hits:
    """Return the hits [n] that a frame with reporting programs answered for its n pixels, in world units.

    Impossible answers are INVALID: the point that is seen has to lie in its surface's domain, or, on a triangle, in
    front of the eye. `origin` is where the fragments' t began.
    """
    possible = picture.in_world & (picture.t >= 0.0)
    for number, group in enumerate(scene.groups):
        mine = np.flatnonzero((picture.batch == number) & ~picture.in_world)
        numbers = {surface: k for k, surface in enumerate(group.distinct)}
        kind = np.broadcast_to([numbers[surface] for surface in group.surfaces], len(group))[picture.instance[mine]]
        for surface, k in numbers.items():
            at = mine[kind == k]
            possible[at] = answers.reachable(surface.domain, picture.local_rays[at], picture.t[at], origin=origin)
    return answers.only(picture.hits(scale_of(scene, picture)), possible)


def scene_truth(scene: Scene, rays: NDArray[np.float32], picture: Picture, folder: Path, margin: float) -> Seen:
    """Certify the first hits of rays float32[n, 6] in world coordinates; `folder` keeps the oracle's answers.

    Instances that a ray passes by within `margin`, in world units, are certified too: they make the ray a grazing one.
    The instance that is seen in the picture is certified on the local ray that its fragment cast, others on the world's
    ray as the instance's float32 record places it.
    """
    wide = rays.astype(np.float64)
    work: dict[Surface, list[_Part]] = defaultdict(list)
    for number, group in enumerate(scene.groups):
        records = pack(group)
        pixel, who = _candidates(group, wide, margin)
        numbers = {surface: k for k, surface in enumerate(group.distinct)}
        kind = np.array([numbers[surface] for surface in group.surfaces])
        for surface, k in numbers.items():
            mine = np.broadcast_to(kind, len(group))[who] == k
            at, own = pixel[mine], who[mine]
            if not len(at):
                continue
            local = _local(records[own], wide[at])
            seen = (picture.batch[at] == number) & (picture.instance[at] == own) & ~picture.in_world[at]
            cast = np.where(seen[:, None], picture.local_rays[at], local)
            scale = records[own, 15].astype(np.float64)
            work[surface].append(_Part(local, cast, at, np.full(len(at), number), own, scale))
    return _nearest(len(rays), [_certified(surface, parts, folder) for surface, parts in work.items()])


def _candidates(group: Group, rays: NDArray[np.float64], margin: float) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Find the pairs of a ray and an instance whose bounding sphere the ray meets, or passes within `margin`.

    Returns the numbers of the rays and of the instances, int[k] each; `rays` is float64[n, 6], `margin` in world units.
    """
    origins, directions = rays[:, :3], rays[:, 3:]
    pixels, instances = [], []
    step = max(1, CHUNK // len(rays))
    for start in range(0, len(group), step):
        spheres = group.spheres[start : start + step]
        # |c - o|² - ((c - o)·d)² over all pairs, d of length 1
        along = spheres[:, :3] @ directions.T - np.einsum("ij,ij->i", origins, directions)[None]
        squared = (
            np.einsum("ij,ij->i", spheres[:, :3], spheres[:, :3])[:, None]
            - 2.0 * spheres[:, :3] @ origins.T
            + np.einsum("ij,ij->i", origins, origins)[None]
        )
        reach = spheres[:, 3] * (1.0 + SLACK) + margin
        who, pixel = np.nonzero(squared - along * along <= (reach * reach)[:, None] + 1e-12 * squared)
        pixels.append(pixel)
        instances.append(who + start)
    return np.concatenate(pixels), np.concatenate(instances)


def _local(records: NDArray[np.float32], rays: NDArray[np.float64]) -> NDArray[np.float32]:
    """Return float32[k, 6]: each world ray in the coordinates of its instance."""
    rows = records[:, :12].astype(np.float64).reshape(-1, 3, 4)
    origins = np.einsum("kij,kj->ki", rows[:, :, :3], rays[:, :3]) + rows[:, :, 3]
    directions = np.einsum("kij,kj->ki", rows[:, :, :3], rays[:, 3:]) * records[:, 15:16].astype(np.float64)
    return np.concatenate([origins, directions], axis=1).astype(np.float32)


def _certified(surface: Surface, parts: list[_Part], folder: Path) -> tuple[_Part, Truth]:
    """Return all pairs of a surface as one part, and the certified first hits of the rays that were cast."""
    whole = _Part(*(np.concatenate([getattr(part, name) for part in parts]) for name in _Part.__dataclass_fields__))
    truth = cached_first_hits(surface, whole.local, folder)  # kept once for all methods
    other = (whole.cast != whole.local).any(axis=1)
    if other.any():
        own = cached_first_hits(surface, whole.cast[other], folder)
        values = {name: np.array(value) for name, value in vars(truth).items()}
        for name, value in vars(own).items():
            values[name][other] = value
        truth = Truth(**values)
    return whole, truth


def _nearest(n: int, found: list[tuple[_Part, Truth]]) -> Seen:
    """Choose from all pairs of a part and its truth what each of the n rays sees first."""
    lower, upper, following, condition = (np.full(n, np.nan) for _ in range(4))
    margin, contrast, second = (np.full(n, np.inf) for _ in range(3))
    status = np.full(n, TruthStatus.MISS, np.uint8)
    batch, instance = np.full(n, -1, np.int32), np.full(n, -1, np.int32)
    if found:
        names = ("pixel", "batch", "instance", "scale")
        pixel, group, who, scale = (np.concatenate([getattr(part, name) for part, _ in found]) for name in names)
        low, high, after, near, faint, ill, kind = (
            np.concatenate([getattr(truth, name) for _, truth in found])
            for name in ("lower", "upper", "following", "margin", "contrast", "condition", "status")
        )
        low, high, after, near = low * scale, high * scale, after * scale, near * scale
        there = np.isin(kind, (TruthStatus.CROSSING, TruthStatus.TOUCH))
        order = np.lexsort((np.where(there, low, np.inf), pixel))
        first = np.ones(len(order), bool)
        first[1:] = pixel[order][1:] != pixel[order][:-1]
        best, rest = order[first], order[~first]
        at = pixel[best]
        hit = there[best]
        lower[at[hit]], upper[at[hit]], condition[at[hit]] = low[best][hit], high[best][hit], ill[best][hit]
        status[at[hit]] = kind[best][hit]
        batch[at[hit]], instance[at[hit]] = group[best][hit], who[best][hit]
        following[at] = np.where(hit, after[best], np.inf)
        np.minimum.at(second, pixel[rest], np.where(there[rest], low[rest], np.inf))
        np.minimum.at(margin, pixel, near)
        np.minimum.at(contrast, pixel, faint)
        undecided = np.zeros(n, bool)
        np.logical_or.at(undecided, pixel, kind == TruthStatus.UNDECIDED)
        status[undecided] = TruthStatus.UNDECIDED
    following = np.fmin(following, second)
    following[np.isnan(following)] = np.inf
    with np.errstate(invalid="ignore"):
        gap = np.where(batch >= 0, second - upper, np.inf)
        margin = np.minimum(margin, np.where(batch >= 0, gap, np.inf))
    return Seen(Truth(lower, upper, status, following, condition, margin, contrast), batch, instance, gap)
