"""Make a static site from many runs, and put it in its place whole or not at all."""

from __future__ import annotations

import contextlib
import os
import shutil
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TypedDict

from harness.contract import FirsthitError
from harness.results import declared, sealed
from harness.results.writing import left_in, temporary_folder
from reports.drawing import images, style
from reports.reading import export
from reports.site import board, method_page, other_pages, pictures, run_page, standings, surface_page
from reports.site.cells import Site
from reports.site.gather import Gathered, gather
from reports.site.markup import Frame, slug

HERE = Path(__file__).parent
MARK = "firsthit-site.json"  # lists the files of a site, so that it is known for one


class _Listing(TypedDict):
    """Declare what MARK holds."""

    files: list[str]


_LISTING = declared.checker(_Listing)
TITLE = "firsthit: results"
PARQUET, CSV = "data/results.parquet", "data/results.csv"


def build(folders: Sequence[Path], output: Path, title: str = TITLE, contact: str = "") -> tuple[Path, tuple[str, ...]]:
    """Make the site of the runs in `folders` in the folder `output`; return its first page, and what could not be used.

    `contact` is whom one sends a run to. The new site takes the place of an old one when it is complete; where anything
    fails, the old one stays. Raises FirsthitError where no run can be read, or where `output` holds what is no part of
    a site, lies in a run, or cannot be written.
    """
    place = output.resolve()
    for folder in folders:
        if place == folder.resolve() or folder.resolve() in place.parents:
            raise FirsthitError(f"{output} lies in the run {folder}, which is only read; name another folder by -o")
    _only_ours(place)
    data = gather(folders)
    with _replacing(place) as new:
        problems = _write(new, data, Frame(title), contact)
    return output / "index.html", problems


def _write(folder: Path, data: Gathered, frame: Frame, contact: str) -> tuple[str, ...]:
    """Write the whole site into an empty folder; return what could not be used."""
    races = standings.races(data.frame)
    cells = standings.cells(races)
    full = surface_page.fullest(cells)
    arrays, differing = pictures.recounted(data.shelf, pictures.chosen(cells, full).values())
    scale = images.scale_of(arrays.values())
    drawn = pictures.write(folder, arrays, scale)
    lost = [f"{found.file}: {found.problem}" for found in data.shelf.damaged.values()]
    data = data.with_problems([*lost, *differing])
    names = sorted({*data.methods, *data.frame["method"]})
    taken: set[str] = set()
    pages = {name: slug(name, taken) for name in names}
    site = Site(frame, data, races, cells, style.marks(names), pages, drawn, scale, contact)
    for path, text in _pages(site, folder).items():
        (folder / path).parent.mkdir(exist_ok=True)
        (folder / path).write_text(text, encoding="utf-8")
    for name in ("site.css", "site.js"):
        shutil.copyfile(HERE / name, folder / name)
    files = sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file())
    (folder / MARK).write_bytes(sealed.sealed({"format": 1, "files": files}))
    return data.problems


def _pages(site: Site, folder: Path) -> dict[str, str]:
    """Return every page by its path; the data is written before, so that its page knows the sizes."""
    (folder / "data").mkdir()
    export.write(site.data.frame, folder / CSV, folder / PARQUET, other_pages.MORE, other_pages.BARE)
    sizes = {path: (folder / path).stat().st_size for path in (PARQUET, CSV)}
    page = site.frame.page
    made = {
        "index.html": page("index.html", site.frame.title, *board.body(site), data=board.data(site)),
        "surfaces.html": page("surfaces.html", "Surfaces", *surface_page.index(site)),
        "methods.html": page("methods.html", "Methods", *method_page.index(site)),
        "runs.html": page("runs.html", "Runs", *run_page.index(site)),
        "data.html": page("data.html", "Data", *other_pages.data(site, sizes)),
        "submit.html": page("submit.html", "Submit yours", *other_pages.submit(site)),
    }
    for name, own in surface_page.by_surface(site.cells).items():
        path = f"surfaces/{name}.html"
        made[path] = page(path, own[0].first.surface_title, *surface_page.body(site, name))
    for method, name in site.pages.items():
        path = f"methods/{name}.html"
        made[path] = page(path, site.label(method), *method_page.body(site, method))
    for part in site.data.parts:
        path = f"runs/{part.id}.html"
        made[path] = page(path, part.plan.title or part.plan.name, *run_page.body(site, part))
    return made


def _only_ours(place: Path) -> None:
    """Raise FirsthitError where `place` is no folder, or holds anything that is no file of a site made here."""
    if not os.path.lexists(place):
        return
    if not place.is_dir():
        raise FirsthitError(f"{place} is no folder; nothing was written")
    there = {path.relative_to(place).as_posix() for path in place.rglob("*") if not path.is_dir()}
    foreign = sorted(there - _listed(place))
    if foreign:
        more = f" and {len(foreign) - 1} more" if len(foreign) > 1 else ""
        raise FirsthitError(
            f"{place} holds {foreign[0]}{more}, which is no part of a site of firsthit; nothing was written"
        )


def _listed(place: Path) -> set[str]:
    """Return the files that a site lists as its own; none where there is no list, or it is damaged."""
    try:
        told = sealed.read(place / MARK)
        _LISTING(told, "")
    except (OSError, ValueError):
        return set()
    return {MARK, *told["files"]}


def _put_back(place: Path) -> None:
    """Put the old site back where a process was killed after it had taken it away, and before the new one was there."""
    for left in left_in(place.parent, f".{place.name}"):
        if (left / "old").exists() and not place.exists():
            (left / "old").rename(place)


@contextlib.contextmanager
def _replacing(place: Path) -> Iterator[Path]:
    """Yield an empty folder beside `place`, which takes its place when the block ends.

    Where the block raises, `place` stays as it was. Raises FirsthitError where nothing can be written.
    """
    try:
        place.parent.mkdir(parents=True, exist_ok=True)
        _put_back(place)
        with temporary_folder(f".{place.name}", place.parent) as own:
            new, old = own / "new", own / "old"
            new.mkdir()
            yield new
            if place.exists():
                place.rename(old)
            try:
                new.rename(place)
            except OSError:
                if old.exists():
                    old.rename(place)
                raise
    except OSError as error:
        raise FirsthitError(f"cannot write the site {place}: {error.strerror or error}", exit_code=3) from error
