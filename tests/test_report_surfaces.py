"""The surfaces' pages of a report: pictures, maps with what breaks enlarged, plots with names, and the atlas."""

from __future__ import annotations

import dataclasses
import io
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from PIL import Image

from reports import content, wording
from reports.analysis import breaks, choices, derive, shown
from reports.drawing import cards, error_maps, images, insets, style
from reports.material import Material
from reports.parts import surface_pages
from reports.reading import load
from reports.reading.arrays import Arrays, Shelf
from tests.synthetic_run import printed, write_run

SIDE = 64


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_run(tmp_path_factory.mktemp("runs") / "quick")


@pytest.fixture
def material(folder: Path) -> Material:
    run = load.load(folder)
    return Material(run, derive.derive(run.frame), breaks.derive(run.families, run.rungs), Shelf(run.folders))


def disc(**changed: Any) -> Arrays:
    """Make up the arrays of a method that hits a disc of half the width rightly, with an error of 1e-7."""
    y, x = np.mgrid[:SIDE, :SIDE] - (SIDE - 1) / 2
    hit = np.hypot(x, y) < SIDE / 4
    shade = np.where(hit, 0.5, np.nan).astype(np.float32)
    error = np.where(hit, 1e-7, np.nan).astype(np.float32)
    none = np.zeros((SIDE, SIDE), np.uint8)
    made = Arrays(hit.astype(np.uint8), error, none, none.astype(bool), shade)
    return dataclasses.replace(made, **changed)


def pixels(png: bytes) -> np.ndarray:
    return np.asarray(Image.open(io.BytesIO(png)).convert("RGB"))


def galleries(blocks: tuple[content.Block, ...]) -> list[content.Gallery]:
    return [block for block in blocks if isinstance(block, content.Gallery)]


# ---- pictures


def test_a_picture_is_stored_as_it_is_whether_with_a_palette_or_without() -> None:
    few = np.zeros((50, 40, 3))
    few[::2, :, 0] = 1.0
    many = np.random.default_rng(1).random((50, 40, 3))
    for image, mode in ((few, "P"), (many, "RGB")):
        png = images.png(image)
        times = -(-images.PIXELS // 50)
        assert Image.open(io.BytesIO(png)).mode == mode
        assert np.array_equal(pixels(png), images.repeated(np.round(255 * image).astype(np.uint8), times))


def test_a_hero_is_smooth_and_keeps_outline_and_colours() -> None:
    image = images.hero(disc(), 4 * SIDE)
    assert image.shape == (4 * SIDE, 4 * SIDE, 3)
    assert np.allclose(image[0, 0], 1.0), "white paper"
    lit = (np.array(images._rgb(style.SURFACE_SHADOW)) + images._rgb(style.SURFACE_LIGHT)) / 2
    assert np.abs(image[2 * SIDE, 2 * SIDE] - lit).max() < 0.01
    covered = (image[..., 0] < 1.0 - 0.5 * (1.0 - lit[0])).mean()
    assert covered == pytest.approx(np.pi / 16, rel=0.06)
    assert len(np.unique(images.png(image))) and Image.open(io.BytesIO(images.png(image))).mode == "P"


@pytest.mark.parametrize("times", [1.0, 1.5, 3.0])
def test_the_background_of_a_hero_is_white_however_little_it_is_enlarged(times: float) -> None:
    image = images.hero(disc(), round(times * SIDE))
    assert image[0, 0].tolist() == [1.0, 1.0, 1.0]


def test_what_is_empty_is_cut_off_alike_in_every_array() -> None:
    samples = np.arange(4 * SIDE * SIDE, dtype=np.float32).reshape(2 * SIDE, 2 * SIDE)
    arrays = disc(samples=samples, condition=np.ones((SIDE, SIDE), np.float32))
    down, across = images.outline([arrays])
    kept = arrays.cropped(down, across)
    assert (arrays.truth > 0).sum() == (kept.truth > 0).sum() and kept.truth.shape < arrays.truth.shape
    assert kept.condition is not None and kept.condition.shape == kept.error.shape == kept.truth.shape
    assert kept.samples is not None and kept.samples[0, 0] == samples[2 * down.start, 2 * across.start]
    assert kept.samples.shape == tuple(2 * side for side in kept.truth.shape)


# ---- where a method breaks


def test_the_window_is_where_most_rays_are_wrong_and_there_is_none_where_all_are_right() -> None:
    assert insets.worst_window(disc(), 1e-3) is None
    wrong = np.zeros((SIDE, SIDE), np.uint8)
    wrong[5, 50] = 1
    wrong[40:43, 20:23] = 2
    found = insets.worst_window(disc(wrong=wrong), 1e-3)
    assert found is not None
    assert found.top <= 40 and found.top + found.side >= 43 and found.left <= 20 and found.left + found.side >= 23
    apart = np.ones((SIDE, SIDE), np.bool_)
    assert insets.worst_window(disc(wrong=wrong, grazing=apart), 1e-3) is None, "grazing rays are counted apart"
    error = disc().error.copy()
    error[30, 33] = 0.01
    largest = insets.worst_window(disc(error=error), 1e-3)
    assert largest is not None and 0 <= 30 - largest.top < largest.side and 0 <= 33 - largest.left < largest.side
    assert insets.worst_window(disc(error=error), 0.1) is None


def test_a_frame_shows_the_window_larger_in_a_corner_that_hides_little() -> None:
    wrong = np.zeros((SIDE, SIDE), np.uint8)
    wrong[40:43, 20:23] = 2
    arrays = disc(wrong=wrong)
    window = insets.worst_window(arrays, 1e-3)
    assert window is not None
    image = images.error_map(arrays, (-8, -2))
    made = insets.framed(image, arrays, window)
    times = insets.PIXELS // SIDE
    assert made.shape == (times * SIDE, times * SIDE, 3)
    false_hit = np.abs(made - np.array(images._rgb(style.WRONG[1].color))).max(axis=2) < 0.01
    assert false_hit.sum() > 4 * 9 * times**2, "the wrong rays are there, and again much larger"
    middle = made[times * SIDE // 2, times * SIDE // 2]
    assert np.allclose(middle, image[SIDE // 2, SIDE // 2], atol=0.01), "what is seen of the surface is not hidden"


def test_maps_are_in_order_of_speed_and_tell_wrong_rays_by_kind(material: Material) -> None:
    rows = material.listed[material.listed["surface"] == "torus"]
    picked = shown.in_strip(rows)
    assert picked.groupby("precision")["median_ms"].apply(lambda ms: ms.is_monotonic_increasing).all()
    cells = [(row, read) for row in picked.itertuples() if (read := material.shelf.get(row)) is not None]
    gallery = error_maps.strip(None, cells, material.error_scale)
    assert len(gallery.panels) == len(cells) > 3 and not gallery.hero
    for panel, (row, _) in zip(gallery.panels, cells, strict=True):
        assert str(row.label) in panel.title and "ms" in panel.note
        told = {kind.color: getattr(row, name) for kind, name in zip(style.WRONG, error_maps.KINDS, strict=True)}
        for color, text in panel.key.items():
            assert text.startswith(f"{told[color]:,} ")
        assert set(panel.key) == {color for color, n in told.items() if not pd.isna(n) and n > 0}


# ---- plots, and the atlas


def test_every_variant_is_named_beside_its_mark_and_wrong_ones_say_how_wrong(material: Material) -> None:
    sections = {section.title: section for section in surface_pages.sections(material)}
    rows = shown.on_pages(material.listed[material.listed["surface"] == "torus"])
    (figure,) = [b for b in sections["Torus: speed against error"].blocks if isinstance(b, content.Figure)]
    drawn = derive.contenders(rows)
    for row in drawn[drawn["error_max"].notna()].itertuples():
        name = wording.excerpt(row.label, 32)
        told = f">{name}<" if row.wrong_rays == 0 else f">{name}: {row.wrong_rays:,} wrong<"
        assert told in figure.svg
    width = float(figure.svg.partition('width="')[2].partition("pt")[0])
    assert width <= 178 / 25.4 * 72 + 1, "as wide as the page's text"


def test_a_run_of_many_surfaces_has_an_atlas(material: Material, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(shown, "SPREADS", 2)
    monkeypatch.setattr(shown, "FOLDED", 1)
    atlas, *rest = surface_pages.sections(material)
    (gallery,) = galleries(atlas.blocks)
    assert [panel.title for panel in gallery.panels] == ["Sphere", "Torus", "Barth #6 $extic_* @65 <b>"]
    assert not any(section.blocks for section in rest), "their pages are looked up"
    assert [bool(galleries(section.details)) for section in rest] == [True, False, False, False]
    for (_, rows), panel in zip(material.listed.groupby("surface", sort=False), gallery.panels, strict=True):
        (choice,) = choices.choices(shown.on_pages(rows))
        told = [line[1] for line in panel.lines[1:]]
        named = ["none" if row is None else choices.written(row, choice.rows) for row in choice.within]
        assert told == named
        for row in rows[rows["device"] == choice.rows["device"].iloc[0]].itertuples():
            assert pd.isna(row.wrong_rays) or row.wrong_rays == 0 or str(row.label) in panel.note
    monkeypatch.setattr(surface_pages, "CARDS", 2)
    (sheet,) = galleries(surface_pages.sections(material)[0].blocks)
    assert sheet.across == 6 and all(not panel.lines and "ms" in panel.note for panel in sheet.panels)


def test_surfaces_that_nobody_timed_have_maps_and_no_times(material: Material) -> None:
    untimed = dict.fromkeys(("median_ms", "lower_ms", "upper_ms", "mrays_per_s", "speedup"), np.nan)
    frame = material.frame.assign(**untimed, front=False)
    made = {s.title: s for s in surface_pages.sections(dataclasses.replace(material, frame=frame))}
    (gallery,) = galleries(made["Torus"].blocks)
    assert len(gallery.panels) > 3 and not any(" ms" in panel.note for panel in gallery.panels[1:])
    assert "Torus: speed against error" not in made
    (table,) = [block for block in made["Torus"].blocks if isinstance(block, content.Table)]
    assert "ms" not in [column.title for column in table.columns]
    assert "max\nerror" in [column.title for column in table.columns]


def test_a_card_says_what_is_hard_and_where_nothing_came_of_a_variant(material: Material) -> None:
    rows = material.listed[material.listed["surface"] == "torus"]
    own = shown.on_pages(rows)
    card = cards.long_card(own, material.choice_of(own), material.shelf, rows)
    assert card is not None
    assert "What is hard: away from silhouettes the condition of a root reaches" in card.note
    assert "Degree 4: x^2 + y^2 + z^2 - 1 = 0, in a ball of radius 1.5." in card.note
    dropped = rows.assign(status=rows["status"].where(rows["method"] != "ray_march", "failed"))
    assert "Without a result here: Ray march." in cards.not_here(dropped)
    assert cards.not_here(rows[rows["status"] == "ok"]) == ""
    assert "Wrong rays, of" in printed((content.Text(card.note),))
