"""Put what a search found into plain sentences, for terminals, pages and scripts alike."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from harness.contract import CLAIMS, Precision, Surface, Variant, plural
from harness.recommend.model import HEADROOM, Cause, Contender, Fallen, Recommendation, Wish, named

BEST_FIRST = (
    Cause.FRAMES,
    Cause.SLOW,
    Cause.ERROR,
    Cause.WRONG,
    Cause.UNMEASURED,
    Cause.FAILED,
    Cause.REFUSED,
    Cause.CLAIM,
)  # how far a variant came before it fell
QUANTILE_NAMES = {"max": "largest error", "p999": "99.9th percentile of errors", "p99": "99th percentile of errors"}
MOST_ALIKE = 3  # variants that a sentence names
LONGEST = 160  # characters of a reason that is quoted beside others


@dataclass(frozen=True)
class Told:
    """Say of a method, in a precision, why it was not recommended.

    best: of its variants the one that came farthest
    error, times: of that variant, as in Contender and Fallen; None where they are not known
    sentence: begins with the method's name
    """

    method: str
    precision: Precision
    best: Variant
    error: float | None
    times: float | None
    sentence: str


def subject(surface: Surface) -> str:
    """Return what sentences call a surface: its title, or "this surface" where that is a formula's start."""
    return "this surface" if surface.title.endswith("...") else surface.title


def question(found: Recommendation, wish: Wish) -> str:
    """Say what was asked for."""
    speed = f", at {wish.fps:g} frames a second or more" if wish.fps else ""
    claims = f", by a method that claims {' and '.join(wish.require)}" if wish.require else ""
    bound = f"with a {QUANTILE_NAMES[wish.quantile]} of at most {wish.error:.3g} along the ray"
    return f"Which method draws {subject(wish.surface)} fastest on {found.device.name}, {bound}{speed}{claims}?"


def answer(found: Recommendation, wish: Wish) -> str:
    """Say what is recommended and how fast it is, or that nothing is."""
    if not found.contenders:
        return f"No method draws {subject(wish.surface)} so on {found.device.name}."
    best = found.contenders[0]
    speed = f"{best.ms:.3g} ms a frame, {1e3 / best.ms:,.4g} frames a second at {wish.size}x{wish.size}"
    told = [named(variant) for variant in found.alike[:MOST_ALIKE]]
    told += [f"{len(found.alike) - MOST_ALIKE} more"] if len(found.alike) > MOST_ALIKE else []
    alike = (
        f" Its time is not told apart from {'that' if len(told) == 1 else 'those'} of {_listed(told)}." if told else ""
    )
    return f"{named(best.variant)} in {best.precision}: {speed}.{alike}"


def _listed(names: Sequence[str]) -> str:
    """Join names as a sentence does: a, b and c."""
    return " and ".join(filter(None, (", ".join(names[:-1]), *names[-1:])))


def rule(found: Recommendation, wish: Wish) -> str:
    """Say which rule of safety was applied, with its figures."""
    if wish.quantile != "max":
        told = (
            f"No factor of safety: the {wish.error:.2g} asked for bound the {QUANTILE_NAMES[wish.quantile]}; single "
            "rays may be worse."
        )
    else:
        told = (
            f"A factor of {HEADROOM:g}: rays that were not sampled may be worse than those that were, so every sampled "
            f"ray had to stay within {wish.target:.2g}, half of the {wish.error:.2g} asked for."
        )
    if not found.contenders:
        return told
    error = found.contenders[0].error
    margin = f", {wish.error / error:,.{0 if wish.error > 100 * error else 1}f} times below the bound" if error else ""
    return f"{told} The {QUANTILE_NAMES[wish.quantile]} measured is {error:.2g}{margin}."


def guarantee(best: Contender) -> str:
    """Say in words what the method of a contender guarantees."""
    if not best.claims:
        return (
            f"No guarantee: {best.variant.method} claims nothing of its answers. What is said here is of the rays that "
            "were sampled."
        )
    claims = "; ".join(f"{claim} ({CLAIMS[claim]})" for claim in best.claims)
    against = (
        f"But answers of this search disprove {' and '.join(best.disproved)}."
        if best.disproved
        else "No answer of this search disproves it."
    )
    return f"{best.variant.method} claims {claims}. {against}"


def checked(found: Recommendation, wish: Wish) -> str:
    """Say on how many rays the recommended variant was checked, and what this says of other rays."""
    chosen_by = f"{plural(wish.views, 'view')} to choose by"
    views = f"{chosen_by} and {wish.held_out_views} held out, of {wish.rays}x{wish.rays} rays each"
    told = f"Outside the grazing and the drowned class no ray is wrong on {views}."
    if found.picture is not None:
        accuracy = found.picture["accuracy"]
        told += f" The same holds for the picture's {accuracy['size']}x{accuracy['size']} rays."
    chance = f" Were more than a share of {3.0 / found.held_out:.1e} wrong, the {found.held_out} held-out rays would "
    return f"{told}{chance}have shown it 19 times in 20.{undecided(found)}"


def undecided(found: Recommendation) -> str:
    """Say, with a space before it, how many hits the oracle could not decide; "" where it decided all."""
    if not found.undecided:
        return ""
    hits = found.decided + found.undecided
    return f" The oracle left {found.undecided} of {plural(hits, 'hit')} undecided; they bound no error."


def mind(found: Recommendation) -> str:
    """Say that the domain cuts the surface, where it does, and what the answer is for."""
    return f"{found.extent}. The answer is for what this domain leaves of it." if found.extent else ""


def certainty(found: Recommendation, wish: Wish) -> dict[str, str]:
    """Return sentences on how certain the answer is, by what they are about."""
    told = {"rule": rule(found, wish)}
    if found.contenders:
        return told | {"guarantee": guarantee(found.contenders[0]), "checked": checked(found, wish)}
    return told | ({"checked": undecided(found).strip()} if found.undecided else {})


def others(found: Recommendation, wish: Wish) -> list[Told]:
    """Say of each method why it is not recommended, or which of its variants are not; who came farthest comes first."""
    holding: dict[tuple[str, Precision], list[Contender]] = {}
    fell: dict[tuple[str, Precision], list[Fallen]] = {}
    for contender in found.contenders:
        holding.setdefault((contender.variant.method, contender.precision), []).append(contender)
    for fallen in sorted(found.fallen, key=_place):
        fell.setdefault((fallen.variant.method, fallen.precision), []).append(fallen)
    keys = dict.fromkeys([*holding, *fell])  # both are in the order of who came farthest
    return [_told(*key, holding.get(key, []), fell.get(key, []), found, wish) for key in keys]


def _place(fallen: Fallen) -> tuple[int, float, float]:
    return BEST_FIRST.index(fallen.cause), fallen.times or 0.0, fallen.error or 0.0


def _told(
    method: str, precision: Precision, mine: list[Contender], fell: list[Fallen], found: Recommendation, wish: Wish
) -> Told:
    """Make the sentence on one method from its variants that hold, the fastest first, and those that fell."""
    clauses = []
    first = found.contenders[0] if found.contenders else None
    if mine and first:
        rest = mine[1:] if mine[0] is first else mine
        if mine[0] is first:
            clauses.append(f"is recommended {how(first.variant)}")
        if rest:
            times = [f"{contender.ms / first.ms:.3g}" for contender in rest]
            spread = times[0] if len(rest) == 1 else f"{times[0]} to {times[-1]}"
            who = how(rest[0].variant) if len(rest) == 1 else f"in {len(rest)} variants"
            clauses.append(f"holds {who}, at {spread} times the recommended one's time")
    for cause in BEST_FIRST:
        if alike := [fallen for fallen in fell if fallen.cause is cause]:
            clauses.append(_clause(cause, alike, len(mine) + len(fell), wish))
    best = mine[0] if mine else fell[0]
    error = best.error
    times_of = best.ms / first.ms if isinstance(best, Contender) and first else getattr(best, "times", None)
    return Told(method, precision, best.variant, error, times_of, f"{method} {'; '.join(clauses)}.")


def how(variant: Variant) -> str:
    """Say with which values of its knobs a variant is meant."""
    label = str(variant)
    if label == variant.method:
        return "with its defaults"
    if label.startswith(variant.method):
        return f"with {label.removeprefix(variant.method).strip(' []')}".replace(",", ", ")
    return f"with the setting “{label}”"


def _clause(cause: Cause, alike: Sequence[Fallen], of: int, wish: Wish) -> str:
    """Write what befell variants of one method for the same cause, the best of them first; `of` is all variants."""
    best = alike[0]
    if of == 1 or (len(alike) == of and len({fallen.why for fallen in alike}) == 1):
        return best.why
    if len(alike) == 1:
        return f"{how(best.variant)} {best.why}"
    many = f"in all {of} variants" if len(alike) == of else f"in {len(alike)} variants"
    match cause:
        case Cause.SLOW:
            times = [fallen.times or 0.0 for fallen in alike]
            spread = f"{min(times):.3g} to {max(times):.3g} times"
            return f"keeps the error {many}, which take {spread} as long as the fastest in a first, short timing"
        case Cause.ERROR:
            errors = [fallen.error or 0.0 for fallen in alike]
            return f"has errors of {min(errors):.2g} to {max(errors):.2g} {many}, over the {wish.target:.2g} allowed"
        case Cause.FRAMES:
            return f"is too slow {many}: the fastest {best.why}"
        case Cause.WRONG:
            return f"is wrong on rays {many}: for example, {how(best.variant)} it {_cut(best.why)}"
    return f"falls {many}: for example, {how(best.variant)} it {_cut(best.why)}"


def _cut(text: str) -> str:
    return text if len(text) <= LONGEST else f"{text[: LONGEST - 2].rstrip()} …"
