"""Figures and tables for papers: which files there are, how large their text is, and that LaTeX can read them."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from harness.cli import main
from harness.commands import experiment
from reports import content, report, wording
from reports.for_papers import column, files, latex
from reports.for_papers.model import Plate, Tabled, distinct, slug
from tests.synthetic_run import arrays, cell, family_cell, stability_run, tiny_run

NEWTON = "newton[EPSILON=0.001]"


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    pytest.importorskip("typst")
    import numpy as np

    folder = tmp_path_factory.mktemp("runs")
    cells = [cell(v, s, "opencl:intel", "float32") for v in ("null", "ray_march", NEWTON) for s in ("torus", "barth")]
    cells += [family_cell(NEWTON, family, "opencl:intel", "float32") for family in ("grazing", "thin_torus")]
    run = tiny_run(folder / "quick", *cells)
    (run / "arrays").mkdir(exist_ok=True)
    for one in cells:
        if one["arrays"]:
            np.savez_compressed(run / one["arrays"], **arrays(one))
    report.build(run, folder / "paper", focus=NEWTON, figures=("svg", "pdf"), tables=files.TABLES)
    return folder / "paper"


def test_each_figure_and_table_is_a_file_named_by_what_it_shows(made: Path) -> None:
    drawn = {f"{name}.{form}" for form in ("svg", "pdf") for name in ("speed-error-torus", "speed-error-barth")}
    drawn |= {f"{name}.{form}" for form in ("svg", "pdf") for name in ("stability", "error-scale")}
    pictures = {f"{what}-{surface}" for surface in ("torus", "barth") for what in ("render", "errors")}
    pictures = {f"render-{s}.png" for s in ("torus", "barth")}
    pictures |= {f"errors-{s}-{m}.png" for s in ("torus", "barth") for m in ("ray-march", "newton-e-0-001")}
    captions = {"captions.md", "captions.tex"}
    assert {path.name for path in (made / "figures").iterdir()} == drawn | pictures | captions
    names = ("results-torus", "results-barth", "winners", "speedups", "stability")
    tabled = {f"{name}{ending}" for name in names for ending in (".tex", ".csv", ".md")}
    assert {path.name for path in (made / "tables").iterdir()} == tabled | captions
    assert {"report.pdf", "report.html", "example.tex"} <= {path.name for path in made.iterdir()}


def test_what_differs_in_a_run_is_in_the_names(tmp_path: Path) -> None:
    both = [cell(NEWTON, "torus", "opencl:intel", p) for p in ("float32", "float64")]
    run = tiny_run(tmp_path / "run", *both)
    told = report.build(run, tmp_path / "made", tables=("csv",)).with_name("tables")
    assert {p.stem for p in told.glob("results-*")} == {"results-torus-float32", "results-torus-float64"}
    assert not (tmp_path / "made" / "figures").exists()


def test_every_file_has_its_caption(made: Path) -> None:
    for folder, forms in (("figures", ("pdf", "png")), ("tables", ("tex",))):
        names = {path.stem for form in forms for path in (made / folder).glob(f"*.{form}")} - {"captions"}
        markdown = (made / folder / "captions.md").read_text()
        assert set(re.findall(r"^## (.+)$", markdown, re.M)) == names
        assert set(re.findall(r"\\label{(?:fig|tab):(.+)}", (made / folder / "captions.tex").read_text())) == names
        assert all(len(text) > 30 for text in re.findall(r"^\*\*.+\*\* (.+)$", markdown, re.M))


def test_figures_are_a_column_wide_and_no_text_is_under_eight_points(made: Path) -> None:
    drawings = sorted((made / "figures").glob("*.svg"))
    assert drawings
    for path in drawings:
        text = path.read_text()
        width = re.search(r'<svg [^>]*?width="([\d.]+)pt"', text)
        assert width and abs(float(width[1]) - 72 * column.WIDTH) < 0.01
        sizes = [float(size) for size in re.findall(r"font: (?:\S+ )*?([\d.]+)px", text)]
        sizes += [float(size) for size in re.findall(r"font-size: ?([\d.]+)px", text)]
        assert sizes and min(sizes) >= column.SIZE == 8.0, path.name
        scaled = re.findall(r"scale\((?!1\b)[^)]*\)", text)
        assert not scaled, "a scaled text would be of another size"
    for path in (made / "figures").glob("*.pdf"):
        box = re.search(rb"/MediaBox \[ ?0 0 ([\d.]+)", path.read_bytes())
        assert box and abs(float(box[1]) - 72 * column.WIDTH) < 0.01
        assert b"/Subtype /Type0" in path.read_bytes(), "its text is text, and its font is in it"


def test_figures_are_the_same_each_time(made: Path, tmp_path: Path) -> None:
    again = report.build(made.with_name("quick"), tmp_path, focus=NEWTON, figures=("svg", "pdf")).with_name("figures")
    for path in again.iterdir():
        assert path.read_bytes() == (made / "figures" / path.name).read_bytes(), path.name


def tabulars(text: str) -> list[tuple[int, list[int]]]:
    """The number of columns of each tabular, and of each of its lines."""
    found = []
    for spec, body in re.findall(r"\\begin{tabular}{(.*?)}\n(.*?)\\end{tabular}", text, re.S):
        kinds = re.sub(r"@{[^}]*}?", "", spec)
        lines = [line for line in body.split("\n") if line.endswith(r"\\")]
        counts = []
        for line in lines:
            spans = [int(span) for span in re.findall(r"\\multicolumn{(\d+)}", line)]
            counts.append(len(re.findall(r"(?<!\\)&", line)) + 1 + sum(spans) - len(spans))
        found.append((len(re.findall("[lrc]", kinds)), counts))
    return found


def balanced(text: str) -> bool:
    plain = re.sub(r"\\[\\{}]", "", text)
    depth = 0
    for character in plain:
        depth += {"{": 1, "}": -1}.get(character, 0)
        if depth < 0:
            return False
    return depth == 0 and plain.count("$") % 2 == plain.count(r"\$") % 2


def test_every_line_of_a_table_has_its_columns_and_every_brace_its_partner(made: Path) -> None:
    paths = [path for path in (made / "tables").glob("*.tex") if path.name != "captions.tex"]
    assert len(paths) == 5
    for path in paths:
        text = path.read_text()
        ((columns, counts),) = tabulars(text)
        assert len(counts) >= 2 and set(counts) == {columns}, path.name
        for rule in (r"\toprule", r"\midrule", r"\bottomrule"):
            assert text.count(rule) == 1
    for path in made.rglob("*.tex"):
        assert balanced(path.read_text()), path
        stray = re.findall(r"(?<![\\{])[#%_](?![^{}]*\.tex})", re.sub(r"^%.*$", "", path.read_text(), flags=re.M))
        assert not [s for s in stray if s != "_"] and "_$" not in path.read_text()
    for path in (made / "example.tex", *made.glob("*/captions.tex")):
        taken = re.findall(r"\\input{(.+?)}", path.read_text())
        shown = re.findall(r"\\includegraphics\[.*?\]{(.+?)}", path.read_text())
        assert taken or shown
        assert all((made / name).is_file() for name in taken)
        assert all((made / f"{name}.pdf").is_file() or (made / f"{name}.png").is_file() for name in shown)
    uses = set(re.findall(r"\\(begin|end){(table\*?|figure|document)}", (made / "example.tex").read_text()))
    assert {kind for _, kind in uses} >= {"figure", "document"}


@pytest.mark.skipif(not any(map(shutil.which, ("tectonic", "pdflatex"))), reason="no LaTeX here")
def test_the_example_compiles(made: Path, tmp_path: Path) -> None:
    engine = "pdflatex" if shutil.which("pdflatex") else "tectonic"
    where = {
        "pdflatex": ["-interaction=nonstopmode", f"-output-directory={tmp_path}"],
        "tectonic": ["-o", str(tmp_path)],
    }
    ran = subprocess.run([engine, *where[engine], "example.tex"], cwd=made, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stdout
    assert (tmp_path / "example.pdf").stat().st_size > 0


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("Barth #6 $extic_* @65 <b>", r"Barth \#6 \$extic\_* @65 \textless{}b\textgreater{}"),
        ("50 % & {x} ~ ^ \\", r"50 \% \& \{x\} \textasciitilde{} \textasciicircum{} \textbackslash{}"),
        ("−8", "$-$8"),
        ("10⁻⁶", "10$^{-6}$"),
        ("ε = 2⁻¹⁸", r"$\varepsilon$ = 2$^{-18}$"),
        ("≈ 20 %", r"$\approx$ 20 \%"),
        ("1.2e−7", r"1.2$\times$10$^{-7}$"),
        ("512 × 512", r"512 $\times$ 512"),
        ("–", "--"),
        ("two\nlines", "two lines"),
        ("Käfer", "Käfer"),
    ],
)
def test_what_latex_would_read_as_a_command_is_escaped(text: str, expected: str) -> None:
    assert latex.escaped(text) == expected
    assert balanced(expected)


@pytest.mark.parametrize(
    ("show", "value", "parts"),
    [
        (wording.number, 0.0123, ("0", ".0123")),
        (wording.number, 1234.0, ("1,234", "")),
        (wording.factor, 7.04, ("7", r".04$\times$")),
        (wording.error, 1.2e-7, ("1", r".2$\times$10$^{-7}$")),
        (wording.whole_percentage, -0.08, ("$-$8", r" \%")),
        (wording.number, None, ("--", "")),
        (wording.text, "4/7", ("4", "/7")),
    ],
)
def test_numbers_stand_with_their_points_below_each_other(show, value, parts) -> None:
    assert latex.aligned(show(value)) == parts


def test_shared_headings_span_their_columns_and_a_bracket_opens_no_option() -> None:
    number = {"show": wording.number, "numeric": True}
    columns = (content.Column("a"), content.Column("b", over="x", **number), content.Column("c", over="x", **number))
    tabled = Tabled("t", content.Table(columns, [("[1]", 1.0, 2.5), ("*", 10.0, None)], "T."), frozenset([1]))
    text = latex.table(tabled)
    assert r" & \multicolumn{4}{c}{x} \\" in text and r"\cmidrule(lr){2-5}" in text
    assert "\n{}[1] & 1 & .00 & 2 & .50 \\\\\n" in text
    assert r"\textbf{\boldmath 10} & \textbf{\boldmath .0} & \textbf{\boldmath --}" in text
    assert tabulars(text) == [(5, [5, 5, 5, 5])]
    assert files._markdown(tabled).splitlines()[-1] == "| **\\*** | **10.0** | **–** |"
    assert files._csv(tabled) == "a,x b,x c\n[1],1.0,2.5\n*,10.0,\n"
    titled = Tabled("t", content.Table((content.Column("=a"),), [("b",)], "T."), frozenset())
    assert files._csv(titled) == "'=a\nb\n", "a heading may be a text of a config, too"


def test_the_focus_is_in_bold(made: Path) -> None:
    text = (made / "tables" / "results-torus.tex").read_text()
    assert re.search(r"\\textbf{\\boldmath Newton, \$\\varepsilon\$ = 0\.001} &", text)
    assert r"\boldmath Ray march" not in text


def test_different_things_of_one_name_have_names_of_their_own() -> None:
    assert slug("Newton, ε = 2⁻¹⁸") == "newton-e-2-18" and slug("§§") == "unnamed"
    plates = [Plate("a", "one", ""), Plate("a", "two", ""), Plate("b", "three", "")]
    named = [plate.name for plate in distinct(plates, ["one", "two", "three"])]
    assert len(set(named)) == 3 and named[2] == "b" and all(name.startswith("a-") for name in named[:2])
    assert [plate.name for plate in distinct(plates[::-1], ["three", "two", "one"])][::-1] == named, "in any order"


def test_an_unknown_form_is_refused_with_the_known_ones(tmp_path: Path, capsys) -> None:
    assert (experiment.FIGURES, experiment.TABLES) == (files.FIGURES, files.TABLES)
    for option, form, known in (("--figures", "eps", "svg, pdf, png"), ("--tables", "html", "latex, csv, markdown")):
        with pytest.raises(SystemExit) as raised:
            main(["report", str(tmp_path), option, f"{known.split(',')[0]},{form}"])
        assert raised.value.code == 2
        assert f"unknown form '{form}'; known: {known}" in capsys.readouterr().err
    assert main(["report", "a", "b", "--figures", "svg"]) == 2
    assert "--figures goes with one run" in capsys.readouterr().err


def test_no_figure_is_replaced_before_all_are_complete(tmp_path: Path, monkeypatch) -> None:
    pytest.importorskip("typst")
    run = stability_run(tmp_path / "run")
    (tmp_path / "made" / "figures").mkdir(parents=True)
    (tmp_path / "made" / "figures" / "stability-float32.svg").write_text("old")
    before = {path: path.is_file() and path.read_bytes() for path in tmp_path.rglob("*")}

    def fail(*_: object) -> None:
        raise RuntimeError("no table")

    monkeypatch.setattr("reports.for_papers.files.write_tables", fail)
    with pytest.raises(RuntimeError, match="no table"):
        report.build(run, tmp_path / "made", figures=("svg",), tables=("csv",))
    after = {path: path.is_file() and path.read_bytes() for path in tmp_path.rglob("*")}
    assert {path: text for path, text in after.items() if path.name != "tables"} == before
