"""Divide the plans of a config into shards, for machines that run a part each and whose runs are merged afterwards.

The cells that are timed together stay together (Cell.together). The division follows from the config alone, so that
it is the same on each machine, whatever its devices: groups are dealt out in falling order of their cells on one
device, each to the shard that has fewest cells so far, the first of several.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from harness.contract import FirsthitError
from harness.experiment import plan
from harness.experiment.config import Experiment
from harness.plugins import Catalog

MOST = 10_000  # shards
_WRITTEN = re.compile(r"([0-9]{1,9})/([0-9]{1,9})")


@dataclass(frozen=True)
class Shard:
    """Name a part of a config's plans: the one of this `number`, 1 to `of`, of as many."""

    number: int
    of: int

    def __str__(self) -> str:
        return f"{self.number}/{self.of}"

    def named(self, run: str) -> str:
        """Return the name of the folder of this shard of a run."""
        return f"{run}.shard-{self.number}-of-{self.of}"


@dataclass(frozen=True)
class Share:
    """Hold what a shard has of one config: the names of its groups of cells, and those of its studies."""

    groups: frozenset[str]
    studies: tuple[str, ...]

    @property
    def is_empty(self) -> bool:
        return not self.groups and not self.studies


def read(text: str) -> Shard:
    """Read a shard that is written as 3/16. Raises FirsthitError for another text."""
    found = _WRITTEN.fullmatch(text.strip())
    number, of = map(int, found.groups()) if found else (0, 0)
    if not 1 <= number <= of <= MOST:
        raise FirsthitError(
            f"{text[:40]!r} names no shard; write K/N, such as 3/16 for the third of 16, with N at most {MOST:,}"
        )
    return Shard(number, of)


def shares(parts: Sequence[Experiment], catalog: Catalog, shard: Shard) -> list[Share]:
    """Return what a shard has of each of the configs that are run together."""
    weights: dict[tuple[int, str, bool], int] = {}  # of part, name, and whether that is a study
    for at, part in enumerate(parts):
        weights |= {(at, name, False): cells for name, cells in plan.together(part, catalog).items()}
        weights |= {(at, name, True): 1 for name in part.config.studies}
    dealt = _dealt(list(weights.values()), shard.of)
    own = [name for name, number in zip(weights, dealt, strict=True) if number == shard.number]
    return [
        Share(
            frozenset(name for at, name, is_study in own if at == part and not is_study),
            tuple(name for at, name, is_study in own if at == part and is_study),
        )
        for part in range(len(parts))
    ]


def _dealt(weights: Sequence[int], count: int) -> list[int]:
    """Deal weights out to `count` shards, the heaviest first, each to the lightest shard; return their numbers."""
    loads, found = [0] * count, [0] * len(weights)
    for at in sorted(range(len(weights)), key=lambda at: -weights[at]):
        lightest = min(range(count), key=loads.__getitem__)
        loads[lightest] += weights[at]
        found[at] = lightest + 1
    return found
