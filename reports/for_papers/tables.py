"""Choose the tables of a run that a paper prints, and name them by what they are."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pandas as pd

from reports import wording
from reports.analysis import derive, ties
from reports.analysis.scene_names import scene_names
from reports.content import Column, Table
from reports.for_papers import stability
from reports.for_papers.figures import groups, several
from reports.for_papers.model import Tabled, distinct, exact, sentence, slug
from reports.material import Material
from reports.reading.tuples import tuples


def tables(material: Material) -> list[Tabled]:
    """Return every table; [] where the run has nothing for one."""
    made = [*_winners(material), *_speedups(material), *_results(material), *_stability(material)]
    return distinct(made, [f"{tabled.title} {tabled.caption}" for tabled in made])


def _label_of(frame: pd.DataFrame, name: str) -> str:
    """Return how people write the method or variant `name`, which a row of `frame` has; else `name`."""
    for column, label in (("method", "method_label"), ("variant", "label")):
        found = frame.loc[frame[column] == name, label]
        if len(found):
            return str(found.iloc[0])
    return name


def _speedup(material: Material, rows: pd.DataFrame) -> str:
    """Say in a sentence what speed-ups are of."""
    baseline = _label_of(material.frame, derive.baseline_of(rows))
    return f"Speed-up is over {baseline}: the median of the ratios of the rounds that timed both."


def _focused(material: Material, rows: Any) -> frozenset[int]:
    """Return the numbers of the rows that are in focus."""
    named = enumerate(tuples(rows)) if material.focus else ()
    return frozenset(i for i, row in named if material.focus in (row.method, row.variant))


def _results(material: Material) -> Iterator[Tabled]:
    """Yield for each scene, device and precision the time and errors of each variant, the fastest first."""
    for name, place, rows in groups(derive.contenders(material.listed)):
        body = [
            (row.label, row.median_ms, row.speedup, row.error_max, row.error_p99, row.wrong_rays)
            for row in tuples(rows)
        ]
        columns = (
            Column("method"),
            Column("ms", wording.number, numeric=True),
            Column("speed-up", wording.factor, numeric=True),
            Column("max", wording.error, numeric=True, over="|t − t*|"),
            Column("p99", wording.error, numeric=True, over="|t − t*|"),
            Column("wrong", wording.count, numeric=True),
        )
        told = sentence(
            f"{place}. {_speedup(material, rows)} Errors are in scene units; wrong rays are those answered "
            f"wrongly away from silhouettes, of {wording.count(rows['accuracy_rays'].max())} checked.",
            exact(rows["error_max"]),
        )
        table = Table(columns, body, f"Time and error on {rows['surface_title'].iloc[0]}.", told)
        yield Tabled(f"results-{name}", table, _focused(material, rows))


def _winners(material: Material) -> Iterator[Tabled]:
    """Yield the fastest variant with no wrong ray of each scene, device and precision."""
    rows = ties.leaders(material.listed)
    if rows.empty:
        return
    named = scene_names(material.listed)
    rows = rows.assign(planned=rows["comparison"].map({name: i for i, name in enumerate(named)}))
    rows = rows.sort_values(["planned", "precision", "device"], kind="stable")
    more = several(rows, "precision", "device")
    labels = dict(material.frame[["variant", "label"]].drop_duplicates().itertuples(index=False, name=None))
    body = [
        (
            named[row.comparison],
            *(getattr(row, name) for name in more),
            row.label,
            row.median_ms,
            row.speedup,
            row.error_max,
            "; ".join(labels[variant] for variant in row.tied) or wording.NONE,
        )
        for row in tuples(rows)
    ]
    columns = (
        Column("surface"),
        *(Column(name) for name in more),
        Column("fastest"),
        Column("ms", wording.number, numeric=True),
        Column("speed-up", wording.factor, numeric=True),
        Column("max |t − t*|", wording.error, numeric=True),
        Column("not told apart from"),
    )
    if all(row[-1] == wording.NONE for row in body):
        columns, body = columns[:-1], [row[:-1] for row in body]
    place = ", ".join(str(rows[name].iloc[0]) for name in ("precision", "device") if name not in more)
    told = sentence(
        f"Of the variants that answer every ray away from silhouettes rightly{f', {place}' if place else ''}.",
        _speedup(material, rows),
        "Errors are in scene units.",
        exact(rows["error_max"]),
    )
    yield Tabled("winners", Table(columns, body, "The fastest method on each surface.", told), _focused(material, rows))


def _speedups(material: Material) -> Iterator[Tabled]:
    """Yield for each device and precision how many times as fast as the baseline each method is on each scene."""
    rows = derive.contenders(material.listed)
    rows = rows[rows["speedup"].notna()].drop_duplicates([*derive.GROUP, "method"])
    named, more = scene_names(material.listed), several(rows, "device", "precision")
    for (device, precision), own in rows.groupby(["device", "precision"], sort=False):
        scenes = [scene for scene in named if scene in set(own["comparison"])]
        of = {(row.comparison, row.method): row.speedup for row in tuples(own)}
        methods = own.groupby("method")["speedup"].median().sort_values(ascending=False).index
        labels = [_label_of(own, method) for method in methods]
        told = sentence(
            f"Of each method the fastest variant with every ray right, {precision} on {device}.",
            _speedup(material, own),
        )
        name = slug("speedups", *(str(own[column].iloc[0]) for column in more))
        strong: set[int] = set()
        if len(scenes) <= len(methods):
            head, titles = "method", [named[scene] for scene in scenes]
            body = [(label, *(of.get((s, m)) for s in scenes)) for label, m in zip(labels, methods, strict=True)]
            focus = own.loc[(own["method"] == material.focus) | (own["variant"] == material.focus), "method"]
            strong = {i for i, method in enumerate(methods) if method in set(focus)}
        else:
            head, titles = "surface", labels
            body = [(named[s], *(of.get((s, m)) for m in methods)) for s in scenes]
        columns = (Column(head), *(Column(title, wording.factor, numeric=True) for title in titles))
        baseline = _label_of(material.frame, derive.baseline_of(own))
        yield Tabled(name, Table(columns, body, f"Speed-up over {baseline}.", told), frozenset(strong))


def _stability(material: Material) -> Iterator[Tabled]:
    """Yield for each device and precision how many rungs of each ladder of hard rays a variant holds."""
    for of in stability.ladders(material):
        columns = (Column("method"), *(Column(str(name), numeric=True) for name in of.told.columns))
        body = [(str(label), *line) for label, *line in of.told.itertuples(name=None)]
        strong = frozenset(i for i, label in enumerate(of.told.index) if label in of.strong)
        table = Table(columns, body, f"Hard rays in {of.precision}.", of.caption)
        yield Tabled(slug("stability", *of.more), table, strong)
