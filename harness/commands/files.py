"""Offer `firsthit import` and `firsthit export`: surfaces from the files of other programs, and for them."""

from __future__ import annotations

import argparse
from pathlib import Path

from harness.commands import Add
from harness.commands.options import add_surface, given_parameters, surface_of, writable
from harness.contract import FirsthitError
from harness.results.writing import write_atomically, write_new


def add_parsers(add: Add) -> None:
    from surfaces.files import FORMS, SUFFIXES

    parser = add("import", "firsthit import cayley.jsurf -o cayley.toml", _READS.format(", ".join(SUFFIXES)))
    parser.add_argument("file", metavar="FILE", help="FILE#NAME or FILE#2 takes one of several surfaces")
    parser.add_argument("--domain", metavar="D", help="instead of the file's own, as `firsthit show` takes it")
    parser.add_argument("--parameter", action="append", default=[], metavar="NAME=VALUE", help="instead of the file's")
    parser.add_argument("--distance", metavar="F", help="as `firsthit show` takes it")
    _add_output(parser, "write the surface as TOML, for --surface and for a config")
    parser.set_defaults(run=_import)

    told = "Write a surface in another program's language: " + "; ".join(f"{k}: {v}" for k, v in FORMS.items()) + "."
    parser = add("export", "firsthit export --surface barth_sextic --as pov -o barth.pov", told)
    add_surface(parser)
    parser.add_argument("--as", dest="form", required=True, choices=list(FORMS), help="the language")
    _add_output(parser, "write into this file and not to standard output")
    parser.set_defaults(run=_export)


_READS = "Read a surface from a file ({}), print its formula, its domain and what was left out, and write it as TOML."


def _add_output(parser: argparse.ArgumentParser, help_: str) -> None:
    """Add the options that name a file to write, which `_write` obeys."""
    parser.add_argument("-o", "--output", type=Path, metavar="FILE", help=help_)
    parser.add_argument("--force", action="store_true", help="replace the file where there is one")


def _import(options: argparse.Namespace) -> int:
    from surfaces import files
    from surfaces.files import own
    from surfaces.model import domain_text
    from surfaces.proofs.extent import remark

    if options.output is not None:
        writable(options.output)
    imported = files.load(options.file, options.domain, given_parameters(options), options.distance)
    surface = imported.surface
    degree = "no polynomial" if surface.degree is None else f"a polynomial of degree {surface.degree}"
    print(f"{surface.name}: read as {imported.form}, {degree}")
    print(f"domain {domain_text(surface.domain)}")
    for name, value in surface.parameters:
        print(f"parameter {name} = {value}")
    print(f"\n{surface.formula}")
    if remarks := [*imported.remarks, *filter(None, [remark(surface)])]:
        print("\n" + "\n".join(remarks))
    if options.output is not None:
        _write(options, "".join(f"# {line}\n" for line in imported.remarks) + own.text_of(surface))
        print(f"\nwrote {options.output}")
    return 0


def _export(options: argparse.Namespace) -> int:
    from surfaces import files

    if options.output is not None:
        writable(options.output)
    text = files.export(surface_of(options), options.form)
    if options.output is None:
        print(text, end="")
    else:
        _write(options, text)
        print(f"wrote {options.output}")
    return 0


def _write(options: argparse.Namespace, text: str) -> None:
    """Write a file. Raises FirsthitError where it is there already and --force is not given."""
    if options.force:
        write_atomically(options.output, text.encode())
    elif options.output.exists():
        raise FirsthitError(f"{options.output} is there already; --force replaces it")
    else:
        write_new(options.output.parent, {options.output.name: text})
