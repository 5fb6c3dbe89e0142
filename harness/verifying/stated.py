"""Check what a row states twice: in its identity, which its key is the hash of, and in its columns."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from harness.accuracy import check
from harness.contract import CellStatus, FirsthitError, Surface, digest
from harness.hardcases import groups
from harness.scenes.camera import distance_of
from harness.verifying.model import CannotTell, Wrong, differing, is_known, surface_of, view_of
from surfaces.model import domain_text


def stated(row: Mapping[str, Any]) -> Iterator[Wrong]:
    """Yield what a row's key, slot and columns say otherwise than its identity does."""
    identity = row["identity"]
    yield from differing("key", row["key"], digest(row["slot"], identity))
    family = row.get("family")
    sampling = f"{row['size']}x{row['size']}x{row['samples_per_pixel']}"
    where = f"{row['surface']} {row['view']} {sampling}"
    settings = f"{row['precision']} {row['stage']} {row['device']}"
    if family is None:
        yield from differing("comparison", row["comparison"], f"{where} {row['stage']}")
        yield from differing("slot", row["slot"], f"{row['variant']} {where} {settings}")
    else:
        yield from differing("comparison", row["comparison"], f"family {family}")
        name = f"{row['variant']} family {family} {row['precision']} {row['device']}"
        yield from differing("slot", row["slot"], name)
    yield from _columns(row, identity)
    yield from _ended(row, identity)
    if family is not None:
        yield from _of_family(row)
    elif row.get("scene") is None:
        yield from _seen(row)


def _columns(row: Mapping[str, Any], identity: Mapping[str, Any]) -> Iterator[Wrong]:
    if isinstance(identity.get("method"), dict):
        names = {Path(file).parent.name for file in identity["method"]}
        if row["method"] not in names:
            yield Wrong("method", row["method"], f"one of {', '.join(sorted(names))}")
    for name in ("parameters", "precision"):
        if name in identity:
            yield from differing(name, row[name], identity[name])
    if isinstance(identity.get("device"), dict):
        yield from differing("device", row["device"], identity["device"].get("name"))
    if isinstance(identity.get("sampling"), list):
        here = [row["size"], row["samples_per_pixel"], row["stage"]]
        yield from differing("size, samples_per_pixel, stage", here, identity["sampling"])
    programs, program = identity.get("program order"), row.get("program")
    if programs is not None and program is not None and program["hash"] not in programs:
        yield Wrong("program.hash", program["hash"], f"one of {', '.join(map(str, programs))}")


def _ended(row: Mapping[str, Any], identity: Mapping[str, Any]) -> Iterator[Wrong]:
    """Yield what a row's status says otherwise than the rest of it."""
    status, accuracy, choice = row["status"], row.get("accuracy"), identity.get("accuracy")
    if status == CellStatus.OK:
        yield from differing("reason", row["reason"], None)
    elif not row["reason"]:
        yield Wrong("reason", row["reason"], f"why it is {status}")
    if "skip" in identity and (status == CellStatus.SKIPPED) != (identity["skip"] is not None):
        yield Wrong("status", status, "skipped" if identity["skip"] else "tried")
    if status == CellStatus.SKIPPED and "skip" in identity:
        yield from differing("reason", row["reason"], identity["skip"])
    if status != CellStatus.OK and row.get("time"):
        yield Wrong("time", "a time", f"none of a cell that is {status}")
    if accuracy and isinstance(choice, dict) and row["answers"]:
        reason = check.unjudged(accuracy, choice["undecided"])
        if row.get("time"):
            reason = reason or check.too_wrong(accuracy, choice["max_wrong_share"])
        if reason and status == CellStatus.OK:
            yield Wrong("status", status, f"failed: {reason}")


def _of_family(row: Mapping[str, Any]) -> Iterator[Wrong]:
    """Yield what a family's row says otherwise than all of its rows do. Raises CannotTell for a family unknown here."""
    try:
        first = groups.groups(row["family"])[0].surface
    except FirsthitError as error:
        raise CannotTell(str(error)) from None
    for name, found in {"view": "none", "size": 0, "samples_per_pixel": 1, "stage": "rays", "view_set": None}.items():
        yield from differing(name, row.get(name), found)
    if row["identity"].get("family") == groups.identity(row["family"]):
        yield from _of_surface(row, first)


def _of_surface(row: Mapping[str, Any], surface: Surface) -> Iterator[Wrong]:
    """Yield what the columns of a surface that is known here say otherwise than the surface."""
    import surfaces
    from surfaces import formula

    for name, found in {
        "surface": surface.name,
        "surface_title": surface.title,
        "surface_group": surface.group,
        "formula": surface.formula,
        "degree": formula.degree(surfaces.tape_of(surface)),
    }.items():
        yield from differing(name, row.get(name), found)
    if row.get("operations") is not None:
        yield from differing("operations", row["operations"], dict(surfaces.operations(surface)))


def _seen(row: Mapping[str, Any]) -> Iterator[Wrong]:
    """Yield what the columns of surface and view say otherwise than the identity."""
    try:
        surface, view = surface_of(row), view_of(row)
    except CannotTell:
        return
    known = is_known(surface)
    stated_here = replace(surface, title=row["surface_title"], group=row.get("surface_group"))
    yield from _of_surface(row, surface if known else stated_here)
    if row.get("domain") is not None:
        yield from differing("domain", row["domain"], domain_text(surface.domain))
    yield from differing("view", row["view"], view.name)
    yield from differing("view_set", row.get("view_set"), view.set)
    camera = row.get("camera")
    if camera:
        for name in ("azimuth", "elevation", "fov"):
            yield from differing(f"camera.{name}", camera[name], getattr(view, name))
        if view.distance is not None or known:
            yield from differing("camera.distance", camera["distance"], distance_of(view, surface), 1e-12)
