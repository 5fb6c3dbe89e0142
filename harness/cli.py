"""The `firsthit` command. Exit codes: 0 done, 1 a gate fell, 2 usage or config, 3 something failed while running."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence
from pathlib import Path

from harness import __version__
from harness.commands import advice, conforming, experiment, gating, kernels, looking, pictures, rays, scenes
from harness.contract import FirsthitError

INTERRUPTED = 3


def build_parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="firsthit",
        description="Which ray caster should draw this implicit surface on this device, and at what error?",
        epilog="example: firsthit run configs/quick.toml && firsthit report runs/quick",
    )
    parser.add_argument("--version", action="version", version=f"firsthit {__version__}")
    parser.add_argument("--plugins", type=Path, metavar="DIR", help="a folder of further methods, one folder each")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for module in (experiment, gating, advice, looking, pictures, scenes, rays, kernels, conforming):
        module.add_parsers(commands)
    return parser


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command; its exit code. A user's mistake is one line on stderr, never a traceback."""
    options = build_parser().parse_args(arguments)
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
