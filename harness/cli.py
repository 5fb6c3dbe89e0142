"""Run the `firsthit` command.

Exit codes are 0 where the command did what it was asked for, 1 where a gate failed, 2 where the usage or a config is
wrong, and 3 where something failed while running.
"""

from __future__ import annotations

import argparse
import importlib
import os
import sys
from collections.abc import Sequence
from pathlib import Path

from harness import __version__
from harness.commands import GROUPS, PLUGINS, adder

INTERRUPTED = 3


def build_parser(arguments: Sequence[str] | None = None) -> argparse.ArgumentParser:
    """Build the parser of a command line. With its `arguments`, only commands named among them have their options."""
    parser = argparse.ArgumentParser(
        prog="firsthit",
        description="Which ray caster should draw this implicit surface on this device, and at what error?",
        epilog="example: firsthit run configs/quick.toml && firsthit report runs/quick",
    )
    parser.add_argument("--version", action="version", version=f"firsthit {__version__}")
    parser.add_argument("--plugins", type=Path, metavar="DIR", help=PLUGINS)
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for module, own in GROUPS.items():
        if arguments is None or own.keys() & set(arguments):
            importlib.import_module(f"harness.commands.{module}").add_parsers(adder(commands))
        else:
            for name, text in own.items():
                commands.add_parser(name, help=text)
    return parser


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command and return its exit code. A user's mistake is one line on stderr, and never a traceback."""
    arguments = sys.argv[1:] if arguments is None else arguments
    options = build_parser(arguments).parse_args(arguments)
    from harness.contract import FirsthitError  # imports numpy, which help and usage do without

    try:
        code: int = options.run(options)
        sys.stdout.flush()
        return code
    except FirsthitError as error:
        print(f"firsthit: {error}", file=sys.stderr)
        return error.exit_code
    except KeyboardInterrupt:
        print("\nfirsthit: stopped; what was finished is kept, the same command goes on from there", file=sys.stderr)
        return INTERRUPTED
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0


if __name__ == "__main__":
    sys.exit(main())
