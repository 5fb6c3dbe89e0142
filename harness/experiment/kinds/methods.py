"""State what follows from what a method's kernel casts, so that plan, runner and commands ask and branch on nothing."""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy as np
from numpy.typing import NDArray

from harness.contract import (
    FirsthitError,
    Hits,
    Method,
    Normal,
    Origin,
    Program,
    Proxy,
    Stage,
    Surface,
    Variant,
)
from harness.devices.messages import Check
from harness.experiment.config import Experiment
from harness.experiment.kinds.drawing import Drawing
from harness.kernels.assemble import Entry
from harness.plugins import Plugin
from harness.scenes.model import Group

Rastering = tuple[Proxy, float, Normal]  # proxy, tolerance in pixels, normal: of stage raster only
NOT_RASTERED: Rastering = ("box", 0.0, "distance")


class MethodKind(ABC):
    """State what follows from what a method's kernel casts.

    Kinds state the properties as class attributes. A shot is an image, or listed rays, that `firsthit show` and
    `firsthit trace` cast once. What `unlisted`, `undrawn` and `shot_refusal` say continues a sentence that begins with
    the method's name.
    """

    @property
    @abstractmethod
    def what(self) -> str:
        """Name what the method casts, in the plural: rays, beams, triangles."""

    @property
    @abstractmethod
    def entries(self) -> tuple[Entry, ...]:
        """List the entries of the method's programs, which `firsthit compile` builds; the first is that of shots."""

    @property
    @abstractmethod
    def unlisted(self) -> str | None:
        """Say why listed rays cannot be cast; None if they can."""

    @property
    @abstractmethod
    def undrawn(self) -> str | None:
        """Say why stage raster cannot draw by the method; None if it can."""

    @property
    def answers_rays(self) -> bool:
        """Tell whether an answer is that of one ray, so that an error along the ray can be told of it."""
        return self.unlisted is None

    @property
    def hard_entries(self) -> tuple[Entry, ...]:
        """List the entries of the programs that cast families of hard rays; () if the method cannot cast them."""
        return ()

    def hard_check(self, programs: tuple[Program, ...], surface: Surface, rays: NDArray[np.float32]) -> Check[Hits]:
        """Make the check that casts rays float32[n, 6] of no image by the programs of `hard_entries`.

        Raises FirsthitError if the method cannot.
        """
        raise FirsthitError(f"the method {self.unlisted}")

    def view_check(
        self,
        programs: tuple[Program, ...],
        surface: Surface,
        camera: NDArray[np.float32],
        rays: NDArray[np.float32],
        size: int,
    ) -> Check[Hits]:
        """Make the check that casts a view's rays, rays_of(camera, k), by the programs of `hard_entries`.

        A kind that answers for pixels casts them as pixels of a frame of `size` x `size` pixels or more. Raises
        FirsthitError if the method cannot.
        """
        return self.hard_check(programs, surface, rays)

    def stage_refusal(self, stage: Stage) -> str | None:
        """Say why the method cannot cast in a stage other than raster; None if it can."""
        return f"the method {self.unlisted}" if stage == "rays" and self.unlisted else None

    def origin_refusal(self, method: Method, origin: Origin) -> str | None:
        """Say why the method cannot begin its rays at `origin`; None if it can."""
        if origin == "nearest":
            return None
        return f"an origin is chosen for rays, and the method {method.name} casts {self.what}"

    def origins(self, experiment: Experiment) -> tuple[Origin, ...]:
        """List the origins that make a difference to the method. One without rays has a single cell for all of them."""
        return ("nearest",)

    def told_origin(self, origin: Origin) -> Origin | None:
        """Return the origin that a row names; None if the method has none."""
        return None

    def rasterings(self, method: Method, experiment: Experiment) -> list[Rastering]:
        """List the ways to rasterise that make a difference to the method."""
        return [NOT_RASTERED]

    def draw_refusal(self, method: Method, variant: Variant, group: Group) -> str | None:
        """Say why the method cannot draw a scene's group of instances; None if it can."""
        return None

    def draw_programs(self, plugin: Plugin, drawing: Drawing) -> tuple[Program, Program]:
        """Make the programs that draw a group: the timed one, and the one that reports what it answers.

        Raises FirsthitError if the method cannot draw the group.
        """
        raise FirsthitError(f"{drawing.variant} {self.undrawn}")

    def compiled_drawing(self, plugin: Plugin, surface: Surface) -> Program | None:
        """Make the reporting program of stage raster, for `firsthit compile`; None if the method draws nothing.

        The reporting program contains the timed one's text.
        """
        return None

    def shot_refusal(self, camera: NDArray[np.float32] | None) -> str | None:
        """Say why the method cannot cast a shot; None if it can.

        `camera`, float32[12], is the camera whose image the shot is; None if the rays are listed ones.
        """
        return self.unlisted if camera is None else None
