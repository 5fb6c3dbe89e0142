"""Make of kept runs a graph of each gated figure of each row over commits, and find the steps in it.

Gated figures are the same to the last digit in every run of the same programs, so a step needs no statistics: it is a
change beyond the gate's own tolerance between two consecutive kept commits on the same arithmetic, with meshes by the
same packages.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from harness.contract import CellStatus, digest
from harness.results.commits import ALIKE, SIZED, Commit, Kept, same_arithmetic

STATUS = "status"  # drawn as a figure of its own where it changes
STATUSES = tuple(str(status) for status in CellStatus)
GONE = "none"
DIRTY, ASIDE = "with uncommitted changes", "not on the line of commits that ends at HEAD"
Value = float | int


class Rule(Protocol):
    """State how much worse one figure may get, as the gate's tolerances do."""

    @property
    def better(self) -> str: ...

    def allowed(self, before: float) -> float:
        """Return the worst value that passes."""

    def verdict(self, before: float, now: float) -> str:
        """Return "pass", "improved" or "regressed"."""


@dataclass(frozen=True)
class Place:
    """Place a commit on the axis of commits: at 0, 1, … on the line; between two of these where it is drawn `apart`.

    apart: why it is not on the line; "" where it is
    """

    at: float
    commit: Commit
    apart: str = ""


@dataclass(frozen=True, eq=False)
class Point:
    """Hold the figure of one row at one commit; `value` is None where the row has none there."""

    place: Place
    value: Value | None
    row: Mapping[str, Any]
    harness: Mapping[str, Any]

    @property
    def scene(self) -> str:
        """Return the hash of what was asked of the method."""
        return str(self.row["scene"])


@dataclass(frozen=True, eq=False)
class Step:
    """Hold a change beyond the tolerance: its figure, row and device, and the two commits between which it happened.

    crept: it happened in changes of which none is beyond the tolerance, over more than two kept commits
    """

    figure: str
    slot: str
    device: str
    before: str
    now: str
    since: Commit
    commit: Commit
    at: float
    worse: bool
    size: float
    notes: tuple[str, ...] = ()
    crept: bool = False


@dataclass(frozen=True, eq=False)
class Span:
    """Hold points on the line that follow each other with the same value; `joined` to the span before by a line."""

    points: tuple[Point, ...]
    joined: bool

    @property
    def value(self) -> Value:
        """Return the value that all points have."""
        value = self.points[0].value
        assert value is not None
        return value


@dataclass(frozen=True, eq=False)
class Graph:
    """Hold one figure of one row on one device over commits, its points drawn apart, and its steps.

    steps: from one kept commit to the next; `crept` are those in several changes
    slack: by how much the largest value may change and make no step
    """

    figure: str
    slot: str
    device: str
    spans: tuple[Span, ...]
    apart: tuple[Point, ...]
    steps: tuple[Step, ...]
    crept: tuple[Step, ...]
    slack: float

    @property
    def told(self) -> tuple[Step, ...]:
        """Return all steps, those too that the figure crept."""
        return self.steps + self.crept

    @property
    def flat(self) -> bool:
        """Tell whether every commit has the same value."""
        return not self.steps and len(set(self.values)) == 1

    @property
    def values(self) -> list[Value]:
        """List the values of all spans and of the points apart."""
        return [span.value for span in self.spans] + [point.value for point in self.apart if point.value is not None]

    def said(self, value: Value) -> str:
        """Write a value with every digit; a status by its name."""
        return STATUSES[int(value)] if self.figure == STATUS else repr(value)


def places(kept: Iterable[Kept], line: Sequence[str] | None) -> dict[Commit, Place]:
    """Place every commit.

    On the line are the clean commits of `line`, in its order, or without it all clean ones, by their dates. All others
    are apart: beside their own commit if that is on the line, else behind the last commit of the line that is no newer.
    """
    commits = sorted({one.commit for one in kept}, key=lambda commit: (commit.date, commit.hash, commit.dirty))
    order = {name: i for i, name in enumerate(line)} if line is not None else None
    on = [commit for commit in commits if not commit.dirty and (order is None or commit.hash in order)]
    if order is not None:
        on.sort(key=lambda commit: order[commit.hash])
    index = {commit.hash: i for i, commit in enumerate(on)}
    placed = {commit: Place(i, commit) for i, commit in enumerate(on)}
    for commit in commits:
        if commit not in placed:
            newer = sum(other.date <= commit.date for other in on) - 1
            at = index.get(commit.hash, newer) + 0.5
            placed[commit] = Place(at, commit, DIRTY if commit.dirty else ASIDE)
    return placed


def graphs(kept: Sequence[Kept], line: Sequence[str] | None, rules: Mapping[str, Rule]) -> list[Graph]:
    """Return the graphs of all figures of `rules`, in its order, then by row and device.

    Status is a figure too, the first, but only where it changes.
    """
    placed = places(kept, line)
    rows: dict[tuple[str, str, str], list[tuple[Place, Kept]]] = {}
    for one in kept:
        for slot in one.rows:
            key = (slot, str(one.device["name"]), _alike(one, slot))
            rows.setdefault(key, []).append((placed[one.commit], one))
    several = Counter((slot, device) for slot, device, _ in rows)
    made: list[Graph] = []
    for (slot, device, alike), runs in sorted(rows.items()):
        label = f"{device} {alike[:6]}" if several[slot, device] > 1 else device
        runs.sort(key=lambda run: run[0].at)
        for name in (STATUS, *rules):
            parts = _by_level(slot, label, runs) if name in SIZED else {label: runs}
            made += [graph for told, own in parts.items() if (graph := _graph(name, slot, told, own, rules.get(name)))]
    order = {name: i for i, name in enumerate((STATUS, *rules))}
    return sorted(made, key=lambda graph: (order[graph.figure], graph.slot, graph.device))


def _alike(one: Kept, slot: str) -> str:
    """Return a text that runs share whose figures of a row can be compared: of its arithmetic and of its mesher."""
    arithmetic, mesher = same_arithmetic(one.device, slot), one.rows[slot].get("mesher")
    return digest([arithmetic, mesher]) if mesher else arithmetic


def _by_level(slot: str, label: str, runs: Sequence[tuple[Place, Kept]]) -> dict[str, list[tuple[Place, Kept]]]:
    """Part the runs of one row by the level at which a quadtree begins on the device; return each part by its label."""
    found: dict[Any, list[tuple[Place, Kept]]] = {}
    for place, one in runs:
        found.setdefault(one.rows[slot].get("device_level"), []).append((place, one))
    several = len(found) > 1
    said = {level: "at a level not told" if level is None else f"from level {level}" for level in found}
    return {f"{label}, {said[level]}" if several else label: own for level, own in found.items()}


def devices(kept: Iterable[Kept]) -> list[str]:
    """Say of each device what it is, once."""
    return sorted({f"{one.device['name']}: {', '.join(str(one.device.get(name)) for name in ALIKE)}." for one in kept})


def steps(drawn: Iterable[Graph]) -> list[Step]:
    """Return the steps of all graphs, the worst first, improvements last."""
    found = [step for graph in drawn for step in graph.told]
    return sorted(found, key=lambda step: (not step.worse, -step.size, step.at))


def _graph(figure: str, slot: str, device: str, runs: Sequence[tuple[Place, Kept]], rule: Rule | None) -> Graph | None:
    """Make the graph of one figure of one row; None where it has no value anywhere, or is a status that stays."""

    def point(place: Place, one: Kept) -> Point:
        row = one.rows[slot]
        if figure == STATUS:
            status = str(row["status"])
            return Point(place, STATUSES.index(status) if status in STATUSES else None, row, one.harness)
        value = row.get(figure)
        number = isinstance(value, int | float) and not isinstance(value, bool)
        return Point(place, value if number else None, row, one.harness)

    every: list[Point] = []
    for place, one in runs:
        made = point(place, one)
        if not (every and every[-1].place == place and (every[-1].value, every[-1].scene) == (made.value, made.scene)):
            every.append(made)  # another processor with the same arithmetic adds nothing
    values = [one.value for one in every if one.value is not None]
    if not values or (figure == STATUS and len(set(values)) == 1):
        return None
    on = [one for one in every if not one.place.apart]
    apart = tuple(one for one in every if one.place.apart and one.value is not None)
    largest = max(map(abs, values))
    slack = abs(rule.allowed(largest) - largest) if rule else 0.0
    steps = tuple(_steps(figure, slot, device, on, rule))
    crept = tuple(_crept(figure, slot, device, on, rule, {step.at for step in steps if step.now != GONE}))
    return Graph(figure, slot, device, tuple(_spans(on)), apart, steps, crept, slack)


def _spans(points: Sequence[Point]) -> Iterator[Span]:
    """Cut points into spans of one value. A point without a value, or another scene, breaks the line."""
    held: list[Point] = []
    joined = False
    for i, point in enumerate(points):
        before = points[i - 1] if i else None
        follows = before is not None and before.value is not None and before.scene == point.scene
        if held and not (follows and point.value == held[-1].value):
            yield Span(tuple(held), joined)
            held = []
        if point.value is not None:
            if not held:
                joined = follows
            held.append(point)
    if held:
        yield Span(tuple(held), joined)


def _steps(figure: str, slot: str, device: str, points: Sequence[Point], rule: Rule | None) -> Iterator[Step]:
    """Find the steps of one graph: each point is held against the last one with a value, of the same scene."""
    last: Point | None = None
    gone = False
    for point in points:
        if last and last.scene != point.scene:
            last, gone = None, False
        found = None
        if last and point.value is None and not gone and point.row["status"] == last.row["status"]:
            gone, found = True, (True, math.inf)
        elif last and last.value is not None and point.value is not None:
            found = _found(last.value, point.value, rule)
        if last and found:
            before, now = _told(last.value, point.value, rule is None)
            since, place = last.place.commit, point.place
            worse, size = found
            notes = _notes(last, point)
            yield Step(figure, slot, device, before, now, since, place.commit, place.at, worse, size, notes)
        if point.value is not None:
            last, gone = point, False


def _crept(
    figure: str, slot: str, device: str, points: Sequence[Point], rule: Rule | None, stepped: Collection[float]
) -> Iterator[Step]:
    """Find what changed beyond the tolerance in changes that are not.

    The last point before each step, before another scene and of all is held against the best since the last step, and
    against the first. `stepped` has the places of the steps.
    """
    stretches: list[list[Point]] = [[]]
    for point in points if rule else ():
        if point.place.at in stepped or (stretches[-1] and stretches[-1][-1].scene != point.scene):
            stretches.append([])
        if point.value is not None:
            stretches[-1].append(point)
    for stretch in stretches:
        if not stretch or rule is None:
            continue
        last, sign = stretch[-1], 1 if rule.better == "lower" else -1
        best = min(stretch, key=lambda point: sign * (point.value or 0))
        for since in (best, stretch[0]):
            assert since.value is not None and last.value is not None
            if found := _found(since.value, last.value, rule):
                before, now = _told(since.value, last.value, False)
                commits, notes = (since.place.commit, last.place.commit), _notes(since, last)
                yield Step(figure, slot, device, before, now, *commits, last.place.at, *found, notes, crept=True)
                break


def _found(before: Value, now: Value, rule: Rule | None) -> tuple[bool, float] | None:
    """Say of a change beyond the tolerance whether it is worse, and how large it is; None for any other.

    Without a rule the values are statuses, of which a later one is worse. Sizes compare as the gate's do: by how far
    the value is beyond what is allowed, over the value before.
    """
    if rule is None:
        return (now > before, math.inf) if before != now else None
    verdict = rule.verdict(before, now)
    if verdict == "pass":
        return None
    return verdict == "regressed", abs(now - rule.allowed(before)) / max(abs(before), 1e-300)


def _told(before: Value | None, now: Value | None, statuses: bool) -> tuple[str, str]:
    """Write both values of a step with six digits, or with all where six do not tell them apart."""
    values = [value for value in (before, now) if value is not None]
    if statuses:
        texts = [STATUSES[int(value)] for value in values]
    else:
        texts = [f"{value:.6g}" if isinstance(value, float) else str(value) for value in values]
    if len(set(texts)) < len(texts):
        texts = [repr(value) for value in values]
    return texts[0], texts[1] if len(texts) > 1 else GONE


def _notes(before: Point, now: Point) -> tuple[str, ...]:
    """Say why a row did not end well, and what a step is not, or not only, due to: its program, and firsthit."""
    notes = [str(now.row["reason"])] if now.row.get("reason") else []
    if "program" in now.row and now.row["program"] == before.row.get("program"):
        notes.append("the row's program is the same")
    then, later = (" ".join(str(point.harness.get(name)) for name in ("version", "commit")) for point in (before, now))
    own = str(now.harness.get("commit"))
    if then != later and not now.place.commit.hash.startswith(own):  # else the commit itself is firsthit's
        notes.append(f"firsthit changed too, {then} to {later}")
    return tuple(notes)
