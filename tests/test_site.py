"""`firsthit publish`: the site of several runs, its numbers, its links, what it refuses, and how a browser shows it."""

from __future__ import annotations

import json
import re
import shutil
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

from harness.cli import main
from harness.contract import FirsthitError, digest
from reports.site import board, build
from tests import browser
from tests.agreeing_rows import stated
from tests.synthetic_run import IDENTITY, arrays, cell, plan, sampled, stability_run

SURFACES = ("torus", "barth")
DEVICES = ("opencl:intel", "opengl:llvmpipe")
VARIANTS = {  # milliseconds, and misses of 2,245 clear rays
    "null": (0.01, 0),
    "ray_march": (20.0, 0),
    "newton[EPSILON=0.001]": (1.0, 5),
    "newton[EPSILON=1e-06]": (2.0, 0),
    "_odd#[STEP_$=0.5,RELAXATION_OF_THE_LAST_STEP=1.25]": (4.0, 0),
}
EVIL = "<script>alert('x')</script> & \"quoted\" <b>"
METHODS = {
    "newton": {
        "title": f"Newton {EVIL}",
        "label": "Newton",
        "summary": "Steps to the root.",
        "source": "toledo2007",
        "doc": {"Theory": f"A step.\n- a point {EVIL}", "What was tried": "On a torus."},
        "tables": [{"part": "What was tried", "header": ["what", "kept"], "rows": [["larger steps", "no"]]}],
        "parameters": [{"name": "EPSILON", "default": 0.001, "meaning": "ends it", "printed": None}],
        "claims": ["no_false_hit"],
        "outside": None,
    }
}


def timed(variant: str, surface: str, device: str) -> dict[str, Any]:
    """Make a cell with the time and the misses of VARIANTS, and a relative error that says which variant it is."""
    ms = VARIANTS[variant][0]
    made = cell(variant, surface, device, "float32")
    sampled(made, [ms] * 20)
    made["surface"] = f"../{EVIL}" if surface == "barth" else surface
    made["surface_title"] = EVIL if surface == "barth" else made["surface_title"]
    if made["answers"]:
        top = 1e-7 if "1e-06" in variant else 5e-4
        facts = made["accuracy"]
        facts |= {"misses": VARIANTS[variant][1], "false_hits": 0, "exhausted": 0, "wrong_root": 0, "invalid": 0}
        facts["error"] = {"max": top}
        facts["relative_error"] = {name: top for name in facts["relative_error"]}
    return made


def written(folder: Path, cpu: str, created: str, variants: tuple[str, ...] = tuple(VARIANTS)) -> Path:
    """Write a run of SURFACES on DEVICES with its arrays, made on a machine with this processor at this time."""
    cells = [timed(v, s, d) for s in SURFACES for d in DEVICES for v in variants]
    (folder / "cells").mkdir(parents=True)
    (folder / "arrays").mkdir()
    told = plan(cells) | {"name": folder.name, "title": f"{folder.name} {EVIL}", "created": created, "methods": METHODS}
    told["environment"] |= {"cpu": cpu}
    (folder / "plan.json").write_text(json.dumps(told))
    for one in cells:
        if one["arrays"]:
            stored = arrays(one)
            clear = ~stored["grazing"] & np.isfinite(stored["error"])
            stored["error"][~clear] = np.nan
            stored["error"] *= np.float32(one["accuracy"]["error"]["max"]) / stored["error"][clear].max()
            stored["wrong"][:] = 0
            stored["wrong"].flat[np.flatnonzero(clear)[: one["accuracy"]["misses"]]] = 1
            stored["error"][stored["wrong"] == 1] = np.nan
            one["accuracy"]["error"] = {"max": float(np.nanmax(stored["error"]))}
            np.savez_compressed(folder / one["arrays"], **stored)
        (folder / "cells" / f"{one['key']}.json").write_text(json.dumps(stated(one)))
    return folder


@pytest.fixture(scope="module")
def runs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder of runs: two of one machine, one of another, families alone, one that is damaged."""
    folder = tmp_path_factory.mktemp("runs")
    written(folder / "old", "Processor A", "2026-01-01T00:00:00+00:00")
    written(folder / "new", "Processor A", "2026-02-01T00:00:00+00:00")
    written(folder / "elsewhere", "Processor B", "2026-01-15T00:00:00+00:00")
    stability_run(folder / "hard")
    (folder / "damaged").mkdir()
    (folder / "damaged" / "plan.json").write_text('{"format": 1, "na')
    broken = timed("null", "torus", DEVICES[0])["key"]
    (folder / "elsewhere" / "cells" / f"{broken}.json").write_text('{"format": 1, "key"')
    return folder


@pytest.fixture(scope="module")
def site(runs: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("site") / "site"
    every = [str(runs / name) for name in ("old", "new", "elsewhere", "hard", "damaged")]
    assert main(["publish", *every, "-o", str(folder)]) == 0
    return folder


class Page(HTMLParser):
    """Read a page's links, ids and text, and hold that its elements end in order."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.links: list[str] = []
        self.ids: list[str] = []
        self.told: list[str] = []
        self.open: list[str] = []
        self.feed(text)
        assert self.open == []

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        named = dict(attributes)
        self.links += [value for name in ("href", "src") if (value := named.get(name))]
        self.ids += [value] if (value := named.get("id")) else []
        if tag not in ("meta", "link", "img", "input", "br"):
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.told.append(data)

    @property
    def text(self) -> str:
        return " ".join(" ".join(self.told).split())


@pytest.fixture(scope="module")
def pages(site: Path) -> dict[str, Page]:
    return {p.relative_to(site).as_posix(): Page(p.read_text(encoding="utf-8")) for p in site.rglob("*.html")}


def test_every_link_leads_to_a_file_of_the_site_and_to_a_place_in_it(site, pages):
    assert len(pages) > 12
    for name, page in pages.items():
        assert len(page.ids) == len(set(page.ids)), f"{name}: an id is used twice"
        for link in page.links:
            if link == "data:,":
                continue
            assert not re.match(r"[a-z]+:|/", link), f"{name}: {link} leaves the site"
            path, _, place = link.partition("#")
            target = (site / name).parent / path if path else site / name
            assert target.is_file(), f"{name}: {link}"
            at = target.resolve().relative_to(site.resolve()).as_posix()
            assert not place or place in pages[at].ids, f"{name}: {link}"


def test_no_page_asks_for_anything_else(site):
    for file in (*site.rglob("*.html"), site / "site.css", site / "site.js"):
        assert not re.search(r"https?:|@import|url\(", file.read_text(encoding="utf-8")), file


def test_texts_of_runs_are_escaped_wherever_they_stand(pages, site):
    assert any(EVIL in page.text for page in pages.values())
    for name in pages:
        assert "<script>alert" not in (site / name).read_text(encoding="utf-8"), name


def test_a_cell_names_who_is_fastest_within_the_bound_and_what_a_faster_one_risks(site):
    text = (site / "index.html").read_text(encoding="utf-8")
    winners = text[text.index('id="winners"') :]
    loose = re.findall(r'<div class="at" data-level="1e-3">(.*?)</div></td>', winners)
    assert loose and all("Newton, ε = 1e−6" in one and "2.00 ms, 10.0×" in one for one in loose)
    assert all("Newton, ε = 0.001: 2.00× faster, 5 of 2,245 rays wrong" in one for one in loose)
    tight = re.findall(r'data-level="1e-6">(.*?)</div>', winners)
    assert tight and all("Newton, ε = 1e−6" in one for one in tight)


def test_keys_pass_over_the_marks_of_a_plot(site):
    for name in ("surfaces/torus.html", "methods/newton.html"):
        plots = re.findall(r"<svg.*?</svg>", (site / name).read_text(encoding="utf-8"), re.DOTALL)
        marks = [mark for plot in plots for mark in re.findall(r"<a [^>]*>", plot)]
        assert marks and all('tabindex="-1"' in mark for mark in marks)


def test_standings_count_cells_and_not_rows(site):
    script = re.search(r'id="cells">(.*?)</script>', (site / "index.html").read_text(encoding="utf-8"))
    told = json.loads(script[1])
    assert len(told["cells"]) == 8  # two surfaces, two devices, two machines
    newton = [one["m"]["newton"] for one in told["cells"] if "newton" in one["m"]]
    assert sum(one["w"][0] == 2 for one in newton) == len(newton)
    line = re.search(r'<tr id="m-newton".*?</tr>', (site / "index.html").read_text(encoding="utf-8"))[0]
    cells = re.findall(r"<td.*?>(.*?)</td>", line)
    assert re.sub("<.*?>", "", cells[0]) == f"{len(newton)}"
    assert cells[1:] == [
        f"{len(newton)} of {len(newton)}",
        f"10.0× in {len(newton)}",
        f"{5 * len(newton)} of {2245 * len(newton):,}",
    ]


def test_devices_of_several_machines_are_told_apart(pages):
    for name in ("opencl:intel", "opengl:llvmpipe"):
        for machine in "AB":
            assert re.search(rf"{name}[^|]*Processor {machine}", pages["index.html"].text)


def test_the_newest_run_of_a_cell_counts_and_the_older_one_is_listed(site, pages):
    page = (site / "surfaces" / "torus.html").read_text(encoding="utf-8")
    counted = re.findall(r'<dt>run</dt><dd><a href="../runs/(.*?).html">', page)
    assert sorted(counted) == ["elsewhere", "elsewhere", "new", "new"]
    assert "The same scene was timed before" in page and 'href="../runs/old.html"' in page
    assert "replaced by other runs" in pages["runs.html"].text


def test_an_older_run_with_more_methods_counts(tmp_path, runs):
    few = written(tmp_path / "few", "Processor A", "2026-03-01T00:00:00+00:00", ("null", "newton[EPSILON=1e-06]"))
    build.build([runs / "new", few], tmp_path / "site")
    page = (tmp_path / "site" / "surfaces" / "torus.html").read_text(encoding="utf-8")
    assert set(re.findall(r'<dt>run</dt><dd><a href="../runs/(.*?).html">', page)) == {"new"}


def test_runs_that_show_nothing_or_are_damaged_are_named(pages, runs):
    told = pages["runs.html"].text
    assert "no timed view" in told
    assert f"cannot read {runs}/damaged/plan.json: truncated or no JSON" in told
    assert "elsewhere: cells/" in told


def test_a_page_says_how_to_run_it_again(pages):
    told = pages["surfaces/torus.html"].text
    for part in (
        "git checkout abc1234",
        "firsthit run configs/quick.toml --device opencl:intel",
        "Processor B",
        "2026.2.0_#1",
    ):
        assert part in told


def test_method_pages_have_theory_what_was_tried_and_whether_claims_held(pages):
    told = pages["methods/newton.html"].text
    for part in ("Theory", "a point", "larger steps", "no false hit", "Held on", "EPSILON"):
        assert part in told


def test_the_data_has_every_row_with_its_run_machine_and_commit(site):
    parquet, flat = pd.read_parquet(site / "data" / "results.parquet"), pd.read_csv(site / "data" / "results.csv")
    assert len(parquet) == len(flat) == 3 * 20 - 1
    assert set(parquet["run"]) == {"old", "new", "elsewhere"}
    assert set(parquet["processor"]) == {"Processor A", "Processor B"}
    assert set(flat["commit"]) == {"abc1234"}


def test_rows_that_do_not_agree_with_their_answers_or_their_key_are_named(tmp_path, runs):
    shutil.copytree(runs / "new", tmp_path / "forged")
    files = sorted((tmp_path / "forged" / "cells").iterdir())
    rows = {file: json.loads(file.read_text()) for file in files}
    better = next(f for f, r in rows.items() if r["variant"] == "newton[EPSILON=0.001]")
    rows[better]["accuracy"]["misses"] = 0
    better.write_text(json.dumps(rows[better]))
    other = next(f for f, r in rows.items() if r["variant"] == "ray_march")
    other.write_text(json.dumps(rows[other] | {"identity": IDENTITY | {"formula": "z"}}))
    _, problems = build.build([tmp_path / "forged"], tmp_path / "site")
    assert any("misses 0, and 5 by its stored answers" in told for told in problems)
    assert any(f"{other.stem}.json: its key is not that of its contents" in told for told in problems)
    assert len(pd.read_parquet(tmp_path / "site" / "data" / "results.parquet")) == 19


@pytest.mark.parametrize(
    ("part", "problem"),
    [
        ({"doc": []}, "doc is no object"),
        ({"parameters": [{"name": "A"}]}, "parameters[].default is missing"),
        ({"title": 3}, "title is no text: 3"),
        ({"tables": [{"rows": 1}]}, "tables[].rows is no list: 1"),
        ({"tables": [{"part": "a", "header": ["b"], "rows": [["c", "d"]]}]}, "tables[]: a row is longer or shorter"),
    ],
)
def test_a_plan_whose_methods_are_damaged_is_named(tmp_path, part, problem):
    folder = tmp_path / "mine"
    (folder / "cells").mkdir(parents=True)
    one = timed("newton[EPSILON=1e-06]", "torus", DEVICES[0])
    told = plan([one]) | {"name": "mine", "methods": {"newton": METHODS["newton"] | part}}
    (folder / "plan.json").write_text(json.dumps(told))
    (folder / "cells" / f"{one['key']}.json").write_text(json.dumps(stated(one)))
    with pytest.raises(FirsthitError, match=re.escape(f"mine/plan.json: methods.newton.{problem}")):
        build.build([folder], tmp_path / "site")


def test_nothing_is_written_where_no_run_can_be_read(tmp_path, runs):
    with pytest.raises(FirsthitError, match="no run could be read"):
        build.build([runs / "damaged", tmp_path / "nowhere"], tmp_path / "site")
    assert list(tmp_path.iterdir()) == []


def test_a_site_that_fails_half_way_leaves_the_old_one(tmp_path, runs, monkeypatch):
    (tmp_path / "site").mkdir()
    (tmp_path / "site" / build.MARK).write_text('{"files": ["index.html"]}')
    (tmp_path / "site" / "index.html").write_text("old")
    monkeypatch.setattr(board, "body", lambda _: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        build.build([runs / "new"], tmp_path / "site")
    assert (tmp_path / "site" / "index.html").read_text() == "old"
    assert [path.name for path in tmp_path.iterdir()] == ["site"]


def test_a_folder_that_holds_anything_else_is_refused(tmp_path, runs, site):
    shutil.copytree(site, tmp_path / "site")
    (tmp_path / "site" / "mine.txt").write_text("mine")
    (tmp_path / "file").write_text("")
    for place, told in (("site", "holds mine.txt"), ("file", "no folder")):
        with pytest.raises(FirsthitError, match=told):
            build.build([runs / "new"], tmp_path / place)
    with pytest.raises(FirsthitError, match="lies in the run"):
        build.build([runs / "new"], runs / "new" / "site")
    assert (tmp_path / "site" / "mine.txt").read_text() == "mine"


def test_equal_runs_give_equal_files_in_place_of_the_old_ones(tmp_path, runs):
    told = []
    for _ in range(2):
        build.build([runs / "new"], tmp_path / "site", contact="mailto:us@example.org")
        told.append({p.relative_to(tmp_path): digest(p.read_bytes().hex()) for p in tmp_path.rglob("*") if p.is_file()})
    assert told[0] == told[1]
    assert 'href="mailto:us@example.org"' in (tmp_path / "site" / "submit.html").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def tab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[browser.Browser]:
    with browser.opened(tmp_path_factory.mktemp("profile")) as opened:
        yield opened


@pytest.mark.parametrize("width", [390, 1280])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_no_page_scrolls_sideways(site, tab, width, scheme):
    features = [{"name": "prefers-color-scheme", "value": scheme}]
    tab.call("Emulation.setEmulatedMedia", features=features)
    tab.call("Emulation.setDeviceMetricsOverride", width=width, height=900, deviceScaleFactor=1, mobile=width == 390)
    names = ("index", "surfaces", "methods", "runs", "data", "submit", "surfaces/torus", "methods/newton", "runs/new")
    for name in names:
        tab.open(site / f"{name}.html")
        tab.run("document.querySelectorAll('details').forEach(one => one.open = true)")
        assert tab.run("document.documentElement.scrollWidth") <= width, name
    dark = tab.run("getComputedStyle(document.body).backgroundColor") != "rgb(255, 255, 255)"
    assert dark == (scheme == "dark")
    assert tab.problems == []
    assert all(address.startswith(("file:", "data:")) for address in tab.requests)


_LINES = (
    "[...document.querySelectorAll('#standings tbody tr')].filter(r => !r.hidden)"
    ".map(r => [...r.cells].map(c => c.textContent.trim()))"
)


def test_the_script_counts_as_the_page_was_written(site, tab):
    tab.call("Emulation.setScriptExecutionDisabled", value=True)
    tab.open(site / "index.html")
    tab.call("Emulation.setScriptExecutionDisabled", value=False)
    written_lines = tab.run(_LINES)
    tab.open(site / "index.html")
    assert tab.run(_LINES) == written_lines


def test_choices_filter_the_standings_and_the_winners(site, tab):
    tab.open(site / "index.html")

    def choose(name: str, value: str) -> None:
        tab.run(f"(s => {{ s.value = {value!r}; s.dispatchEvent(new Event('change', {{bubbles: true}})) }})"
                f"(document.querySelector('select[name={name}]'))")  # fmt: skip

    choose("machine", "Processor A")
    assert tab.run(_LINES)[0][:3] == ["Newton", "4", "4 of 4"]
    choose("kind", "Quartics")
    assert tab.run(_LINES)[0][:3] == ["Newton", "2", "2 of 2"]
    assert tab.run("[...document.querySelectorAll('#winners [data-kind]')].filter(s => !s.hidden).length") == 1
    assert tab.run("[...document.querySelectorAll('#classes thead th')].filter(h => !h.hidden).length") == 3
    choose("error", "1e-6")
    assert [line[2] for line in tab.run(_LINES)] == ["2 of 2", "0 of 2", "0 of 2"]
    shown = "[...document.querySelectorAll('.at')].filter(e => e.offsetParent).every(e => e.dataset.level === '1e-6')"
    assert tab.run(shown)
    choose("method", "newton")
    assert len(tab.run(_LINES)) == 1


def test_a_run_that_cannot_be_read_is_told_on_a_quiet_screen_too(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(build, "build", lambda *_: (tmp_path / "index.html", ["cannot read run/plan.json"]))
    assert main(["publish", "run", "-q", "-o", str(tmp_path)]) == 0
    assert "firsthit: cannot read run/plan.json" in capsys.readouterr().err
