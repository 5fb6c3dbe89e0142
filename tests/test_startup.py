"""What commands import before they answer, what `run` says first, and how start-up times are told."""

from __future__ import annotations

import importlib
import json
import os
import pkgutil
import shutil
import subprocess
import sys

import pytest

from harness import ROOT, commands
from harness.cli import build_parser
from harness.commands import GROUPS

from .benchmarks import startup

PLACE = commands.__path__
LOADED = """
import json, sys
from harness.cli import main
try:
    main(sys.argv[1:])
except SystemExit:
    pass
print(json.dumps(sorted(sys.modules)))
"""


def loaded(*arguments: str) -> set[str]:
    """The modules that a command has imported when it ends."""
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-c", LOADED, *arguments]
    ran = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=200, check=True)
    return set(json.loads(ran.stdout.splitlines()[-1]))


def _commands(modules: set[str]) -> set[str]:
    return {name.rpartition(".")[2] for name in modules if name.startswith("harness.commands.")}


def test_help_imports_no_command_and_nothing_that_computes():
    modules = loaded("--help")
    assert "harness.commands" in modules and not _commands(modules)
    assert not modules & {"numpy", "sympy", "flint", "harness.contract", "surfaces", "multiprocessing"}


def test_a_command_imports_its_own_module_alone():
    modules = loaded("list", "configs")
    assert _commands(modules) & GROUPS.keys() == {"listing"}
    assert not modules & {"sympy", "flint", "harness.devices.executor"}


def test_every_command_is_in_the_table_with_the_module_that_adds_it():
    here = {name: importlib.import_module(f"harness.commands.{name}") for _, name, _ in pkgutil.iter_modules(PLACE)}
    assert GROUPS.keys() == {name for name, module in here.items() if hasattr(module, "add_parsers")}
    whole, light = build_parser().format_help(), build_parser(["--help"]).format_help()
    assert whole == light
    for module, own in GROUPS.items():
        added: list[str] = []

        def add(name: str, *_: str, added: list[str] = added):
            added.append(name)
            return build_parser([])  # a parser that takes any options

        here[module].add_parsers(add)
        assert added == list(own)


def test_a_folder_of_plugins_may_be_called_as_a_command_is(tmp_path, monkeypatch, capsys):
    from harness.cli import main

    shutil.copytree(ROOT / "methods" / "null", tmp_path / "run" / "mine")  # it does not load, under another name
    monkeypatch.chdir(tmp_path)
    assert main(["--plugins", "run", "list", "methods"]) == 0
    assert "newton" in capsys.readouterr().out


def test_start_up_times_are_told_by_their_median_beside_the_limit():
    starts = [startup.Start(name, (), limit) for name, limit in (("a", 0.3), ("b", 0.3), ("c", None))]
    lines = startup.table(starts, {"a": [0.1, 0.2, 9.0], "b": [0.2, 0.3, 0.4], "c": [1.0, 1.0]}).splitlines()
    assert [line.split() for line in lines[1:]] == [
        ["a", "0.20", "s", "9.00", "s", "0.3", "s", "ok"],
        ["b", "0.30", "s", "0.40", "s", "0.3", "s", "over"],
        ["c", "1.00", "s", "1.00", "s", "-", "-"],
    ]


@pytest.mark.parametrize("terminal", [False, True])
def test_a_start_is_timed_until_it_says_so_or_ends_and_fails_aloud(terminal):
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    for until in (None, b"COMMAND"):
        assert startup.seconds_of(startup.Start("help", ("--help",), 0.3, until, terminal), environment) > 0.0
    for arguments, until in ((("nonesuch",), None), (("--help",), b"what help does not say")):
        with pytest.raises(RuntimeError, match="failed"):
            startup.seconds_of(startup.Start("bad", arguments, 0.3, until, terminal), environment)
