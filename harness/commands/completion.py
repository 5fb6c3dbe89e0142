"""Offer `firsthit completion`: print what makes a shell complete commands, options, names and paths.

The shell's function runs `firsthit` with _ARGCOMPLETE in the environment at each TAB; `harness.cli` then calls
`complete`. Nothing slow is imported for that and no device is opened: devices are those that an earlier look has kept.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable, Iterable
from pathlib import Path

from harness.commands import Add

SHELLS = ("bash", "zsh", "fish")
Namespace = argparse.Namespace


def add_parsers(add: Add) -> None:
    parser = add(
        "completion",
        'eval "$(firsthit completion bash)"',
        "Print what makes a shell complete commands, options, surfaces, methods, devices, knobs, configs and paths. "
        'Into ~/.bashrc or, after compinit, ~/.zshrc: eval "$(firsthit completion bash)" or zsh; '
        "into ~/.config/fish/config.fish: firsthit completion fish | source.",
    )
    parser.add_argument("shell", choices=SHELLS)
    parser.set_defaults(run=_completion)


def _completion(options: Namespace) -> int:
    """Print the function that a shell completes by. Raises FirsthitError where argcomplete is not installed."""
    try:
        from argcomplete.shell_integration import shellcode
    except ModuleNotFoundError:
        from harness.contract import FirsthitError

        message = "completion needs the package argcomplete: pip install 'firsthit[completion]'"
        raise FirsthitError(message, exit_code=3) from None
    print(shellcode(["firsthit"], shell=options.shell), end="")
    return 0


def complete(build: Callable[[list[str]], argparse.ArgumentParser]) -> None:
    """Tell a shell how its command line may go on, and end the process; `build` makes the parser of a command line."""
    import argcomplete

    parser = build(os.environ["COMP_LINE"].split())
    _prepare(parser)
    argcomplete.autocomplete(parser, always_complete_options="long")


def _prepare(parser: argparse.ArgumentParser) -> None:
    """Give each option and argument what completes its values, where these are no choices and no files."""
    from argcomplete.completers import DirectoriesCompleter, FilesCompleter

    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            for own in action.choices.values():
                _prepare(own)
        elif action.choices is None and action.dest in COMPLETERS:
            action.completer = _Named(COMPLETERS[action.dest])  # type: ignore[attr-defined]
        elif action.dest == "folders":
            action.completer = FilesCompleter(("zip",))  # type: ignore[attr-defined]
        elif action.metavar == "DIR" or action.dest in FOLDERS:
            action.completer = DirectoriesCompleter()  # type: ignore[attr-defined]
        elif action.choices is None and action.type is not Path:
            action.completer = _Named(lambda _: ())  # type: ignore[attr-defined]


class _Named:
    """Complete a value by names, of those that begin as it does, and by files where a name may be one."""

    def __init__(self, names: Callable[[Namespace], Iterable[str]]) -> None:
        self._names = names

    def __call__(self, prefix: str, parsed_args: Namespace, action: argparse.Action, **_: object) -> list[str]:
        from argcomplete.completers import FilesCompleter

        found = [name for name in self._names(parsed_args) if name.startswith(prefix)]
        if action.dest == "config":
            return found + list(FilesCompleter(("toml",))(prefix))
        return found + (list(FilesCompleter()(prefix)) if action.dest in FILES and (prefix or not found) else [])


def _surfaces(_options: Namespace) -> list[str]:
    import surfaces

    names = (*surfaces.names(), *surfaces.names(surfaces.GALLERY))
    return [form for name in names for form in (name, *surfaces.forms_of(name))]


def _groups(_options: Namespace) -> list[str]:
    import surfaces

    return [*surfaces.groups(), surfaces.GALLERY]


def _methods(options: Namespace) -> list[str]:
    from harness import plugins

    return plugins.named(_plugins(options))


def _devices(_options: Namespace) -> list[str]:
    from harness.devices import kept_answers
    from harness.devices.interface import INSTALL

    kept = [answer for backend in INSTALL if (answer := kept_answers.recall(backend))]
    return [info.name for answer in kept for info in answer.devices if not info.problem]


def _configs(_options: Namespace) -> list[str]:
    from harness.experiment import shipped

    return shipped.names()


def _knobs(options: Namespace) -> list[str]:
    """List the knobs of the method that --method names, as `NAME=`."""
    from harness.contract import FirsthitError
    from harness.plugins import find_methods

    try:
        method = find_methods(_plugins(options)).get(_last(options, "method")).method
    except FirsthitError:
        return []
    return [f"{knob.name}=" for knob in method.parameters]


def _parameters(options: Namespace) -> list[str]:
    """List the parameters of the surface that --surface names, as `NAME=`."""
    import surfaces
    from harness.contract import FirsthitError
    from surfaces import files

    named = _last(options, "surface")
    try:
        surface = files.load(named).surface if files.is_file(named) else surfaces.get(named)
        return [f"{name}=" for name, _ in surface.parameters]
    except FirsthitError:
        return []


def _claims(_options: Namespace) -> Iterable[str]:
    from harness.contract import CLAIMS

    return CLAIMS


def _cells(options: Namespace) -> list[str]:
    """List the keys of the results in the folder that --runs names."""
    folder = getattr(options, "runs", None) or Path("runs")
    from harness.results.history import keys_below

    return sorted({key for _, key in keys_below(Path(folder))})


def _plugins(options: Namespace) -> Path | None:
    return getattr(options, "plugins", None)


def _last(options: Namespace, name: str) -> str:
    """Return the value that was given last to an option; "" where none was."""
    value = getattr(options, name, None) or ""
    return value if isinstance(value, str) else str(value[-1])


COMPLETERS: dict[str, Callable[[Namespace], Iterable[str]]] = {  # by the destinations of options and arguments
    "surface": _surfaces,
    "group": _groups,
    "method": _methods,
    "device": _devices,
    "config": _configs,
    "knob": _knobs,
    "parameter": _parameters,
    "cell": _cells,
    "require": _claims,
}
FOLDERS = ("folder",)  # arguments that are folders; "folders" are folders and archives
FILES = ("surface", "cell")  # names that may be files
