"""Say which method to take for which surface, what it costs, and what it risks."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

import pandas as pd

from reports import wording
from reports.analysis import choices, derive, tradeoffs
from reports.analysis.choices import ERRORS, Choice
from reports.analysis.scene_names import picture_sizes, rays_checked
from reports.reading.tuples import tuples

NAMED = 8  # a run with more surfaces counts them
MOST = 4  # methods that are counted one by one
PROMISES = {  # what the claims of harness.contract come to
    "no_missed_root": "miss no root",
    "finds_touch": "find roots that only touch",
    "no_false_hit": "give no false hit",
    "error_below_tolerance": "keep the error below a tolerance",
    "conservative_bound": "pass no root by a step that is too long",
}


def lead(found: Sequence[Choice]) -> str:
    """Say in one sentence which method to take for which surface, and what it costs; `found` has at least one."""
    rows = found[0].rows
    device, sizes = rows["device"].iloc[0], {size for one in found for size in picture_sizes(one.rows)}
    where = f"On {device}" + (f", for {sizes.pop()} pixels" if len(sizes) == 1 else "")
    where += f", of {len(found)} surfaces" if len(found) > NAMED else ""
    if all(one.rows["method"].nunique() < 2 for one in found):
        names = wording.listed(sorted({str(label) for one in found for label in one.rows["method_label"]}))
        return f"{where}, nothing is compared: {names} takes {_span(found)}."
    if all(one.best is None for one in found):
        return f"{where}, no variant was timed that answers every ray away from silhouettes rightly."
    if all(one.within[0] is None for one in found):
        return f"{where}, no right answer is within {wording.level(ERRORS[0])} of the scene's radius."
    return f"{where}, the fastest right answers come from {_winners(found, 0)}."


def _winners(found: Sequence[Choice], level: int) -> str:
    """Name the winner of each surface at one of ERRORS: surface by surface, or how often each method wins."""
    won = [(one, one.within[level]) for one in found if one.within[level] is not None]
    if not won:
        return "no variant"
    by_label: dict[str, list[tuple[Choice, Any]]] = {}
    for one, row in won:
        named = len(found) <= NAMED
        label = inline(row, one.rows) if named else str(row.method_label)
        label = " or ".join([label, *choices.others(one.tied[level])]) if named else label
        by_label.setdefault(label, []).append((one, row))
    if len(found) <= NAMED:
        parts = [
            f"{label} on {wording.listed([f'{one.name} ({_ms(row)})' for one, row in pairs])}"
            for label, pairs in by_label.items()
        ]
        apart = " (“or”: times that are not told apart)" if any(one.tied[level] for one, _ in won) else ""
        return wording.listed(parts) + apart
    ordered = sorted(by_label.items(), key=lambda item: -len(item[1]))
    parts = [f"{label} on {len(pairs)} ({_range(pairs)})" for label, pairs in ordered[:MOST]]
    rest = sum(len(pairs) for _, pairs in ordered[MOST:])
    parts += [f"others on {rest}"] if rest else []
    shared = sum(bool(one.tied[level]) for one, _ in won)
    return wording.listed(parts) + (f"; on {shared} another method is not told apart" if shared else "")


def inline(row: Any, rows: pd.DataFrame | None = None) -> str:
    """Write a variant for use in a sentence: Newton (ε = 0.001); with its precision where `rows` have several."""
    name, _, rest = (str(row.label) if rows is None else choices.written(row, rows)).partition(", ")
    return f"{name} ({rest})" if rest else name


def _ms(row: Any) -> str:
    """Write a time, and that it is floor-bound where it is."""
    return f"{wording.number(row.median_ms)} ms" + (", floor-bound" if bool(row.floor_bound) else "")


def _range(pairs: Sequence[tuple[Choice, Any]]) -> str:
    """Write the times of several rows."""
    times = sorted(row.median_ms for _, row in pairs)
    low, high = wording.number(times[0]), wording.number(times[-1])
    return f"{low} ms" if low == high else f"{low} to {high} ms"


def _span(found: Sequence[Choice]) -> str:
    """Write the times of all timed rows."""
    return _range([(one, row) for one in found for row in tuples(one.rows)])


def exact(found: Sequence[Choice]) -> str:
    """Say how far the answer holds: to 1e-3 of the radius, to 1e-6, or to neither."""
    loose, tight = (wording.level(error) for error in ERRORS)
    rough = [one for one in found if one.within[0] is None]
    there = [one for one in found if one.within[-1] is not None]
    same = [one for one in there if one.within[0].Index == one.within[-1].Index]
    if len(rough) == len(found):
        return f"No variant that is right everywhere has a largest error within {loose} of the scene's radius."
    told = f"Largest errors are within {loose} of the scene's radius"
    if rough:
        told += f", but on {_on(rough, len(found))} no variant that is right everywhere is so exact"
    if not there:
        return f"{told}. No variant of this run is right to {tight} on any surface; the table names the nearest."
    if len(same) == len(found):
        return f"{told}, and the same variants reach {tight}."
    rest = "" if len(there) == len(found) else f" On {_on(_others(found, there), len(found))} nothing does."
    return f"{told}. {tight} is reached by {_winners(there, -1)}.{rest}"


def gain(found: Sequence[Choice]) -> str:
    """Say how many times as fast as the baseline the winners are, where both are right; "" where that is not known.

    A winner whose time is floor-bound is left out, since the harness is measured there more than the method.
    """
    rows = [one.best for one in found if one.best is not None and not wording.absent(one.best.speedup)]
    best = len(rows)
    rows = [row for row in rows if row.baseline not in (row.method, row.variant)]
    itself = best - len(rows)
    told = sorted(row.speedup for row in rows if not row.floor_bound)
    if not rows:
        return ""
    name = _baseline(found)
    if not told:
        return f"Every time is floor-bound, mostly the harness's own, so that no gain over {name} is told."
    low, high = wording.factor(told[0]), wording.factor(told[-1])
    left = len(rows) - len(told)
    rest = f" ({left} left out, whose {'time is' if left == 1 else 'times are'} floor-bound)" if left else ""
    where = "" if len(rows) == len(found) else f", on {len(rows)} of {wording.plural(len(found), 'surface')}"
    where += " on which that is right too" if best < len(found) else ""
    where += f"; on {itself} it is the fastest itself" if itself else ""
    return f"{low if low == high else f'{low} to {high}'} as fast as {name}{where}{rest}."


def _baseline(found: Sequence[Choice]) -> str:
    """Return the label of the baseline that the rows name."""
    rows = pd.concat([one.rows for one in found])
    name = derive.baseline_of(rows)
    own = rows[(rows["method"] == name) | (rows["variant"] == name)]
    if own.empty:
        return name
    return str(own["method_label"].iloc[0] if name in set(own["method"]) else own["label"].iloc[0])


def _others(found: Sequence[Choice], some: Sequence[Choice]) -> list[Choice]:
    """Return the choices that are not among `some`."""
    names = {one.name for one in some}
    return [one for one in found if one.name not in names]


def _on(some: Sequence[Choice], total: int) -> str:
    """Name surfaces, or count them where there are many."""
    return wording.listed([one.name for one in some]) if len(some) <= 4 else f"{len(some)} of {total} surfaces"


def risk(found: Sequence[Choice], methods: Mapping[str, Mapping[str, Any]]) -> str:
    """Say how many rays the winners answer wrongly, and what they promise about rays that nobody checked.

    `methods` is what the plan's methods say of themselves.
    """
    best = [one.best for one in found if one.best is not None]
    lost = [one for one in found if one.best is None]
    told = []
    if best:
        rays = rays_checked(_best_rows(found))
        apart = sum(_count(row.grazing_wrong_rays) + _count(row.drowned_wrong_rays) for row in best)
        edge = f"but for {apart:,} that graze a silhouette or drown in rounding" if apart else "grazing ones included"
        told.append(f"Of {rays} rays checked on each surface, none is wrong, {edge}.")
        told += _promises({str(row.method): str(row.method_label) for row in best}, methods)
    if lost:
        where = _fewest(lost) if len(lost) < 4 else ""
        told.append(f"On {_on(lost, len(found))} every variant answers some rays wrongly{where}.")
    told.append("Rays are held against first hits that are certified in ball arithmetic.")
    return " ".join(told)


def _fewest(lost: Sequence[Choice]) -> str:
    """Say which variants have fewest wrong rays on surfaces on which all have some."""
    rows = [one.pictured for one in lost]
    each = [
        f"{inline(row)} {wording.count(row.wrong_rays)} of {wording.count(row.accuracy_rays)}"
        for row in rows
        if not wording.absent(row.wrong_rays)
    ]
    return f"; fewest: {wording.listed(each)}" if each else ""


def _best_rows(found: Sequence[Choice]) -> pd.DataFrame:
    """Return the rows of the best variants as a frame."""
    return pd.concat([one.rows.loc[[one.best.Index]] for one in found if one.best is not None])


def _count(value: Any) -> int:
    """Return a count, 0 for none."""
    return 0 if wording.absent(value) else int(value)


def _promises(winners: Mapping[str, str], methods: Mapping[str, Mapping[str, Any]]) -> list[str]:
    """Say which of the winning methods promise what; `winners` are labels by method."""
    by_promise: dict[str, list[str]] = {}
    for method, label in winners.items():
        claims = [PROMISES[claim] for claim in methods.get(method, {}).get("claims", []) if claim in PROMISES]
        by_promise.setdefault(wording.listed(claims), []).append(label)
    none = by_promise.pop("", [])
    told = [
        f"{wording.listed(labels)} promise{'s' * (len(labels) == 1)} to {what}" for what, labels in by_promise.items()
    ]
    if none:
        told.append(f"{wording.listed(none)} promise{'s' * (len(none) == 1)} nothing beyond the rays checked")
    return [f"{'; '.join(told)}."] if told else []


def bought(found: Sequence[Choice]) -> str:
    """Say where speed is bought with wrong rays."""
    trades = [(one, trade) for one in found for trade in tradeoffs.faster(one)[:1]]
    if not trades:
        return "No variant that answers rays wrongly is proved faster."
    if len(trades) > 4:
        counted = Counter(str(trade.row.method_label) for _, trade in trades)
        each = [f"{label} on {count}" for label, count in counted.most_common()]
        of_all = f"{len(trades)} of {wording.plural(len(found), 'surface')}"
        return f"On {of_all}: {wording.listed(each)}. “Trade-offs” lists them."
    by_label: dict[str, list[str]] = {}
    for one, trade in trades:
        told = f"{one.name} ({trade.told})"
        by_label.setdefault(inline(trade.row), []).append(told)
    return f"{'; '.join(f'{label} on {wording.listed(where)}' for label, where in by_label.items())}."


def focus(found: Sequence[Choice], focus: str, method: str) -> str:
    """Say in a sentence where the method or variant that the report is about wins, ties and loses, and where it errs.

    `method` is its method; the sentence is "" where none of the choices has a row of it.
    """
    wins: list[str] = []
    shared: list[str] = []
    wrong: list[str] = []
    coarse: list[str] = []
    beaten: dict[str, list[str]] = {}
    label = ""
    for one in found:
        own = one.rows[(one.rows["variant"] == focus) | (one.rows["method"] == focus)]
        if own.empty:
            continue
        label = str(own["label"].iloc[0] if focus != method else own["method_label"].iloc[0])
        if not derive.all_right(own).any():
            wrong.append(one.name)
        elif one.within[0] is not None and derive.within(own, ERRORS[0]).empty:
            coarse.append(one.name)
        elif one.best.Index in own.index:
            (shared if one.tied[0] else wins).append(one.name)
        elif set(own.index) & set(one.tied_rows[0]):
            shared.append(one.name)
        else:
            beaten.setdefault(inline(one.best) if len(found) <= NAMED else str(one.best.method_label), []).append(
                one.name
            )
    told = [f"is the fastest right answer on {_some(wins)}"] if wins else []
    told += [f"is not told apart from the fastest on {_some(shared)}"] if shared else []
    if beaten:
        ordered = sorted(beaten.items(), key=lambda item: -len(item[1]))
        told.append(f"is beaten {wording.listed([f'by {who} on {_some(where)}' for who, where in ordered[:4]])}")
        rest = sum(len(where) for _, where in ordered[4:])
        told[-1] += f" and by others on {rest} more" if rest else ""
    told += [f"errs by more than {wording.level(ERRORS[0])} of the scene's radius on {_some(coarse)}"] if coarse else []
    told += [f"answers some rays wrongly on {_some(wrong)}"] if wrong else []
    return f"{label} {'; it '.join(told)}." if told else ""


def _some(names: Sequence[str]) -> str:
    """Name up to four surfaces, or count them."""
    return wording.listed(list(names)) if len(names) <= 4 else f"{len(names)} surfaces"
