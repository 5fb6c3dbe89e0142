"""Test the first page, the winners and the page of a focus: what they say, and that the first page is one page."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pandas as pd
import pytest
import typst

from harness.contract import digest
from reports import content, first_page
from reports.analysis import breaks, choices, derive, tradeoffs
from reports.drawing import cards, multiples, placing, standings, style
from reports.material import Material
from reports.parts import focus, winners
from reports.reading import load
from reports.reading.arrays import Shelf
from reports.rendering import document
from reports.sentences import answer
from tests.synthetic_run import SURFACES, cell, printed, retime, sampled, stability_run, tiny_run, write_run


def timed(
    method: str, surface: str, ms: float, error: float = 1e-5, misses: int = 0, device: str = "opencl:intel"
) -> dict[str, Any]:
    made = cell("ray_march", "torus", device, "float32")
    slot = f"{method} {surface} {device}"
    made |= {"slot": slot, "key": digest(slot), "variant": method, "method": method.partition("[")[0], "arrays": None}
    made |= {"surface": surface, "surface_title": SURFACES.get(surface, (surface.title(),))[0]}
    made["comparison"] = f"{surface} front 256x256x1 compute"
    made["accuracy"] |= {"relative_error": {"max": error}, "error": {"max": error}, "misses": misses}
    made["accuracy"] |= dict.fromkeys(("false_hits", "exhausted", "wrong_root"), 0)
    made["accuracy"] |= {name: 0 for name in made["accuracy"] if name.startswith(("grazing_", "drowned_"))}
    made["accuracy"]["grazing_margin"] = 0.001
    return retime(made, ms)


def chosen(folder: Path, *cells: dict[str, Any]) -> list[choices.Choice]:
    return choices.choices(derive.derive(load.load(tiny_run(folder, *cells)).frame))


def about(folder: Path, name: str = "") -> content.Document:
    """Make the first page, the page of a focus and the winners alone: other parts take longer than all three."""
    run = load.load(folder)
    frame, rungs = derive.derive(run.frame), breaks.derive(run.families, run.rungs)
    material = Material(run, frame, rungs, Shelf(run.folders), name)
    sections = (*focus.sections(material), *winners.sections(material))
    return content.Document(run.plan.title, "", first_page.section(material), sections)


# ---- the answer


def test_the_first_page_says_what_a_winner_costs_and_risks(tmp_path: Path) -> None:
    cells = [timed("ray_march", "torus", 40.0), timed("newton", "torus", 2.0, 1e-4), timed("sturm", "torus", 9.0, 1e-7)]
    cells += [timed("lucky", "torus", 0.5, misses=7)]
    folder = tiny_run(tmp_path / "run", *cells)
    plan = json.loads((folder / "plan.json").read_text())
    (folder / "plan.json").write_text(json.dumps(plan | {"methods": {"newton": {"claims": ["no_false_hit"]}}}))
    made = about(folder)
    told = printed(made.summary.blocks)
    assert (
        "On opencl:intel, for 256 × 256 pixels, the fastest right answers come from Newton on Torus (2.00 ms)." in told
    )
    assert "20.0× as fast as Ray march." in told
    assert "Largest errors are within 10⁻³ of the scene's radius. 10⁻⁶ is reached by Sturm on Torus (9.00 ms)." in told
    assert "Of 2,304 rays checked on each surface, none is wrong, grazing ones included." in told
    assert "Newton promises to give no false hit." in told
    assert "Lucky on Torus (4.00× as fast, 7 wrong rays)." in told
    assert "4 cells: 4 ok." in told
    assert "certified in ball arithmetic" in told


def test_grazing_rays_and_methods_that_promise_nothing_are_named(tmp_path: Path) -> None:
    made = timed("newton", "torus", 2.0)
    made["accuracy"]["grazing_misses"] = 3
    told = answer.risk(chosen(tmp_path / "run", made, timed("sturm", "torus", 4.0)), {"newton": {"claims": []}})
    assert "none is wrong, but for 3 that graze a silhouette or drown in rounding." in told
    assert "Newton promises nothing beyond the rays checked." in told


def test_a_surface_on_which_all_are_wrong_is_said_with_the_fewest(tmp_path: Path) -> None:
    cells = [timed("newton", "torus", 2.0, misses=9), timed("sturm", "torus", 4.0, misses=2)]
    (one,) = chosen(tmp_path / "run", *cells)
    assert one.best is None and one.pictured.variant == "sturm"
    told = answer.risk([one], {})
    assert "On Torus every variant answers some rays wrongly; fewest: Sturm 2 of 2,304." in told


def test_many_surfaces_are_counted(tmp_path: Path) -> None:
    cells = []
    for i in range(12):
        cells += [timed("newton", f"s{i}", 1.0 + i), timed("sturm", f"s{i}", 3.0 if i < 9 else 0.5)]
    lead = answer.lead(chosen(tmp_path / "run", *cells))
    assert "of 12 surfaces, the fastest right answers come from Sturm on" in lead or "come from Newton on" in lead
    assert lead.count("S1") == 0


@pytest.mark.parametrize(("times", "tied"), [((300.0, 310.0, 320.0), False), ((15.0, 16.0, 17.0), True)])
def test_too_few_rounds_tell_only_times_that_are_far_apart(
    tmp_path: Path, times: tuple[float, ...], tied: bool
) -> None:
    fast = sampled(timed("newton", "torus", 2.0), [9.0, 10.0, 11.0] * 4)
    (one,) = chosen(tmp_path / "run", fast, sampled(timed("slow", "torus", 2.0), list(times)))
    assert one.best.variant == "newton"
    assert one.tied[0] == (("Slow",) if tied else ())
    assert ("or Slow" in answer.lead([one])) is tied


def test_where_nothing_is_exact_the_fastest_right_row_stands_for_the_surface(tmp_path: Path) -> None:
    cells = [timed("newton", "torus", 2.0, 5e-3), timed("march", "torus", 9.0, 2e-3)]
    (one,) = chosen(tmp_path / "run", *cells)
    assert one.within == (None, None) and one.best.variant == "newton" and one.nearest.variant == "march"
    assert "no right answer is within 10⁻³ of the scene's radius" in answer.lead([one])


def test_what_is_fast_and_inexact_is_no_tie_of_the_winner(tmp_path: Path) -> None:
    cells = [timed("newton", "torus", 2.0, 1e-4), timed("coarse", "torus", 0.5, 5e-3)]
    (one,) = chosen(tmp_path / "run", *cells)
    squares = {label: own[0].text for label, own in standings.matrix([one]).rows}
    assert squares == {"Newton": "2.00 ms", "Coarse": "0.250×, error 5.0e−3"}


def test_a_surface_that_no_ray_hits_has_a_winner(tmp_path: Path) -> None:
    cells = [timed("newton", "torus", 2.0), timed("march", "torus", 9.0)]
    for made in cells:
        made["accuracy"] |= {"error": {"max": None}, "relative_error": {"max": None}}
        made["accuracy"] |= {"truth_hits": 0, "truth_misses": made["accuracy"]["rays"]}
    found = chosen(tmp_path / "run", *cells)
    assert found[0].best.variant == "newton"
    assert "come from Newton on Torus (2.00 ms)" in answer.lead(found)
    assert "every variant answers some rays wrongly" not in answer.risk(found, {})
    assert answer.focus(found, "newton", "newton") == "Newton is the fastest right answer on Torus."


def test_ties_in_another_precision_name_it(tmp_path: Path) -> None:
    cells = [timed("newton", "torus", 2.0), timed("sturm", "torus", 3.0), timed("bernstein", "torus", 2.0)]
    cells[2]["precision"] = "float64"
    (one,) = chosen(tmp_path / "run", *cells)
    assert {one.best.label, *one.tied[0]} in ({"Newton", "Bernstein, float64"}, {"Bernstein", "Newton"})


def test_a_card_compares_like_with_like(tmp_path: Path) -> None:
    made = timed("newton", "torus", 2.0, 8e-7)
    made["accuracy"]["error"] = {"max": 1.6e-6}
    (one,) = chosen(tmp_path / "run", made)
    assert cards.winners(one.rows, one)[-1] == ("10⁻⁶", "Newton", "2.00", "8.0e−7"), "an error over the radius"


def test_a_focus_with_wrong_rays_beats_no_right_method(tmp_path: Path) -> None:
    folder = tiny_run(tmp_path / "run", timed("mine", "torus", 1.0, misses=5), timed("sturm", "torus", 9.0))
    page = about(folder, "mine").sections[0]
    told = printed(page.blocks)
    assert "right is Sturm" in told
    ((_, squares),) = next(block for block in page.blocks if isinstance(block, content.Matrix)).rows
    assert [(square.text, square.color) for square in squares] == [("9.00×", "")]


# ---- trade-offs


def test_trade_offs_are_faster_and_wrong_or_slower_and_more_exact(tmp_path: Path) -> None:
    cells = [timed("newton", "torus", 2.0, 1e-4), timed("quick", "torus", 1.0, misses=40)]
    cells += [timed("quickest", "torus", 0.5, misses=80), timed("same", "torus", 1.5, misses=39)]
    cells += [
        timed("sturm", "torus", 8.0, 1e-6),
        timed("march", "torus", 90.0, 0.9e-6),
        timed("slow", "torus", 9.0, 1e-5),
    ]
    (one,) = chosen(tmp_path / "run", *cells)
    assert [trade.row.variant for trade in tradeoffs.faster(one)] == ["quickest", "quick"]
    assert [trade.times for trade in tradeoffs.faster(one)] == pytest.approx([0.25, 0.5], rel=0.05)
    assert [trade.row.variant for trade in tradeoffs.exacter(one)] == ["sturm"], "nothing slower that is not exacter"
    made = about(tmp_path / "run")
    told = next(printed(section.blocks) for section in made.sections if section.title == "Winners")
    assert "Torus | Newton, 2.00 ms | Quickest | 4.00× as fast | 80 wrong rays of 2,304" in told
    assert "Sturm | error 100× smaller | 4.00× the time" in told


# ---- winners


def test_the_winners_matrix_names_method_and_time_and_notes_ties(tmp_path: Path) -> None:
    cells = [
        timed(m, "torus", ms, device=d)
        for d, m, ms in (
            ("opencl:intel", "newton", 2.0),
            ("opencl:intel", "sturm", 4.0),
            ("opencl:intel", "yuksel", 8.0),
            ("opencl:pocl", "newton", 9.0),
            ("opencl:pocl", "sturm", 3.0),
        )
    ]
    cells.append(timed("newton", "sphere", 1.0, misses=5))
    made = about(tiny_run(tmp_path / "run", *cells))
    section = next(section for section in made.sections if section.title == "Winners")
    matrix = next(block for block in section.blocks if isinstance(block, content.Matrix))
    assert matrix.columns == ("opencl:intel", "opencl:pocl\n2 of 3 methods")
    rows = {heading: squares for heading, squares in matrix.rows}
    assert [square.text for square in rows["Torus"]] == ["Newton\n2.00", "Sturm\n3.00"]
    assert rows["Torus"][0].color == style.pale(style.marks(["newton"])["newton"].color, 0.68)
    assert [square.text for square in rows["Sphere"]] == ["all wrong\nsomewhere", "–"]
    told = printed(section.blocks)
    assert "opencl:pocl | 2 | 2.63× | 0.751× | 4.51× | Sturm on Torus; Newton on Torus" in told


# ---- focus


def test_a_focus_has_the_page_behind_the_first_with_wins_ties_and_losses(tmp_path: Path) -> None:
    cells = [timed("ray_march", surface, 40.0) for surface in ("torus", "sphere", "barth")]
    cells += [timed("mine", "torus", 1.0), timed("mine", "sphere", 4.0), timed("mine", "barth", 1.0, misses=3)]
    cells += [timed("newton", surface, 2.0) for surface in ("torus", "sphere", "barth")]
    folder = tiny_run(tmp_path / "run", *cells)
    made = about(folder, "mine")
    assert made.sections[0].title == "Mine against the others" and made.sections[0].own_page
    told = printed(made.summary.blocks)
    assert "Mine is the fastest right answer on Torus; it is beaten by Newton on Sphere; it answers some rays" in told
    page = made.sections[0]
    matrix = next(block for block in page.blocks if isinstance(block, content.Matrix))
    squares = {heading: dict(zip(matrix.columns, own, strict=True)) for heading, own in matrix.rows}
    assert squares["Torus"]["Newton"].text == "2.00×" and squares["Sphere"]["Newton"].text == "0.500×"
    assert squares["Torus"]["Newton"].color != squares["Sphere"]["Newton"].color
    assert any(heading.endswith("(3 wrong)") for heading in squares)
    table = printed(page.blocks)
    assert "Mine beside Ray march, and what beats it." in table
    assert "40.0× | nothing" in table and "10.0× | Newton 2.00×" in table
    assert not any("against the others" in section.title for section in about(folder, "").sections)


def test_a_focus_may_be_a_variant_and_its_method_is_the_strongest(tmp_path: Path) -> None:
    cells = [timed("newton[A=1]", "torus", 2.0), timed("newton[A=2]", "torus", 3.0), timed("sturm", "torus", 5.0)]
    made = about(tiny_run(tmp_path / "run", *cells), "newton[A=2]")
    assert "Newton, a = 2 is beaten by Newton (a = 1) on Torus." in printed(made.summary.blocks)
    assert focus.ORDER < 10
    marks = style.marks(["newton", "sturm"], "newton")
    assert marks["newton"] == style.marks(["newton"])["newton"]
    assert marks["sturm"].marker == style.marks(["sturm"])["sturm"].marker
    assert marks["sturm"].color != style.marks(["sturm"])["sturm"].color


# ---- marks


def test_no_two_of_the_suite_and_sixty_plugins_share_a_mark() -> None:
    plugins = [f"plugin_{i}" for i in range(60)]
    names = [*style._HOUSE, *plugins]
    for of in (style.marks(names), style.marks(names, "plugin_3")):
        assert len({(mark.color, mark.marker) for mark in of.values()}) == len(names)
    assert style.marks(names) == style.marks(reversed(names))


def test_a_plugin_keeps_its_mark_beside_others() -> None:
    alone = style.marks(["mine"])["mine"]
    kept = [style.marks(["mine", f"other_{i}"])["mine"] == alone for i in range(40)]
    assert sum(kept) >= 38, "but for the rare name that asks for the same mark"
    assert style.marks(["mine", "newton", "sturm"])["mine"] == alone


# ---- small multiples


def test_every_method_is_named_beside_a_mark_or_in_the_key(tmp_path: Path) -> None:
    names = ["newton", "sturm", "yuksel", "eft_yuksel", "ray_march", "bernstein", "lu_lipschitz", "analytic"]
    cells = [timed(name, "torus", 1.0 + 0.1 * i, 1e-5 * (1 + i)) for i, name in enumerate(names)]
    found = chosen(tmp_path / "run", *cells)
    made = multiples.figure(found, style.marks(names), 3.0)
    assert made is not None and made == multiples.figure(found, style.marks(names), 3.0)
    for row in found[0].rows.itertuples():
        assert f">{row.method_label}<" in made.svg
    assert "Newton in 1.00 ms" in made.description


def test_long_times_have_room_beside_the_name_of_their_axis() -> None:
    short, long = (multiples._left(pd.Series([1.0, longest])) for longest in (20.0, 11_000.0))
    wider = placing.text_size("10,000", multiples.TEXT)[0] - placing.text_size("20", multiples.TEXT)[0]
    assert long - short == pytest.approx(wider / 72)


def test_one_row_alone_has_no_plot(tmp_path: Path) -> None:
    found = chosen(tmp_path / "run", timed("newton", "torus", 1.0))
    assert multiples.figure(found, style.marks(["newton"]), 3.0) is None
    assert answer.lead(found).endswith("nothing is compared: Newton takes 1.00 ms.")


# ---- other runs


def test_a_run_that_timed_nothing_opens_with_who_is_right(tmp_path: Path) -> None:
    cells = [timed("newton", "torus", 1.0, misses=3), timed("sturm", "torus", 1.0)]
    made = about(tiny_run(tmp_path / "run", *(one | {"time": None} for one in cells)))
    told = printed(made.summary.blocks)
    assert told.startswith("Right on every ray away from silhouettes: Sturm. The others answer some wrongly.")
    assert "Newton | float32 | 0 | 1 | 3 | 2,304" in told
    assert "Newton | 3 wrong" in told and "Sturm | right" in told


def test_runs_of_hard_rays_and_of_the_harness_alone_have_a_first_page(tmp_path: Path) -> None:
    made = about(stability_run(tmp_path / "stability"))
    assert made.summary.blocks[0].strong and any(isinstance(b, content.Table) for b in made.summary.blocks)
    null = cell("null", "torus", "opencl:intel", "float32")
    made = about(tiny_run(tmp_path / "null", null))
    assert printed(made.summary.blocks).startswith("This run has the harness alone: a method that answers nothing.")


@pytest.mark.parametrize("surfaces", [1, 8, 12])
def test_the_first_page_is_one_page(tmp_path: Path, surfaces: int) -> None:
    methods = ("newton", "sturm", "yuksel", "eft_yuksel", "ray_march")
    cells = [timed(m, f"surface_{i}", 1.0 + k + i % 3) for i in range(surfaces) for k, m in enumerate(methods)]
    made = about(tiny_run(tmp_path / "run", *cells))
    bare = tuple(content.Section(f"A section of {word}", (content.Text("…"),)) for word in "abcdefghijklmnopqrst")
    made = content.Document(made.title, made.subtitle, made.summary, bare)  # contents are as long as they are
    document.write_pdf(made, tmp_path / "pdf", tmp_path / "report.pdf", "2026-01-01")
    (end,) = json.loads(
        typst.query(tmp_path / "pdf" / "report.typ", "<first-page>", **document._settings(tmp_path / "pdf"))
    )
    assert end["value"] == 1


def test_pictures_of_the_first_page_are_of_the_winners(tmp_path: Path) -> None:
    made = about(write_run(tmp_path / "run"))
    (strip,) = [block for block in made.summary.blocks if isinstance(block, content.Gallery)]
    assert strip.across == len(strip.panels) == 3
    assert all("ms\nerror" in panel.note for panel in strip.panels)


def test_a_focus_that_is_fast_and_inexact_is_not_called_beaten(tmp_path: Path) -> None:
    cells = [timed("newton", "torus", 2.0, 1e-4), timed("coarse", "torus", 0.5, 5e-3)]
    found = chosen(tmp_path / "run", *cells)
    assert answer.focus(found, "coarse", "coarse") == "Coarse errs by more than 10⁻³ of the scene's radius on Torus."
