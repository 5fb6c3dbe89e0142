"""Find the configs that come with firsthit by their names, wherever firsthit is installed."""

from __future__ import annotations

from pathlib import Path

from harness import ROOT
from harness.contract import FirsthitError
from surfaces.words import suggestion

FOLDER = ROOT / "configs"


def names() -> list[str]:
    """List the names of the shipped configs, sorted."""
    return sorted(path.stem for path in FOLDER.glob("*.toml"))


def located(config: str | Path) -> Path:
    """Return the file that `config` means: a file, or else the shipped config of that name, as in `quick`.

    Raises FirsthitError, with the nearest name, where there is neither.
    """
    path = Path(config)
    if path.is_file() or path.suffix or not path.name or len(path.parts) != 1:  # if it is not there, reading it says so
        return path
    known = names()
    if path.name in known:
        return FOLDER / f"{path.name}.toml"
    hint = suggestion(path.name, known, otherwise="see `firsthit list configs`")
    if (beside := path.with_name(f"{path.name}.toml")).is_file():
        hint = f"did you mean {str(beside)!r}?"
    raise FirsthitError(f"there is no config {path.name!r}, neither a file nor one that firsthit ships; {hint}")
