"""Start the `firsthit` command: Ctrl-C ends it silently while nothing is begun, and after all is done."""

from __future__ import annotations

import signal
import sys


def main() -> int:
    """Run the command line of this process and return its exit code. Raises SystemExit as harness.cli.main does."""
    _quietly()
    from harness.cli import main as run

    try:
        return run()
    finally:
        _quietly()


def _quietly() -> None:
    """Let the system end the process at Ctrl-C, in the place of a traceback; one that is ignored stays so."""
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)


if __name__ == "__main__":
    sys.exit(main())
