"""Declare plan.json: what a run set out to do, where, and with which methods.

Rows say what was measured; the plan says which rows belong together. Older plans lack what is NotRequired.
"""

# Without `from __future__ import annotations`: on texts TypedDict does not see which members are NotRequired.

from pathlib import Path
from typing import Annotated, Any, Literal, NotRequired, TypedDict

from harness.results import declared, sealed, store
from harness.results.declared import NOT_NEGATIVE, SHARE

Versions = dict[str, str] | list[tuple[str, str]]  # by package; pairs in older plans


class Probed(TypedDict):
    """Hold what the probes of a device found (harness/devices/probes.py); nothing, for a device with a problem."""

    two_sum: NotRequired[Annotated[float, SHARE]]
    two_prod_split: NotRequired[Annotated[float, SHARE]]
    two_prod_fma: NotRequired[Annotated[float, SHARE]]
    round_to_nearest: NotRequired[Annotated[float, SHARE]]
    division: NotRequired[Annotated[float, SHARE]]
    peak_gflops: NotRequired[Annotated[float, NOT_NEGATIVE]]
    peak_median_gflops: NotRequired[Annotated[float, NOT_NEGATIVE]]
    peak_shape: NotRequired[str]
    clock_ratio: NotRequired[Annotated[float | None, NOT_NEGATIVE]]


class Device(TypedDict):
    """Hold a device as its driver names it, and what its probes found.

    Of a merged run `machine` and `processor` say where it is, and `name` is how rows are told (Named.device).
    """

    name: str
    title: NotRequired[str | None]
    driver: NotRequired[str | None]
    compiler: NotRequired[str | None]
    compute_units: NotRequired[int | None]
    float64: NotRequired[bool]
    clock: NotRequired[Literal["device", "wall"]]
    versions: NotRequired[Versions]
    problem: NotRequired[str | None]
    resident: NotRequired[int | None]
    probes: NotRequired[Probed | None]
    machine: NotRequired[str | None]
    processor: NotRequired[str | None]


class Machine(TypedDict):
    """Hold what the run was made with (harness/running/environment.py)."""

    firsthit: NotRequired[str]
    commit: NotRequired[str | None]
    dirty: NotRequired[bool]
    python: NotRequired[str]
    platform: NotRequired[str]
    cpu: NotRequired[str]
    machine: NotRequired[str | None]
    versions: NotRequired[Versions]


class Named(TypedDict):
    """Name a cell.

    at: the place of the cell in the whole plan, of which this run has a shard
    device: how the device of the row is told, where its own name stands for several devices of a merged run
    """

    key: str
    slot: str
    at: NotRequired[int]
    device: NotRequired[str]


class Sharded(TypedDict):
    """Name the shard that a run is: the one of this number, from 1, of as many."""

    number: int
    of: int


class Merged(TypedDict):
    """Name a run that went into a merged one: its folder's name, and what its plan.json said."""

    run: str
    machine: str
    commit: NotRequired[str | None]
    dirty: NotRequired[bool]
    created: str
    command: str
    shard: NotRequired[Sharded]


class NamedStudy(TypedDict):
    """Name a study."""

    study: str
    key: str


class Facts(TypedDict):
    """Hold what a family of hard rays is."""

    title: str
    parameter: str
    harder: str
    why: str
    source: str


class CardTable(TypedDict):
    """Hold a table of a method's page."""

    part: str
    header: list[str]
    rows: list[list[str]]


class Knob(TypedDict):
    """Hold a knob of a method."""

    name: str
    default: float
    meaning: str
    printed: NotRequired[float | None]


class Card(TypedDict):
    """Hold what a method says of itself (harness/running/cards.py)."""

    label: NotRequired[str]
    title: NotRequired[str]
    summary: NotRequired[str]
    source: NotRequired[str | None]
    doc: NotRequired[dict[str, str]]
    tables: NotRequired[list[CardTable]]
    parameters: NotRequired[list[Knob]]
    claims: NotRequired[list[str]]
    outside: NotRequired[str | None]


class PlanFile(TypedDict):
    """Hold plan.json."""

    name: str
    title: str
    config: str
    config_text: str
    command: str
    created: str
    environment: Machine
    devices: list[Device]
    cells: list[Named]
    families: NotRequired[list[Named]]
    family_facts: NotRequired[dict[str, Facts]]
    methods: NotRequired[dict[str, Card]]
    studies: NotRequired[list[NamedStudy]]
    include: NotRequired[list[str]]
    baseline: NotRequired[str]
    focus: NotRequired[str]
    shard: NotRequired[Sharded]
    merged: NotRequired[list[Merged]]


def _card_table(table: dict[str, Any]) -> str | None:
    if any(len(row) != len(table["header"]) for row in table["rows"]):
        return "a row is longer or shorter than the header"
    return None if table["header"] else "its header is empty"


def _plan(plan: dict[str, Any]) -> str | None:
    """Say which name can be no file's or folder's."""
    keys = [one["key"] for list_ in ("cells", "families", "studies") for one in plan.get(list_, ())]
    if wrong := next((key for key in keys if not (key.isascii() and key.isalnum() and len(key) <= 64)), None):
        return f"{wrong!r:.40} is no key"
    if "" in keys:
        return "a key is empty"
    if wrong := next((n for n in plan.get("include", ()) if Path(n).name != n or "\0" in n or n in (".", "..")), None):
        return f"{wrong!r:.40} is no name of a run"
    return None


_check = declared.checker(PlanFile, {CardTable: _card_table, PlanFile: _plan})


def read(path: Path) -> dict[str, Any]:
    """Read a plan, and hold it against its checksum and its declaration. Raises OSError or ValueError."""
    plan = store.of_format(sealed.read(path), store.FORMAT)
    _check(plan, "")
    return plan
