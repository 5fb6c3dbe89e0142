"""Go through all checks of a method on a bench, part by part.

A new kind of check is one more function in EXAMINATIONS.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from harness.conformance.cases import (
    OUTSIDE,
    Bench,
    Case,
    Finding,
    not_checked,
    refusal,
    touch_cases,
    view_case,
    views_case,
)
from harness.conformance.checks import CLAIM_CHECKS, agreement, answers, decided, finds_touch, same_bits
from harness.conformance.knobs import settings_of, swept
from harness.contract import PRECISIONS, Precision, Surface
from harness.plugins import Plugin

SWEPT = ("torus", "barth_sextic", "sphere", "plane_squared")  # knobs are turned on the first that the method accepts
Located = tuple[str, Iterator[Finding]]  # what is checked there, and its findings, made as they are asked for


def examine(bench: Bench, plugin: Plugin, case: Case, precision: Precision, setting: str = "") -> Iterator[Finding]:
    """Yield every check of a method's answers on one case, its claims among them.

    `setting` names one of the paper's own settings; "" is the default. A setting is held to the same claims as the
    default, and to the limits that checks.py states for settings. Raises what casting on the bench raises.
    """
    knobs = plugin.method.settings[setting] if setting else {}
    hits, again = (bench.cast(plugin, case, precision, **knobs) for _ in range(2))
    yield decided(case)
    yield answers(hits, case)
    yield same_bits(hits, again)
    yield from agreement(hits, case, precision, setting)
    for claim in sorted(plugin.method.claims & CLAIM_CHECKS.keys()):
        yield CLAIM_CHECKS[claim](plugin, hits, case, precision, knobs)


def examine_touches(bench: Bench, plugin: Plugin, precision: Precision) -> Iterator[Finding]:
    """Yield the checks of the claim finds_touch; none where the method does not state it."""
    if "finds_touch" not in plugin.method.claims:
        return
    for case in touch_cases():
        if refusal(plugin, case.surface, precision, bench) is None:
            yield finds_touch(bench.cast(plugin, case, precision), case)


def examine_knobs(bench: Bench, plugin: Plugin) -> Iterator[Finding]:
    """Yield for each knob that says which way it is finer whether the error falls on the way there, and never grows.

    This is in float32. The other such knobs stand at their coarsest values, since a fine one could hide what the knob
    does.
    """
    import surfaces

    accepted = (surface for surface in map(surfaces.get, SWEPT) if not refusal(plugin, surface, "float32", bench))
    surface = next(accepted, None)
    knobs = [parameter for parameter in plugin.method.parameters if parameter.finer]
    for parameter in knobs:
        if surface is None:
            reason = f"the method accepts none of {', '.join(SWEPT)}"
            yield not_checked(f"{parameter.name} finer {parameter.finer}", reason)
            continue
        others = {other.name: settings_of(other)[0] for other in knobs if other is not parameter}
        yield from swept(bench, plugin, view_case(surface, OUTSIDE), parameter, others)


def _on_surfaces(bench: Bench, plugin: Plugin, chosen: Sequence[Surface]) -> Iterator[Located]:
    """Examine the default and the papers' settings on every view of the chosen surfaces."""
    for surface in chosen:
        for precision in PRECISIONS:
            where = f"{surface.name} {precision}"
            if reason := refusal(plugin, surface, precision, bench):
                yield where, iter([not_checked("nothing", reason)])
                continue
            for setting in ("", *own_settings(plugin)):
                named = f"{where}, setting {setting}" if setting else where
                yield named, examine(bench, plugin, views_case(surface), precision, setting)


def own_settings(plugin: Plugin) -> list[str]:
    """List the papers' settings that are not the default under another name."""
    default = plugin.variant({}).parameters
    return [name for name in plugin.method.settings if plugin.setting(name).parameters != default]


def _on_dense(bench: Bench, plugin: Plugin, _: Sequence[Surface]) -> Iterator[Located]:
    """Examine the default on dense random polynomials of every degree that the method accepts."""
    from harness.conformance import dense

    for where, case, precision in dense.cases(bench, plugin):
        yield where, examine(bench, plugin, case, precision)


def _on_touches(bench: Bench, plugin: Plugin, _: Sequence[Surface]) -> Iterator[Located]:
    """Examine the default on rays that touch a surface, in each precision."""
    for precision in PRECISIONS:
        yield f"touches {precision}", examine_touches(bench, plugin, precision)


def _on_knobs(bench: Bench, plugin: Plugin, _: Sequence[Surface]) -> Iterator[Located]:
    """Examine the method's knobs."""
    yield "float32", examine_knobs(bench, plugin)


EXAMINATIONS: list[Callable[[Bench, Plugin, Sequence[Surface]], Iterator[Located]]] = [
    _on_surfaces,
    _on_dense,
    _on_touches,
    _on_knobs,
]
