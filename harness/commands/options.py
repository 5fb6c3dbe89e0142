"""Add options that several commands share, and read what they stand for."""

from __future__ import annotations

import argparse
import shlex
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from harness.contract import ORIGINS, PRECISIONS, FirsthitError, Surface, Variant
from harness.experiment.size import MOST
from harness.limits import JOBS, TIMEOUT, Limit
from harness.plugins import Catalog, find_methods
from harness.results.writing import SPECIAL, is_special
from harness.running.trace import Caster, usable_device
from harness.terminal import SCREEN

N = TypeVar("N", int, float)
SURFACE_OPTIONS = ("surface", "formula", "domain", "distance")  # of add_surface, but for the parameters


def number(limit: Limit) -> Callable[[str], float]:
    """Make the type of an option whose value is a number within a limit, as argparse takes it."""
    return lambda text: _within(_read(text, float, "a number"), limit)


def whole(limit: Limit) -> Callable[[str], int]:
    """Make the type of an option whose value is a whole number within a limit, as argparse takes it."""
    return lambda text: _within(_read(text, int, "a whole number"), limit)


def _read(text: str, kind: Callable[[str], N], name: str) -> N:
    """Read a number. Raises ArgumentTypeError, to which argparse adds the option's name, where the text is none."""
    try:
        return kind(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text[:40]!r} is not {name}") from None


def _within(value: N, limit: Limit) -> N:
    """Return a number that is within a limit. Raises ArgumentTypeError for one that is not."""
    if problem := limit.broken(value):
        raise argparse.ArgumentTypeError(problem)
    return value


def add_surface(parser: argparse.ArgumentParser) -> None:
    """Add the options that name a surface, which `surface_of` reads."""
    which = parser.add_mutually_exclusive_group(required=True)
    help_ = "a surface of the catalog, see `firsthit list surfaces`, or a file that `firsthit import` reads"
    which.add_argument("--surface", metavar="NAME", help=help_)
    which.add_argument("--formula", metavar="F", help="f(x, y, z) of your own, as in 'x^2 + y^2*z^3 - z^4'")
    domain = "sphere:R, sphere:X,Y,Z:R, box:X,Y,Z (half extents), or auto for a box that is found; default sphere:1.5"
    parser.add_argument("--domain", metavar="D", help=domain)
    distance = "a formula that is nowhere larger than the distance to the surface, for sphere_tracing; it is tested"
    parser.add_argument("--distance", metavar="F", help=distance)
    parser.add_argument("--parameter", action="append", default=[], metavar="NAME=VALUE", help="of the surface")


def add_method(parser: argparse.ArgumentParser, default: str | None = None) -> None:
    """Add the options that name a method and where it casts, which `caster_of` reads; `default` is a method."""
    help_ = "see `firsthit list methods`" + (f" (default: {default})" if default else "")
    parser.add_argument("--method", required=default is None, default=default, metavar="NAME", help=help_)
    parser.add_argument("--knob", action="append", default=[], metavar="NAME=VALUE", help="a parameter of the method")
    parser.add_argument("--device", metavar="NAME", help="see `firsthit list devices`; default: the first usable one")
    parser.add_argument("--precision", choices=PRECISIONS, default="float32")
    add_origin(parser)
    add_timeout(parser)


def add_timeout(parser: argparse.ArgumentParser) -> None:
    """Add the option that says how long one step may take, such as compiling or casting all rays."""
    help_ = "for one step, which is given up after so long (default: 60)"
    parser.add_argument("--timeout", type=number(TIMEOUT), default=60.0, metavar="SECONDS", help=help_)


def add_jobs(parser: argparse.ArgumentParser, what: str = "certify first hits") -> None:
    """Add the option that says how many processes do `what`; harness.cli hands it to harness.spreading."""
    help_ = f"processes that {what}, if there is much to do (default: one for each core); 1 starts none"
    parser.add_argument("--jobs", type=whole(JOBS), metavar="N", help=help_)


def add_wait(parser: argparse.ArgumentParser) -> None:
    """Add the option that says what to do where another command writes into the folder of the results."""
    help_ = "where another command writes into the same folder, wait until it has ended"
    parser.add_argument("--wait", action="store_true", help=help_)


def add_yes(parser: argparse.ArgumentParser, what: str = "cells") -> None:
    """Add the option without which a plan of very many cells, or of what `what` names, is refused."""
    parser.add_argument("--yes", action="store_true", help=f"go on where there are more than {MOST:,} {what}")


def typed() -> str:
    """Return the command line of this process, as one types it."""
    return shlex.join(["firsthit", *sys.argv[1:]])


def add_origin(parser: argparse.ArgumentParser) -> None:
    """Add the option that says where a method sees its rays begin."""
    help_ = "where the method sees its rays begin: nearest the domain's centre (default), at their entry, at the eye"
    parser.add_argument("--origin", choices=ORIGINS, default="nearest", help=help_)


def _assignments(texts: list[str], option: str) -> dict[str, str]:
    """Read NAME=VALUE from each text.

    Raises FirsthitError, which names the option, for other text and for a name that is given twice.
    """
    pairs = {}
    for text in texts:
        name, equals, value = text.partition("=")
        if not equals or not name.strip() or not value.strip():
            raise FirsthitError(f"{option} {text!r}: write NAME=VALUE")
        if name.strip() in pairs:
            raise FirsthitError(f"{option} {text!r}: {name.strip()!r} is given twice")
        pairs[name.strip()] = value.strip()
    return pairs


def given_parameters(options: argparse.Namespace) -> dict[str, str | float]:
    """Return the values that --parameter gives. Raises FirsthitError for what is not NAME=VALUE."""
    return dict(_assignments(options.parameter, "--parameter"))


def named_surface(
    name: str,
    parameters: dict[str, str | float] | None = None,
    domain: str | None = None,
    distance: str | None = None,
) -> Surface:
    """Return a surface of the catalog or of a file, and say on standard error what of the file was left out.

    Raises FirsthitError where there is none, or where it cannot be made.
    """
    import surfaces
    from surfaces import files

    if files.is_file(name):
        imported = files.load(name, domain, parameters, distance)
        for remark in imported.remarks:
            tell(f"firsthit: {name}: {remark}")
        return imported.surface
    for option, given in (("--domain", domain), ("--distance", distance)):
        if given is not None:
            raise FirsthitError(f"{option} goes with --formula and with files; a surface of the catalog has its own")
    return surfaces.get(name, **(parameters or {}))


def surface_of(options: argparse.Namespace) -> Surface:
    """Return the surface that --surface or --formula names. Raises FirsthitError where it cannot be made."""
    import surfaces

    parameters = given_parameters(options)
    if options.surface is not None:
        return named_surface(options.surface, parameters, options.domain, options.distance)
    domain = "sphere:1.5" if options.domain is None else options.domain
    return surfaces.from_formula(options.formula, domain, parameters=parameters, distance=options.distance)


def surface_words(options: argparse.Namespace) -> list[str]:
    """Return the words of a command line by which the options of `add_surface` name the same surface again."""
    given = [(name, getattr(options, name, None)) for name in SURFACE_OPTIONS]
    words = [word for name, value in given if value is not None for word in (f"--{name}", str(value))]
    return words + [word for text in options.parameter for word in ("--parameter", text)]


def _number(text: str, name: str) -> float | int:
    """Read a knob's value; a whole number without point or exponent is an int. Raises FirsthitError for others."""
    try:
        value = float(text)
    except ValueError:
        raise FirsthitError(f"--knob {name}={text}: not a number") from None
    return int(value) if value.is_integer() and "." not in text and "e" not in text.lower() else value


def given_variant(options: argparse.Namespace, catalog: Catalog) -> Variant:
    """Return the method that --method names, with the values that --knob gives to its knobs.

    Raises FirsthitError where there is no such method, knob or value.
    """
    given = _assignments(options.knob, "--knob")
    return catalog.get(options.method).variant({name: _number(text, name) for name, text in given.items()})


def methods_of(options: argparse.Namespace) -> Catalog:
    """Find the methods, those of --plugins among them, and say what the user should know of them on standard error.

    Raises FirsthitError where a method that --method names is not there, or cannot be loaded.
    """
    catalog = find_methods(options.plugins)
    named = getattr(options, "method", None) or []
    for name in [named] if isinstance(named, str) else named:
        catalog.get(name)
    for line in catalog.warnings:
        tell_wrong(f"firsthit: {line}")
    return catalog


def caster_of(options: argparse.Namespace) -> Caster:
    """Return the caster that the options of `add_method` name.

    Without --device the devices are looked for. Raises FirsthitError for a name that means nothing.
    """
    catalog = methods_of(options)
    variant = given_variant(options, catalog)
    device = usable_device().name if options.device is None else options.device
    plugin = catalog.get(options.method)
    return Caster(plugin, variant, device, options.precision, options.origin, options.timeout)


def add_history(parser: argparse.ArgumentParser) -> None:
    """Add the option that says where kept runs lie, which `history_of` reads."""
    help_ = "kept runs are in DIR/NAME (default: history/NAME beside the config NAME.toml)"
    parser.add_argument("--history", type=Path, metavar="DIR", help=help_)


def history_of(options: argparse.Namespace, config: Path) -> Path:
    """Return the folder of a config's kept runs."""
    folder: Path = options.history or config.parent / "history"
    return folder / config.stem


def tell(line: str) -> None:
    """Write a line that is not a result, on standard error; a quiet screen leaves it out."""
    SCREEN.say(line)


def tell_wrong(line: str) -> None:
    """Write on standard error what is wrong, though the command goes on, as of a damaged file; quiet screens too."""
    SCREEN.say(line, error=True)


def writable_png(path: Path) -> Path:
    """Return `path` if a picture can be put there. Raises FirsthitError where it cannot, or is not named as a PNG."""
    if writable(path).suffix.lower() != ".png":
        name = path.with_suffix(".png").name
        raise FirsthitError(f"cannot write {path}: pictures are PNG files; name it {name}")
    return path


def writable(path: Path) -> Path:
    """Return `path` if a file can be put there. Raises FirsthitError where it cannot.

    Commands ask this before long work, so that no finished result is lost.
    """
    if is_special(path):
        raise FirsthitError(f"cannot write {path}: {SPECIAL}")
    if path.is_dir() or not path.parent.is_dir():
        raise FirsthitError(f"cannot write {path}: {'it is a folder' if path.is_dir() else 'no such folder'}")
    return path
