"""Run the `firsthit` command, and say by its exit code how it ended (EXIT_CODES)."""

from __future__ import annotations

import argparse
import contextlib
import errno
import importlib
import os
import sys
import traceback
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn, TypeGuard

from harness import __version__
from harness.commands import GROUPS, PLUGINS, adder
from harness.stopping import asked, code_of, stoppable

if TYPE_CHECKING:
    from _typeshed import SupportsWrite

USAGE = 2
FAILED = 3
CLOSED_PIPE = 141  # 128 + SIGPIPE
EXIT_CODES = """exit codes:
  0    done
  1    a check, a gate or a bound does not hold
  2    the command or a config is wrong
  3    something failed while running, or could not be compared
  129  stopped since its terminal was closed (SIGHUP)
  130  stopped by Ctrl-C
  141  who reads the output went away before its end
  143  stopped by SIGTERM, as `kill` and `timeout` send it
"""
FULL = (errno.ENOSPC, errno.EDQUOT)  # of a disk or a quota: no mistake of ours
SIGNED = ("--formula", "--distance", "--view", "--surface")  # options whose values may begin with a minus sign
RUN_CELLS = ("run", "gate", "bless", "recommend")  # commands that store a row as soon as its cell ends
TIMED = ("run", "recommend")  # those of them whose cells are timed


class UsageError(SystemExit):
    """End a command whose usage is wrong, after argparse has said so on standard error."""

    def __init__(self, message: str) -> None:
        super().__init__(2)
        self.message = message


class Parser(argparse.ArgumentParser):
    """Parse a command line, and print help as any other output: argparse's own hides that nobody reads it."""

    def error(self, message: str) -> NoReturn:
        """Say what is wrong with the usage. Raises UsageError."""
        with contextlib.suppress(SystemExit):
            super().error(message)
        raise UsageError(message)

    def _print_message(self, message: str, file: SupportsWrite[str] | None = None) -> None:
        """Print help, usage or version. Raises OSError where it cannot be written."""
        (file or sys.stderr).write(message)


def build_parser(arguments: Sequence[str] | None = None) -> argparse.ArgumentParser:
    """Build the parser of a command line. With its `arguments`, only commands named among them have their options."""
    parser: argparse.ArgumentParser = Parser(
        prog="firsthit",
        description="Which ray caster should draw this implicit surface on this device, and at what error?",
        epilog=f"{EXIT_CODES}\nexample: firsthit run configs/quick.toml && firsthit report runs/quick",
        formatter_class=argparse.RawDescriptionHelpFormatter,
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
    """Run one command and return its exit code, which is one of EXIT_CODES.

    A user's mistake is one line on stderr, and never a traceback. Raises SystemExit as argparse does, for --help and
    where the usage is wrong.
    """
    if "_ARGCOMPLETE" in os.environ:  # a shell asks how its command line may go on
        from harness.commands import completion

        completion.complete(build_parser)
    from harness.terminal import guarded

    options = argparse.Namespace(command=None, force=False, jobs=1, json=False, quiet=False, verbose=False)
    with guarded(), stoppable():
        return _guarded(sys.argv[1:] if arguments is None else arguments, options)


def _guarded(arguments: Sequence[str], options: argparse.Namespace) -> int:
    """Run one command and return its exit code, whatever becomes of its output. Raises SystemExit as `main` does."""
    try:
        try:
            return _ended(arguments, options)
        finally:
            _flush()  # a pipe that was closed is told here; told at the interpreter's end, it would be lost
    except KeyboardInterrupt as error:
        return code_of(error)
    except BrokenPipeError:
        _write_nowhere()
        return CLOSED_PIPE
    except OSError as error:
        _write_nowhere()
        print(f"firsthit: {_unwritten(error)}", file=sys.stderr)
        return FAILED


def _ended(arguments: Sequence[str], options: argparse.Namespace) -> int:
    """Run one command, say what went wrong, and return its exit code.

    Raises SystemExit as argparse does, and OSError where standard output itself cannot be written.
    """
    usage: UsageError | None = None
    try:
        return _run(arguments, options)
    except UsageError as error:
        usage, code, told = error, USAGE, error.message
    except KeyboardInterrupt as error:
        code, told = _ended_by(error, options)
    except Exception as error:
        stop = asked()
        if not stop and (isinstance(error, BrokenPipeError) or (_is_full(error) and error.filename is None)):
            raise
        code, told = _known(error)
        if stop:  # a library may answer the signal by an error of its own, as NumPy does while it is imported
            code, told = _ended_by(stop, options)
        elif told:
            _told(f"firsthit: {told}")
        else:
            told = f"{type(error).__name__}: {error}"
            _cleared()
            traceback.print_exc()  # a mistake of ours; Python would end with 1, which says that a check does not hold
    # a usage that is wrong leaves `options` empty; argparse takes the beginning of an option for it
    if options.json or any(len(word) > 2 and "--json".startswith(word) for word in arguments):
        from harness.commands import machine

        machine.write_error(options.command, code, told)
    if usage:
        raise usage
    return code


def _ended_by(stop: KeyboardInterrupt, options: argparse.Namespace) -> tuple[int, str]:
    """Say that a command was stopped; return its exit code and what was said."""
    told = _stopped(options)
    try:
        _told(f"firsthit: {told}")
    except OSError:  # a terminal that was closed, which is what SIGHUP tells
        _write_nowhere()
    return code_of(stop), told


def _signed(arguments: Sequence[str]) -> list[str]:
    """Join an option of SIGNED and its value where that begins with a minus sign: argparse takes it for an option."""
    joined: list[str] = []
    for word in arguments:
        if joined and joined[-1] in SIGNED and word.startswith("-") and not word.startswith(("--", "-o", "-h")):
            joined[-1] += f"={word}"
        else:
            joined.append(word)
    return joined


def _run(arguments: Sequence[str], options: argparse.Namespace) -> int:
    """Parse a command line into `options` and run the command; return its exit code."""
    arguments = _signed(arguments)
    build_parser(arguments).parse_args(arguments, options)
    from harness.terminal import SCREEN

    SCREEN.level = "quiet" if options.quiet else "verbose" if options.verbose else "normal"
    with _spread(options.jobs):
        if options.json:
            from harness.commands import machine

            return machine.run(options.run, options)
        code: int = options.run(options)
        return code


def _spread(jobs: int | None) -> contextlib.AbstractContextManager[None]:
    """Let a command that has the option --jobs hand its work to so many processes while it runs."""
    if jobs == 1:
        return contextlib.nullcontext()
    from harness.spreading import pool

    return pool.over(jobs)


def _cleared() -> None:
    """Clear the live lines, which go on in a thread of their own where a command was left by an error."""
    from harness.terminal import SCREEN

    SCREEN.show(None)


def _told(line: str) -> None:
    """Write what went wrong, with nothing behind it that was live. Raises OSError where it cannot be written."""
    _cleared()
    print(line, file=sys.stderr)


def _is_full(error: Exception) -> TypeGuard[OSError]:
    """Tell whether an error says that a disk or a quota is full."""
    return isinstance(error, OSError) and error.errno in FULL


def _known(error: Exception) -> tuple[int, str]:
    """Return exit code and message of an error that the user can put right; the message is empty for any other."""
    from harness.contract import FirsthitError  # imports numpy, which help and usage do without

    if isinstance(error, FirsthitError):
        return error.exit_code, str(error)
    if isinstance(error, OSError) and error.errno == errno.ENAMETOOLONG and error.filename:
        return USAGE, f"{str(error.filename)[:40]!r}… is too long for the name of a file"
    return FAILED, _unwritten(error) if _is_full(error) else ""


def _unwritten(error: OSError) -> str:
    """Say which file cannot be written, and why."""
    return f"cannot write{f' {error.filename}' if error.filename else ''}: {error.strerror}"


def _stopped(options: argparse.Namespace) -> str:
    """Say what is left of a command that was stopped: cells that ended have rows, whatever else was going on."""
    if options.command not in RUN_CELLS:
        return "stopped"
    retried = getattr(options, "retry", None)
    less = "--force" if options.force else "--retry" if retried else ""
    same = f"the command without {less}" if less else "the same command"
    steps = ", with what was checked and timed of others" if options.command in TIMED else ""
    return f"stopped; finished cells are kept{steps}, and {same} goes on from there"


def _flush() -> None:
    """Write out what was printed. Raises BrokenPipeError where nobody reads it."""
    for stream in (sys.stdout, sys.stderr):
        if stream:  # None where the caller closed it before
            stream.flush()


def _write_nowhere() -> None:
    """Throw away what is left to be written, which the interpreter would complain of at its end."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except OSError:
            os.dup2(nowhere, stream.fileno())


if __name__ == "__main__":
    sys.exit(main())
