"""Tell before anything runs which rows cannot be compared with a baseline, and what to do about it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from harness.contract import plural
from harness.devices.discovery import known_devices
from harness.gate.comparable import OTHER_SCENE
from harness.gate.judge import Judged, Verdict


def foretold(found: Sequence[Judged], total: int, config: Path, baseline: Path) -> str:
    """Write what `Prepared.incomparable` found of `total` rows, each reason once; "" if all rows can be compared.

    New rows are told of only if no row can be compared.
    """
    told = [j for j in found if j.verdict is Verdict.INCOMPARABLE or len(found) == total]
    if not told:
        return ""
    rows_of = f"{len(told)} of {plural(total, 'row')}"
    lines = [f"firsthit: {rows_of} cannot be compared with {baseline}, whatever the methods answer:"]
    for reason in dict.fromkeys(j.reason for j in told):
        rows = [j for j in told if j.reason == reason]
        more = f" and {len(rows) - 1} more" * (len(rows) > 1)
        lines += [f"  {rows[0].slot} on {rows[0].device}{more}: {reason}", f"    {_to_do(rows, config)}"]
    return "\n".join(lines)


def others(devices: set[str]) -> list[str]:
    """List the usable devices of this machine beside `devices`, as far as is known."""
    return [info.name for info in known_devices().devices if not info.problem and info.name not in devices]


def _to_do(rows: Sequence[Judged], config: Path) -> str:
    """Say what to do about rows with one reason."""
    bless = f'firsthit bless {config} --reason "…"'
    if rows[0].verdict is Verdict.NEW or rows[0].reason == OTHER_SCENE:
        return f"do: {bless}"
    names = others({j.device for j in rows})
    if not names:
        return "no other device of this machine can be used; see `firsthit devices`"
    return f"do: gate on another device, --device {' or --device '.join(names)}"
