"""Generate kernel text for a surface: its constants, and functions of fixed names that kernels call.

FUNCTIONS holds the names that a method may need, and `Method.needs` those that it does:

    constants                 #define SURFACE_DEGREE (0 where not algebraic), DOMAIN_IS_BOX, DOMAIN_RADIUS,
                              DOMAIN_CENTER, DOMAIN_LOWER, DOMAIN_UPPER, BOUNDING_RADIUS, FEATURE_RADIUS (the last two
                              are DOMAIN_RADIUS if the surface does not state them); always defined
    surface_value             real surface_value(vec3 p)
    surface_gradient          vec3 surface_gradient(vec3 p)
    surface_hessian_product   vec3 surface_hessian_product(vec3 p, vec3 v)
    surface_normal            vec3 surface_normal(vec3 p)                         the unit vector along f's gradient
    surface_distance          real surface_distance(vec3 p)                       for surfaces that have a distance
    surface_distance_normal   vec3 surface_distance_normal(vec3 p)                the unit vector along the distance's
                              gradient; on a torus that of P - C with C = (R x / rho, R y / rho, 0), toledo2007,
                              equation 6. Either normal is the zero vector if its gradient is zero or not finite
    surface_range             Interval surface_range(Interval x, Interval y, Interval z)
                              f in the box: without 0 only if f has no root there, see harness/kernels/ranges.py
    surface_range_along       Interval surface_range_along(Ray ray, real t0, real t1)
    surface_gradient_range    GradientRange surface_gradient_range(Interval x, Interval y, Interval z)
                              surface_range of the box, and intervals that hold f's derivatives there by x, y and z; the
                              whole line where they are not known, see harness/kernels/gradient_ranges.py
    surface_coefficients_along  void surface_coefficients_along(Ray ray, OUT real c[SURFACE_DEGREE + 1])
                              f(origin + t direction) = c[0] + c[1] t + …, by exact expansion, for degrees 1 to 4
    surface_polynomial_along  Stretch surface_polynomial_along(Ray ray, real t0, real t1,
                                                               OUT real c[SURFACE_DEGREE + 1])
                              f = c[0] + c[1] x + … with t = middle + reach x. To degree 4 it is the exact expansion
                              with x = t. From degree 5 to 20 it is the compensated fit over [t0, t1], x in [-1, 1]
                              (szente, 2.1); POLYNOMIAL_EVALUATIONS is how often that evaluates f. The library
                              fit_samples comes with it
    surface_along             struct Along; Along surface_along(Ray ray)          the surface prepared for one ray
    surface_value_along       real surface_value_along(Along along, real t)
    surface_dual_along        Dual surface_dual_along(Along along, real t)        value, and derivative by t

An Along holds the expansion's coefficients to degree 4; beyond it, and if f is no polynomial, it holds the ray.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from fractions import Fraction
from functools import lru_cache
from pathlib import Path

from harness import ROOT
from harness.contract import GENERATED, Box, FirsthitError, Precision, Section, Surface
from harness.kernels.gradient_ranges import gradient_function
from harness.kernels.printing import Language, RealPrinter, function_text, functions_used, operations_used, table
from harness.kernels.ranges import range_function, range_operations
from harness.kernels.reach import safe_reach
from harness.oracle.stated_distance import refutation
from surfaces.evaluation import tape_of
from surfaces.formula import parse
from surfaces.lowering import coefficients_along, gradient, hessian_product, real_tape, tangent
from surfaces.tape import LEAVES, Tape
from surfaces.words import suggestion

MAX_EXPANDED_DEGREE = 4
MAX_FITTED_DEGREE = 20
# How many operations on reals and on intervals a program's functions may have. The compiler of each language that takes
# most of them needs 20 s for as many (Mesa 22.3; Intel 2026.2 and PoCL 3.1; unions of spheres, ray_march and
# interval_march). tests/benchmarks/compile_times.py measures it.
MOST_OPERATIONS: dict[Language, dict[str, int]] = {
    "glsl": {"real": 10_000, "interval": 1_800},
    "cl": {"real": 30_000, "interval": 2_500},
}
_LIB = Path(__file__).parent / "glsl" / "lib"
_INTERVAL = {  # files of interval operations beyond lib/interval.glsl, only in programs that call them
    "interval_exp_log": {"exp", "log"},
    "interval_powr": {"powr"},
    "interval_atan2": {"atan2"},
    "interval_jumps": {"floor", "below", "select", "sign", "atan2"},
}
_FIT_SAMPLES = _LIB / "fit_samples.glsl"  # reads tables, and so comes after them

_CALLED = {"powr": "pow", "atan2": "atan"}  # how GLSL calls operations that it knows by other names
FEW_OPERATIONS = 200  # of a tape: no function that is made of fewer is too long

FUNCTIONS = tuple(GENERATED)
_POINT = {"x": "p.x", "y": "p.y", "z": "p.z"}
_RAY = {f"{part}{axis}": f"ray.{name}.{axis}" for part, name in (("o", "origin"), ("d", "direction")) for axis in "xyz"}


def expands(surface: Surface) -> bool:
    """Return whether the surface's coefficients along a ray are generated by exact expansion."""
    return surface.degree is not None and 1 <= surface.degree <= MAX_EXPANDED_DEGREE


def _closure(surface: Surface | None, needs: Iterable[str]) -> list[str]:
    """Return the needed functions and those that they call, ordered so that each comes after what it calls.

    Without a surface, the functions that only some surfaces call are left out. Raises FirsthitError for an unknown
    name.
    """
    wanted: set[str] = set()

    def want(name: str) -> None:
        """Add a function and all that it calls. Raises FirsthitError for an unknown name."""
        if name not in GENERATED:
            raise FirsthitError(f"there is no generated function {name!r}; {suggestion(name, FUNCTIONS)}")
        wanted.add(name)
        for other in GENERATED[name]:
            want(other)

    for need in needs:
        want(need)
    if surface is not None and "surface_along" in wanted:
        evaluated = {"surface_value"} if "surface_value_along" in wanted else set()
        wanted |= {"surface_coefficients_along"} if expands(surface) else evaluated
    if surface is not None and "surface_polynomial_along" in wanted:
        wanted |= {"surface_coefficients_along"} if expands(surface) else {"surface_value"}
    return [name for name in FUNCTIONS if name in wanted]


def libraries_for(needs: Iterable[str], surface: Surface | None = None) -> tuple[str, ...]:
    """Return the kernel libraries that the generated functions need beside `ray`.

    Given the surface, those that only other surfaces need are left out. Raises FirsthitError for an unknown name.
    """
    wanted = _closure(None, needs)
    interval: tuple[str, ...] = ("interval",) if "surface_range" in wanted else ()
    interval += ("interval_slopes",) if "surface_gradient_range" in wanted else ()
    dual = ("dual",) if "surface_dual_along" in wanted else ()
    fitted = "surface_polynomial_along" in wanted and not (surface is not None and expands(surface))
    return interval + dual + (("dual", "fit", "polynomial") if fitted else ())


@lru_cache(maxsize=4096)
def unsupported(surface: Surface, precision: Precision, language: Language) -> str | None:
    """Return why the surface cannot be evaluated in this precision and language, or None if it can."""
    used = functions_used(real_tape(tape_of(surface)))
    weak = [name for name in used if name != "sqrt"]
    if language == "glsl" and precision == "float64" and weak:
        return f"GLSL has no {_CALLED.get(weak[0], weak[0])} in float64"
    try:
        RealPrinter(_POINT, precision, language).body(real_tape(tape_of(surface)))
    except FirsthitError as error:
        return str(error)
    return None


@lru_cache(maxsize=4096)
def too_long(surface: Surface, needs: tuple[str, ...], precision: Precision, language: Language) -> str | None:
    """Return why the needed functions are too long for any compiler of the language, or None if they are not."""
    if len(tape_of(surface).ops) < FEW_OPERATIONS:
        return None
    writer = _Writer(surface, precision, language, free=False)
    try:
        for name in _closure(surface, needs):
            getattr(writer, name)()
    except (_TooLong, FirsthitError) as error:
        return str(error)
    return None


def surface_sections(
    surface: Surface, needs: Iterable[str], precision: Precision, language: Language, free: bool = False
) -> tuple[Section, ...]:
    """Return the constants and the needed functions, one section each; a function comes after those that it calls.

    If `free`, the surface's domain and parameters are no constants: instances that are drawn together differ in them,
    and the text reads those of the instance by the names that glsl/raster/free.glsl defines.

    Raises FirsthitError for an unknown name, and if the surface lacks a function in this precision and language.
    """
    wanted = _closure(surface, needs)
    if reason := unsupported(surface, precision, language):
        raise FirsthitError(f"{surface.name}: {reason}")
    writer = _Writer(surface, precision, language, free)
    makers: dict[str, Callable[[], str]] = {
        name: getattr(writer, name) for name in dict.fromkeys(["constants", *wanted])
    }
    try:
        sections = [Section(f"generated: surface {surface.name}, {name}", make()) for name, make in makers.items()]
    except _TooLong as error:
        raise FirsthitError(f"{surface.name}: {error}") from None
    if "surface_polynomial_along" in wanted and not expands(surface):
        at = 1 + list(makers).index("surface_value")
        sections[at:at] = [*_fit_tables(surface, precision, language), _file(_FIT_SAMPLES)]
    used = set(operations_used(tape_of(surface))) if "surface_range" in wanted else set()
    return tuple([_file(_LIB / f"{name}.glsl") for name, calls in _INTERVAL.items() if calls & used] + sections)


def _file(path: Path) -> Section:
    """Return a file of glsl/lib as a section."""
    return Section(path.relative_to(ROOT).as_posix(), path.read_text(encoding="utf-8"))


def _fit_tables(surface: Surface, precision: Precision, language: Language) -> list[Section]:
    """Return the tables that fit_samples.glsl reads. Raises FirsthitError if the surface has no degree from 1 to 20."""
    from harness.kernels.fitting import fit_tables

    if surface.degree is None or not 1 <= surface.degree <= MAX_FITTED_DEGREE:
        known = f"surface_polynomial_along is for degrees 1 to {MAX_FITTED_DEGREE}"
        raise FirsthitError(f"{surface.name} is {_degree_of(surface)}; {known}")
    tables = fit_tables(surface.degree, "monomial", precision)
    return [
        Section(f"generated: table {name}", table(name, values, precision, language)) for name, values in tables.items()
    ]


def _degree_of(surface: Surface) -> str:
    """Return how a message names the surface's degree."""
    return "no polynomial" if surface.degree is None else f"of degree {surface.degree}"


class _TooLong(Exception):
    """Report that functions have more operations than any compiler takes; the text says how many."""


class _Writer:
    """Write a surface's functions: each method that is named in FUNCTIONS returns the text of that function."""

    def __init__(self, surface: Surface, precision: Precision, language: Language, free: bool) -> None:
        self.surface = surface
        self.free = free
        self.exact = parse(surface.formula, dict(surface.parameters), free)
        self.real = real_tape(self.exact)
        self.precision = precision
        self.language = language
        self.operations = {"real": 0, "interval": 0}  # of all functions that have been written
        names = sorted(dict(surface.parameters)) if free else []
        self.parameters = {name: f"instance_parameters.{part}" for name, part in zip(names, "xyzw", strict=False)}

    def _printer(self, variables: Mapping[str, str]) -> RealPrinter:
        """Return a printer in which the surface's parameters have their names."""
        return RealPrinter({**variables, **self.parameters}, self.precision, self.language)

    def constants(self) -> str:
        surface, domain = self.surface, self.surface.domain
        literal = self._printer({}).literal

        def real(value: float | None) -> str:
            return literal(Fraction(domain.radius if value is None else value))

        def vector(values: Iterable[float]) -> str:
            return f"vec3({', '.join(real(v) for v in values)})"

        box = isinstance(domain, Box)
        lower = domain.lower if isinstance(domain, Box) else [c - domain.radius for c in domain.center]
        upper = domain.upper if isinstance(domain, Box) else [c + domain.radius for c in domain.center]
        values = {
            "SURFACE_DEGREE": str(surface.degree or 0),
            "DOMAIN_IS_BOX": str(int(box)),
            "DOMAIN_RADIUS": real(domain.radius),
            "DOMAIN_CENTER": vector(domain.center),
            "DOMAIN_LOWER": vector(lower),
            "DOMAIN_UPPER": vector(upper),
            "BOUNDING_RADIUS": real(surface.bounding_radius),
            "FEATURE_RADIUS": real(surface.feature_radius),
        }
        named = ("SURFACE_DEGREE", "DOMAIN_IS_BOX") if self.free else tuple(values)
        return "\n".join(f"#define {name} {values[name]}" for name in named)

    def _body(self, variables: Mapping[str, str], tape: Tape) -> tuple[list[str], list[str]]:
        """Return a real tape's statements and its outputs. Raises _TooLong if no compiler takes them."""
        self._add("real", sum(op.name not in LEAVES for op in tape.ops))
        return self._printer(variables).body(tape)

    def _add(self, kind: str, count: int) -> None:
        """Count operations. Raises _TooLong if the functions that have been written have too many of the kind."""
        self.operations[kind] += count
        self._hold(kind, self.operations[kind])

    def _hold(self, kind: str, count: int) -> None:
        """Raise _TooLong if so many operations are too many of the kind."""
        if count > (most := MOST_OPERATIONS[self.language][kind]):
            compiler = {"glsl": "GLSL", "cl": "OpenCL C"}[self.language]
            raise _TooLong(
                f"its functions have {count:,} operations on {kind}s or more, and no compiler of {compiler} that was"
                f" tried takes more than {most:,} in 20 s"
            )

    def _derivable(self, tape: Tape) -> Tape:
        """Return a tape whose derivatives are asked for. Raises _TooLong if it is too long itself, as they would be."""
        self._hold("real", sum(op.name not in LEAVES for op in tape.ops))
        return tape

    def _scalar(self, name: str, tape: Tape) -> str:
        """Return the text of a function of a point whose value is a tape's output."""
        lines, (value,) = self._body(_POINT, tape)
        return function_text(f"real {name}(vec3 p)", lines, f"return {value};")

    def surface_value(self) -> str:
        return self._scalar("surface_value", self.real)

    def surface_gradient(self) -> str:
        lines, values = self._body(_POINT, gradient(self._derivable(self.real)))
        return function_text("vec3 surface_gradient(vec3 p)", lines, f"return vec3({', '.join(values)});")

    def surface_normal(self) -> str:
        return function_text("vec3 surface_normal(vec3 p)", [], "return unit_vector(surface_gradient(p));")

    def surface_distance_normal(self) -> str:
        lines, values = self._body(_POINT, gradient(self._distance("surface_distance_normal"), guarded=False))
        last = f"return unit_vector(vec3({', '.join(values)}));"
        return function_text("vec3 surface_distance_normal(vec3 p)", lines, last)

    def surface_hessian_product(self) -> str:
        variables = {**_POINT, "vx": "v.x", "vy": "v.y", "vz": "v.z"}
        lines, values = self._body(variables, hessian_product(self._derivable(self.real)))
        return function_text(
            "vec3 surface_hessian_product(vec3 p, vec3 v)", lines, f"return vec3({', '.join(values)});"
        )

    def _distance(self, needed_by: str) -> Tape:
        """Return the surface's distance function. Raises FirsthitError if it has none, or a wrong one."""
        if self.surface.distance is None:
            raise FirsthitError(f"{self.surface.name} has no distance function, which {needed_by} needs")
        if problem := refutation(self.surface):
            raise FirsthitError(problem)
        return real_tape(parse(self.surface.distance, dict(self.surface.parameters), self.free))

    def surface_distance(self) -> str:
        return self._scalar("surface_distance", self._distance("surface_distance"))

    def surface_range(self) -> str:
        reach = None if self.parameters else safe_reach(self.surface, self.precision)  # instances' are not known yet
        self._add("interval", range_operations(self.exact))
        return range_function(self.exact, self.parameters, reach, self.precision, self.language)

    def surface_range_along(self) -> str:
        axes = [f"bounded_affine(ray.origin.{a}, ray.direction.{a}, t0, t1)" for a in "xyz"]
        head = "Interval surface_range_along(Ray ray, real t0, real t1)"
        return function_text(
            head,
            [],
            f"return surface_range({axes[0]},",
            *(f"                     {a}" for a in (axes[1] + ",", axes[2] + ");")),
        )

    def surface_gradient_range(self) -> str:
        reach = None if self.parameters else safe_reach(self.surface, self.precision)
        text, count = gradient_function(self.exact, self.parameters, reach, self.precision, self.language)
        self._add("interval", count)
        return text

    def surface_coefficients_along(self) -> str:
        """Return the text of the function. Raises FirsthitError for a surface whose degree is not expanded."""
        if not expands(self.surface):
            known = f"surface_coefficients_along expands degrees 1 to {MAX_EXPANDED_DEGREE}"
            raise FirsthitError(f"{self.surface.name} is {_degree_of(self.surface)}; {known}")
        assert self.surface.degree is not None
        lines, values = self._body(_RAY, coefficients_along(self._derivable(self.real), self.surface.degree))
        stores = [f"c[{k}] = {value};" for k, value in enumerate(values)]
        return function_text("void surface_coefficients_along(Ray ray, OUT real c[SURFACE_DEGREE + 1])", lines, *stores)

    def surface_polynomial_along(self) -> str:
        head = "Stretch surface_polynomial_along(Ray ray, real t0, real t1, OUT real c[SURFACE_DEGREE + 1])"
        evaluations = 0
        if expands(self.surface):
            lines = ["surface_coefficients_along(ray, c);", "return make_stretch(0.0, 1.0);"]
        else:
            evaluations = (self.surface.degree or 0) + 1
            lines = [
                "Stretch stretch = make_stretch(0.5 * (t0 + t1), 0.5 * (t1 - t0));",
                "real samples[COEFFICIENTS];",
                "real fitted[COEFFICIENTS];",
                "for (int i = 0; i <= SURFACE_DEGREE; i++) {",
                "    samples[i] = surface_value(ray_point(ray, stretch.middle + stretch.reach * NODES[i]));",
                "}",
                "fit(samples, false, true, fitted);",
                "for (int i = 0; i <= SURFACE_DEGREE; i++) c[i] = fitted[i];",
                "return stretch;",
            ]
        return f"#define POLYNOMIAL_EVALUATIONS {evaluations}\n" + function_text(head, lines)

    def surface_along(self) -> str:
        if expands(self.surface):
            member, fill = "real c[SURFACE_DEGREE + 1]", "surface_coefficients_along(ray, along.c);"
        else:
            member, fill = "Ray ray", "along.ray = ray;"
        lines = ["Along along;", fill, "return along;"]
        return f"STRUCT(Along) struct Along {{ {member}; }};\n\n" + function_text("Along surface_along(Ray ray)", lines)

    def surface_value_along(self) -> str:
        head = "real surface_value_along(Along along, real t)"
        if not expands(self.surface):
            return function_text(head, [], "return surface_value(ray_point(along.ray, t));")
        degree = self.surface.degree or 0
        steps = [f"value = value * t + along.c[{k}];" for k in reversed(range(degree))]
        return function_text(head, [f"real value = along.c[{degree}];", *steps], "return value;")

    def surface_dual_along(self) -> str:
        head = "Dual surface_dual_along(Along along, real t)"
        if not expands(self.surface):
            lines = ["vec3 p = ray_point(along.ray, t);"]
            variables = {**_POINT, **{f"d{axis}": f"along.ray.direction.{axis}" for axis in "xyz"}}
            more, values = self._body(
                variables, tangent(self._derivable(self.real), {axis: f"d{axis}" for axis in "xyz"})
            )
            return function_text(head, lines + more, f"return make_dual({', '.join(values)});")
        degree = self.surface.degree or 0
        lines = [f"real value = along.c[{degree}];", "real derivative = value;"]
        for k in reversed(range(1, degree)):
            lines += [f"value = value * t + along.c[{k}];", "derivative = derivative * t + value;"]
        return function_text(head, [*lines, "value = value * t + along.c[0];"], "return make_dual(value, derivative);")
