"""Hash the project's own files by whole folders: what decides a row, a truth file, a mesh or a study.

A folder counts with everything in it, so that a new module is covered on the day it appears. What is left out stands in
NOT_DECIDING with its reason. tests/test_identity.py walks the imports of a run and fails where it reaches one of them.
"""

from __future__ import annotations

import ast
import hashlib
import platform
from collections.abc import Iterator
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from harness import ROOT
from harness.contract import FirsthitError, digest

DECIDING = ("harness", "surfaces")
NOT_DECIDING = {
    "harness/__init__.py": "holds the version's number and says where the project is, which no row depends on",
    "harness/running/batch.py": "chooses which cells are run, and leaves running them to the runner",
    "harness/running/due.py": "chooses which cells are run, by what is stored",
    "harness/running/packing.py": "packs finished rows, whose bytes stay as they are",
    "harness/running/picture.py": "draws a picture to look at, and stores no row",
    "harness/running/run.py": "chooses which cells are run, and leaves running them to the runner",
    "harness/running/trace.py": "casts rays to look at, and stores no row",
    "harness/running/cards.py": "copies docstrings for the report",
    "harness/cli.py": "reads the command line",
    "harness/start.py": "starts the command",
    "harness/py.typed": "says that type checkers may read the annotations",
    "surfaces/py.typed": "says that type checkers may read the annotations",
    "harness/cluster": "takes steps to devices elsewhere, and changes none of them",
    "harness/running/fleet.py": "says what offers devices elsewhere",
    "harness/commands": "read options and print; what an option changes is in the config, and so in the identity",
    "harness/conformance": "checks methods and stores no row",
    "harness/console.py": "prints tables and progress",
    "harness/terminal.py": "prints lines",
    "harness/experiment/shards.py": "chooses which cells are run",
    "harness/experiment/schema.py": "tells editors what a config may hold, and reads none",
    "harness/gate": "judges finished rows",
    "harness/merging": "joins finished rows, and clears them away",
    "harness/recommend": "chooses among finished rows",
    "harness/results/archive.py": "packs finished rows",
    "harness/results/commits.py": "keeps the figures of finished rows",
    "harness/results/compaction.py": "packs finished rows, whose bytes stay as they are",
    "harness/results/columns.py": "prints a page of the documentation",
    "harness/results/lock.py": "lets one command at a time write, whatever that is",
    "harness/results/schema.py": "says which columns reports make of finished rows",
    "harness/shipping": "writes programs out for others, and stores no row",
    "harness/schemas.py": "writes schemas, which no run reads",
    "harness/verifying": "checks finished rows",
    "harness/studies": "are no cells; each has a key of its own, see harness/studies/__init__.py",
}
TRUTH = ("harness/contract.py", "harness/limits.py", "harness/oracle", "surfaces")
MESHES = ("harness/contract.py", "harness/limits.py", "harness/scenes/meshes.py", "surfaces")
PACKAGES = ("numpy", "python-flint")  # those of bindings and of the mesher stand elsewhere in a row's identity
LIBRARIES = ("site-packages", "dist-packages")  # folders that hold other people's modules beside a plugin's


@cache
def hashes(*parts: str) -> dict[str, str]:
    """Return the 16-digit hash of each file of `parts`, by its path below the project.

    `parts` are files and folders, named from the project's folder. Raises FirsthitError where one is not there, since
    a name alone covers nothing.
    """
    found: dict[str, str] = {}
    for part in parts:
        path = ROOT / part
        if not path.exists():
            raise FirsthitError(f"{path} is missing, so that what decides a result is not known; install firsthit anew")
        found |= {file.relative_to(ROOT).as_posix(): hash_of(file) for file in files_in(path)}
    return found


@cache
def methodology() -> dict[str, str]:
    """Return the hash of each of our files that decide what a row says, by its path below the project."""
    return {path: found for path, found in hashes(*DECIDING).items() if left_out(path) is None}


@cache
def digest_of(*parts: str) -> str:
    """Return one hash of all files of `parts`. Raises FirsthitError where a part is not there."""
    return digest(hashes(*parts))


@cache
def packages() -> dict[str, str]:
    """Return the versions of the packages that compute truth, tables and verdicts, and the minor version of Python."""
    found = {"python": ".".join(platform.python_version_tuple()[:2])}
    for name in PACKAGES:
        try:
            found[name] = version(name)
        except PackageNotFoundError:  # a source tree on the path, without its metadata
            found[name] = "unknown"
    return found


def left_out(path: str) -> str | None:
    """Say why a file, such as `harness/cli.py`, does not decide a row; None where it does."""
    folders = [path, *(parent.as_posix() for parent in Path(path).parents)]
    return next((NOT_DECIDING[folder] for folder in folders if folder in NOT_DECIDING), None)


def hash_of(file: Path) -> str:
    """Return the first 16 digits of a file's SHA-256."""
    return hashlib.sha256(file.read_bytes()).hexdigest()[:16]


def files_in(path: Path) -> list[Path]:
    """List `path` itself, or all files below it, sorted, without hidden ones, backups and compiled Python."""
    if path.is_file():
        return [path]
    found = (file for file in path.rglob("*") if file.is_file() and not file.name.endswith("~"))
    return sorted(file for file in found if not _is_litter(file.relative_to(path)))


def _is_litter(path: Path) -> bool:
    return any(part.startswith(".") or part == "__pycache__" for part in path.parts)


def of_method(folder: Path) -> dict[str, str]:
    """Return the hash of each file of a method's folder, and of each of its own modules that these files import.

    Its own modules are those beside the folder and those of the package that holds it; imports inside functions count.
    The harness's modules are covered by `methodology`, other packages by what they change in the program. A file that
    a method reads from elsewhere is not seen.
    """
    top = _topmost(folder)
    open_files, found = files_in(folder), dict[Path, str]()
    while open_files:
        file = open_files.pop()
        if file not in found:
            found[file] = hash_of(file)
            if file.suffix == ".py":
                open_files += imported(file, _roots(folder, top))
    return dict(sorted((_named(file, top.parent), found[file]) for file in found))


def _named(file: Path, above: Path) -> str:
    return (file.relative_to(above) if file.is_relative_to(above) else file).as_posix()


def _topmost(folder: Path) -> Path:
    """Return the folder of the outermost package that holds `folder`, or `folder` itself."""
    while (folder.parent / "__init__.py").exists():
        folder = folder.parent
    return folder


def _roots(folder: Path, top: Path) -> list[tuple[Path, str | None]]:
    """List where a method's own modules may lie, each with the package they must be of; None: of any name."""
    roots: list[tuple[Path, str | None]] = [(folder, None), (top.parent, top.name)]
    if folder.parent.name not in LIBRARIES:
        roots.append((folder.parent, None))
    return [(root, name) for root, name in roots if name is not None or root != ROOT]


def imported(file: Path, roots: list[tuple[Path, str | None]]) -> list[Path]:
    """List the files below `roots` that a Python file imports, at its top or in functions; none where it is broken."""
    try:
        tree = ast.parse(file.read_bytes())
    except (SyntaxError, ValueError, RecursionError, MemoryError):  # then the method is not loaded
        return []
    found: list[Path] = []
    for names, level in _imports(tree):
        if level:
            start = file.parent.joinpath(*[".."] * (level - 1)).resolve()
            found += [path for name in names for path in _modules(start, name)]
        for root, package in () if level else roots:
            own = (name for name in names if package is None or name.partition(".")[0] == package)
            found += [path for name in own for path in _modules(root, name)]
    return found


def _imports(tree: ast.Module) -> Iterator[tuple[list[str], int]]:
    """Yield, for each import, the modules that it may mean, and how many folders up it starts."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield [name.name for name in node.names], 0
        elif isinstance(node, ast.ImportFrom):
            base = node.module or ""
            yield [base, *(f"{base}.{name.name}".lstrip(".") for name in node.names)], node.level


def _modules(root: Path, name: str) -> Iterator[Path]:
    """Yield the files that importing `name` below `root` executes: the module's, and those of packages on the way."""
    path = root
    for part in name.split(".") if name else ():
        path = path / part
        for file in (path / "__init__.py", path.with_name(f"{path.name}.py")):
            if file.is_file():
                yield file
