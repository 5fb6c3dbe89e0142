"""Count the cells of a plan without making any, and ask before a plan that is larger than most people mean."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from harness.contract import DeviceInfo, FirsthitError
from harness.experiment import kinds
from harness.experiment.config import FASTEST, Experiment, views_of
from harness.experiment.targets import choose_devices
from harness.plugins import Catalog

MOST = 20_000  # cells of a plan that nobody is asked about


def cells_of(experiment: Experiment, catalog: Catalog, found: Sequence[DeviceInfo] | None = None) -> int:
    """Return how many cells harness.experiment.plan.grid lists for the devices `found`.

    Without them, before devices were looked for, it is the least number of cells: each of the words all, any and
    fastest stands for a device that is named too, or for one.
    """
    config = experiment.config
    shots = len(config.sizes) * len(config.samples_per_pixel)
    frames = len(experiment.surfaces) * len(config.view) * shots
    scenes = sum(len(views_of(scene, config)) for scene in experiment.scenes) * shots
    total = 0
    alike = Counter((one.method, experiment.stages_of(one), experiment.devices_of(one)) for one in experiment.variants)
    for (name, stages, words), variants in alike.items():
        method = catalog.get(name).method
        rastered = len(kinds.rasterings("raster", method, experiment)) if scenes else 0
        staged = sum(len(kinds.rasterings(stage, method, experiment)) for stage in stages)
        origins = len(kinds.of_method(method).origins(experiment))
        casters = variants * len(experiment.prepasses) * origins * len(experiment.precisions)
        devices = _devices(experiment, words, found)
        total += casters * devices * (frames * staged + scenes * rastered + len(config.families))
    return total


def _devices(experiment: Experiment, words: Sequence[str], found: Sequence[DeviceInfo] | None) -> int:
    if found is None:
        return max(1, len({*words} - {"all", "any", FASTEST}))
    return len(choose_devices(list(words), list(found), kinds.only_rasters(experiment)))


def check_size(
    experiment: Experiment, catalog: Catalog, found: Sequence[DeviceInfo] | None = None, yes: bool = False
) -> str | None:
    """Say of a large plan how many cells it has, at least where devices are not `found` yet; None of any other.

    Raises FirsthitError as `asked` does.
    """
    cells = cells_of(experiment, catalog, found)
    return asked(f"{experiment.path}: {'at least ' if found is None else ''}{cells:,} cells", cells, yes)


def asked(told: str, cells: int, yes: bool) -> str | None:
    """Return what is `told` of so many cells if they are many, else None.

    Raises FirsthitError where they are many and nobody said `yes` to that.
    """
    if cells <= MOST:
        return None
    if not yes:
        raise FirsthitError(f"{told}; more than {MOST:,} are run with --yes only (from Python: yes=True)")
    return told
