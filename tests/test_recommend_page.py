"""What `firsthit recommend` prints, the object for scripts, and the page to pass on: they say the same."""

import re
import shlex
import shutil
import subprocess

import pytest
from jsonschema import Draft202012Validator

from harness.cli import main
from harness.commands import recommend as command
from harness.commands.answers.table import answer_schema
from harness.plugins import Catalog, find_methods
from harness.recommend import search

from .conftest import usable_devices
from .test_machine import answered

pytestmark = pytest.mark.usefixtures("devices_found_once")
FORMULA = "x^2 + 2*y^2 + z^2 - a"
SMALL = ("--size", "32", "--rays", "16", "--views", "1", "--seconds", "0.01", "--precision", "float32")
METHODS = ("newton", "interval_march", "sphere_tracing")


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """The folder of all searches here, in which each finds the rows of those before."""
    return tmp_path_factory.mktemp("runs")


@pytest.fixture
def asked(runs, monkeypatch):
    """The words of a search that is small, among three methods."""
    if not usable_devices():
        pytest.skip("no device")
    plugins = find_methods().plugins
    catalog = Catalog({name: plugins[name] for name in METHODS})
    monkeypatch.setattr(command, "methods_of", lambda _: catalog)
    monkeypatch.setattr(search, "PICTURE_RAYS", 32)
    words = ["--formula", FORMULA, "--parameter", "a=0.9", "--device", usable_devices()[0].name]
    return ["recommend", *words, *SMALL, "--runs", str(runs)]


def test_answer_object_and_page_say_the_same(asked, runs, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("surfaces.proofs.extent.remark", lambda _: "formula: its domain cuts the surface")
    page = tmp_path / "page.html"
    value, _ = answered(capsys, *asked, "--error", "1e-3", "-o", str(page))
    Draft202012Validator(answer_schema("recommend")).validate(value)
    best = value["recommended"]
    assert best == value["contenders"][0] and best["error"] <= value["rule"]["allowed"] == 5e-4
    assert value["rule"]["factor"] == 2.0 and "A factor of 2" in value["rule"]["text"]
    assert value["asked"]["surface"]["parameters"] == {"a": "0.9"} and value["page"] == str(page)
    assert {one["method"] for one in value["methods"]} == set(METHODS), "a sentence for each method"
    assert all(one["sentence"].startswith(one["method"]) for one in value["methods"])
    assert next(one for one in value["fallen"] if one["method"] == "sphere_tracing")["cause"] == "refused"
    assert value["guarantee"].startswith("No guarantee" if best["method"] == "newton" else "interval_march claims")

    assert main([*asked, "--error", "1e-3", "-o", str(page)]) == 0
    printed = " ".join(capsys.readouterr().out.split())
    text = " ".join(re.sub(r"<[^>]+>", " ", page.read_text()).split())
    for other in (printed, text.replace("&#x27;", "'").replace("&quot;", '"').replace("&lt;", "<")):
        for told in (value["question"], value["answer"], value["remark"], value["again"], value["ship"]):
            assert " ".join(told.split()) in other
        assert value["guarantee"] in other and value["rule"]["text"] in other
        for one in value["methods"]:
            assert one["sentence"].removeprefix(one["method"]).strip() in other
    assert len(re.findall('<img alt="[^"]*"[^>]* src="data:image/webp', page.read_text())) == 2

    again = shlex.split(value["again"])
    assert again[:2] == ["firsthit", "recommend"]
    assert main([*again[1:], "--runs", str(runs)]) == 0
    assert value["answer"] in " ".join(capsys.readouterr().out.split()), "the same rows are found again"
    made = shlex.split(value["ship"].replace("DIR", str(tmp_path / "made")))
    assert main(made[1:]) == 0
    (program,) = (tmp_path / "made").glob("program.*")
    for name, number in best["knobs"].items():
        assert f"{name} = {number:.9g}" in " ".join(program.read_text().replace("//", "").split())


def test_a_page_is_one_page(asked, tmp_path, capsys):
    for ending, begins in (("pdf", b"%PDF-"), ("png", b"\x89PNG")):
        page = tmp_path / f"page.{ending}"
        assert main([*asked, "--error", "1e-3", "-o", str(page)]) == 0
        assert f"page       {page}" in capsys.readouterr().out
        assert page.read_bytes().startswith(begins)
    if shutil.which("pdftotext"):
        command = ["pdftotext", "-layout", tmp_path / "page.pdf", "-"]
        ran = subprocess.run(command, capture_output=True, text=True, check=True)
        assert ran.stdout.count("\f") == 1 and "Which method draws" in ran.stdout


def test_where_nothing_holds_page_and_object_say_so_too(asked, tmp_path, capsys):
    page = tmp_path / "page.html"
    value, _ = answered(capsys, *asked, "--error", "1e-12", "-o", str(page), code=1)
    Draft202012Validator(answer_schema("recommend")).validate(value)
    assert value["recommended"] is None and value["ship"] is None and not value["contenders"]
    assert {one["cause"] for one in value["fallen"]} >= {"error", "refused"}
    assert "No method draws" in value["answer"] and "No method draws" in page.read_text()
    assert "data:image/png" not in page.read_text()
    assert main([*asked, "--error", "1e-12"]) == 1
    assert "ship " not in capsys.readouterr().out


def test_a_required_claim_is_asked_again_and_a_quantile_has_no_factor(asked, capsys):
    value, _ = answered(
        capsys,
        *asked,
        "--error",
        "1e-3",
        "--require",
        "no_missed_root",
        "--quantile",
        "p99",
        "--require",
        "no_missed_root",
    )
    assert value["asked"]["require"] == ["no_missed_root"] and "--require no_missed_root" in value["again"]
    assert {one["method"] for one in value["contenders"]} == {"interval_march"}
    assert value["rule"]["factor"] == 1.0 and "No factor of safety" in value["rule"]["text"]
    assert {one["cause"] for one in value["fallen"] if one["method"] != "interval_march"} == {"claim"}
