"""Find methods: folders with a method.py and a kernel.glsl, of the project, of --plugins and of entry points."""

from __future__ import annotations

import dataclasses
import importlib.metadata
import importlib.util
import os
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from harness import ROOT
from harness.contract import CLAIMS, FirsthitError, Method, Variant
from harness.limits import is_finite
from harness.stated import NAME, guarded, line_of, problem_of, read_file, stated
from surfaces.model import beginning, is_number
from surfaces.words import LONGEST_NAME, suggestion

if TYPE_CHECKING:
    from harness.hosting.host import Host

BUILT_IN = ROOT / "methods"
ENTRY_POINTS = "firsthit.methods"

A_METHOD = "a method is a folder with a method.py and a kernel.glsl"

AHEAD = 4  # processes of plugins that are started while an earlier one is waited for

AS_PRINTED = "as printed"  # a setting of every method that has a knob whose default is ours


@dataclass(frozen=True)
class Plugin:
    """Hold a method and the folder that its kernel is in.

    broken: why it cannot be loaded; `method` then states a name and nothing else, and takes any knob. None: it can
    """

    method: Method
    folder: Path
    broken: str | None = None

    def variant(self, given: Mapping[str, float | int]) -> Variant:
        """Give every knob of the method a value: the `given` one, else its default.

        Raises FirsthitError for a knob that the method does not have, for a value that is no finite number, and for a
        fraction where the knob's values are whole numbers.
        """
        if not isinstance(given, Mapping):
            raise FirsthitError(f'{self.method.name}: knobs are values by name, as in {{"N": 3}}, not {given!r}')
        defaults = self._defaults if self.broken is None else dict(given)
        for name in given:
            if name not in defaults:
                hint = suggestion(name, sorted(defaults))
                raise FirsthitError(f"method {self.method.name!r} has no parameter {name!r}; {hint}")
        bound = defaults | {name: self._bound(name, value, defaults[name]) for name, value in given.items()}
        turned = ",".join(f"{name}={bound[name]:g}" for name in sorted(given))
        label = f"{self.method.name}[{turned}]" if turned else self.method.name
        return Variant(self.method.name, tuple(sorted(bound.items())), label)

    @cached_property
    def _defaults(self) -> dict[str, float | int]:
        """Return the default of each knob. Raises FirsthitError for one that is no value of a knob."""
        return {knob.name: self._bound(knob.name, knob.default, knob.default) for knob in self.method.parameters}

    def _bound(self, name: str, value: float, default: float) -> float | int:
        """Return a knob's value as a number of its default's kind. Raises FirsthitError where it cannot be one."""
        if not is_number(value):
            raise FirsthitError(f"{self.method.name}: {name} is a number, not {value!r}")
        if not is_finite(value):
            raise FirsthitError(f"{self.method.name}: {name} is a finite number, not {beginning(value)}")
        if isinstance(default, int) and value != int(value):
            raise FirsthitError(f"{self.method.name}: {name} is a whole number, not {value}")
        if isinstance(default, int) and not -(2**31) <= value < 2**31:  # a kernel's int has 32 bits
            raise FirsthitError(f"{self.method.name}: {name} is a whole number of 32 bits, which {value:g} is not")
        return type(default)(value)

    def setting(self, name: str) -> Variant:
        """Return the variant of one of the papers' own settings, or of AS_PRINTED.

        AS_PRINTED binds every knob whose default is ours at its source's value. Raises FirsthitError for a setting that
        the method does not state.
        """
        if name == AS_PRINTED and self.method.printed:
            return dataclasses.replace(self.variant(self.method.printed), label=f"{self.method.name} {AS_PRINTED}")
        if self.broken is not None:
            return dataclasses.replace(self.variant({}), label=name)
        if name not in self.method.settings:
            known = [*self.method.settings, *([AS_PRINTED] if self.method.printed else [])]
            raise FirsthitError(
                f"method {self.method.name!r} has no setting {name!r}; {suggestion(name, sorted(known))}"
            )
        return dataclasses.replace(self.variant(self.method.settings[name]), label=name)

    def deviations(self) -> list[Variant]:
        """Return the variants that show what our changes to a method's knobs are worth.

        They are the default, the default with each changed knob alone at its source's value, and with all of them.
        """
        printed = self.method.printed
        alone = [self.variant({name: value}) for name, value in printed.items()]
        return [self.variant({}), *alone, *([self.setting(AS_PRINTED)] if len(printed) > 1 else [])]


@dataclass(frozen=True)
class Catalog:
    """Hold the methods that were found by name, and why other folders with a method.py could not be loaded.

    notes: what the user should know of how the methods were found
    extra: the folder of --plugins
    folders: those of the broken ones, where they have one
    """

    plugins: dict[str, Plugin] = field(default_factory=dict)
    broken: dict[str, str] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    extra: Path | None = None
    folders: dict[str, Path] = field(default_factory=dict)

    def with_stand_ins(self) -> Catalog:
        """Return the catalog with a stand-in for each broken method, which plans take for it: its rows then fail.

        A config that names a method which cannot be loaded thus runs everything else.
        """
        standing = {
            name: Plugin(Method(name, "a method that cannot be loaded"), self.folders.get(name, Path(name)), why)
            for name, why in self.broken.items()
        }
        return dataclasses.replace(self, plugins=self.plugins | standing)

    @property
    def warnings(self) -> list[str]:
        """Return a line for each note, and for each method that cannot be loaded."""
        return [*self.notes, *(f"method {name!r} cannot be loaded: {why}" for name, why in self.broken.items())]

    def get(self, name: str, beside: Path | None = None) -> Plugin:
        """Return a method by name. `beside` is a folder in which to look for one that --plugins did not name.

        Raises FirsthitError if there is none and, with exit code 3, if it could not be loaded.
        """
        if not isinstance(name, str):
            raise FirsthitError(f"a method's name is a text, as in 'newton', not {name!r}")
        if name in self.plugins:
            return self.plugins[name]
        if name in self.broken:
            raise FirsthitError(f"method {name!r} cannot be loaded: {self.broken[name]}", exit_code=3)
        raise FirsthitError(self._absent(name, beside))

    def _absent(self, name: str, beside: Path | None) -> str:
        """Say that there is no such method, and where it may be."""
        here = f"there is no method {name!r} here"
        if self.extra is not None:
            here += f", nor in --plugins {self.extra}"
        near = suggestion(name, sorted(self.plugins), otherwise="see `firsthit list methods`")
        if NAME.fullmatch(name) and len(name) <= LONGEST_NAME and (folder := _lying_about(name, beside)):
            return f"{here}; it is in the folder {_shown(folder)}: give --plugins {_shown(folder.parent)}"
        return f"{here}; {'' if self.extra else 'is it in a folder for --plugins? '}{near}"


def _lying_about(name: str, beside: Path | None) -> Path | None:
    """Return the folder of a method in the working folder or `beside`, or in a folder of these; None without one."""
    for place in filter(None, (Path.cwd(), beside)):
        own = [place] if place.resolve().name == name else []
        for folder in (*own, place / name, *sorted(place.glob(f"*/{name}"))):
            if (folder / "method.py").is_file():
                return folder
    return None


def _shown(path: Path) -> str:
    """Write a path as it is typed in the working folder."""
    return os.path.relpath(path) if path.resolve().is_relative_to(Path.cwd()) else str(path)


class _Loader:
    """Load methods: firsthit's own in this process, and each other one in a process of its own (harness.hosting)."""

    def __init__(self) -> None:
        self._hosts: dict[Path, Host] = {}
        self._loaded: dict[Path, Method | FirsthitError] = {}

    def begin(self, folders: Iterable[Path]) -> None:
        """Start the processes of folders that `load` will be asked for."""
        for folder in folders:
            if folder.parent != BUILT_IN and folder not in self._hosts and (folder / "method.py").is_file():
                from harness.hosting.host import Host  # which commands without plugins do not pay for

                self._hosts[folder] = Host(str(folder / "method.py"))
                self._hosts[folder].begin()

    def load(self, folder: Path) -> Method:
        """Return the METHOD that `folder`/method.py states. Raises FirsthitError, with the reason, without one."""
        if folder not in self._loaded:
            try:
                self._loaded[folder] = self._load(folder)
            except FirsthitError as error:
                self._loaded[folder] = error
        if isinstance(found := self._loaded[folder], FirsthitError):
            raise found
        return found

    def _load(self, folder: Path) -> Method:
        path = folder / "method.py"
        if not path.exists():
            raise FirsthitError(f"{folder} has a kernel.glsl but no method.py; {A_METHOD}")
        if not (folder / "kernel.glsl").exists():
            raise FirsthitError(f"{folder} has a method.py but no kernel.glsl; {A_METHOD}")
        read_file(path)
        _check_kernel(folder / "kernel.glsl")
        if folder.parent == BUILT_IN:
            method = stated(path)
            if not isinstance(method, Method):
                raise FirsthitError(f"{path} does not define METHOD = Method(...)")
            _check(method, folder)
            return guarded(method, path)
        self.begin([folder])
        method = self._hosts[folder].load(path)
        _check(method, folder)
        return method


def _check(method: Method, folder: Path) -> None:
    """Raise FirsthitError, with the line, if what a method states can mean nothing."""
    path = folder / "method.py"
    if problem := problem_of(method):
        raise FirsthitError(f"{path}:{line_of(path, problem.split()[0].rstrip(':'))}: {problem}")
    for claim in sorted(method.claims - CLAIMS.keys()):
        raise FirsthitError(f"{path} claims {claim!r}, which no test knows; {suggestion(claim, sorted(CLAIMS))}")
    if "error_below_tolerance" in method.claims and method.tolerance is None:
        raise FirsthitError(f"{path} claims error_below_tolerance; that needs tolerance=..., see harness/contract.py")
    for setting, values in method.settings.items():
        try:
            Plugin(method, folder).variant(values)
        except FirsthitError as error:
            raise FirsthitError(f"{path}:{line_of(path, 'settings')}: setting {setting!r}: {error}") from None


def _check_name(method: Method, folder: Path, name: str) -> None:
    """Raise FirsthitError, with the line, if a method is not called `name`."""
    if name != method.name:
        path = folder / "method.py"
        at = f"{path}:{line_of(path, 'name')}"
        raise FirsthitError(f"{at}: the method is named {method.name!r}, its folder {name!r}; they must agree")


def _check_kernel(path: Path) -> None:
    """Raise FirsthitError, with file and line, if a kernel is no readable text, or asks for another file."""
    read = read_file(path)
    try:
        text = read.decode()
    except UnicodeDecodeError as error:
        line = read.count(b"\n", 0, error.start) + 1
        raise FirsthitError(f"{path}:{line}: it is not written in UTF-8; save it in this encoding") from None
    if include := re.search(r"(?m)^[ \t]*#[ \t]*include\b", text):
        line = text.count("\n", 0, include.start()) + 1
        raise FirsthitError(f"{path}:{line}: a kernel is one file; write what it would include into it")


def built_in() -> list[str]:
    """List the names of the project's own methods, sorted. None of them is loaded."""
    return [folder.name for folder in _folders(BUILT_IN)]


def named(extra: Path | None = None) -> list[str]:
    """List the names of the folders that the project and `extra` have for methods, sorted. None of them is loaded."""
    try:
        more = [] if extra is None else _extra_folders(extra)
    except FirsthitError:
        more = []
    return sorted({*built_in(), *(folder.name for folder in more)})


def _folders(directory: Path) -> list[Path]:
    """Return the folders in a directory that hold a method.py or a kernel.glsl, sorted."""
    return sorted({path.parent for name in ("method.py", "kernel.glsl") for path in directory.glob(f"*/{name}")})


def _named(folders: list[Path]) -> list[tuple[str, Path]]:
    """Put the name of each folder before it, which is its method's."""
    return [(folder.name, folder) for folder in folders]


def _extra_folders(extra: Path) -> list[Path]:
    """Return the folders of methods that --plugins names: those in it, or itself where it is a method's.

    Raises FirsthitError where it is no folder, or no method is in it.
    """
    if not extra.is_dir():
        raise FirsthitError(f"--plugins {extra}: {'it is a file' if extra.exists() else 'no such folder'}; {A_METHOD}")
    folder = extra if extra.name not in ("", "..") else extra.resolve()
    own = [folder] if any((folder / name).exists() for name in ("method.py", "kernel.glsl")) else []
    if found := own + _folders(folder):
        return found
    deeper = next((path.parents[1] for path in sorted(folder.glob("*/*/method.py"))), None)
    hint = f"give --plugins {_shown(deeper)}" if deeper else f"as {extra / 'mine' / 'method.py'}"
    raise FirsthitError(f"--plugins {extra}: there is no method in it; {A_METHOD}; {hint}")


def _entry_point_folders(loader: _Loader) -> tuple[list[tuple[str, Path]], dict[str, str]]:
    """Return names and folders of the methods that installed packages state by entry points, and why others have none.

    An entry point names a package of any name, which is one method's folder or holds the folders of several. Reasons
    are by the entry point's name.
    """
    found: list[tuple[str, Path]] = []
    broken: dict[str, str] = {}
    for point in importlib.metadata.entry_points(group=ENTRY_POINTS):
        try:
            places = _places(point.module)
        except Exception as error:  # somebody's package, which may fail in any way
            why = str(error) if isinstance(error, FirsthitError) else f"{type(error).__name__}: {error}"
            broken[point.name] = f"its entry point names {point.value}: {why}"
            continue
        own = [(_stated_name(place, loader), place) for place in places if (place / "method.py").exists()]
        own += [(folder.name, folder) for place in places for folder in _folders(place)]
        if not own:
            broken[point.name] = f"its entry point names {point.value}, which is no package that holds a method.py"
        found += [method for method in own if method not in found]
    return found, broken


def _places(module: str) -> list[Path]:
    """Return the folders of a package; [] for what is none. Of one in another one, looking for it runs that one's code.

    Raises FirsthitError where that code goes wrong.
    """
    if "." in module:
        from harness.hosting.host import Host

        host = Host(f"the package {module}")
        try:
            return host.places(module)
        finally:
            host.close()
    spec = importlib.util.find_spec(module)
    return [Path(place) for place in (spec.submodule_search_locations if spec else None) or ()]


def _stated_name(folder: Path, loader: _Loader) -> str:
    """Return the name that a method states, whatever its folder is called; the folder's where it cannot be loaded."""
    try:
        return loader.load(folder).name
    except FirsthitError:
        return folder.name


def find_methods(extra: Path | None = None) -> Catalog:
    """Return the methods of the project, of installed packages (entry point group `firsthit.methods`) and of `extra`.

    `extra` is a folder of methods, or the folder of one. A folder that cannot be loaded is listed as broken. One of
    `extra` takes the place of an installed method of its name, and a note says so. Raises FirsthitError where no
    method is in `extra`, where a method has the name of one of the project, and where two installed ones have one name.
    """
    loader = _Loader()
    given = [] if extra is None else _extra_folders(extra)
    loader.begin(given[:AHEAD])  # they start while ours are loaded
    installed, broken = _entry_point_folders(loader)
    catalog = Catalog(extra=extra, broken=broken)
    own = _folders(BUILT_IN)
    found: dict[str, Path] = {}
    for name, folder in (*_named(own), *installed, *_named(given)):
        if name in found and found[name].resolve() == folder.resolve():
            continue
        if name in found:
            _check_replaceable(folder, found[name], own, given)
            catalog.notes.append(f"method {name!r}: {folder} of --plugins is used, and not the installed {found[name]}")
        found[name] = folder
    waiting = list(found.values())
    for name, folder in found.items():
        loader.begin(waiting[:AHEAD])
        del waiting[0]
        try:
            method = loader.load(folder)
            _check_name(method, folder, name)
            catalog.plugins[name] = Plugin(method, folder)
        except FirsthitError as error:
            catalog.broken[name], catalog.folders[name] = str(error), folder
    return catalog


def _check_replaceable(folder: Path, other: Path, own: list[Path], given: list[Path]) -> None:
    """Raise FirsthitError if a method's folder may not take the place of another one of its name."""
    name = folder.name
    if other in own:
        rename = f"rename the folder, and name={name!r} in {folder / 'method.py'}, to my_{name} for example"
        raise FirsthitError(f"two methods are called {name!r}: {folder} and firsthit's own, which stays; {rename}")
    if folder not in given:
        raise FirsthitError(f"two installed methods are called {name!r}: {other} and {folder}; uninstall one")
