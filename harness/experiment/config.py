"""Experiment configs: TOML, typed, every mistake answered with file, line and the nearest thing that exists."""

from __future__ import annotations

import contextlib
import dataclasses
import difflib
import math
import tomllib
import types
import typing
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from harness.contract import (
    BASELINE,
    NORMALS,
    ORIGINS,
    PRECISIONS,
    PREPASSES,
    PROXIES,
    STAGES,
    FirsthitError,
    Normal,
    Origin,
    Precision,
    Prepass,
    Proxy,
    Stage,
    Surface,
    Variant,
    View,
)
from harness.plugins import Catalog
from harness.scenes.choice import SceneChoice, cut, scenes_of
from harness.scenes.model import Scene
from harness.scenes.views import AngleChoice, DirectionChoice, by_angle, by_direction


@dataclass(frozen=True)
class MethodChoice:
    """A method, and for each knob one value or several; several knobs multiply. `settings` are the papers' own, by the
    names that the method gives them. `stages` are this method's, where they are not the experiment's. `deviations`: the
    default, and beside it each knob that we changed at the value that the method's source prints."""

    name: str
    parameters: dict[str, list[float]] = field(default_factory=dict)
    settings: list[str] = field(default_factory=list)
    stages: list[str] = field(default_factory=list)
    deviations: bool = False


@dataclass(frozen=True)
class SurfaceChoice:
    """A surface of the config's own; without a formula the catalog's of that name. Without a domain it is in the
    catalog's, or in sphere:1.5."""

    formula: str = ""
    domain: str = ""
    parameters: dict[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class AccuracyChoice:
    """Accuracy is checked on each view sampled `size` × `size`.

    Rays nearer than `grazing_margin` scene radii to another answer are a class of their own; a variant that is wrong
    on more than `max_wrong_share` of the others is not timed. Where the oracle leaves more than a share of `undecided`
    hits, of those and the decided ones together, a row has no accuracy, and fails.
    """

    size: int = 128
    grazing_margin: float = 1e-3
    max_wrong_share: float = 0.5
    undecided: float = 0.01


@dataclass(frozen=True)
class BudgetChoice:
    """Per cell: `seconds` of timing, stopped early once the 95 % interval of the median is within `interval`;
    `timeout` seconds for any one step (build, check, one repetition), after which the worker is killed. A frame of more
    than so many `triangles` is skipped.

    A slow cell is timed in at least so many `rounds`, though they take up to 16 times `seconds`: fewer cannot tell two
    variants apart (8 at the level of reports.pairs). `repetitions` are the most that any cell is timed in.
    """

    seconds: float = 2.0
    interval: float = 0.02
    rounds: int = 8
    repetitions: int = 200
    timeout: float = 60.0
    triangles: int = 1_000_000_000


@dataclass(frozen=True)
class ToleranceChoice:
    """How much worse a gated figure may get: `absolute` + `relative` × the baseline. `better`: "lower" or "higher", if
    not as usual; `gated` = false leaves the figure alone."""

    absolute: float = 0.0
    relative: float = 0.0
    better: str = ""
    gated: bool = True


@dataclass(frozen=True)
class GateChoice:
    """Figures with tolerances of their own (harness.results.figures has the others'), and the device facts that must be
    the `same` for rows to be compared."""

    same: list[str] = field(default_factory=lambda: ["title", "driver", "compiler", "processor"])
    figures: dict[str, ToleranceChoice] = field(default_factory=dict)


@dataclass(frozen=True)
class Config:
    """An experiment: methods × prepass × origins × surfaces × views × sizes × samples × stages × precisions × devices,
    and, untimed, methods × families of hard rays × precisions × devices. `surfaces` and `families` may be ["all"].

    `baseline` is the method, or the variant by its label, that reports give speed-ups over.
    `studies` are computations of harness.studies. With `include`, a list of config files, it holds nothing else:
    each of them is run into its own folder, and one report collects them.
    """

    title: str
    include: list[str] = field(default_factory=list)
    baseline: str = BASELINE
    studies: list[str] = field(default_factory=list)
    method: list[MethodChoice] = field(default_factory=list)
    surfaces: list[str] = field(default_factory=list)
    families: list[str] = field(default_factory=list)
    view: list[View] = field(default_factory=list)  # those of `angles` and `directions` are added; default: one view
    angles: AngleChoice | None = None
    directions: DirectionChoice | None = None
    sizes: list[int] = field(default_factory=lambda: [256])
    samples_per_pixel: list[int] = field(default_factory=lambda: [1])
    precisions: list[str] = field(default_factory=lambda: ["float32"])
    stages: list[str] = field(default_factory=lambda: ["compute"])
    prepass: list[str] = field(default_factory=lambda: ["none"])
    origins: list[str] = field(default_factory=lambda: ["nearest"])  # of rays; beams and triangles have none
    proxies: list[str] = field(default_factory=lambda: ["box"])  # of stage raster
    tolerances: list[float] = field(default_factory=lambda: [0.0])  # of stage raster, in pixels; 0: the method's own
    normals: list[str] = field(default_factory=lambda: ["distance"])  # of stage raster: what hits are shaded by
    devices: list[str] = field(default_factory=lambda: ["all"])
    seed: int = 1
    accuracy: AccuracyChoice = field(default_factory=AccuracyChoice)
    budget: BudgetChoice = field(default_factory=BudgetChoice)
    surface: dict[str, SurfaceChoice] = field(default_factory=dict)
    scene: dict[str, SceneChoice] = field(default_factory=dict)  # drawn by stage raster, each from its own view
    gate: GateChoice = field(default_factory=GateChoice)


@dataclass(frozen=True)
class Experiment:
    """A config with every name in it resolved."""

    name: str
    path: Path
    text: str
    config: Config
    variants: tuple[Variant, ...]
    surfaces: tuple[Surface, ...]
    precisions: tuple[Precision, ...]
    stages: tuple[Stage, ...]
    included: tuple[Path, ...] = ()  # of a config that includes others
    prepasses: tuple[Prepass, ...] = ("none",)
    origins: tuple[Origin, ...] = ("nearest",)
    proxies: tuple[Proxy, ...] = ("box",)
    normals: tuple[Normal, ...] = ("distance",)
    scenes: tuple[Scene, ...] = ()
    own_stages: Mapping[Variant, tuple[Stage, ...]] = field(default_factory=dict)  # where they are not `stages`

    def stages_of(self, variant: Variant) -> tuple[Stage, ...]:
        return self.own_stages.get(variant, self.stages)


Where = tuple[str | int, ...]


class _Source:
    """The config's text, to say on which line something stands."""

    def __init__(self, path: Path, text: str) -> None:
        self.path, self.lines = path, text.splitlines()

    def error(self, where: Where, message: str) -> FirsthitError:
        return FirsthitError(f"{self.path}:{self._line(where)}: {message}")

    def _line(self, where: Where) -> int:
        """The line that sets `where`, or its nearest ancestor: tomllib keeps no positions, so the shortest beginning of
        the file that sets it is looked for."""
        for depth in range(len(where), 0, -1):
            for count in range(1, len(self.lines) + 1):
                with contextlib.suppress(tomllib.TOMLDecodeError):
                    if _has(tomllib.loads("\n".join(self.lines[:count])), where[:depth]):
                        return count
        return 1


def _has(table: Any, where: Where) -> bool:
    try:
        for part in where:
            table = table[part]
    except (KeyError, IndexError, TypeError):
        return False
    return True


def _read(kind: Any, value: Any, where: Where, source: _Source) -> Any:
    """`value` as `kind`: a dataclass, list, dict, str, float, int, bool, or a union of such with None."""
    origin = typing.get_origin(kind)
    name = ".".join(map(str, where))
    if dataclasses.is_dataclass(kind) and isinstance(kind, type):
        return _read_table(kind, value, where, source)
    if origin in (types.UnionType, typing.Union):
        return _read(next(k for k in typing.get_args(kind) if k is not type(None)), value, where, source)
    if origin is list:
        items = value if isinstance(value, list) else [value]
        if not items:
            raise source.error(where, f"{name} is empty; give at least one")
        return [_read(typing.get_args(kind)[0], item, (*where, i), source) for i, item in enumerate(items)]
    if origin is tuple:
        kinds = typing.get_args(kind)
        if not isinstance(value, list) or len(value) != len(kinds):
            raise source.error(where, f"{name} needs {len(kinds)} numbers, not {value!r}")
        return tuple(_read(k, item, (*where, i), source) for i, (k, item) in enumerate(zip(kinds, value, strict=True)))
    if origin is dict:
        if not isinstance(value, dict):
            raise source.error(where, f"{name} is a table of names, not {value!r}")
        return {key: _read(typing.get_args(kind)[1], item, (*where, key), source) for key, item in value.items()}
    if kind is float and isinstance(value, int) and not isinstance(value, bool):
        return value if "parameters" in where else float(value)
    if isinstance(value, float) and not math.isfinite(value):
        raise source.error(where, f"{name} is a finite number, not {value!r}")
    if not isinstance(value, kind) or isinstance(value, bool) != (kind is bool):
        words = {float: "a number", int: "a whole number", str: "a text in quotes", bool: "true or false"}[kind]
        raise source.error(where, f"{name} is {words}, not {value!r}")
    return value


def _read_table(kind: type[Any], value: Any, where: Where, source: _Source) -> Any:
    if not isinstance(value, dict):
        raise source.error(where, f"{'.'.join(map(str, where))} is a table, not {value!r}")
    hints = typing.get_type_hints(kind)
    place = ".".join(map(str, where)) or "the top level"
    for key in value:
        if key not in hints:
            near = difflib.get_close_matches(key, hints, 1)
            hint = f"did you mean {near[0]!r}?" if near else f"known: {', '.join(hints)}"
            raise source.error((*where, key), f"unknown key {key!r} in {place}; {hint}")
    for spec in dataclasses.fields(kind):
        required = spec.default is dataclasses.MISSING and spec.default_factory is dataclasses.MISSING
        if required and spec.name not in value:
            raise source.error(where, f"{place} lacks {spec.name!r}")
    return kind(**{key: _read(hints[key], item, (*where, key), source) for key, item in value.items()})


def _check_gate(gate: GateChoice, source: _Source) -> None:
    from harness.gate.baseline import FACTS
    from harness.results.figures import KNOWN

    for values, known, where in ((gate.same, FACTS, "same"), (gate.figures, KNOWN, "figures")):
        try:
            _known(values, known, where, source)
        except FirsthitError as error:
            raise source.error(("gate", where), str(error).split(": ", 1)[1]) from None
    for name, choice in gate.figures.items():
        if choice.better not in ("", "lower", "higher"):
            raise source.error(("gate", "figures", name, "better"), f"better: {choice.better!r} is not lower or higher")
        if not (choice.absolute >= 0.0 and choice.relative >= 0.0):
            raise source.error(("gate", "figures", name), f"{name}: a tolerance is not negative")


def _known(values: Iterable[str], known: Iterable[str], key: str, source: _Source) -> None:
    for value in values:
        if value not in known:
            near = difflib.get_close_matches(value, known, 1)
            hint = f"did you mean {near[0]!r}?" if near else f"known: {', '.join(known)}"
            raise source.error((key,), f"{key}: unknown {value!r}; {hint}")


def _positive(config: Config, source: _Source) -> None:
    checks: list[tuple[Where, float, float, float]] = [
        *((("sizes", i), size, 1, 16384) for i, size in enumerate(config.sizes)),
        (("accuracy", "size"), config.accuracy.size, 1, 4096),
        (("accuracy", "grazing_margin"), config.accuracy.grazing_margin, 0.0, 1.0),
        (("accuracy", "max_wrong_share"), config.accuracy.max_wrong_share, 0.0, 1.0),
        (("accuracy", "undecided"), config.accuracy.undecided, 0.0, 1.0),
        (("budget", "seconds"), config.budget.seconds, 0.0, 1e5),
        (("budget", "interval"), config.budget.interval, 0.0, 1.0),
        (("budget", "rounds"), config.budget.rounds, 1, 1e6),
        (("budget", "repetitions"), config.budget.repetitions, 1, 1e6),
        (("budget", "timeout"), config.budget.timeout, 1e-3, 1e6),
        *((("view", i, "fov"), view.fov, 1e-3, 179.0) for i, view in enumerate(config.view)),
        *(
            (("view", i, "distance"), view.distance, 1e-6, 1e9)
            for i, view in enumerate(config.view)
            if view.distance is not None
        ),
        *((("view", i, "azimuth"), view.azimuth, -360.0, 360.0) for i, view in enumerate(config.view)),
        *((("view", i, "elevation"), view.elevation, -90.0, 90.0) for i, view in enumerate(config.view)),
        *_view_set_limits(config),
    ]
    for where, value, low, high in checks:
        if not low <= value <= high:
            raise source.error(where, f"{'.'.join(map(str, where))}: {value} is outside [{low:g}, {high:g}]")
    for samples in config.samples_per_pixel:
        if samples not in (1, 4, 9, 16):
            raise source.error(("samples_per_pixel",), f"samples_per_pixel: {samples} is not one of 1, 4, 9, 16")
    for key, names in (
        ("angles", [f"{angle:g}" for angle in config.angles.values] if config.angles else []),
        ("view", [view.name for view in _with_view_sets(config).view]),
        ("surfaces", config.surfaces),
        ("families", config.families),
    ):
        if twice := [name for name in names if names.count(name) > 1]:
            raise source.error((key,), f"{key}: {twice[0]!r} is named twice")


def _view_set_limits(config: Config) -> Iterator[tuple[Where, float, float, float]]:
    if config.angles:
        yield from ((("angles", "values", i), angle, 0.0, 180.0) for i, angle in enumerate(config.angles.values))
        yield ("angles", "azimuth"), config.angles.azimuth, -360.0, 360.0
    if config.directions:
        yield ("directions", "count"), config.directions.count, 1, 10_000
    for key, choice in (("angles", config.angles), ("directions", config.directions)):
        if choice:
            yield (key, "fov"), choice.fov, 1e-3, 179.0
            if choice.distance is not None:
                yield (key, "distance"), choice.distance, 1e-6, 1e9


def _with_view_sets(config: Config) -> Config:
    views = [*config.view]
    views += by_angle(config.angles) if config.angles else []
    views += by_direction(config.directions) if config.directions else []
    return dataclasses.replace(config, view=views or [View("default")])


def _sweep(choice: MethodChoice) -> list[Mapping[str, float]]:
    grid: list[dict[str, float]] = [{}]
    for name, values in choice.parameters.items():
        grid = [{**point, name: value} for point in grid for value in values]
    return list(grid)


def _collection(path: Path, text: str, config: Config, table: dict[str, Any], source: _Source) -> Experiment:
    """The experiment of a config that includes others, named relative to its own folder."""
    if more := [key for key in table if key not in ("title", "include")]:
        raise source.error(
            (more[0],), f"{more[0]} cannot stand beside include; put it into one of the configs included"
        )
    paths = [path.parent / name for name in config.include]
    for i, included in enumerate(paths):
        if not included.is_file():
            raise source.error(("include", i), f"include: there is no config {included}")
        if paths.index(included) < i:
            raise source.error(("include", i), f"include: {config.include[i]!r} is named twice")
    return Experiment(path.stem, path, text, config, (), (), (), (), tuple(paths))


def _surface(name: str, parameters: Mapping[str, float], config: Config) -> Surface:
    """A surface of the config's own, or of the catalog, with `parameters` bound."""
    import surfaces

    stated = config.surface.get(name, SurfaceChoice())
    given = {key: repr(value) for key, value in {**stated.parameters, **parameters}.items()}
    if not stated.formula:
        return cut(surfaces.get(name, **given), stated.domain)
    return surfaces.from_formula(stated.formula, stated.domain or "sphere:1.5", name=name, parameters=given)


def load(path: Path, catalog: Catalog) -> Experiment:
    """Read and resolve a config. Raises FirsthitError with file and line for anything wrong in it."""
    import surfaces
    from harness import hardcases, studies

    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "it is not UTF-8 text"
        raise FirsthitError(f"cannot read {path}: {reason}; see `firsthit list configs`") from None
    source = _Source(path, text)
    try:
        table = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise FirsthitError(f"{path}: not valid TOML: {error}") from None
    config: Config = _read_table(Config, table, (), source)
    if config.include:
        return _collection(path, text, config, table, source)
    _positive(config, source)
    config = _with_view_sets(config)
    if not (config.surfaces or config.scene or config.families or config.studies):
        raise source.error(
            (), "name surfaces to draw, or scenes, or families of hard rays, or studies, or some of each"
        )
    if (config.surfaces or config.scene or config.families) and not config.method:
        raise source.error((), "the top level lacks 'method'")
    _known(config.studies, studies.NAMES, "studies", source)
    if config.families == ["all"]:
        config = dataclasses.replace(config, families=list(hardcases.names()))
    _known(config.families, hardcases.names(), "families", source)
    _known(config.precisions, PRECISIONS, "precisions", source)
    _known(config.stages, STAGES, "stages", source)
    _check_gate(config.gate, source)
    _known(config.prepass, PREPASSES, "prepass", source)
    _known(config.origins, ORIGINS, "origins", source)
    _known(config.proxies, PROXIES, "proxies", source)
    _known(config.normals, NORMALS, "normals", source)

    variants: list[Variant] = []
    own_stages: dict[Variant, tuple[Stage, ...]] = {}
    for i, choice in enumerate(config.method):
        _known(choice.stages, STAGES, "stages", source)
        try:
            plugin = catalog.get(choice.name)
            own = [plugin.setting(name) for name in choice.settings]
            own += plugin.deviations() if choice.deviations else []
            if choice.parameters or not own:
                own += [plugin.variant(point) for point in _sweep(choice)]
        except FirsthitError as error:
            raise source.error(("method", i, "name"), str(error)) from None
        variants += own
        if choice.stages:
            own_stages |= dict.fromkeys(own, typing.cast(tuple[Stage, ...], tuple(choice.stages)))
    if "baseline" in table:
        answering = [v for v in variants if catalog.get(v.method).method.answers]
        _known(
            [config.baseline], dict.fromkeys([*(v.method for v in answering), *map(str, answering)]), "baseline", source
        )
    bound = [(variant.method, variant.parameters) for variant in variants]
    if twice := [variant for variant, key in zip(variants, bound, strict=True) if bound.count(key) > 1]:
        raise source.error(("method",), f"{twice[0]} is named twice")
    chosen: list[Surface] = []
    for name in surfaces.names() if config.surfaces == ["all"] else config.surfaces:
        try:
            chosen.append(_surface(name, {}, config))
        except FirsthitError as error:
            where: Where = ("surface", name, "formula") if name in config.surface else ("surfaces",)
            raise source.error(where, str(error)) from None
    scenes: list[Scene] = []
    for name, choice_of_scene in config.scene.items():
        try:
            scenes += scenes_of(
                name,
                choice_of_scene,
                lambda one: cut(_surface(one.surface, one.parameters, config), one.domain),
                lambda one: catalog.get(one.method).variant(one.knobs),
            )
        except FirsthitError as error:
            raise source.error(("scene", name), str(error)) from None
    return Experiment(
        path.stem,
        path,
        text,
        config,
        tuple(variants),
        tuple(chosen),
        typing.cast(tuple[Precision, ...], tuple(config.precisions)),
        typing.cast(tuple[Stage, ...], tuple(config.stages)),
        prepasses=typing.cast(tuple[Prepass, ...], tuple(config.prepass)),
        origins=typing.cast(tuple[Origin, ...], tuple(config.origins)),
        proxies=typing.cast(tuple[Proxy, ...], tuple(config.proxies)),
        normals=typing.cast(tuple[Normal, ...], tuple(config.normals)),
        scenes=tuple(scenes),
        own_stages=own_stages,
    )
