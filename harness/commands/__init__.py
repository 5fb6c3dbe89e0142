"""Offer what `firsthit` does: a module for each group of commands, with options and printing and nothing else.

GROUPS says of every command what it does and which module holds it, so that a module is imported only where one of its
commands is named: most of them import numpy, python-flint and more. Each module has `add_parsers(add)`, which calls
`add` for each of its commands, gives the parser the command's options, and sets as its default `run` the function that
takes the parsed options and returns the exit code.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Protocol

QUIET = "write errors and final results only"
VERBOSE = "write every cell and check, also those that were skipped or reused, and what compilers say"
PLUGINS = (
    "a folder of further methods, one folder each, or the folder of one; stands before or after the command. "
    "Plugins, installed ones too, are programs that run as you, with your rights: what goes wrong in one costs its own "
    "rows, but nothing keeps it from your files"
)

GROUPS: dict[str, dict[str, str]] = {
    "experiment": {
        "plan": "print a config's cells and how long they will take",
        "run": "run a config; finished cells are reused",
        "why": "say what would make a cell run again, or what set it apart from its last result",
        "report": "make the PDF, HTML, CSV and Parquet of a run, or hold two runs against each other; runs nothing",
    },
    "publish": {
        "publish": "make a static site from many runs: who wins where, with pictures and the data; runs nothing"
    },
    "cluster": {"worker": "offer this machine's devices and cores to runs with --cluster"},
    "folders": {
        "merge": "join runs of one config, of shards or of several machines, to one run; runs nothing",
        "archive": "pack a run into one file, which report, merge, verify and publish read",
        "clean": "remove the rows of a run's folder that its plan does not name",
    },
    "gate": {
        "gate": "fail where a config's results are worse than its blessed baseline",
        "bless": "make a config's present results the baseline of its gate",
    },
    "verify": {"verify": "check stored rows again by what they say, and a sample's truth by the oracle; runs nothing"},
    "history": {"history": "draw a config's gated figures over the commits whose runs are kept, with their steps"},
    "recommend": {
        "recommend": "the fastest variant whose certified error stays within a bound, and why the others fell",
    },
    "shipping": {"kernel": "write a method's whole program for a surface, with an example that draws it"},
    "devices": {"devices": "the devices of this machine and what their arithmetic and clocks are worth"},
    "listing": {"list": "what there is to choose from"},
    "schema": {"schema": "print the JSON schema of configs, by which editors complete, explain and check them"},
    "completion": {"completion": "print what makes bash, zsh or fish complete commands, options, names and paths"},
    "pictures": {
        "show": "say how a surface is read, and draw a shaded picture",
        "sheet": "draw every surface of the catalog, or of a group, on one sheet",
    },
    "files": {
        "import": "read a surface from another program's file, and say what was left out",
        "export": "write a surface in another program's language",
    },
    "scenes": {"scene": "draw a scene of a config, by rasterisation"},
    "rays": {"trace": "cast a file of rays by a method", "oracle": "certified first hits for a file of rays"},
    "new": {"new": "make a folder for a method of your own, which compiles, runs and is gated at once"},
    "kernels": {"compile": "compile every method's kernel on every device, for the surfaces named"},
    "conform": {
        "conform": "check a method's answers, claims and knobs as the tests check ours, at its default and its papers' "
        "settings, from several views; exit code 1 where a check fails or nothing was checked",
    },
}


class Add(Protocol):
    """Add the parser of a command of GROUPS.

    Its help is what GROUPS says of the command, and so is its description where none is given.
    """

    def __call__(self, name: str, example: str, description: str | None = None) -> argparse.ArgumentParser: ...


def adder(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> Add:
    """Make the function that modules of commands are given. It adds to `commands`."""
    told = {name: text for own in GROUPS.values() for name, text in own.items()}

    def add(name: str, example: str, description: str | None = None) -> argparse.ArgumentParser:
        text, epilog = told[name], f"example: {example}"
        parser = commands.add_parser(name, help=text, description=description or text, epilog=epilog)
        # Without a default of its own: it is given here, or before the command, or not at all; the last one counts.
        parser.add_argument("--plugins", type=Path, metavar="DIR", default=argparse.SUPPRESS, help=PLUGINS)
        tells = parser.add_mutually_exclusive_group()
        tells.add_argument("-q", "--quiet", action="store_true", help=QUIET)
        tells.add_argument("-v", "--verbose", action="store_true", help=VERBOSE)
        return parser

    return add
