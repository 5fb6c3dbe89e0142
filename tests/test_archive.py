"""A run that was packed into one file is read as its folder is, and damage costs its own file."""

from __future__ import annotations

import io
import json
import random
import zipfile
from pathlib import Path

import pytest

import firsthit
from harness import cli
from harness.contract import FirsthitError
from harness.merging.merge import merge
from harness.results import archive, sealed
from reports.reading import load
from tests.machine_runs import contents, pictured, usual, write


def packed(tmp_path: Path, truth: bool = False) -> tuple[Path, Path]:
    run = write(tmp_path / "quick", usual())
    (run / "cells" / "0123456789abcdef.json").write_text("stale: no longer in the plan")
    (run / "truth").mkdir()
    (run / "truth" / "abc.npz").write_bytes(b"truth")
    archive.pack(run, tmp_path / "quick.zip", truth)
    return run, tmp_path / "quick.zip"


def rewritten(source: Path, target: Path, changed: dict[str, bytes]) -> Path:
    """Write an archive with other members; one of b"" is left out."""
    with zipfile.ZipFile(source) as old, zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as new:
        for name in old.namelist():
            if name not in changed:
                new.writestr(name, old.read(name))
        for name, content in changed.items():
            if content:
                new.writestr(name, content)
    return target


def test_an_archive_holds_what_the_plan_names_and_the_same_run_gives_the_same_bytes(tmp_path: Path) -> None:
    run, file = packed(tmp_path)
    with archive.opened(file) as folder:
        named = {name: text for name, text in contents(run).items() if not name.startswith(("truth/", "cells/0123"))}
        assert contents(folder) == named and folder.name == "quick"
    assert not folder.exists()
    assert archive.pack(run, tmp_path / "again.zip") == len(named)
    assert (tmp_path / "again.zip").read_bytes() == file.read_bytes()
    archive.pack(run, tmp_path / "truth.zip", truth=True)
    with archive.opened(tmp_path / "truth.zip") as folder:
        assert (folder / "truth" / "abc.npz").read_bytes() == b"truth"
    with archive.opened(run) as folder:
        assert folder == run


def test_load_merge_and_verify_read_the_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    run, file = packed(tmp_path)
    assert firsthit.load(file).equals(firsthit.load(run))
    merge([run], tmp_path / "one", "m")
    merge([file], tmp_path / "two", "m")
    one, two = (contents(tmp_path / name) for name in ("one", "two"))
    assert one.keys() == two.keys() and all(one[name] == two[name] for name in one if name != "plan.json")
    assert pictured(tmp_path / "two", usual()[0])
    assert cli.main(["verify", "--sample", "0", str(file)]) == 0
    assert "6 rows, 0 do not hold" in capsys.readouterr().out
    name = f"quick/cells/{usual()[0]['key']}.json"
    hurt = rewritten(file, tmp_path / "hurt.zip", {name: b"{"})
    assert cli.main(["verify", "--sample", "0", str(hurt)]) == 1
    assert f"hurt.zip/cells/{usual()[0]['key']}.json" in capsys.readouterr().out.replace("\n", "")
    assert cli.main(["archive", str(run), "-o", str(tmp_path / "c.zip")]) == 0
    assert (tmp_path / "c.zip").read_bytes() == file.read_bytes()


def test_a_collection_is_packed_with_its_parts(tmp_path: Path) -> None:
    run, _ = packed(tmp_path)
    plan = json.loads((run / "plan.json").read_text()) | {"name": "papers", "include": ["quick", "gone"], "cells": []}
    plan.pop("checksum")
    (tmp_path / "papers").mkdir()
    (tmp_path / "papers" / "plan.json").write_bytes(sealed.sealed(plan))
    archive.pack(tmp_path / "papers", tmp_path / "papers.zip")
    with load.opened(tmp_path / "papers.zip") as found:
        assert len(found.frame) == 6 and found.folder == tmp_path / "papers.zip"
        assert [one.file for one in found.unreadable] == ["gone"]


def test_a_damaged_row_is_told_as_in_a_folder_and_costs_itself(tmp_path: Path) -> None:
    run, file = packed(tmp_path)
    row = usual()[3]
    name = f"quick/cells/{row['key']}.json"
    whole = bytearray(file.read_bytes())
    with zipfile.ZipFile(file) as found:
        at = found.getinfo(name).header_offset + 200
    whole[at] ^= 0xFF
    (tmp_path / "hurt.zip").write_bytes(whole)
    with load.opened(tmp_path / "hurt.zip") as found_run:
        assert len(found_run.frame) == 5
        (broken,) = found_run.unreadable
        assert broken.file == name.removeprefix("quick/") and row["slot"] in broken.problem
    hurt = rewritten(file, tmp_path / "edited.zip", {name: (run / "cells" / f"{row['key']}.json").read_bytes()[:-9]})
    with load.opened(hurt) as found_run:
        assert "checksum" in found_run.unreadable[0].problem


OUTSIDE = ("../x.json", "/x.json", "quick/../../x.json", "quick/cells/../../../x.json", "other/plan.json")


@pytest.mark.parametrize("name", (*OUTSIDE, "quick/.lock", "quick/cells/a/b.json", "quick\\..\\x.json"))
def test_no_member_is_written_elsewhere(tmp_path: Path, name: str) -> None:
    run, file = packed(tmp_path)
    evil = rewritten(file, tmp_path / "evil.zip", {name: b"{}"})
    before = contents(tmp_path)
    with archive.opened(evil) as folder:
        assert len(contents(folder)) == len(contents(run)) - 2, "it is never written"
        assert {path.name for path in folder.parent.iterdir()} == {"quick"}
    assert contents(tmp_path) == before


def test_what_is_no_archive_or_would_fill_the_disk_is_refused_in_a_line(tmp_path: Path) -> None:
    _, file = packed(tmp_path)
    (tmp_path / "text.zip").write_text("no zip file")
    empty = io.BytesIO()
    zipfile.ZipFile(empty, "w").close()
    (tmp_path / "empty.zip").write_bytes(empty.getvalue())
    (tmp_path / "half.zip").write_bytes(file.read_bytes()[: file.stat().st_size // 2])
    facts = {"format": 1, "run": "..", "runs": [".."], "truth": False}
    rewritten(file, tmp_path / "up.zip", {"archive.json": sealed.sealed(facts)})
    rewritten(file, tmp_path / "new.zip", {"archive.json": sealed.sealed(facts | {"format": 2, "run": "quick"})})
    rewritten(file, tmp_path / "bare.zip", {"archive.json": b""})
    with zipfile.ZipFile(tmp_path / "bomb.zip", "w", zipfile.ZIP_DEFLATED) as bomb:
        bomb.writestr("archive.json", sealed.sealed(facts | {"run": "quick", "runs": ["quick"]}))
        for number in range(70):
            bomb.writestr(f"quick/cells/{number}.json", bytes(2**20))
    reasons = {"text": "no whole archive", "empty": "no archive.json", "half": "not a whole one", "up": "names no run"}
    reasons |= {"new": "its format is 2", "bare": "no archive.json", "bomb": "would unpack to"}
    for name, reason in reasons.items():
        with pytest.raises(FirsthitError, match=reason), archive.opened(tmp_path / f"{name}.zip"):
            pass
    with pytest.raises(FirsthitError, match="lies in the run"):
        archive.pack(tmp_path / "quick", tmp_path / "quick" / "own.zip")
    with pytest.raises(FirsthitError, match="no run folder"):
        archive.pack(tmp_path / "none", tmp_path / "none.zip")


def test_archives_that_are_damaged_anywhere_are_read_or_named(tmp_path: Path) -> None:
    """Whatever byte is hurt: no traceback, and no row that is not one of the run's."""
    run, file = packed(tmp_path)
    good = {
        json.loads(text)["key"]: text
        for name, text in contents(run).items()
        if name.startswith("cells/") and text[:1] == b"{"
    }
    whole, dice = file.read_bytes(), random.Random(1)
    for _ in range(40):
        hurt = bytearray(whole)
        for _ in range(dice.randint(1, 4)):
            hurt[dice.randrange(len(hurt))] = dice.randrange(256)
        if dice.random() < 0.2:
            hurt = hurt[: dice.randrange(len(hurt))]
        (tmp_path / "hurt.zip").write_bytes(hurt)
        try:
            with archive.opened(tmp_path / "hurt.zip") as folder:
                for path in (folder / "cells").glob("*.json"):
                    try:
                        sealed.read(path)
                    except ValueError:
                        continue
                    assert path.read_bytes() == good[path.stem]
        except FirsthitError:
            pass


def test_a_report_is_put_beside_the_archive() -> None:
    from reports.place import place

    assert place(Path("runs/quick")).name == "quick.report"
