"""With --json, standard output holds one JSON object and nothing else, however a command ends."""

import argparse
import dataclasses
import errno
import json
import math
from enum import StrEnum
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from harness import __version__, cli
from harness.cli import main
from harness.commands import machine
from harness.commands.machine import Answer, plain
from harness.contract import FirsthitError


def answered(capsys, *arguments, code=0):
    """Run a command line and return the object that it prints."""
    capsys.readouterr()
    try:
        found = main([*map(str, arguments), "--json"])
    except SystemExit as ended:
        found = ended.code
    told = capsys.readouterr()
    value = json.loads(told.out, parse_constant=lambda name: pytest.fail(f"{name} is no JSON"))
    assert (found, value["exit_code"]) == (code, code), told.err
    assert list(value)[: len(machine.OWN)] == list(machine.OWN)
    assert (value["format"], value["firsthit"]) == (machine.FORMAT, __version__)
    return value, told.err


@pytest.fixture
def command(monkeypatch):
    """Replace the function of a command that offers --json."""

    def put(function):
        def build(_arguments=None):
            parser = cli.Parser(prog="firsthit")
            commands = parser.add_subparsers(dest="command", required=True)
            machine.add_json(one := commands.add_parser("try"))
            one.add_argument("--count", type=int)
            one.set_defaults(run=function)
            return parser

        monkeypatch.setattr(cli, "build_parser", build)

    return put


def raising(error):
    def function(_options: argparse.Namespace) -> Answer:
        print("a table that nobody asked for")
        raise error

    return function


def test_what_a_command_prints_besides_goes_to_standard_error(command, capsys):
    def function(_options):
        print("a table")
        return Answer({"cells": [1, 2]}, 1)

    command(function)
    value, told = answered(capsys, "try", code=1)
    assert (value["command"], value["error"], value["cells"]) == ("try", None, [1, 2])
    assert told == "a table\n"


@pytest.mark.parametrize(
    ("error", "code", "told"),
    [
        (FirsthitError("no such thing"), 2, "no such thing"),
        (FirsthitError("it broke", exit_code=3), 3, "it broke"),
        (KeyboardInterrupt(), 130, "stopped"),
        (OSError(errno.ENOSPC, "No space left on device", "rows"), 3, "cannot write rows: No space left on device"),
        (ZeroDivisionError("ours"), 3, "ZeroDivisionError: ours"),
    ],
)
def test_a_command_that_fails_says_so_in_its_object_and_on_standard_error(command, capsys, error, code, told):
    command(raising(error))
    value, err = answered(capsys, "try", code=code)
    assert (value["command"], value["error"]) == ("try", told)
    assert set(value) == set(machine.OWN) and told in err


@pytest.mark.parametrize(("words", "name"), [(["try", "--count", "x"], "try"), (["tri"], None), ([], None)])
def test_a_usage_that_is_wrong_is_an_object_too(command, capsys, words, name):
    command(raising(AssertionError("it ran")))
    value, err = answered(capsys, *words, code=2)
    assert value["command"] == name and value["error"] in err and "usage: firsthit" in err


def test_the_beginning_of_the_option_asks_for_an_object_too(command, capsys):
    command(raising(AssertionError("it ran")))
    with pytest.raises(SystemExit):
        main(["try", "--js", "--count", "x"])
    assert json.loads(capsys.readouterr().out)["exit_code"] == 2


def test_a_command_that_returns_no_answer_and_one_that_takes_a_field_of_every_object_are_mistakes_of_ours(
    command, capsys
):
    command(lambda _options: 0)
    assert "TypeError" in answered(capsys, "try", code=3)[0]["error"]
    command(lambda _options: Answer({"error": "mine"}))
    assert "ValueError" in answered(capsys, "try", code=3)[0]["error"]


class Word(StrEnum):
    SOME = "some"


@dataclasses.dataclass(frozen=True)
class Inner:
    name: str
    value: float | None


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (math.inf, "Infinity"),
        (-math.inf, "-Infinity"),
        (np.float32("nan"), "NaN"),
        (np.float64(0.1), 0.1),
        (np.int32(7), 7),
        (2**70, 2**70),
        (Fraction(1, 4), 0.25),
        (True, True),
        (np.bool_(False), False),
        (np.array(2.5), 2.5),
        (Word.SOME, "some"),
        (Path("a/b"), "a/b"),
        (frozenset({"b", "a"}), ["a", "b"]),
        ((1, None), [1, None]),
        (np.array([1.5, np.inf]), [1.5, "Infinity"]),
        ({"one": Inner("x", math.inf)}, {"one": {"name": "x", "value": "Infinity"}}),
    ],
)
def test_values_are_written_in_full_and_what_json_cannot_hold_is_a_text(value, expected):
    found = plain(value)
    assert found == expected and type(found) is type(expected)
    assert json.loads(json.dumps(found, allow_nan=False)) == expected


def test_a_number_is_read_back_as_it_was():
    assert json.loads(json.dumps(plain(1.0 / 3.0))) == 1.0 / 3.0
    assert float(plain(-math.inf)) == -math.inf and math.isnan(float(plain(math.nan)))


@pytest.mark.parametrize("value", [object(), b"bytes", {1: "a key"}, Inner])
def test_what_has_no_form_in_json_is_refused(value):
    with pytest.raises(TypeError):
        plain(value)
