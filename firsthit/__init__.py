"""Find where rays first hit implicit surfaces f(x, y, z) = 0, by published methods, and how exactly each answers.

    import firsthit
    rays = firsthit.rays_of(firsthit.View("front"), "torus", 256)
    hits = firsthit.trace("torus", rays, method="newton")     # on a device of this machine
    truth = firsthit.oracle("torus", rays)                    # intervals proved to hold the first hits

A surface is given as a name of the catalog (`firsthit.surfaces.names()`), as the text of a formula, which is then drawn
in a ball of radius 1.5 about the origin, or as a Surface: `surfaces.get("torus", R="0.5")`,
`surfaces.from_formula("x^2 + y^2 - a", "box:1,1,1", parameters={"a": 0.3})`.

Rays are float32[n, 6]: an origin and a direction of length 1 each. Lengths are in the surface's own units, angles in
degrees. What a caller can put right is raised as FirsthitError. A folder of methods of your own goes by `plugins`; its
method.py imports Method and Parameter from here, see docs/methods.md.
"""

from __future__ import annotations

import re
import warnings
from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import surfaces as surfaces
from harness import __version__ as __version__
from harness.contract import (
    CLAIMS,
    Box,
    CellStatus,
    DeviceInfo,
    Domain,
    FirsthitError,
    Hits,
    MeshRecipe,
    Method,
    Origin,
    Parameter,
    Precision,
    RayStatus,
    Sphere,
    Surface,
    Truth,
    TruthStatus,
    Variant,
    View,
)
from harness.limits import JOBS, PICTURE, PIXELS, checked_names, checked_path, held
from surfaces.words import COORDINATES

if TYPE_CHECKING:
    import numpy as np
    import pandas as pd
    from numpy.typing import NDArray

    from harness.recommend.model import Quantile, Recommendation
    from harness.running.run import Run
    from harness.running.trace import Caster

__all__ = [
    "CLAIMS",
    "Box",
    "CellStatus",
    "DeviceInfo",
    "Domain",
    "FirsthitError",
    "Hits",
    "MeshRecipe",
    "Method",
    "Origin",
    "Parameter",
    "Precision",
    "RayStatus",
    "Recommendation",
    "Run",
    "Sphere",
    "Surface",
    "Truth",
    "TruthStatus",
    "Variant",
    "View",
    "devices",
    "load",
    "methods",
    "oracle",
    "rays_of",
    "recommend",
    "render",
    "run",
    "surfaces",
    "trace",
]

AnySurface = str | Surface
AnyPath = str | Path
_LATE = {"Run": "harness.running.run", "Recommendation": "harness.recommend.model"}  # imported where they are used
_NAME = re.compile("[A-Za-z0-9_:]+")


def __getattr__(name: str) -> Any:
    if name in _LATE:
        from importlib import import_module

        return getattr(import_module(_LATE[name]), name)
    raise AttributeError(f"module 'firsthit' has no attribute {name!r}")


def methods(plugins: AnyPath | None = None) -> dict[str, Method]:
    """Return every method by its name: ours, those of installed packages, and those in the folder `plugins`.

    A folder whose method.py cannot be loaded, or states what makes no sense, is left out; `trace` says why when it is
    named. Raises FirsthitError where `plugins` is no folder or two methods have one name.
    """
    from harness.plugins import find_methods

    return {name: plugin.method for name, plugin in sorted(find_methods(_folder(plugins)).plugins.items())}


def devices() -> list[DeviceInfo]:
    """Look for the devices of this machine, in processes of their own. The `problem` of a usable one is None."""
    from harness.devices.discovery import discover_devices

    return discover_devices()


def rays_of(view: View, surface: AnySurface, size: int) -> NDArray[np.float32]:
    """Return the rays through the pixels' middles of a square picture: float32[size², 6], row by row from the top left.

    A view without a distance stands where the surface's bounding sphere just fills its field of view. Raises
    FirsthitError for a surface that there is not, for what is no View, and for a size that no picture has.
    """
    from harness.scenes import camera

    held("view", view, View)
    return camera.rays_of(camera.camera_for(view, _surface(surface)), held("size", size, Annotated[int, PIXELS]))


def trace(
    surface: AnySurface,
    rays: NDArray[np.float32],
    method: str,
    device: str | None = None,
    *,
    knobs: Mapping[str, float] | None = None,
    precision: Precision = "float32",
    origin: Origin = "nearest",
    t_min: float = 0.0,
    plugins: AnyPath | None = None,
    timeout: float = 60.0,
) -> Hits:
    """Cast rays float32[n, 6] by a method and return what it answers for each of them, right or wrong.

    The device is a name of `devices()`, or the first usable one. `knobs` are the method's parameters that are not to
    have their default; `origin` says where the method sees its rays begin; only hits from the distance `t_min` on
    count. Compiling and casting may each take `timeout` seconds. Warns where f, evaluated in float64, contradicts many
    answers.

    Raises FirsthitError for rays, names and numbers that make no sense, where the method refuses the surface, and with
    exit_code 3 where the device is not here, or it, its compiler or the method's kernel fails.
    """
    from harness.running.trace import cast, checked_rays

    chosen, checked = _surface(surface), checked_rays(rays)
    caster = _caster(method, device, knobs, precision, origin, plugins, timeout)
    return cast(caster, chosen, checked, t_min=t_min, tell=_warn)


def oracle(surface: AnySurface, rays: NDArray[np.float32], t_min: float = 0.0, *, jobs: int | None = None) -> Truth:
    """Return proved intervals of the first hits of rays float32[n, 6] from the distance `t_min` on.

    A ray on which neither a hit nor a miss could be proved is UNDECIDED. No device is used. Many rays are
    certified by `jobs` processes, one for each core if that is None; the answers do not depend on it. Raises
    FirsthitError for a surface, rays or a distance that make no sense.
    """
    from harness.oracle import first_hits
    from harness.running.trace import checked_rays

    chosen, checked = _surface(surface), checked_rays(rays)
    with _processes(jobs):
        return first_hits(chosen, checked, t_min)


def render(
    surface: AnySurface,
    method: str,
    device: str | None = None,
    *,
    size: int = 512,
    view: View | tuple[float, float] = (30.0, 30.0),
    knobs: Mapping[str, float] | None = None,
    precision: Precision = "float32",
    origin: Origin = "nearest",
    plugins: AnyPath | None = None,
    timeout: float = 60.0,
) -> NDArray[np.uint8]:
    """Draw a surface by a method and return the picture, uint8[size, size, 3] in RGB, row 0 at the top.

    `view` is a View, or its azimuth and elevation in degrees. The light is at the eye, the ground is white; rays that
    the method gave up are orange, answers that can be none magenta. The other arguments, and what is raised, are those
    of `trace`.
    """
    from harness.running.picture import picture, shown_by

    held("size", size, Annotated[int, PICTURE])
    chosen, shown = _surface(surface), shown_by(view)
    caster = _caster(method, device, knobs, precision, origin, plugins, timeout)
    return picture(caster, chosen, shown, size, _warn)[0]


def run(
    config: AnyPath,
    *,
    runs: AnyPath = "runs",
    devices: Sequence[str] = (),
    force: bool = False,
    retry_failed: bool = False,
    wait: bool = False,
    yes: bool = False,
    jobs: int | None = None,
    shard: str | None = None,
    cluster: AnyPath | None = None,
    plugins: AnyPath | None = None,
    tell: Callable[[str], None] | None = None,
) -> Run:
    """Run a config: check each cell's answers against the oracle, time it, and store its row in a folder below `runs`.

    `config` is the path of a TOML file, or the name of a config that firsthit ships, as in "quick". `devices` take the
    place of those that it names. Finished cells are reused; `force` runs them again, `retry_failed` runs those again
    that failed, timed out or crashed. A plan of more than 20,000 cells is run with `yes` only. First hits are
    certified by `jobs` processes, one for each core if that is None; never while a time is taken. With `shard`, as in
    "3/16", that part of the config is run, into a folder of its own. With `cluster`, cells run on the devices of a Dask
    cluster, and its cores take the oracle's work: the HOST:PORT of its scheduler, "local" or "local:N" for one on this
    machine, or the path of a TOML file for Slurm (docs/cluster.md). `tell` is called with a line of text for whatever
    ends; `print` will do. Where another run writes into the same folder, `wait` waits until it has ended. A run that
    was stopped, as by interrupting a notebook, goes on from there when it is called again.

    A cell that fails is a row that says why. Raises FirsthitError for an argument that makes no sense, with file and
    line for a mistake in the config, and with exit_code 3 where none of its devices is there, the folder is another
    run's, a row cannot be written, or the cluster cannot be reached or needs a package that is missing.
    """
    import shlex
    from contextlib import ExitStack

    from harness.running import run as running

    checked_path("config", config)
    folder = checked_path("runs", runs)
    named, watcher = checked_names("devices", devices), running.teller(tell)
    given = running.read(config, _folder(plugins), named, watcher, yes, shard=shard)
    words = ["firsthit", *(["--plugins", str(plugins)] if plugins else []), "run", str(config), "--runs", str(runs)]
    stated = {"--cluster": cluster, "--shard": shard}
    words += [word for name, said in stated.items() if said is not None for word in (name, str(said))]
    words += ["--yes"] if yes else []
    command = shlex.join([*words, *(word for name in devices for word in ("--device", name))])
    again: dict[str, Any] = {"force": force, "retry_failed": retry_failed, "wait": wait}
    with ExitStack() as held_open:
        held_open.enter_context(_processes(jobs))
        if cluster is not None:
            from harness.cluster import starting

            again["fleet"] = held_open.enter_context(starting.opened(str(cluster), given, watcher.warned))
        return running.run(given, folder, command, watcher=watcher, **again)


def load(folder: AnyPath) -> pd.DataFrame:
    """Return a run's cells as a table: a row each, with the columns of results.csv, as `median_ms` and `error_max`.

    `folder` is a Run's, any that `firsthit run` made, or a file of `firsthit archive`. Families of hard rays are not
    among the rows. Raises FirsthitError where it is no such folder or file, or no cell is finished and, with exit_code
    3, where pandas is missing.
    """
    try:
        from reports.analysis.derive import derive
        from reports.reading.load import opened
    except ModuleNotFoundError as error:
        message = f"a table of results needs the package {error.name}: pip install 'firsthit[report]'"
        raise FirsthitError(message, exit_code=3) from None
    with opened(checked_path("folder", folder)) as found:
        frame = derive(found.frame, found.plan.peaks)
    return frame.drop(columns=["label", "method_label"])  # results.csv has no words


def recommend(
    surface: AnySurface,
    error: float,
    device: str | None = None,
    *,
    quantile: Quantile = "max",
    fps: float = 0.0,
    size: int = 512,
    precision: Precision | None = None,
    views: int = 5,
    rays: int = 64,
    seconds: float = 1.0,
    seed: int = 1,
    require: Sequence[str] = (),
    yes: bool = False,
    runs: AnyPath = "runs",
    wait: bool = False,
    jobs: int | None = None,
    plugins: AnyPath | None = None,
    tell: Callable[[str], None] | None = None,
) -> Recommendation:
    """Search for the fastest variants whose certified |t - t*| stays within `error`, in the surface's units.

    The bound is on a quantile of the errors ("max", "p999" or "p99") on `rays`² rays of each of `views` views, chosen
    by `seed`, and of half as many views held out, two at least. Pictures of `size`² pixels are timed for `seconds` a
    variant and view; under `fps` frames a second a variant falls. Without a precision float64 is tried where no float32
    holds. Only methods that make all claims of `require`, names of CLAIMS, are tried. Rows are kept below `runs`, where
    `wait` waits for another search of the same surface to end; `tell` is called with a line of text for each step and
    whatever ends. More than 20,000 checks need `yes`. `jobs` is that of `run`.

    `contenders` of the answer is empty where nothing holds, and `fallen` says why. Raises FirsthitError for names and
    numbers that make no sense, and with exit_code 3 where the device is not here or a row cannot be written.
    """
    from harness.plugins import find_methods
    from harness.recommend import model, search
    from harness.running.run import teller

    wish = model.Wish(
        surface=_surface(surface),
        error=error,
        quantile=quantile,
        fps=fps,
        size=size,
        precision=precision,
        views=views,
        rays=rays,
        seed=seed,
        seconds=seconds,
        require=tuple(checked_names("require", require)),
    )
    catalog, folder = find_methods(_folder(plugins)), checked_path("runs", runs)
    stated = wish, catalog, device, folder, teller(tell)
    with _processes(jobs):
        return search.recommend(*stated, command="firsthit.recommend", wait=wait, yes=yes)


def _surface(given: AnySurface) -> Surface:
    """Return a Surface as it is, and for a text the surface that it names or describes.

    A text of letters, digits, _ and : alone is a name of the catalog, but for x, y and z; any other is a formula.
    Raises FirsthitError for a name that the catalog does not have, and for a formula with a mistake in it.
    """
    if isinstance(given, Surface):
        return given
    if not isinstance(given, str):
        raise FirsthitError(f"a surface is a name, a formula or a Surface, not {type(given).__name__}")
    named = _NAME.fullmatch(given) and given not in COORDINATES
    return surfaces.get(given) if named else surfaces.from_formula(given)


def _caster(
    method: str,
    device: str | None,
    knobs: Mapping[str, float] | None,
    precision: Precision,
    origin: Origin,
    plugins: AnyPath | None,
    timeout: float,
) -> Caster:
    from harness.plugins import find_methods
    from harness.running.trace import Caster, usable_device

    catalog = find_methods(_folder(plugins))
    for note in catalog.notes:
        _warn(note)
    plugin = catalog.get(method)
    variant = plugin.variant({} if knobs is None else knobs)
    return Caster(plugin, variant, usable_device().name if device is None else device, precision, origin, timeout)


def _processes(jobs: int | None) -> AbstractContextManager[None]:
    """Let `jobs` processes take the oracle's work while a block runs. Raises FirsthitError for no such number."""
    from harness.spreading import pool

    return pool.over(None if jobs is None else held("jobs", jobs, Annotated[int, JOBS]))


def _folder(plugins: AnyPath | None) -> Path | None:
    return None if plugins is None else checked_path("plugins", plugins)


def _warn(line: str) -> None:
    warnings.warn(line, stacklevel=4)
