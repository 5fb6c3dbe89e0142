"""Keep what a gate found by the commit that it was found at, for `firsthit history`."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path

from harness.contract import FirsthitError
from harness.gate.baseline import Entry
from harness.gate.checked import Checked
from harness.gate.repository import changed, commit_of, holding
from harness.results import commits
from harness.results.commits import Commit, Kept
from harness.running.environment import describe

REASON = 300  # characters of a reason that are kept


@dataclass(frozen=True)
class Keeping:
    """Hold the commit that rows are to be kept by, and the folder; `because` says which files make its tree dirty."""

    commit: Commit
    folder: Path
    because: tuple[str, ...] = ()

    def keep(self, checked: Checked) -> list[Path]:
        """Write a file for each device that `checked` has rows of, and return their paths.

        Rows are kept whether they pass or not. Raises FirsthitError where a file cannot be written.
        """
        environment = describe()
        harness = {"version": environment["firsthit"], "commit": environment["commit"], "dirty": environment["dirty"]}
        written = []
        for key, entries in checked.now.rows.items():
            rows = {slot: _short(entry) for slot, entry in entries.items()}
            kept = Kept(checked.experiment.name, self.commit, checked.now.devices[key], rows, harness)
            written.append(commits.write(self.folder, kept, key))
        return written


def _short(entry: Entry) -> Entry:
    """Shorten the reason of an entry, which may be a compiler's whole log, to one line of REASON characters."""
    if "reason" not in entry:
        return entry
    return entry | {"reason": " ".join(str(entry["reason"]).split())[:REASON]}


def keeping(plugins: Path | None, config: Path, folder: Path, written: Collection[Path]) -> Keeping:
    """Say, before anything runs, which commit the rows of a config will be kept by below `folder`.

    `written` are files and folders that commands write, whose changes make no tree dirty. Raises FirsthitError where
    there is no repository, or no commit in it.
    """
    top = holding(plugins, config)
    if top is None:
        where = plugins or config
        raise FirsthitError(
            f"--keep: {where} is in no git repository, so there is no commit to keep rows by; "
            f"`git init` one and commit, or leave --keep out"
        )
    written = [*written, folder]
    commit = commit_of(top, plugins, config, written)
    because = changed(top, plugins, config, written) if commit.dirty else []
    return Keeping(commit, folder, tuple(because))
