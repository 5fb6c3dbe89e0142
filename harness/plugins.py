"""Find methods: folders with a method.py and a kernel.glsl, of the project, of --plugins and of entry points."""

from __future__ import annotations

import dataclasses
import importlib.metadata
import importlib.util
import re
import sys
import typing
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from harness import ROOT
from harness.contract import CLAIMS, PRECISIONS, Casts, FirsthitError, Method, Parameter, Variant
from harness.limits import Distinct, is_finite
from surfaces.model import is_number
from surfaces.words import suggestion

BUILT_IN = ROOT / "methods"
ENTRY_POINTS = "firsthit.methods"

NAME = re.compile("[A-Za-z][A-Za-z0-9_]*")  # of a method: a Python module's, and a part of files' names
KNOB = re.compile("[A-Z][A-Z0-9_]*")  # a constant's name in GLSL and in OpenCL C
CASTS = typing.get_args(Casts)

AS_PRINTED = "as printed"  # a setting of every method that has a knob whose default is ours


@dataclass(frozen=True)
class Plugin:
    """Hold a method and the folder that its kernel is in."""

    method: Method
    folder: Path

    def variant(self, given: Mapping[str, float | int]) -> Variant:
        """Give every knob of the method a value: the `given` one, else its default.

        Raises FirsthitError for a knob that the method does not have, for a value that is no finite number, and for a
        fraction where the knob's values are whole numbers.
        """
        if not isinstance(given, Mapping):
            raise FirsthitError(f'{self.method.name}: knobs are values by name, as in {{"N": 3}}, not {given!r}')
        defaults = {parameter.name: parameter.default for parameter in self.method.parameters}
        for name in given:
            if name not in defaults:
                hint = suggestion(name, sorted(defaults))
                raise FirsthitError(f"method {self.method.name!r} has no parameter {name!r}; {hint}")
        bound = {name: self._bound(name, given.get(name, default), default) for name, default in defaults.items()}
        turned = ",".join(f"{name}={bound[name]:g}" for name in sorted(given))
        label = f"{self.method.name}[{turned}]" if turned else self.method.name
        return Variant(self.method.name, tuple(sorted(bound.items())), label)

    def _bound(self, name: str, value: float, default: float) -> float | int:
        """Return a knob's value as a number of its default's kind. Raises FirsthitError where it cannot be one."""
        if not is_number(value):
            raise FirsthitError(f"{self.method.name}: {name} is a number, not {value!r}")
        if not is_finite(value):
            raise FirsthitError(f"{self.method.name}: {name} is a finite number, not {str(value)[:40]}")
        if isinstance(default, int) and value != int(value):
            raise FirsthitError(f"{self.method.name}: {name} is a whole number, not {value}")
        return type(default)(value)

    def setting(self, name: str) -> Variant:
        """Return the variant of one of the papers' own settings, or of AS_PRINTED.

        AS_PRINTED binds every knob whose default is ours at its source's value. Raises FirsthitError for a setting that
        the method does not state.
        """
        if name == AS_PRINTED and self.method.printed:
            return dataclasses.replace(self.variant(self.method.printed), label=f"{self.method.name} {AS_PRINTED}")
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
    """Hold the methods that were found by name, and why other folders with a method.py could not be loaded."""

    plugins: dict[str, Plugin] = field(default_factory=dict)
    broken: dict[str, str] = field(default_factory=dict)

    def get(self, name: str) -> Plugin:
        """Return a method by name. Raises FirsthitError if there is none, or if it could not be loaded."""
        if not isinstance(name, str):
            raise FirsthitError(f"a method's name is a text, as in 'newton', not {name!r}")
        if name in self.plugins:
            return self.plugins[name]
        if name in self.broken:
            raise FirsthitError(f"method {name!r} cannot be loaded: {self.broken[name]}")
        hint = suggestion(name, sorted(self.plugins))
        raise FirsthitError(f"there is no method {name!r}; {hint}; see `firsthit list methods`")


def _load(folder: Path, name: str | None) -> Method:
    """Return the METHOD that `folder`/method.py states.

    Raises FirsthitError, with the reason, if it states none, or one that is not called `name`, where that is given.
    """
    path = folder / "method.py"
    if not (folder / "kernel.glsl").exists():
        raise FirsthitError(f"{folder} has a method.py but no kernel.glsl")
    spec = importlib.util.spec_from_file_location(f"firsthit_method_{folder.name}", path)
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    writes_bytecode, sys.dont_write_bytecode = sys.dont_write_bytecode, True
    try:
        spec.loader.exec_module(module)
    except Exception as error:  # a plugin may fail in any way; it must cost its own rows only
        raise FirsthitError(f"{path}: {type(error).__name__}: {error}") from error
    finally:
        sys.dont_write_bytecode = writes_bytecode
    method = getattr(module, "METHOD", None)
    if not isinstance(method, Method):
        raise FirsthitError(f"{path} does not define METHOD = Method(...)")
    if problem := _problem(method):
        raise FirsthitError(f"{path}: {problem}")
    for claim in sorted(method.claims - CLAIMS.keys()):
        raise FirsthitError(f"{path} claims {claim!r}, which no test knows; {suggestion(claim, sorted(CLAIMS))}")
    if "error_below_tolerance" in method.claims and method.tolerance is None:
        raise FirsthitError(f"{path} claims error_below_tolerance; that needs tolerance=..., see harness/contract.py")
    for setting, values in method.settings.items():
        try:
            Plugin(method, folder).variant(values)
        except FirsthitError as error:
            raise FirsthitError(f"{path}: setting {setting!r}: {error}") from None
    if name not in (None, method.name):
        raise FirsthitError(f"{path} names its method {method.name!r}, its folder {name!r}; they must agree")
    return method


def _problem(method: Method) -> str | None:
    """Say what in a method's statement can mean nothing, and what to write; None where all of it makes sense."""
    kinds = ("name", str), ("parameters", tuple | list), ("precisions", tuple | list), ("claims", set | frozenset)
    for field_name, kind in (*kinds, ("settings", Mapping)):
        if not isinstance(getattr(method, field_name), kind):
            return f"{field_name} is {getattr(method, field_name)!r}; see class Method in harness/contract.py"
    if not NAME.fullmatch(method.name):
        return f"the name {method.name!r} must be letters, digits and _, and begin with a letter; rename the folder too"
    stated = (("casts", (method.casts,), CASTS), ("precisions", method.precisions, PRECISIONS))
    for what, values, known in stated:
        for value in values:
            if value not in known:
                return f"{what}: unknown {value!r}; known: {', '.join(known)}"
    names = [parameter.name for parameter in method.parameters if isinstance(parameter, Parameter)]
    if twice := Distinct().broken(names):
        return f"the knob {twice}; keep one of the two"
    return next((problem for parameter in method.parameters if (problem := _knob_problem(parameter))), None)


def _knob_problem(knob: object) -> str | None:
    """Say what in the statement of a knob can mean nothing, and what to write; None where all of it makes sense."""
    if not isinstance(knob, Parameter):
        return f"parameters has {knob!r}; give it Parameter(...)"
    if not isinstance(knob.name, str) or not KNOB.fullmatch(knob.name):
        return f"the knob {knob.name!r} must be capitals, digits and _, and begin with a capital, since kernels read it"
    if knob.finer not in (None, "up", "down"):
        return f"the knob {knob.name} is finer {knob.finer!r}; write up, down or None"
    for number in (knob.default, *knob.sweep, *([] if knob.printed is None else [knob.printed])):
        if not is_number(number) or not is_finite(number):
            return f"the knob {knob.name} has the value {number!r}; give it a finite number"
    return None


def _folders(directory: Path) -> list[Path]:
    """Return the folders in a directory that hold a method.py, sorted."""
    return sorted(path.parent for path in directory.glob("*/method.py"))


def _entry_point_folders() -> tuple[list[tuple[str, Path]], dict[str, str]]:
    """Return names and folders of the methods that installed packages state by entry points, and why others have none.

    An entry point names a package of any name, which is one method's folder or holds the folders of several. Reasons
    are by the entry point's name.
    """
    found: list[tuple[str, Path]] = []
    broken: dict[str, str] = {}
    for point in importlib.metadata.entry_points(group=ENTRY_POINTS):
        try:
            spec = importlib.util.find_spec(point.module)
        except Exception as error:  # somebody's package, which may fail in any way
            broken[point.name] = f"its entry point names {point.value}: {type(error).__name__}: {error}"
            continue
        places = [Path(place) for place in (spec.submodule_search_locations if spec else None) or ()]
        own = [(_stated_name(place), place) for place in places if (place / "method.py").exists()]
        own += [(folder.name, folder) for place in places for folder in _folders(place)]
        if not own:
            broken[point.name] = f"its entry point names {point.value}, which is no package that holds a method.py"
        found += [method for method in own if method not in found]
    return found, broken


def _stated_name(folder: Path) -> str:
    """Return the name that a method states, whatever its folder is called; the folder's where it cannot be loaded."""
    try:
        return _load(folder, None).name
    except FirsthitError:
        return folder.name


def find_methods(extra: Path | None = None) -> Catalog:
    """Return the methods of the project, of installed packages (entry point group `firsthit.methods`) and of `extra`.

    A folder that cannot be loaded is listed as broken. Raises FirsthitError where `extra` is not a folder, or two
    folders have one name.
    """
    if extra is not None and not extra.is_dir():
        raise FirsthitError(f"--plugins {extra}: no such folder")
    installed, broken = _entry_point_folders()
    catalog = Catalog(broken=broken)
    own, given = ([(folder.name, folder) for folder in _folders(place)] if place else [] for place in (BUILT_IN, extra))
    for name, folder in (*own, *installed, *given):
        if name in catalog.plugins and catalog.plugins[name].folder.resolve() == folder.resolve():
            continue  # an installed method whose folder --plugins names too
        if name in catalog.plugins:
            raise FirsthitError(f"two methods are called {name!r}: {catalog.plugins[name].folder} and {folder}")
        try:
            catalog.plugins[name] = Plugin(_load(folder, name), folder)
        except FirsthitError as error:
            catalog.broken[name] = str(error)
    return catalog
