"""Offer `firsthit recommend`: the fastest variant within an error."""

from __future__ import annotations

import argparse
from pathlib import Path

from harness import console
from harness.commands import Add
from harness.commands.options import add_surface, methods_of, number, surface_of, whole
from harness.commands.printer import Printer
from harness.contract import PRECISIONS
from harness.limits import PIXELS, RAYS, SECONDS, SEED
from harness.recommend.search import (
    ERROR,
    FPS,
    HEADROOM,
    QUANTILES,
    VIEWS,
    Fallen,
    Recommendation,
    Wish,
    named,
    recommend,
)

NOTHING_HOLDS = 1
REASON = 110  # characters of a reason that are printed


def add_parsers(add: Add) -> None:
    parser = add(
        "recommend",
        "firsthit recommend --formula 'x^4 + y^4 + z^4 - 1' --error 1e-5",
        "Check every method, with its papers' settings and its knobs' sweeps, against the oracle on "
        "sampled views; time those within the bound, interleaved; check the fastest once more on views held out. "
        "Exit codes: 0 a variant is recommended, 1 none holds, 2 usage, 3 something failed while running.",
    )
    add_surface(parser)
    parser.add_argument("--error", type=number(ERROR), required=True, metavar="E", help="largest |t - t*|, scene units")
    parser.add_argument(
        "--quantile",
        choices=QUANTILES,
        default="max",
        help=f"of the errors that must keep E; max leaves a factor {HEADROOM:g} for rays not sampled (default: max)",
    )
    parser.add_argument("--fps", type=number(FPS), default=0.0, metavar="N", help="frames per second at least")
    parser.add_argument("--size", type=whole(PIXELS), default=512, help="pixels per side that are timed (default: 512)")
    parser.add_argument("--precision", choices=PRECISIONS, help="default: float32, and float64 where none holds")
    parser.add_argument("--device", metavar="NAME", help="see `firsthit list devices`; default: the first usable one")
    parser.add_argument("--views", type=whole(VIEWS), default=5, metavar="N", help="views to choose by (default: 5)")
    rays = "rays per side checked a view (default: 64)"
    parser.add_argument("--rays", type=whole(RAYS), default=64, metavar="N", help=rays)
    seconds = "of timing a variant and view (default: 1)"
    parser.add_argument("--seconds", type=number(SECONDS), default=1.0, metavar="S", help=seconds)
    parser.add_argument("--seed", type=whole(SEED), default=1, help="of the views (default: 1)")
    parser.add_argument("--runs", type=Path, default=Path("runs"), metavar="DIR", help="rows go here (default: runs)")
    parser.set_defaults(run=_recommend)


def _recommend(options: argparse.Namespace) -> int:
    wish = Wish(
        surface=surface_of(options),
        error=options.error,
        quantile=options.quantile,
        fps=options.fps,
        size=options.size,
        precision=options.precision,
        views=options.views,
        rays=options.rays,
        seed=options.seed,
        seconds=options.seconds,
    )
    found = recommend(wish, methods_of(options), options.device, options.runs, _Printer())
    print(_answer(found, wish))
    return 0 if found.contenders else NOTHING_HOLDS


class _Printer(Printer):
    """Prints the search's steps on standard error, since standard output has the recommendation alone."""

    def told(self, line: str) -> None:
        self.warned(line)


def _answer(found: Recommendation, wish: Wish) -> str:
    """Say which variant is recommended, how fast and how certain it is, and why the other variants were dropped."""
    device = found.device
    bound = f"a {wish.quantile} error of {wish.error:.2g}"
    if not found.contenders:
        head = f"Nothing draws {wish.surface.title} on {device.name} within {bound}. Why each variant fell:"
        return "\n".join([head, _fallen(found), *([told] if (told := _undecided(found)) else []), *_extent(found)])
    best = found.contenders[0]
    speed = f"{best.ms:.3g} ms a frame, {1e3 / best.ms:.3g} frames/s at {wish.size}x{wish.size}"
    views = f"{wish.views} views to choose by and {wish.held_out_views} held out"
    columns = ("variant", "precision", "ms", "times", f"{wish.quantile} error", "evaluations")
    rows = [
        (
            named(c.variant),
            c.precision,
            f"{c.ms:.3g}",
            f"{c.ms / best.ms:.3g}",
            f"{c.error:.2g}",
            f"{c.evaluations:.4g}",
        )
        for c in found.contenders
    ]
    return "\n".join(
        [
            f"{named(best.variant)} in {best.precision} is the fastest that draws {wish.surface.title} within {bound} "
            f"on {device.name}: {speed}.",
            f"Outside the grazing and the drowned class no ray is wrong on {views}. Were more than a share of "
            f"{3.0 / found.held_out:.1e} wrong, the {found.held_out} held-out rays would have shown it 19 times in 20.",
            *([told] if (told := _undecided(found)) else []),
            *_extent(found),
            "",
            console.table(columns, rows),
            "",
            "Why the others fell:",
            _fallen(found),
        ]
    )


def _undecided(found: Recommendation) -> str:
    """Say how many hits the oracle could not decide; "" where it decided all."""
    if not found.undecided:
        return ""
    return (
        f"The oracle left {found.undecided} of {found.decided + found.undecided} hits undecided; they bound no error."
    )


def _extent(found: Recommendation) -> list[str]:
    """Say that the surface is cut, and the answer is for what the domain leaves of it."""
    return [f"{found.extent}. The answer is for what this domain leaves of it."] if found.extent else []


def _fallen(found: Recommendation) -> str:
    """Write a line for each variant that fell; one line for all variants of a method that fell for the same reason."""
    grouped: dict[tuple[str, str, str], list[Fallen]] = {}
    for fallen in found.fallen:
        grouped.setdefault((fallen.variant.method, fallen.precision, fallen.why), []).append(fallen)
    rows = []
    for (method, precision, why), alike in grouped.items():
        name = named(alike[0].variant) if len(alike) == 1 else f"{method}, {len(alike)} variants"
        rows.append((name, precision, why if len(why) <= REASON else why[: REASON - 2] + " …"))
    return console.table(("variant", "precision", "why"), rows) if rows else "none did"
