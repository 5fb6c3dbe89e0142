"""Run a campaign: many trials, each made by chance from the campaign's seed and its own number, and so repeatable.

Trials run in blocks, and what a block found is kept as soon as it ends. A campaign that was stopped goes on from there.
"""

from __future__ import annotations

import contextlib
import importlib
import json
import os
import random
import shutil
import signal
import sys
import tempfile
import threading
import time
import traceback
from collections import Counter
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, ProcessPoolExecutor, wait
from dataclasses import dataclass, field
from multiprocessing import get_context, parent_process
from pathlib import Path
from typing import Any

from harness.results.sources import digest_of

# What a result is of: all that a campaign tries, the campaigns, and what they make and know of it
MADE = (
    "agreeing_rows",
    "exact_roots",
    "exact_surfaces",
    "fuzz_formulas",
    "hostile_texts",
    "kept_runs",
    "made_formulas",
)
CODE = ("harness", "surfaces", "methods", "reports", "tests/campaigns", *(f"tests/{name}.py" for name in MADE))
_ending = threading.Event()  # a trial ends what it started
ENDINGS: list[Callable[[], None]] = []  # to be called when a trial ends, however it ends
KEPT = 20  # trials that fell whose words are kept


class Fell(Exception):
    """Say that what may not happen did happen, with all that is needed to understand it."""


@dataclass(frozen=True)
class Place:
    """Hold the folders of a trial.

    shared: of the campaign; `prepare` filled it, and no trial changes it
    own: empty when the trial begins, and removed after it
    """

    shared: Path
    own: Path


@dataclass(frozen=True)
class Campaign:
    """State a campaign: what it tries, and what may not happen.

    name: one word, which is also its module's name
    tries: what each trial does, in one sentence
    promise: what may not happen, in one sentence that begins with "no"
    trial: tries `each` cases with the dice that it is given, and returns what happened in a few words, or counts them
        where it tries several. Raises Fell, or any other error, where the promise does not hold
    small: cases of the part that the ordinary tests run, a few seconds in all
    whole: cases of the campaign
    each: cases of a trial
    block: trials after which what was found is kept
    prepare: fills the shared folder once
    limit: seconds of one trial, after which it counts as a hang
    first: the number of the small part's first trial, where trials differ in how long they take
    """

    name: str
    tries: str
    promise: str
    trial: Callable[[random.Random, Place], str | Counter[str]]
    small: int
    whole: int
    each: int = 1
    block: int = 1
    prepare: Callable[[Path], None] = lambda _: None
    limit: int = 120
    first: int = 0


@dataclass
class Found:
    """Hold what trials found: how often each outcome was met, and the numbers and words of those that fell."""

    cases: int = 0
    seconds: float = 0.0
    counts: Counter[str] = field(default_factory=Counter)
    fell: int = 0
    told: list[str] = field(default_factory=list)

    def add(self, other: Found) -> None:
        """Add what other trials found."""
        self.cases += other.cases
        self.seconds += other.seconds
        self.counts.update(other.counts)
        self.fell += other.fell
        self.told = [*self.told, *other.told][:KEPT]


def campaign_named(name: str) -> Campaign:
    """Return the campaign that the module of this name states."""
    campaign: Campaign = importlib.import_module(f"tests.campaigns.{name}").CAMPAIGN
    return campaign


def names() -> list[str]:
    """List the campaigns, sorted."""
    modules = {path.stem for path in Path(__file__).parent.glob("*.py") if "\nCAMPAIGN = " in path.read_text()}
    return sorted(modules)


def trials(campaign: Campaign, seed: int, numbers: range, shared: Path) -> Found:
    """Make the trials of these numbers, one after the other."""
    found = Found()
    for number in numbers:
        start = time.monotonic()
        try:
            outcome: str | Counter[str] = _tried(campaign, seed, number, shared)
        except Exception as error:  # whatever a trial raises is a promise that does not hold
            told = str(error) if isinstance(error, Fell) else traceback.format_exc()
            outcome = "fell"
            found.fell += 1
            found.told = [*found.told, f"trial {number}: {told}"][:KEPT]
        found.cases += campaign.each
        found.counts.update([outcome] if isinstance(outcome, str) else outcome)
        found.seconds += time.monotonic() - start
    return found


def _tried(campaign: Campaign, seed: int, number: int, shared: Path) -> str | Counter[str]:
    dice = random.Random(f"{campaign.name} {seed} {number}")
    with tempfile.TemporaryDirectory(prefix="firsthit-campaign-") as own, _limited(campaign.limit):
        try:
            return campaign.trial(dice, Place(shared, Path(own)))
        finally:
            _ending.set()
            try:
                while ENDINGS:
                    ENDINGS.pop()()
            finally:
                _ending.clear()


@contextlib.contextmanager
def _limited(seconds: int) -> Iterator[None]:
    """Raise Fell in a block that takes longer than `seconds`."""

    def late(*_: Any) -> None:
        raise Fell(f"it took longer than {seconds} s")

    before = signal.signal(signal.SIGALRM, late)
    signal.alarm(seconds)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)


def code() -> str:
    """Return a hash of all that a campaign tries, and of the campaigns: results of other code are not counted."""
    return digest_of(*CODE)[:8]


def kept_in(folder: Path, seed: int) -> Path:
    """Return the file that keeps what a campaign found with this seed and this code."""
    return folder / f"seed-{seed}-{code()}.jsonl"


def read_kept(path: Path) -> tuple[Found, set[int]]:
    """Return what an earlier call found, and the first numbers of the blocks that it made."""
    whole, done = Found(), set[int]()
    for line in path.read_text().splitlines() if path.exists() else []:
        with contextlib.suppress(ValueError):  # the last line, where it was stopped while writing
            read = json.loads(line)
            done.add(read.pop("first"))
            whole.add(Found(**read | {"counts": Counter(read["counts"])}))
    return whole, done


def prepared(campaign: Campaign, folder: Path) -> Path:
    """Return the shared folder of a campaign, which is filled once for each state of the code."""
    shared = folder / f"shared-{code()}"
    if not shared.exists():
        making = folder / "making"
        shutil.rmtree(making, ignore_errors=True)
        making.mkdir(parents=True)
        campaign.prepare(making)
        making.rename(shared)
    return shared


def run(campaign: Campaign, seed: int, count: int, folder: Path, jobs: int, tell: Callable[[Found], None]) -> Found:
    """Try `count` cases in `jobs` processes, and return what all of them found, with those of an earlier call.

    `folder` keeps what each block found, for this seed and this code; `tell` hears of the whole after each block.
    """
    numbers_of_all, shared = -(-count // campaign.each), prepared(campaign, folder)
    kept = kept_in(folder, seed)
    whole, done = read_kept(kept)
    todo = [first for first in range(0, numbers_of_all, campaign.block) if first not in done]
    pool = ProcessPoolExecutor(jobs, get_context("spawn"), initializer=_quiet)
    with kept.open("a") as file:
        waiting: dict[Any, int] = {}
        try:
            while todo or waiting:
                while todo and len(waiting) < jobs:
                    first = todo.pop(0)
                    numbers = range(first, min(first + campaign.block, numbers_of_all))
                    waiting[pool.submit(_block, campaign.name, seed, numbers, shared)] = first
                for future in wait(waiting, return_when=FIRST_COMPLETED).done:
                    found, first = future.result(), waiting.pop(future)
                    whole.add(found)
                    file.write(json.dumps({"first": first, **vars(found)}) + "\n")
                    file.flush()
                    tell(whole)
        finally:
            if todo or waiting:  # it was stopped
                for process in list(pool._processes.values()):
                    process.terminate()
            pool.shutdown(cancel_futures=True)
    return whole


def _quiet() -> None:
    """Leave Ctrl-C and SIGHUP to the campaign, which ends its processes by SIGTERM; so does its own end, by any signal.

    A trial that is under way then ends what it started.
    """

    def follow() -> None:
        if campaign := parent_process():
            campaign.join()
            while True:  # a signal that comes just before the process begins to wait does not wake it
                os.kill(os.getpid(), signal.SIGTERM)
                time.sleep(1.0)

    for number in (signal.SIGINT, signal.SIGHUP):
        signal.signal(number, lambda *_: None)  # what is ignored, the commands that trials start would ignore too
    signal.signal(signal.SIGTERM, _leave)
    threading.Thread(target=follow, daemon=True).start()


def _leave(*_: Any) -> None:
    """End this process at once: between blocks it has nothing to end, and the pool would print what is raised then."""
    os._exit(128 + signal.SIGTERM)


def _end_trial(*_: Any) -> None:
    """Raise SystemExit, and ask again a second later: what runs now may drop it, as Python does in a callback.

    A trial that ends what it started is not disturbed.
    """
    threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGTERM)).start()
    if not _ending.is_set():
        raise SystemExit


def _dropped(error: Any) -> None:
    if error.exc_type is not SystemExit:
        sys.__unraisablehook__(error)


def _block(name: str, seed: int, numbers: range, shared: Path) -> Found:
    sys.unraisablehook = _dropped
    signal.signal(signal.SIGTERM, _end_trial)
    try:
        return trials(campaign_named(name), seed, numbers, shared)
    except SystemExit:  # the pool would take it for the block's result, and wait for another one
        _leave()
        raise
    finally:
        signal.signal(signal.SIGTERM, _leave)
