"""Read and write .jsurf, the files of jsurf and SURFER: `key=value` lines, as Java's Properties has them.

jsurf clips at the unit sphere of its own space, from which a scale of 10^`scale_factor`, and `surface_transform_matrix`
behind it, lead to the coordinates of the equation (jsurf 0.4.1: FileFormat.load, RayCreator and ClipToSphere). So the
domain is a sphere of that radius. Its equations have `+ - * / ^`, parentheses, parameters and functions of numbers, and
no product is left unwritten (AlgebraicExpression.g).
"""

from __future__ import annotations

import math
import re
from itertools import pairwise

from surfaces.files.expressions import div, negative, power, word
from surfaces.files.source import Reading, Source, Token, tokens
from surfaces.files.syntax import PLAIN, Dialect, Parser, Scope, coordinates, one
from surfaces.language.tokens import exact
from surfaces.model import Domain, FirsthitError, Sphere

NAME = "a .jsurf file"
_PARAMETER = "surface_parameter_"
_ESCAPE = re.compile(r"\\(u[0-9A-Fa-f]{4}|.)")
_MATRIX = "surface_transform_matrix"
_FUNCTIONS = ("sin", "cos", "tan", "asin", "acos", "atan", "exp", "log", "sqrt", "ceil", "floor", "abs", "sign")
DIALECT = Dialect(
    infix={**PLAIN, "/": (60, div), "^": (80, power)},
    prefix={"-": (70, negative)},
    functions={name: one(name) for name in _FUNCTIONS},
)
_MAX_EXPONENT = 30.0  # of the scale: float32, which holds a domain, ends at 10^38


def read(source: Source) -> Reading:
    """Read a file. Raises FirsthitError where it has no equation, or one that is none."""
    pairs = _properties(source)
    if "surface_equation" not in pairs:
        source.fail("a .jsurf file has a line surface_equation=…, and this one has none")
    scope = Scope(coordinates(), {}, set("xyz"))
    values: dict[str, str] = {}
    for key, (value, line) in pairs.items():
        name = key.removeprefix(_PARAMETER)
        if name == key:
            continue
        if name in ("x", "y", "z"):
            source.remark(f"parameter {name} is left out, since {name} is a coordinate")
            continue
        ours = name if name == "e" else scope.fresh(name)
        scope.values[name] = word(ours)
        values[ours] = _decimal(source, value, line)
    text, line = pairs["surface_equation"]
    words = tokens(source, text, line)
    _check_names(source, words, scope)
    written = str(Parser(source, words, DIALECT, scope).whole())
    names = set(re.findall(r"[A-Za-z_][A-Za-z_0-9]*", written))
    unused = [name for name, ours in scope.values.items() if str(ours) in values and str(ours) not in names]
    source.left_out((f"{_PARAMETER}{name}" for name in unused), "the equation does not name it")
    domain = _domain(source, pairs)
    rest = [key for key in pairs if not key.startswith(_PARAMETER) and key not in ("surface_equation", "scale_factor")]
    source.left_out(sorted(_groups(rest)), "what concerns the picture")
    return Reading(written, domain, {name: value for name, value in values.items() if name in names})


def _check_names(source: Source, words: list[Token], scope: Scope) -> None:
    """Raise FirsthitError at a letter of the equation that is no coordinate and has no line as a parameter."""
    for token, following in pairwise(words):
        short = token.kind == "name" and len(token.text) == 1 and following.text != "("
        if short and token.text not in scope.values:
            small = token.text.lower()
            told = f"write {small}" if small in "xyz" else f"the file has no {_PARAMETER}{token.text}=…"
            source.fail(f"unknown name {token.text!r}: {told}", token.line)


def _groups(keys: list[str]) -> list[str]:
    """Return the kinds of keys of a picture, each once: "light" for light_color_0."""
    kinds = ("camera", "light", "front_material", "back_material")
    return [next((f"{kind}_…" for kind in kinds if key.startswith(kind)), key) for key in keys if key != _MATRIX]


def _properties(source: Source) -> dict[str, tuple[str, int]]:
    """Return the values of the keys, with their lines. Raises FirsthitError for a line that has no key."""
    pairs: dict[str, tuple[str, int]] = {}
    lines = source.text.split("\n")
    at = 0
    while at < len(lines):
        number, line = at + 1, lines[at].strip()
        at += 1
        if not line or line[0] in "#!":
            continue
        while re.search(r"(?<!\\)(?:\\\\)*\\$", line) and at < len(lines):
            line, at = line[:-1] + lines[at].strip(), at + 1
        match = re.fullmatch(r"((?:[^\\=:\s]|\\.)+)\s*[=:]?\s*(.*)", line)
        if match is None:
            source.fail(f"expected key=value, found {line[:40]!r}", number)
        key, value = (_ESCAPE.sub(_unescaped, part) for part in match.groups())
        pairs[key] = value, number
    return pairs


def _unescaped(escape: re.Match[str]) -> str:
    """Return the character that Java's Properties means by an escape."""
    code = escape[1]
    return chr(int(code[1:], 16)) if len(code) > 1 else {"n": "\n", "t": "\t", "r": "\r", "f": "\f"}.get(code, code)


def _decimal(source: Source, text: str, line: int) -> str:
    """Return the text of a decimal number. Raises FirsthitError for any other text."""
    try:
        exact(text.strip())
    except FirsthitError as error:
        source.fail(str(error), line)
    return text.strip()


def _domain(source: Source, pairs: dict[str, tuple[str, int]]) -> Domain:
    """Return the sphere at which jsurf clips, in the equation's coordinates."""
    text, line = pairs.get("scale_factor", ("0", None))
    scale = float(_decimal(source, text, line or 1))
    if abs(scale) > _MAX_EXPONENT:
        source.fail(f"scale_factor {text}: the domain's radius would be 10^{scale:g}", line)
    radius, center = 10.0**scale, (0.0, 0.0, 0.0)
    if _MATRIX in pairs:
        text, line = pairs[_MATRIX]
        entries = [float(_decimal(source, entry, line)) for entry in text.split()]
        if len(entries) != 16:
            source.fail(f"{_MATRIX} has 16 numbers, not {len(entries)}", line)
        rows = [entries[i : i + 3] for i in (0, 4, 8)]
        lengths = [math.hypot(*row) for row in rows]
        products = [sum(a * b for a, b in zip(rows[i], rows[j], strict=True)) for i, j in ((0, 1), (0, 2), (1, 2))]
        if max(map(abs, products)) > 1e-5 * max(lengths) ** 2 or min(lengths) < (1 - 1e-5) * max(lengths):
            source.remark(
                f"{_MATRIX} makes an ellipsoid of jsurf's clipping sphere; the sphere around it is the domain"
            )
        radius *= max(lengths) if min(lengths) > (1 - 1e-5) * max(lengths) else math.hypot(*lengths)
        center = (entries[3], entries[7], entries[11])
    return Sphere(radius, center)


_HEADER = """camera_type=ORTHOGRAPHIC_CAMERA
camera_height=2.0
camera_fov_y=60.0
camera_transform=1.0 0.0 0.0 0.0  0.0 1.0 0.0 0.0  0.0 0.0 1.0 -1.0  0.0 0.0 0.0 1.0
rotation_matrix=1.0 0.0 0.0 0.0  0.0 1.0 0.0 0.0  0.0 0.0 1.0 0.0  0.0 0.0 0.0 1.0
background_color=1.0 1.0 1.0
light_status_0=ON
light_position_0=-100.0 100.0 100.0
light_color_0=1.0 1.0 1.0
light_intensity_0=1.0
"""
_MATERIAL = """{side}_material_color={color}
{side}_material_ambient_intensity=0.4
{side}_material_diffuse_intensity=0.8
{side}_material_specular_iIntensity=0.5
{side}_material_shininess=30.0
"""


def text_of(comments: list[str], equation: str, radius: float, center: tuple[float, float, float]) -> str:
    """Return the text of a file with this equation, clipped by the sphere of this radius and centre."""
    sides = (("front", "0.9 0.6 0.2"), ("back", "0.3 0.5 0.9"))
    materials = "".join(_MATERIAL.format(side=side, color=color) for side, color in sides)
    rows = [" ".join(repr(float(e)) for e in (*(i == j for j in range(3)), center[i])) for i in range(3)]
    moved = f"{_MATRIX}={'  '.join(rows)}  0.0 0.0 0.0 1.0\n" if any(center) else ""
    head = "".join(f"# {line}\n" for line in comments)
    return f"{head}{_HEADER}{materials}scale_factor={math.log10(radius)!r}\n{moved}surface_equation={equation}\n"
