"""State what `firsthit recommend` answers with --json."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from harness.commands.answers.listed import DomainFacts, domain_facts
from harness.contract import Precision, Surface, Variant
from harness.recommend import telling
from harness.recommend.model import Cause, Contender, Fallen, Quantile, Recommendation, Wish, named
from harness.recommend.telling import Told


@dataclass(frozen=True)
class AskedSurface:
    """Say what is to be drawn.

    name: of the catalog; formula where it is a formula of one's own
    title: for people
    formula: f(x, y, z), in the formula language
    parameters: values of the formula's names, as exact decimals
    domain: where it is looked at
    """

    name: str
    title: str
    formula: str
    parameters: Mapping[str, str]
    domain: DomainFacts


@dataclass(frozen=True)
class Asked:
    """Say what was asked for, and how it was searched.

    surface: what is to be drawn
    error: the largest |t - t*| allowed, scene units
    quantile: of which errors that is the bound
    fps: frames per second at least; 0 for any
    require: claims that a method must make
    size: pixels per side of the frames that are timed
    precision: the only one that was tried; null for float32, and float64 where no float32 variant holds
    views: how many views variants are chosen by
    held_out_views: how many others the chosen ones are checked on
    rays: per side that are checked on each view
    seed: of the views
    seconds: of timing for each contender and view
    """

    surface: AskedSurface
    error: float
    quantile: Quantile
    fps: float
    require: Sequence[str]
    size: int
    precision: Precision | None
    views: int
    held_out_views: int
    rays: int
    seed: int
    seconds: float


@dataclass(frozen=True)
class ContenderFacts:
    """Say what is known of a variant that holds on every view.

    variant: its name
    method: its method's name
    knobs: the values of all of the method's knobs
    precision: of its numbers
    ms: the time of a frame, the mean over the views to choose by, ms
    frames_per_second: 1000 over that
    error: the largest certified error on any view, of the quantile asked for, scene units
    evaluations: the largest mean number of evaluations of f per ray on any view
    claims: what its method claims of its answers; `firsthit list methods --json` says what each means
    disproved: those that an answer of this search contradicts
    """

    variant: str
    method: str
    knobs: Mapping[str, float]
    precision: Precision
    ms: float
    frames_per_second: float
    error: float
    evaluations: float
    claims: Sequence[str]
    disproved: Sequence[str]


@dataclass(frozen=True)
class FallenFacts:
    """Say why a variant does not hold, or was not timed further.

    variant: its name
    method: its method's name
    knobs: the values of all of the method's knobs
    precision: of its numbers
    cause: the kind of reason, in the order of the search; slow and frames keep the error
    why: the reason with its figures, which continues a sentence that begins with the variant
    error: the largest certified error that was measured, scene units; null where none was
    times: its time over the fastest's in the same timing; null where it was not timed
    """

    variant: str
    method: str
    knobs: Mapping[str, float]
    precision: Precision
    cause: Cause
    why: str
    error: float | None
    times: float | None


@dataclass(frozen=True)
class MethodSentence:
    """Say in a sentence why a method is not recommended, or which of its variants are not.

    method: its name
    precision: in which it was tried
    sentence: begins with the name
    """

    method: str
    precision: Precision
    sentence: str


@dataclass(frozen=True)
class Safety:
    """Say which rule of safety was applied.

    factor: the error asked for over the one that sampled rays had to keep
    allowed: the error that sampled rays had to keep, scene units
    text: the same in words, with the figures
    """

    factor: float
    allowed: float
    text: str


@dataclass(frozen=True)
class CheckedRays:
    """Say on what the recommended variant was checked.

    held_out_rays: how many rays were judged on the views held out
    decided_hits: how many hits the oracle decided, on all views
    undecided_hits: how many it left undecided; they bound no error
    text: the same in words; null where nothing is recommended
    """

    held_out_rays: int
    decided_hits: int
    undecided_hits: int
    text: str | None


@dataclass(frozen=True)
class Recommend:
    """Name the fastest variant that keeps an error, and say why the others are not it.

    Exit code 0: a variant is recommended; 1: none holds.

    question: what was asked, in words
    asked: what was asked
    device: the name of the device that it is for
    answer: what is recommended, in words
    recommended: the first of `contenders`; null where none holds
    guarantee: what its method guarantees, in words; null where none holds
    rule: which rule of safety was applied
    checked: on what it was checked
    contenders: the variants that hold on every view, the fastest first
    fallen: all other variants
    methods: a sentence for each method, that of the best first
    remark: what is to be known of a surface that its domain cuts or does not hold; null where nothing is
    again: the command that searches the same again
    ship: the command that writes the recommended variant's program; null where none holds
    page: the file that the page was written to; null without one
    folder: where the rows are
    """

    question: str
    asked: Asked
    device: str
    answer: str
    recommended: ContenderFacts | None
    guarantee: str | None
    rule: Safety
    checked: CheckedRays
    contenders: Sequence[ContenderFacts]
    fallen: Sequence[FallenFacts]
    methods: Sequence[MethodSentence]
    remark: str | None
    again: str
    ship: str | None
    page: str | None
    folder: str


@dataclass(frozen=True)
class Beside:
    """Hold what a command knows beside what was found: see Recommend."""

    again: str
    ship: str | None
    page: Path | None


def recommend(found: Recommendation, wish: Wish, beside: Beside) -> Recommend:
    """Return what is said of a search."""
    contenders = [_contender(contender) for contender in found.contenders]
    best = found.contenders[0] if found.contenders else None
    text = telling.checked(found, wish) if best else None
    return Recommend(
        question=telling.question(found, wish),
        asked=_asked(wish),
        device=found.device.name,
        answer=telling.answer(found, wish),
        recommended=contenders[0] if contenders else None,
        guarantee=telling.guarantee(best) if best else None,
        rule=Safety(wish.error / wish.target, wish.target, telling.rule(found, wish)),
        checked=CheckedRays(found.held_out, found.decided, found.undecided, text),
        contenders=contenders,
        fallen=[_fallen(fallen) for fallen in found.fallen],
        methods=[_sentence(told) for told in telling.others(found, wish)],
        remark=found.extent,
        again=beside.again,
        ship=beside.ship,
        page=None if beside.page is None else str(beside.page),
        folder=str(found.folder),
    )


def _asked(wish: Wish) -> Asked:
    return Asked(
        surface=_surface(wish.surface),
        error=wish.error,
        quantile=wish.quantile,
        fps=wish.fps,
        require=wish.require,
        size=wish.size,
        precision=wish.precision,
        views=wish.views,
        held_out_views=wish.held_out_views,
        rays=wish.rays,
        seed=wish.seed,
        seconds=wish.seconds,
    )


def _surface(surface: Surface) -> AskedSurface:
    return AskedSurface(
        surface.name, surface.title, surface.formula, dict(surface.parameters), domain_facts(surface.domain)
    )


def _contender(of: Contender) -> ContenderFacts:
    figures = of.ms, 1e3 / of.ms, of.error, of.evaluations
    return ContenderFacts(*_names(of.variant), of.precision, *figures, of.claims, of.disproved)


def _fallen(of: Fallen) -> FallenFacts:
    return FallenFacts(*_names(of.variant), of.precision, of.cause, of.why, of.error, of.times)


def _names(variant: Variant) -> tuple[str, str, dict[str, float]]:
    return named(variant), variant.method, dict(variant.parameters)


def _sentence(told: Told) -> MethodSentence:
    return MethodSentence(told.method, told.precision, told.sentence)
