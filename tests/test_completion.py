"""Shells complete commands, options, names and paths, by the functions that `firsthit completion` prints."""

import builtins
import json
import os
import shutil
import subprocess
import sys

import pytest

import surfaces
from harness import ROOT
from harness.cli import main
from harness.contract import DeviceInfo
from harness.devices import kept_answers

DRIVE = {  # what types a line into a shell and prints what its function offers, one a line
    "bash": """eval "$(firsthit completion bash)"
COMP_WORDBREAKS=$' \\t\\n"\\'><=;|&(:'
while IFS= read -r line; do
    COMP_LINE="$line" COMP_POINT=${#line} COMP_TYPE=9 COMPREPLY=()
    _python_argcomplete firsthit
    printf '%s\\n' "> $line" "${COMPREPLY[@]}"
done""",
    "zsh": """autoload -Uz compinit; compinit -u -D
eval "$(firsthit completion zsh)"
_describe() { print -l -- ${${(P)2}%%:*} }
while read -r line; do
    words=(firsthit) BUFFER=$line CURSOR=${#line}
    print -- "> $line"; _python_argcomplete
done""",
    "fish": """firsthit completion fish | source
while read line
    echo "> $line"; complete -C "$line" | string split -f1 \\t
end
true""",
}


@pytest.fixture
def typed(tmp_path, monkeypatch):
    """A function that types lines into a shell and returns what it offers for each; it stands in a folder of its own.

    Nothing is kept of devices but one that works and one that does not.
    """
    command = tmp_path / "bin" / "firsthit"
    command.parent.mkdir()
    command.write_text(f'#!/bin/sh\nexec {sys.executable} -m harness.cli "$@"\n')
    command.chmod(0o755)
    monkeypatch.setenv("PATH", f"{command.parent}:{os.environ['PATH']}")
    monkeypatch.setenv("PYTHONPATH", f"{ROOT}:{os.environ.get('PYTHONPATH', '')}")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    device = DeviceInfo("opencl:kept", "A", "driver", "compiler", 4, True, "wall", ())
    kept_answers.keep("opencl", [device], [command])
    here = tmp_path / "here"
    (here / "runs" / "mine" / "cells").mkdir(parents=True)
    (here / "runs" / "mine" / "cells" / "0123abcd.json").write_text("{}")
    (here / "torus_d.jsurf").write_text("surface_equation=x-a\nsurface_parameter_a=1\n")
    (here / "plugins" / "own_method").mkdir(parents=True)
    (here / "plugins" / "own_method" / "method.py").write_text("raise SystemExit('it must not be run for its name')")
    (here / "quick-own.toml").write_text("")
    (here / "quick.txt").write_text("")

    def type_into(shell, *lines):
        words = [shell, *(["-f"] if shell == "zsh" else []), "-c", DRIVE[shell]]
        ran = subprocess.run(
            words, input="\n".join(lines) + "\n", cwd=here, capture_output=True, text=True, timeout=100
        )
        assert ran.returncode == 0 and "Traceback" not in ran.stderr, ran.stderr
        blocks = [block.splitlines() for block in ran.stdout.removeprefix("> ").split("\n> ")]
        assert [block[0] for block in blocks] == list(lines)
        return [sorted(filter(None, (line.strip() for line in block[1:]))) for block in blocks]

    return type_into


def needs(shell):
    return pytest.param(shell, marks=pytest.mark.skipif(not shutil.which(shell), reason=f"no {shell}"))


@pytest.mark.parametrize("shell", [needs("bash"), needs("zsh"), needs("fish")])
def test_a_shell_completes_commands_and_names(typed, shell):
    commands, methods = typed(shell, "firsthit pla", "firsthit show --method interval_m")
    assert (commands, methods) == (["plan"], ["interval_march"])


@pytest.mark.skipif(not shutil.which("bash"), reason="no bash")
def test_bash_completes_options_and_every_kind_of_name(typed):
    expected = {
        "firsthit gate --ag": ["--against"],
        "firsthit list ": [
            "--help",
            "--json",
            "--plugins",
            "--quiet",
            "--verbose",
            "configs",
            "devices",
            "methods",
            "surfaces",
        ],
        "firsthit show --surface torus:n": ["nested"],  # bash breaks words at a colon, and has the first part already
        "firsthit recommend --surface=barth_s": ["barth_sextic"],
        "firsthit show --surface torus --parameter ": ["R=", "r="],
        "firsthit show --surface torus_d": ["torus_d.jsurf", "torus_distance"],
        "firsthit show --surface torus_d.jsurf --parameter ": ["a="],
        "firsthit trace --method newton --knob MAX": ["MAX_EVALUATIONS="],
        "firsthit trace --device ": ["opencl:kept"],
        "firsthit --plugins plugins conform --method own": ["own_method"],
        "firsthit sheet --group no": ["nodal"],
        "firsthit plan quick": ["quick", "quick-own.toml"],
        "firsthit why 01": ["0123abcd"],
        "firsthit report r": ["runs/"],
    }
    assert dict(zip(expected, typed("bash", *expected), strict=True)) == expected


def test_names_are_found_without_slow_imports():
    code = """import argparse, json, sys
from harness.commands import completion
options = argparse.Namespace(method="newton", surface="torus")
found = {name: list(names(options)) for name, names in completion.COMPLETERS.items()}
print(json.dumps([found, sorted(sys.modules)]))"""
    environment = os.environ | {"PYTHONPATH": f"{ROOT}:{os.environ.get('PYTHONPATH', '')}"}
    command = [sys.executable, "-c", code]
    ran = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=100, check=True)
    found, modules = json.loads(ran.stdout)
    assert set(surfaces.names()) <= set(found["surface"]) and "EPSILON=" in found["knob"]
    assert not set(modules) & {"sympy", "flint", "pyopencl", "moderngl", "matplotlib", "multiprocessing"}


def test_where_argcomplete_is_not_installed_the_command_says_what_to_install(monkeypatch, capsys):
    imported = builtins.__import__

    def without(name, *arguments, **more):
        if name.startswith("argcomplete"):
            raise ModuleNotFoundError(name=name)
        return imported(name, *arguments, **more)

    monkeypatch.setattr(builtins, "__import__", without)
    assert main(["completion", "bash"]) == 3
    assert "pip install 'firsthit[completion]'" in capsys.readouterr().err
