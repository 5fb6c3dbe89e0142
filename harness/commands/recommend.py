"""Offer `firsthit recommend`: the fastest variant within an error."""

from __future__ import annotations

import argparse
import importlib.util
import textwrap
from pathlib import Path

from harness import console
from harness.commands import Add
from harness.commands.answers import recommending
from harness.commands.answers.recommending import Beside
from harness.commands.machine import Answer, add_json
from harness.commands.options import (
    add_jobs,
    add_surface,
    add_wait,
    add_yes,
    methods_of,
    number,
    surface_of,
    surface_words,
    typed,
    whole,
    writable,
)
from harness.commands.printer import Printer
from harness.commands.shipping import command_for
from harness.contract import CLAIMS, PRECISIONS, FirsthitError
from harness.escaping import shell
from harness.limits import PIXELS, RAYS, SEED
from harness.plugins import Catalog
from harness.recommend import telling
from harness.recommend.model import ERROR, FPS, HEADROOM, QUANTILES, SECONDS, VIEWS, Recommendation, Wish, named
from harness.recommend.search import recommend

NOTHING_HOLDS = 1
PAGES = (".pdf", ".html", ".png")
WIDTH = 118  # characters of a line that is printed
USUAL = {
    "quantile": "max",
    "fps": 0.0,
    "size": 512,
    "precision": None,
    "views": 5,
    "rays": 64,
    "seconds": 1.0,
    "seed": 1,
}


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
        default=USUAL["quantile"],
        help=f"of the errors that must keep E; max leaves a factor {HEADROOM:g} for rays not sampled (default: max)",
    )
    fps, size, views = USUAL["fps"], USUAL["size"], USUAL["views"]
    parser.add_argument("--fps", type=number(FPS), default=fps, metavar="N", help="frames per second at least")
    claims = f"only methods that claim this of their answers: {', '.join(CLAIMS)}; may be repeated"
    parser.add_argument("--require", action="append", default=[], metavar="CLAIM", help=claims)
    parser.add_argument(
        "--size", type=whole(PIXELS), default=size, help="pixels per side that are timed (default: 512)"
    )
    parser.add_argument("--precision", choices=PRECISIONS, help="default: float32, and float64 where none holds")
    parser.add_argument("--device", metavar="NAME", help="see `firsthit list devices`; default: the first usable one")
    parser.add_argument(
        "--views", type=whole(VIEWS), default=views, metavar="N", help="views to choose by (default: 5)"
    )
    rays = "rays per side checked a view (default: 64)"
    parser.add_argument("--rays", type=whole(RAYS), default=USUAL["rays"], metavar="N", help=rays)
    seconds = "of timing a variant and view (default: 1)"
    parser.add_argument("--seconds", type=number(SECONDS), default=USUAL["seconds"], metavar="S", help=seconds)
    parser.add_argument("--seed", type=whole(SEED), default=USUAL["seed"], help="of the views (default: 1)")
    parser.add_argument("--runs", type=Path, default=Path("runs"), metavar="DIR", help="rows go here (default: runs)")
    add_jobs(parser)
    add_wait(parser)
    add_yes(parser, "checks")
    page = "write the answer as a page with a picture and its error map: FILE.pdf, FILE.html or FILE.png"
    parser.add_argument("-o", "--output", type=Path, metavar="FILE", help=page)
    add_json(parser)
    parser.set_defaults(run=_recommend)


def _recommend(options: argparse.Namespace) -> int | Answer:
    surface, page = surface_of(options), options.output
    wish = Wish(
        surface=surface,
        error=options.error,
        quantile=options.quantile,
        fps=options.fps,
        size=options.size,
        precision=options.precision,
        views=options.views,
        rays=options.rays,
        seed=options.seed,
        seconds=options.seconds,
        require=tuple(dict.fromkeys(options.require)),
    )
    if page is not None:
        _check_page(page)
    catalog = methods_of(options)
    stated = wish, catalog, options.device, options.runs, _Printer()
    pictured, wait, yes = page is not None, options.wait, options.yes
    found = recommend(*stated, pictured=pictured, command=typed(), wait=wait, yes=yes)
    again, ship = _commands(found, options, catalog)
    beside = Beside(again, ship, page)
    code = 0 if found.contenders else NOTHING_HOLDS
    if page is not None:
        from harness.commands.recommended import write_page

        write_page(found, wish, beside, page)
    if options.json:
        return Answer(recommending.recommend(found, wish, beside), code)
    print(printed(found, wish, beside))
    if page is not None:
        print(f"\npage       {page}")
    return code


class _Printer(Printer):
    """Prints the search's steps on standard error, since standard output has the recommendation alone."""

    def told(self, line: str) -> None:
        self.warned(line)


def _check_page(path: Path) -> None:
    """Raise FirsthitError, before long work, where no page can be written to `path`, or a package for it is missing."""
    if writable(path).suffix.lower() not in PAGES:
        raise FirsthitError(f"cannot write {path}: a page is one of {', '.join(PAGES)}; name it {path.stem}.pdf")
    for package in ("matplotlib", "pandas", "PIL", "typst"):
        if not importlib.util.find_spec(package):
            raise FirsthitError(f"a page needs the package {package}: pip install 'firsthit[report]'", exit_code=3)


def _commands(found: Recommendation, options: argparse.Namespace, catalog: Catalog) -> tuple[str, str | None]:
    """Return the commands that make the same search again and that ship what is recommended; None where nothing is."""
    words = ["firsthit", "recommend", *surface_words(options), "--error", f"{options.error:g}"]
    given = {name: getattr(options, name) for name, usual in USUAL.items() if getattr(options, name) != usual}
    words += [word for name, value in given.items() for word in (f"--{name}", str(value))]
    words += [word for claim in options.require for word in ("--require", claim)]
    words += ["--plugins", str(options.plugins)] if options.plugins else []
    words += ["--yes"] if options.yes else []
    again = shell([*words, "--device", found.device.name])
    if not found.contenders:
        return again, None
    best = found.contenders[0]
    made = command_for(options, catalog, best.variant, best.precision)
    return again, f"{made} --device {found.device.name} -o DIR"


def printed(found: Recommendation, wish: Wish, beside: Beside) -> str:
    """Say what is asked, what is recommended, how fast and how certain it is, and why the others are not."""
    told = {"question": telling.question(found, wish), "answer": telling.answer(found, wish)}
    told |= {"mind": telling.mind(found)} if found.extent else {}
    told |= telling.certainty(found, wish)
    parts = [_paragraph(name, text) for name, text in told.items()]
    if found.contenders:
        parts += ["", _table(found, wish)]
    parts += ["", "Why other variants are not recommended, a sentence for each method:"]
    for other in telling.others(found, wish):
        parts.append(textwrap.fill(other.sentence, WIDTH, initial_indent="- ", subsequent_indent="  "))
    parts += ["", f"again      {beside.again}", *([f"ship       {beside.ship}"] if beside.ship else [])]
    return "\n".join(parts)


def _paragraph(name: str, text: str) -> str:
    return textwrap.fill(text, WIDTH, initial_indent=f"{name:<10} ", subsequent_indent=" " * 11, break_on_hyphens=False)


def _table(found: Recommendation, wish: Wish) -> str:
    best = found.contenders[0]
    columns = ("variant", "precision", "ms", "times", f"{wish.quantile} error", "evaluations", "claims")
    rows = [
        (
            named(c.variant),
            c.precision,
            f"{c.ms:.3g}",
            f"{'≈ ' if c.variant in found.alike else ''}{c.ms / best.ms:.3g}",
            f"{c.error:.2g}",
            f"{c.evaluations:.4g}",
            ", ".join(c.claims) or "none",
        )
        for c in found.contenders
    ]
    return console.table(columns, rows)
