"""Devices, machine, software and config of a run."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from reports import wording
from reports.content import Block, Code, Column, Table, Text
from reports.reading.run import Plan

PROBLEM_LIMIT = 120  # characters of why a device cannot be used


def blocks(plan: Plan) -> tuple[Block, ...]:
    """Make a line for each device, and a sentence on the machine and the software."""
    return (_devices(plan), Text(_made_with(plan)), *([_merged(plan)] if plan.merged else []))


def _merged(plan: Plan) -> Table:
    """Make a line for each run that went into a merged one."""
    body = []
    for one in plan.merged:
        shard = f"{one['shard']['number']} of {one['shard']['of']}" if "shard" in one else None
        commits = wording.listed(replace(plan, merged=(one,)).commits) or wording.NONE
        body.append((one["run"], one["machine"], shard, commits, one["created"][:16].replace("T", " ")))
    columns = (Column("run", stretch=1), Column("machine"), Column("shard"), Column("commit"), Column("made"))
    kept = [i for i in range(len(columns)) if any(not wording.absent(row[i]) for row in body)]
    lines = [tuple(row[i] for i in kept) for row in body]
    caption = "Their times are compared within a machine alone."
    return Table(tuple(columns[i] for i in kept), lines, "Runs that were merged.", caption)


def details(plan: Plan) -> tuple[Block, ...]:
    """Tell all that is known of the devices and the machine, and the config's text."""
    return (devices_table(plan), _environment(plan), Code(plan.config_text, "toml"))


def _devices(plan: Plan) -> Table:
    """Make a line for each device with what a reader needs to know of it."""
    body: list[tuple[Any, ...]] = []
    for device in plan.devices:
        peak = (device.get("probes") or {}).get("peak_gflops")
        problem = device.get("problem")
        told = (device.get("title"), device.get("driver"), device.get("compute_units"), peak)
        last = wording.excerpt(problem, PROBLEM_LIMIT) if problem else "yes" if device.get("float64") else "no"
        body.append((device.get("name"), *told, last))
    return Table(
        (
            Column("device"),
            Column("hardware", stretch=3),
            Column("driver", stretch=3),
            Column("units", wording.count, numeric=True),
            Column("peak,\nGFLOP/s", _two_digits, numeric=True),
            Column("float64" if not any(device.get("problem") for device in plan.devices) else "float64 or problem"),
        ),
        body,
        "Devices of this run.",
    )


def _made_with(plan: Plan) -> str:
    """Write in a sentence or two which machine and which software the run was made with."""
    told = plan.environment
    commit = f"commit {wording.listed(replace(plan, merged=()).commits)}" if told.get("commit") else ""
    own = [f"firsthit {told.get('firsthit') or ''}".strip(), commit]
    versions = [f"{name} {version}" for name, version in _pairs(told.get("versions"))]
    python = f"Python {told['python']}" if told.get("python") else ""
    software = ", ".join(filter(None, (*own, python, *versions)))
    machine = ", ".join(filter(None, (told.get("cpu"), told.get("platform"))))
    where = f" on {machine}" if machine else ""
    if plan.merged:
        newest = plan.created[:16].replace("T", " ")
        return f"The newest of the runs that were merged was made on {newest}, the first by {software}{where}."
    return f"Made on {plan.created[:16].replace('T', ' ')} by {software}{where}."


def devices_table(plan: Plan) -> Table:
    """Make a line for each device with what its probes found; columns without any value are left out."""
    body: list[tuple[Any, ...]] = []
    for device in plan.devices:
        versions = ", ".join(f"{name} {version}" for name, version in _pairs(device.get("versions")))
        told = (device.get("title"), device.get("driver"), device.get("compiler"), device.get("compute_units"))
        probes = device.get("probes") or {}
        peak = (probes.get("peak_gflops"), probes.get("peak_median_gflops"), probes.get("peak_shape"))
        float64 = "yes" if device.get("float64") else "no"
        how = (float64, device.get("clock"), versions, device.get("problem"))
        body.append((device.get("name"), *told, *peak, *how))
    columns: tuple[Column, ...] = (
        Column("device"),
        Column("hardware"),
        Column("driver"),
        Column("compiler"),
        Column("units", numeric=True),
        Column("peak", _two_digits, numeric=True, over="GFLOP/s"),
        Column("median", _two_digits, numeric=True, over="GFLOP/s"),
        Column("reached by"),
        Column("float64"),
        Column("clock"),
        Column("bindings"),
        Column("problem"),
    )
    known = [i for i in range(len(columns)) if not all(wording.absent(row[i]) for row in body)]
    columns, body = tuple(columns[i] for i in known), [tuple(row[i] for i in known) for row in body]
    caption = (
        "The clock is the one to be believed there, and times are by it. The peak is the best rate of float32 "
        "multiply-adds, two operations each, that a launch of the probe's loops reached, however many chains it had: "
        "shares of a peak are shares of this rate. The median is of all launches of that loop: where it is far below "
        "the peak, other programs slowed the probe down, and the next one may find another peak."
    )
    return Table(columns, body, "Devices of this run.", caption)


def _two_digits(value: Any) -> str:
    """Write two significant digits without an exponent; a dash for a missing value."""
    return wording.NONE if wording.absent(value) else f"{float(f'{value:.1e}'):,g}"


def _environment(plan: Plan) -> Table:
    """Make a line for each fact about the machine and the software that the run was made with."""
    told = {name: value for name, value in plan.environment.items() if name not in ("versions", "dirty")}
    if commits := replace(plan, merged=()).commits:
        told["commit"] = commits[0]
    versions = ", ".join(f"{name} {version}" for name, version in _pairs(plan.environment.get("versions")))
    body = [("config", plan.config), ("created", plan.created), *told.items(), ("packages", versions or None)]
    whose = "the first of the runs that were merged" if plan.merged else "this run"
    return Table((Column(""), Column("")), body, f"The machine and software of {whose}.")


def _pairs(versions: Any) -> list[tuple[str, str]]:
    """Return versions as pairs of name and version; runs store them as an object or as a list of pairs."""
    if isinstance(versions, Mapping):
        return [(str(name), str(version)) for name, version in versions.items()]
    return [(str(pair[0]), str(pair[1])) for pair in versions or [] if isinstance(pair, list) and len(pair) == 2]
