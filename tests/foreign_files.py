"""Equations of the literature as Python text, their values, and writers of other programs' files.

Nothing here is shared with the readers and writers of surfaces.files: the equations are parsed by Python's own ast, and
evaluated by Python.
"""

from __future__ import annotations

import ast
import json
import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import mpmath
import numpy as np

Terms = dict[tuple[int, ...], Fraction]  # a polynomial: coefficients by powers
PHI = "((1 + sqrt(5))/2)"
POLYNOMIALS = {  # name: (radius of the domain, equation, source)
    "cayley": (3.0, "x**2 + y**2 - x**2*z + y**2*z + z**2 - 1", "A. Cayley 1869"),
    "clebsch": (
        2.0,
        "81*(x**3 + y**3 + z**3) - 189*(x**2*y + x**2*z + y**2*x + y**2*z + z**2*x + z**2*y) + 54*x*y*z"
        " + 126*(x*y + x*z + y*z) - 9*(x**2 + y**2 + z**2) - 9*(x + y + z) + 1",
        "A. Clebsch 1871, in the form of Endrass",
    ),
    "dingdong": (2.0, "x**2 + y**2 - (1 - z)*z**2", "H. Hauser, gallery of singular algebraic surfaces"),
    "whitney": (1.5, "x**2 - y**2*z", "H. Whitney 1943"),
    "tangle": (3.5, "x**4 - 5*x**2 + y**4 - 5*y**2 + z**4 - 5*z**2 + 11.8", "beamcasting, Fig. 2"),
    "heart": (1.5, "(x**2 + 9/4*y**2 + z**2 - 1)**3 - x**2*z**3 - 9/80*y**2*z**3", "G. Taubin 1993"),
    "steiner": (1.0, "x**2*y**2 + y**2*z**2 + x**2*z**2 + x*y*z", "J. Steiner 1844"),
    "torus": (1.2, "(x**2 + y**2 + z**2 + 0.49 - 0.09)**2 - 4*0.49*(x**2 + y**2)", "toledo2007, section 4"),
    "cyclide": (3.0, "(x**2 + y**2 + z**2)**2 - 4*(1.25*x - 0.75)**2 - 4*y**2", "C. Dupin 1803; a = 5/4, b = mu = 1"),
    "chair": (
        8.0,
        "(x**2 + y**2 + z**2 - 23.75)**2 - 0.8*((z - 5)**2 - 2*x**2)*((z + 5)**2 - 2*y**2)",
        "surface named chair, MathWorld: k = 5, a = 0.95, b = 0.8",
    ),
    "klein": (
        4.5,
        "(x**2 + y**2 + z**2 + 2*y - 1)*((x**2 + y**2 + z**2 - 2*y - 1)**2 - 8*z**2)"
        " + 16*x*z*(x**2 + y**2 + z**2 - 2*y - 1)",
        "I. Stewart",
    ),
    "eistuete": (2.0, "(x**2 + y**2)**3 - 4*x**2*y**2*(z**2 + 1)", "H. Hauser"),
    "helix": (2.0, "6*x**2 - 2*x**4 - y**2*z**2", "H. Hauser"),
    "kreisel": (8.5, "60*(x**2 + y**2)*z**4 - (60 - x**2 - y**2 - z**2)**3", "H. Hauser"),
    "nepali": (2.0, "(x*y - z**3 - 1)**2 - (1 - x**2 - y**2)**3", "H. Hauser"),
    "distel": (1.25, "x**2 + y**2 + z**2 + 1000*(x**2 + y**2)*(x**2 + z**2)*(y**2 + z**2) - 1", "H. Hauser"),
    "kolibri": (1.0, "x**3 + x**2*z**2 - y**2", "H. Hauser"),
    "dullo": (1.2, "(x**2 + y**2 + z**2)**2 - (x**2 + y**2)", "H. Hauser"),
    "tuelle": (1.0, "y*z*(x**2 + y - z)", "H. Hauser"),
    "zitrus": (1.2, "x**2 + z**2 - y**3*(1 - y)**3", "H. Hauser"),
    "miau": (1.0, "x**2*y*z + x**2*z**2 + 2*y**3*z + 3*y**3", "H. Hauser"),
    "fermat_quartic": (1.5, "x**4 + y**4 + z**4 - 1", "P. Fermat's form of degree 4"),
    "fermat_sextic": (1.5, "x**6 + y**6 + z**6 - 1", "P. Fermat's form of degree 6"),
    "chmutov_quartic": (1.3, "8*(x**4 + y**4 + z**4) - 8*(x**2 + y**2 + z**2) + 3 + 1", "S. V. Chmutov 1992, T4"),
    "hunt": (4.2, "4*(x**2 + y**2 + z**2 - 13)**3 + 27*(3*x**2 + y**2 - 4*z**2 - 12)**2", "B. Hunt 1996"),
    "piriform": (1.2, "x**4 - x**3 + y**2 + z**2", "G. de Longchamps's piriform, revolved"),
    "chmutov_septic": (
        1.2,
        "64*(x**7 + y**7 + z**7) - 112*(x**5 + y**5 + z**5) + 56*(x**3 + y**3 + z**3) - 7*(x + y + z) + 1",
        "S. V. Chmutov 1992, T7",
    ),
    "barth_sextic": (
        2.0,
        f"4*({PHI}**2*x**2 - y**2)*({PHI}**2*y**2 - z**2)*({PHI}**2*z**2 - x**2)"
        f" - (1 + 2*{PHI})*(x**2 + y**2 + z**2 - 1)**2",
        "W. Barth 1996",
    ),
    "endrass_octic": (
        4.0,
        "64*(x**2 - 1)*(y**2 - 1)*((x - y)**2 - 2)*((x + y)**2 - 2)"
        " - (-4*(1 + sqrt(2))*(x**2 + y**2)**2 + (8*(2 + sqrt(2))*z**2 + 4 + 14*sqrt(2))*(x**2 + y**2)"
        " - 16*z**4 + 8*(1 - 2*sqrt(2))*z**2 - 1 - 12*sqrt(2))**2",
        "S. Endrass 1997",
    ),
    "barth_decic": (
        2.0,
        f"8*(x**2 - {PHI}**4*y**2)*(y**2 - {PHI}**4*z**2)*(z**2 - {PHI}**4*x**2)"
        "*(x**4 + y**4 + z**4 - 2*x**2*y**2 - 2*y**2*z**2 - 2*z**2*x**2)"
        f" + (3 + 5*{PHI})*(x**2 + y**2 + z**2 - 1)**2*(x**2 + y**2 + z**2 - 2 + {PHI})**2",
        "W. Barth 1996",
    ),
}
OTHERS = {
    "gyroid": (4.0, "sin(x)*cos(y) + sin(y)*cos(z) + sin(z)*cos(x)", "A. Schoen 1970, nodal approximation"),
    "schwarz_p": (4.0, "cos(x) + cos(y) + cos(z)", "H. A. Schwarz 1890, nodal approximation"),
    "schwarz_d": (4.0, "cos(x)*cos(y)*cos(z) - sin(x)*sin(y)*sin(z)", "H. A. Schwarz 1890, nodal approximation"),
    "neovius": (4.0, "3*(cos(x) + cos(y) + cos(z)) + 4*cos(x)*cos(y)*cos(z)", "E. R. Neovius 1883"),
    "iwp": (
        4.0,
        "2*(cos(x)*cos(y) + cos(y)*cos(z) + cos(z)*cos(x)) - (cos(2*x) + cos(2*y) + cos(2*z))",
        "A. Schoen 1970",
    ),
    "scherk": (2.5, "sin(z) - (exp(x) - exp(-x))*(exp(y) - exp(-y))/4", "H. F. Scherk 1834, second surface"),
    "torus_distance": (1.2, "sqrt((sqrt(x**2 + y**2) - 0.7)**2 + z**2) - 0.3", "J. C. Hart 1996"),
    "box_distance": (
        1.0,
        "sqrt(max(abs(x) - 0.5, 0)**2 + max(abs(y) - 0.4, 0)**2 + max(abs(z) - 0.3, 0)**2)"
        " + min(max(abs(x) - 0.5, max(abs(y) - 0.4, abs(z) - 0.3)), 0) - 0.05",
        "J. C. Hart 1996, with a rounding",
    ),
    "octahedron": (1.2, "abs(x) + abs(y) + abs(z) - 1", "a ball of the sum norm"),
    "blinn_blob": (
        1.6,
        "exp(-4*(x**2 + y**2 + z**2)) + exp(-8*((x - 0.8)**2 + y**2 + z**2))"
        " + exp(-8*(x**2 + (y - 0.8)**2 + z**2)) - 0.4",
        "J. F. Blinn 1982",
    ),
    "metaballs": (
        2.0,
        "1/((x - 0.6)**2 + y**2 + z**2 + 0.05) + 1/((x + 0.6)**2 + y**2 + z**2 + 0.05) - 3",
        "H. Nishimura 1985",
    ),
    "smooth_union": (
        1.6,
        "-log(exp(-8*(sqrt((x - 0.5)**2 + y**2 + z**2 + 0.01) - 0.6))"
        " + exp(-8*(sqrt((x + 0.5)**2 + y**2 + z**2 + 0.01) - 0.6)))/8",
        "I. Quilez's smooth minimum of two spheres",
    ),
    "lens": (1.5, "max(x**2 + y**2 + (z - 0.5)**2 - 1, x**2 + y**2 + (z + 0.5)**2 - 1)", "A. Ricci 1973, intersection"),
    "two_balls": (
        1.6,
        "min((x - 0.6)**2 + y**2 + z**2 - 0.5, (x + 0.6)**2 + y**2 + z**2 - 0.4)",
        "A. Ricci 1973, union",
    ),
}


@dataclass(frozen=True)
class Case:
    """Hold a file that a writer makes of an equation, and the equation's values in the file's coordinates."""

    name: str
    form: str
    file: str
    text: str
    equation: str
    scale: float  # f(x, y, z) of the file is the equation's at (scale*x, scale*y, scale*z)

    @property
    def is_polynomial(self) -> bool:
        return self.name in POLYNOMIALS


def value(equation: str, x: Any, y: Any, z: Any, functions: dict[str, Callable[..., Any]]) -> Any:
    """Evaluate an equation by Python in the numbers given."""
    code = compile(_Whole().visit(ast.parse(equation, mode="eval")), "equation", "eval")
    return eval(code, {"__builtins__": {}, **functions}, {"x": x, "y": y, "z": z})


class _Whole(ast.NodeTransformer):
    """Make an exact number of every decimal."""

    def visit_Constant(self, node: ast.Constant) -> ast.AST:
        call = ast.Call(ast.Name("number", ast.Load()), [ast.Constant(str(node.value))], [])
        return ast.fix_missing_locations(ast.copy_location(call, node))

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        if isinstance(node.op, ast.Pow):
            return ast.copy_location(ast.BinOp(self.visit(node.left), node.op, node.right), node)
        return self.generic_visit(node)


FLOATS = {
    "number": float, "sqrt": np.sqrt, "exp": np.exp, "log": np.log, "sin": np.sin, "cos": np.cos,
    "abs": np.abs, "min": np.minimum, "max": np.maximum,
}  # fmt: skip
MPMATH = {
    "number": mpmath.mpf, "sqrt": mpmath.sqrt, "exp": mpmath.exp, "log": mpmath.log, "sin": mpmath.sin,
    "cos": mpmath.cos, "abs": abs, "min": min, "max": max,
}  # fmt: skip


class Poly:
    """Hold a polynomial in any variables with fractions as coefficients."""

    def __init__(self, terms: Terms) -> None:
        self.terms = {powers: c for powers, c in terms.items() if c}

    @staticmethod
    def of(other: Any) -> Poly:
        return other if isinstance(other, Poly) else Poly({(): Fraction(other)})

    def __add__(self, other: Any) -> Poly:
        terms = dict(self.terms)
        for powers, c in Poly.of(other).terms.items():
            terms[powers] = terms.get(powers, Fraction(0)) + c
        return Poly(terms)

    def __mul__(self, other: Any) -> Poly:
        terms: Terms = {}
        for p, a in self.terms.items():
            for q, b in Poly.of(other).terms.items():
                powers = _sum(p, q)
                terms[powers] = terms.get(powers, Fraction(0)) + a * b
        return Poly(terms)

    def __pow__(self, n: int) -> Poly:
        result = Poly.of(1)
        for _ in range(n):
            result = result * self
        return result

    def __neg__(self) -> Poly:
        return self * -1

    def __sub__(self, other: Any) -> Poly:
        return self + Poly.of(other) * -1

    def __truediv__(self, other: Any) -> Poly:
        return self * (1 / Poly.of(other).terms[()])

    def __radd__(self, other: Any) -> Poly:
        return self + other

    def __rmul__(self, other: Any) -> Poly:
        return self * other

    def __rsub__(self, other: Any) -> Poly:
        return self * -1 + other

    def coefficients(self) -> list[Fraction]:
        """Return the coefficients of a polynomial in one variable, lowest power first."""
        table = {(powers or (0,))[0]: c for powers, c in self.terms.items()}
        return [table.get(i, Fraction(0)) for i in range(max(table, default=-1) + 1)]


def _sum(p: tuple[int, ...], q: tuple[int, ...]) -> tuple[int, ...]:
    size = max(len(p), len(q))
    total = [(p[i] if i < len(p) else 0) + (q[i] if i < len(q) else 0) for i in range(size)]
    while total and not total[-1]:
        total.pop()
    return tuple(total)


def _root(a: Any) -> Poly:
    with mpmath.workdps(80):
        return Poly.of(Fraction(str(mpmath.sqrt(mpmath.mpf(str(Poly.of(a).terms[()]))))))


EXACT = {"number": lambda text: Poly.of(Fraction(text)), "sqrt": _root}


# how formats write an equation


def infix(equation: str, power: str = "^") -> str:
    """Write an equation with another sign for powers, or as a function pow(a, n), with all parentheses."""

    def text(node: ast.AST) -> str:
        match node:
            case ast.Expression(body):
                return text(body)
            case ast.Constant(number):
                return str(number)
            case ast.Name(name):
                return name
            case ast.UnaryOp(ast.USub(), operand):
                return f"(-{text(operand)})"
            case ast.BinOp(left, ast.Pow(), right):
                return f"pow({text(left)}, {text(right)})" if power == "pow" else f"({text(left)}){power}{text(right)}"
            case ast.BinOp(left, operator, right):
                sign = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}[type(operator)]
                return f"({text(left)} {sign} {text(right)})"
            case ast.Call(ast.Name(name), arguments):
                return f"{name}({', '.join(map(text, arguments))})"
        raise AssertionError(ast.dump(node))

    return text(ast.parse(equation, mode="eval"))


def jsurf(equation: str, radius: float) -> str:
    lines = ["#jSurfer surface description", "camera_type=ORTHOGRAPHIC_CAMERA", "background_color=1.0 1.0 1.0"]
    return "\n".join([*lines, f"scale_factor={math.log10(radius)!r}", f"surface_equation={infix(equation)}"]) + "\n"


def surf(equation: str, radius: float) -> str:
    """Write a script that names the summands of the equation and scales the picture by a half."""
    body = ast.parse(equation, mode="eval").body
    parts = []
    while isinstance(body, ast.BinOp) and isinstance(body.op, ast.Add | ast.Sub):
        parts.append(("+" if isinstance(body.op, ast.Add) else "-", infix(ast.unparse(body.right))))
        body = body.left
    parts.append(("+", infix(ast.unparse(body))))
    names = "".join(f"poly f{i} = {text};\n" for i, (_, text) in enumerate(reversed(parts)))
    total = " ".join(f"{sign} f{i}" for i, (sign, _) in enumerate(reversed(parts)))
    view = f"double s = 0.5;\nscale_x = s; scale_y = s; scale_z = s;\nradius = {2 * radius!r};\n"
    return (
        f"// a script\nwidth = 300;\n{view}{names}surface = {total.removeprefix('+ ')};\nclear_screen;\ndraw_surface;\n"
    )


def povray_poly(equation: str, radius: float) -> str:
    axes = {name: Poly({tuple(int(i == k) for i in range(k + 1)): Fraction(1)}) for k, name in enumerate("xyz")}
    found = value(equation, axes["x"], axes["y"], axes["z"], EXACT).terms
    full = {(*powers, *(0,) * (3 - len(powers))): c for powers, c in found.items()}
    degree = max(map(sum, full))
    values = []
    for i in range(degree, -1, -1):  # the manual's order: x falls first, then y, then z
        for j in range(degree - i, -1, -1):
            values += [full.get((i, j, k), Fraction(0)) for k in range(degree - i - j, -1, -1)]
    listed = ", ".join(str(float(v)) for v in values)
    kind = {3: "cubic {", 4: "quartic {"}.get(degree, f"poly {{ {degree},")
    return f"{kind} <{listed}> sturm clipped_by {{ sphere {{ <0, 0, 0>, {radius!r} }} }} }}\n"


def povray_function(equation: str, radius: float) -> str:
    body = infix(equation, "pow").replace("log(", "ln(")
    region = f"sphere {{ <0,0,0>, {radius!r} }}"
    return f"isosurface {{ function {{ {body} }} contained_by {{ {region} }} max_gradient 10 }}\n"


def isosurface(equation: str, radius: float) -> str:
    limits = {f"{axis}{end}": [f"{sign}R"] for axis in "XYZ" for end, sign in (("min", "-"), ("max", ""))}
    model = {"Name": ["model"], "Component": ["part"], "Const": [f"R={radius!r}"], "Fxyz": ["F(x,y,z,t)"], **limits}
    model["Funct"] = [f"F={infix(equation)}"]
    return json.dumps({"Iso3D": model}, indent=4)


def tape(equation: str, radius: float) -> str:
    """Write a tape in the cube from -1 to 1, of the equation at points that are scaled by the radius."""
    lines: list[str] = []

    def emit(*words: str) -> str:
        lines.append(" ".join((f"_{len(lines)}", *words)))
        return f"_{len(lines) - 1}"

    axes: dict[str, str] = {}

    def text(node: ast.AST) -> str:
        match node:
            case ast.Expression(body):
                return text(body)
            case ast.Constant(number):
                return emit("const", str(number))
            case ast.Name(name):
                if name not in axes:
                    axes[name] = emit("mul", emit(f"var-{name}"), emit("const", repr(radius)))
                return axes[name]
            case ast.UnaryOp(ast.USub(), operand):
                return emit("neg", text(operand))
            case ast.BinOp(left, ast.Pow(), ast.Constant(n)):
                base = text(left)
                result = base
                for _ in range(n - 1):
                    result = emit("square", base) if result == base and n == 2 else emit("mul", result, base)
                return result
            case ast.BinOp(left, operator, right):
                word = {ast.Add: "add", ast.Sub: "sub", ast.Mult: "mul", ast.Div: "div"}[type(operator)]
                return emit(word, text(left), text(right))
            case ast.Call(ast.Name(name), arguments):
                return emit({"log": "ln"}.get(name, name), *map(text, arguments))
        raise AssertionError(ast.dump(node))

    text(ast.parse(equation, mode="eval"))
    return "# a tape\n" + "\n".join(lines) + "\n"


WRITERS = {
    "jsurf": (".jsurf", jsurf),
    "surf": (".pic", surf),
    "pov": (".pov", povray_poly),
    "function": (".pov", povray_function),
    "json": (".json", isosurface),
    "vm": (".vm", tape),
}


def cases() -> list[Case]:
    """Return all files: polynomials as .jsurf, scripts, coefficients; all else as tapes, functions and models."""
    found = []
    for table, forms in ((POLYNOMIALS, ("jsurf", "surf", "pov")), (OTHERS, ("vm", "json", "function"))):
        for name, (radius, equation, _) in table.items():
            for form in forms:
                if form == "pov" and "sqrt" in equation:  # its coefficients would be rounded
                    continue
                suffix, write = WRITERS[form]
                scale = radius if form == "vm" else 1.0
                found.append(Case(name, form, f"{name}_{form}{suffix}", write(equation, radius), equation, scale))
    return found
