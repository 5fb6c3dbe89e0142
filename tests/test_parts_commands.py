"""Every command gives the same of a run whose rows lie in Parquet parts as of one whose rows are files."""

from __future__ import annotations

import contextlib
import io
import os
import re
import shutil
from argparse import Namespace
from pathlib import Path

import pytest

import firsthit
from harness import cli
from harness.commands import completion
from harness.gate import baseline, pictures
from harness.merging.clean import clean
from harness.results import compaction, parts
from harness.results.history import past_of
from harness.results.store import Store
from reports.reading import load
from reports.site import gather
from tests.machine_runs import contents, row_of, usual, write

OLD = row_of("newton[EPSILON=0.001]", "torus", driver="0", started="2026-11-21T03:00:10+00:00") | {"arrays": None}
ROW = re.compile(r"(cells/[0-9a-f]+\.json|parts/[0-9a-f-]+\.parquet)")

PROGRESS = re.compile(r"firsthit: [a-z]+ \[\d+/\d+\]")  # said where a step takes long


def pack(folder: Path) -> Path:
    """Put most rows of a run into two parts; the last one stays a file."""
    store = Store(folder)
    keys = store.files()
    kept = {key: store.text(key) for key in keys}
    for some in (keys[:3], keys[3:-1]):
        for key in keys:
            (folder / "cells" / f"{key}.json").unlink(missing_ok=True)
        for key in some:
            store.write_text(key, kept[key])
        assert compaction.compact(folder, most=0).rows == len(some)
    store.write_text(keys[-1], kept[keys[-1]])
    assert len(parts.parts_in(folder)) == 2 and Store(folder).files() == keys[-1:]
    return folder


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """Return two folders with the same runs of two machines: with files, and with parts."""
    filed, packed = tmp_path_factory.mktemp("filed"), tmp_path_factory.mktemp("packed")
    Store(write(filed / "runs" / "quick", usual())).write(OLD)
    write(filed / "runs" / "other", usual(machine="lab2", driver="2", factor=3.0), machine="lab2")
    shutil.copytree(filed / "runs", packed / "runs")
    for name in ("quick", "other"):
        pack(packed / "runs" / name)
    return filed, packed


def said(folder: Path, *command: str) -> tuple[int, str, str]:
    """Run a command in a folder; return its exit code and what it printed, without the names of rows' files."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.chdir(folder), contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = cli.main(list(command))
    return code, *(ROW.sub("ROW", text.getvalue()) for text in (out, err))


def rows_in(folder: Path) -> dict[str, bytes]:
    """Return the bytes of each row of a run."""
    store = Store(folder)
    every = store.keys()
    return {key: store.text(key) for key in every}


@pytest.mark.parametrize(
    "command",
    [
        ("merge", "runs/quick", "runs/other", "-o", "all"),
        ("archive", "runs/quick", "-o", "quick.zip"),
        ("verify", "runs/quick", "--sample", "0", "--jobs", "1"),
        ("verify", "runs/quick", "--sample", "all", "--jobs", "1", "--seed", "3"),
    ],
    ids=" ".join,
)
def test_a_command_prints_and_writes_the_same(made: tuple[Path, Path], command: tuple[str, ...]) -> None:
    answers = []
    for folder in made:
        before = set(folder.rglob("*"))
        code, out, err = said(folder, *command)
        lines = sorted(line for line in out.splitlines() if "column" not in line)  # of parts alone
        err = "".join(line for line in err.splitlines() if not PROGRESS.match(line))
        new = {path.relative_to(folder).as_posix() for path in set(folder.rglob("*")) - before}
        answers.append(
            (code, lines, err, {name: (folder / name).read_bytes() for name in new if (folder / name).is_file()})
        )
    assert answers[0] == answers[1]
    assert answers[0][1], "something is printed"


def test_clean_removes_the_same_rows(made: tuple[Path, Path], tmp_path: Path) -> None:
    left = []
    for name, folder in zip(("filed", "packed"), made, strict=True):
        run = shutil.copytree(folder / "runs" / "quick", tmp_path / name)
        before = rows_in(run)
        dry = clean(run, "firsthit clean", dry=True)
        assert rows_in(run) == before and all(one.size > 0 for one in dry)
        assert clean(run, "firsthit clean") == dry and clean(run, "firsthit clean") == []
        left.append((rows_in(run), [(one.what, one.key) for one in dry]))
    assert left[0] == left[1] and [key for _, key in left[0][1]] == [OLD["key"]]


def test_clean_leaves_a_damaged_part_as_it_is(made: tuple[Path, Path], tmp_path: Path) -> None:
    run = shutil.copytree(made[1] / "runs" / "quick", tmp_path / "quick")
    for part in parts.parts_in(run):
        part.write_bytes(part.read_bytes() + b"more")
    before = contents(run)
    assert clean(run, "firsthit clean") == [] and contents(run) == before


def test_readers_find_the_same_rows(made: tuple[Path, Path]) -> None:
    key = next(row["key"] for row in usual() if row["slot"] == OLD["slot"])
    found = []
    for folder in made:
        runs = folder / "runs"
        past = past_of(key, runs)
        assert past.before and (past.row["key"], past.before["key"]) == (key, OLD["key"])
        run = load.load(runs / "quick")
        (of_site,) = gather._parts([(run, run.frame)])
        with contextlib.chdir(folder):
            blessed = pictures.blessed_in(baseline.Baseline({}, {}), Path("runs/quick"))
        found.append(
            (
                past,
                completion._cells(Namespace(runs=runs)),
                firsthit.load(runs / "quick").to_csv(),
                (of_site.not_run, len(of_site.rows), of_site.problems),
                blessed is not None,
            )
        )
    assert (vars(found[0][0]), found[0][1:]) == (vars(found[1][0]), found[1][1:])
    assert len(found[0][1]) == 13 and os.sep not in str(found[0][3])


def test_a_merged_run_is_packed_where_it_has_many_rows(
    made: tuple[Path, Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert said(made[1], "merge", "runs/quick", "runs/other", "-o", str(tmp_path / "filed"))[0] == 0
    monkeypatch.setattr(compaction, "MOST", 5)
    for _ in range(2):  # the second time the merged run comes first, and nothing is new
        code, out, _ = said(made[1], "merge", "runs/quick", "runs/other", "-o", str(tmp_path / "packed"))
        assert code == 0
    assert "nothing was new" in out
    assert parts.parts_in(tmp_path / "packed") and rows_in(tmp_path / "packed") == rows_in(tmp_path / "filed")


def test_a_damaged_part_is_named_by_what_merges_it(made: tuple[Path, Path], tmp_path: Path) -> None:
    runs = shutil.copytree(made[1] / "runs", tmp_path / "runs")
    part = parts.parts_in(runs / "quick")[0]
    part.write_bytes(part.read_bytes()[:-50])
    code, _, err = said(tmp_path, "merge", "runs/quick", "-o", "all")
    assert code == 3 and f"parts/{part.name}" not in err and "ROW was left out" in err
