"""Find the device that a config means by `fastest`, by measuring the peak rate of each device that works."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass, field, replace
from typing import Protocol

from harness.contract import DeviceInfo
from harness.devices import kept_answers
from harness.devices.executor import START_SECONDS, LocalExecutor
from harness.devices.probes import Probes
from harness.experiment import kinds, targets
from harness.experiment.config import FASTEST, Experiment
from harness.running.environment import kept_probes, probed

STEADY = 0.7  # the least share of the best launch's rate that the median one has where a probe was not disturbed
Tried = tuple[DeviceInfo, Probes | None]  # what `environment.probed` returns


class _Hears(Protocol):
    def doing(self, what: str) -> AbstractContextManager[object]: ...

    def warned(self, line: str) -> None: ...


@dataclass(frozen=True, eq=False)
class Settled:
    """Hold experiments whose devices have names, and what was measured for that, by the devices' names."""

    parts: tuple[Experiment, ...]
    tried: Mapping[str, Tried] = field(default_factory=dict)


def settled(
    parts: Sequence[Experiment], found: list[DeviceInfo], hears: _Hears, known: Mapping[str, Tried] | None = None
) -> Settled:
    """Put the name of the fastest of the devices `found` in place of that word, and tell `hears` which it is and why.

    Peaks are those that probes found before and that are kept in the user's cache folder, as `firsthit devices` prints
    them; a device without one is measured, which takes seconds, and kept. What is `known` of devices elsewhere, by
    their names, is not measured again. Raises FirsthitError, with exit code 3, where no device works.
    """
    asking = [part for part in parts if FASTEST in part.wanted_devices()]
    if not asking:
        return Settled(tuple(parts))
    tried = _measured(targets.usable(found, all(map(kinds.only_rasters, asking))), hears, known or {})
    told: dict[str, None] = {}
    made = tuple(_named(part, found, tried, told) if part in asking else part for part in parts)
    for line in told:
        hears.warned(line)
    return Settled(made, tried)


def _measured(devices: Sequence[DeviceInfo], hears: _Hears, known: Mapping[str, Tried]) -> dict[str, Tried]:
    """Probe devices, or take what is known or kept of them."""
    folder, executor = kept_answers.probes_folder(), LocalExecutor(START_SECONDS)
    tried = {info.name: known[info.name] for info in devices if info.name in known}
    try:
        for info in (info for info in devices if info.name not in known):
            if folder and kept_probes(info, folder)[0]:
                tried[info.name] = probed(executor, info, folder)
                continue
            with hears.doing(f"measuring the peak rate of {info.name}, to find the fastest device; it is kept"):
                tried[info.name] = probed(executor, info, folder)
    finally:
        executor.close()
    return tried


def _named(part: Experiment, found: list[DeviceInfo], tried: Mapping[str, Tried], told: dict[str, None]) -> Experiment:
    """Return an experiment with the fastest device's name in place of the word; add to `told` how it was chosen."""
    measured = {
        info: probes.peak_gflops
        for info in targets.usable(found, kinds.only_rasters(part))
        if (probes := tried[info.name][1])
    }
    if not measured:
        raise targets.none_usable()
    order = targets.ranked(measured)
    peaks = {info.name: measured[info] for info in order}
    others = ", ".join(f"{name} {peak:,.0f}" for name, peak in peaks.items() if name != order[0].name)
    beside = f" ({others})" if others else ""
    told[f"the fastest device is {order[0].name}, with a peak of {peaks[order[0].name]:,.0f} Gflop/s{beside}"] = None
    rivals = [info.name for info in order[1:] if (info.resident is None) == (order[0].resident is None)]
    slowed = [name for name in rivals if (own := tried[name][1]) and own.peak_median_gflops < STEADY * own.peak_gflops]
    if slowed:
        told[
            f"that choice is not certain: other programs slowed the probe of {', '.join(slowed)} down, and its peak "
            "may be higher; name a device, or let an idle machine measure anew with `firsthit devices --again`"
        ] = None
    return replace(
        part,
        config=replace(part.config, devices=_with_name(part.config.devices, order[0].name)),
        own_devices={v: tuple(_with_name(names, order[0].name)) for v, names in part.own_devices.items()},
        peaks=peaks,
    )


def _with_name(words: Sequence[str], name: str) -> list[str]:
    return list(dict.fromkeys(name if word == FASTEST else word for word in words))
