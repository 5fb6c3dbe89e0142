"""Hold the oracle against first roots that are known exactly. See tests.exact_surfaces and tests.exact_roots."""

from __future__ import annotations

import random
from collections import Counter
from fractions import Fraction
from math import hypot, isfinite, sqrt

import numpy as np

import surfaces
from harness.contract import Box, Domain, FirsthitError, Sphere, Truth, TruthStatus
from harness.oracle import first_hits
from tests import exact_surfaces
from tests.campaigns.frame import Campaign, Fell, Place
from tests.exact_roots import Hit, Poly, constant, first_hit, linear
from tests.exact_surfaces import Shape

EACH = 20  # rays of one formula
WIDEST = 2.0**-38  # of a certified interval, in domain radii
SPECIAL = [0.0, 0.0, 0.0, 1.0, -1.0, 0.5, -0.5, 0.25]
LONG_DEGREE = 9  # of all parts together, from which on rays have few digits, so that the reference is quick


def _ray(pick: random.Random, shape: Shape, radius: float, few: bool) -> list[float]:
    """Return a ray: anywhere, along special directions, at a mark or shortly beside it, from near or far."""
    d = [pick.choice(SPECIAL) if pick.random() < 0.5 else pick.gauss(0.0, 1.0) for _ in range(3)]
    if pick.random() < 0.5:
        d = [pick.choice(SPECIAL) for _ in range(3)]
    if not any(d):
        d[pick.randrange(3)] = 1.0
    aim = [pick.gauss(0.0, 0.35) * radius for _ in range(3)]
    kind = pick.random()
    if kind < 0.3:
        aim = [pick.choice(SPECIAL) for _ in range(3)]
    elif kind < 0.65 and shape.marks:
        aim = list(pick.choice(shape.marks))
        if pick.random() < 0.5:
            aim[pick.randrange(3)] += pick.choice([-1, 1]) * 10.0 ** -pick.uniform(2.0, 9.0)
    digits = 2.0 ** pick.choice([4, 8]) if few else 0.0
    if digits and pick.random() < 0.95:
        d, aim = ([round(v * digits) / digits for v in numbers] for numbers in (d, aim))
    if not any(d):
        d = [1.0, 0.0, 0.0]
    back = pick.choice([0.0, 0.5, 1.0, 2.0, 4.0, 4.0, 4.0, 1000.0])
    stretch = pick.choice([1.0, 1.0, 1.0, 2.0, 0.5, 1.0 / 1024, 4096.0])
    return [a - back * v for a, v in zip(aim, d, strict=True)] + [v * stretch for v in d]


def _domain(pick: random.Random) -> Domain:
    if pick.random() < 0.5:
        return Sphere(pick.choice([1.0, 1.5, 1.75, 2.0]), tuple(pick.choice([0.0, 0.0, 0.25]) for _ in range(3)))  # type: ignore[arg-type]
    a = pick.choice([1.0, 1.25, 1.5])
    return Box((-a, -1.0, -a), (1.0, a, a))


def _inside(domain: Domain, ray: list[Fraction], t_min: Fraction) -> tuple[list[Poly], Fraction, Fraction] | None:
    """Return polynomials in t that are not negative in the domain and from t_min on, and bounds of such t.

    None where a ray misses a box.
    """
    o, d = ray[:3], ray[3:]
    if isinstance(domain, Box):
        enter, leave = t_min, None
        for k in range(3):
            low, high = Fraction(domain.lower[k]), Fraction(domain.upper[k])
            if not d[k]:
                if not low <= o[k] <= high:
                    return None
                continue
            at = sorted(((low - o[k]) / d[k], (high - o[k]) / d[k]))
            enter, leave = max(enter, at[0]), at[1] if leave is None else min(leave, at[1])
        assert leave is not None
        if enter > leave:
            return None
        room = (leave - enter) / 16 + Fraction(domain.radius) / 64 / max(abs(v) for v in d)
        return [linear(-enter, Fraction(1)), linear(leave, Fraction(-1))], enter - room, leave + room
    center, radius = [Fraction(c) for c in domain.center], Fraction(domain.radius)
    within = constant(radius * radius)
    for k in range(3):
        within = within - linear(o[k] - center[k], d[k]) ** 2
    middle = sum((center[k] - o[k]) * d[k] for k in range(3)) / sum(v * v for v in d)
    reach = 2 * radius / max(abs(v) for v in d)
    low, high = max(t_min - reach / 16, middle - reach), middle + reach
    return ([within, linear(-t_min, Fraction(1))], low, high) if low < high else None


def _reference(shape: Shape, domain: Domain, ray: list[float], t_min: float) -> Hit | None:
    exact = [Fraction(v) for v in ray]
    found = _inside(domain, exact, Fraction(t_min))
    if found is None:
        return None
    inside, low, high = found
    axes = [linear(o, d) for o, d in zip(exact[:3], exact[3:], strict=True)]
    return first_hit([p.along(*axes) for p in shape.parts], shape.sign, inside, low, high)


def _held(shape: Shape, domain: Domain, ray: list[float], t_min: float, truth: Truth, k: int) -> tuple[str, str]:
    """Return what the oracle answered for ray k, and what is wrong with that, "" if nothing is."""
    status = TruthStatus(int(truth.status[k]))
    if status == TruthStatus.UNDECIDED:
        return f"undecided, {shape.kind}", "a polynomial is undecided" * (shape.kind == "polynomial")
    known = _reference(shape, domain, ray, t_min)
    lower, upper = float(truth.lower[k]), float(truth.upper[k])
    told = f"{status.name.lower()}"
    if known is None:
        return told, "there is no root" * (status != TruthStatus.MISS)
    where = f"the first root is near {float(known.low)!r} to {float(known.high)!r}"
    if status == TruthStatus.MISS:
        return told, where
    if not (isfinite(lower) and isfinite(upper) and known.at_least(Fraction(lower)) and known.at_most(Fraction(upper))):
        return told, f"{where}, not in {lower!r} to {upper!r}"
    if known.crosses != (status == TruthStatus.CROSSING) and shape.kind != "jumps":
        return told, f"{where}; f {'changes' if known.crosses else 'keeps'} its sign there"
    if upper - lower > WIDEST * domain.radius / hypot(*ray[3:]) + 2.0**-49 * abs(lower):
        return told, f"the interval is {upper - lower} wide"
    return told, ""


def _trial(dice: random.Random, place: Place) -> Counter[str]:
    del place
    if dice.random() < 0.15:
        surface, shape = dice.choice(exact_surfaces.known())
    else:
        make = [exact_surfaces.sparse, exact_surfaces.piece, exact_surfaces.planted, exact_surfaces.kept]
        shape = dice.choice([*make, exact_surfaces.compared, exact_surfaces.joined, exact_surfaces.joined])(dice)
        try:
            surface = surfaces.from_formula(shape.text, _domain(dice))
        except FirsthitError:
            return Counter({"of a refused formula": EACH})
    few = sum(p.degree for p in shape.parts) >= LONG_DEGREE
    rays = np.array([_ray(dice, shape, surface.domain.radius, few) for _ in range(EACH)], np.float32)
    t_min = dice.choice([0.0] * 8 + [0.5, 1.0, 2.0, 4.0, sqrt(2.0), dice.uniform(0.0, 5.0)])
    truth = first_hits(surface, rays, t_min)
    seen: Counter[str] = Counter()
    for k, ray in enumerate(rays.tolist()):
        answer, wrong = _held(shape, surface.domain, ray, t_min, truth, k)
        if wrong:
            raise Fell(f"{shape.text} in {surface.domain} along {ray} from {t_min}: {answer}, but {wrong}")
        seen[answer] += 1
    return seen


CAMPAIGN = Campaign(
    name="oracle",
    tries="asks the oracle for the first hit of a ray whose first root is known exactly",
    promise="no interval without the first root, no miss of one, no wrong kind of root, no undecided polynomial",
    trial=_trial,
    small=400,
    whole=100_000,
    each=EACH,
    block=25,
    limit=600,
)
