"""Read isosurface models as JSON, as MathMod keeps them: `{"Iso3D": {"Fxyz": ["x*x + y*y - 1"], "Xmin": ["-2"], …}}`.

Its documentation (documentation/Introduction.txt in parisolab/mathmod) names the keys: Const and Funct define constants
and functions of (x, y, z, t), each component has an equation in Fxyz and limits in Xmin … Zmax. Expressions are those
of fparser, Warp's function parser: truth is a number that rounds to another than 0, `%` is C's fmod, `=` compares, and
signs bind less tight than `^`. `t` is time. A file may hold many models, in MathModels.
"""

from __future__ import annotations

import json
import re
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Any, NoReturn

from surfaces import formula
from surfaces.files.expressions import (
    SUM,
    Text,
    both,
    call,
    choose,
    compare,
    div,
    either,
    negative,
    number,
    opposite,
    power,
    rational,
    word,
)
from surfaces.files.source import Reading, Source, Token, tokens
from surfaces.files.syntax import PLAIN, SAME, Dialect, Parser, Parts, Scope, comparison, coordinates, function, one
from surfaces.model import Box, FirsthitError

NAME = "an isosurface model"
_LIMITS = ("Xmin", "Xmax", "Ymin", "Ymax", "Zmin", "Zmax")
_KEYS = ("Fxyz", "Const", "Funct", "Component", "Name", *_LIMITS)
_SILENT = ("Description", "Grid", "Vect", "Varu")  # about the text, the mesh, how fast it is made, older files
_POINT = re.compile(r"DOTSYMBOL|\$DOT\$")  # how some collections write the point of a decimal


def _true(a: Text) -> Text:
    """Return a condition: for a number, that it rounds to another than 0."""
    return a if a.is_condition else compare(call("abs", a), ">=", word("0.5"))


DIALECT = Dialect(
    infix={
        "|": (10, lambda a, b: either(_true(a), _true(b))),
        "&": (20, lambda a, b: both(_true(a), _true(b))),
        **{sign: (30, comparison({"=": "=="}.get(sign, sign))) for sign in ("=", "!=", "<", "<=", ">", ">=")},
        **PLAIN,
        "/": (60, div),
        "%": (60, lambda a, b: call("fmod", a, b)),
        "^": (80, power),
    },
    prefix={"-": (70, negative), "+": (70, lambda a: a), "!": (70, lambda a: opposite(_true(a)))},
    functions={
        **SAME,
        **{name: one(name) for name in ("asinh", "acosh", "atanh", "log", "log2", "log10", "exp2", "cbrt")},
        **{name: one(name) for name in ("sec", "csc", "cot", "ceil", "floor", "trunc")},
        "int": one("nearest"),
        **{name: (2, 2, function(name)) for name in ("atan2", "min", "max", "hypot")},
        "pow": (2, 2, power),
        "if": (3, 3, lambda a, b, c: choose(_true(a), b, c)),
    },
    names={"pi": word("pi"), "Pi": word("pi"), "PI": word("pi")},
    unread={
        **{name: "noise is not read" for name in ("NoiseW", "NoiseP", "p_skeletal_int")},
        **{
            name: "write out its formula" for name in ("f_hex_y", "fmesh", "fhelix1", "fhelix2", "f_helix1", "f_helix2")
        },
        **{name: "complex numbers are not read" for name in ("real", "imag", "arg", "conj", "polar")},
        **{
            name: "values that are kept from one component to the next are not read" for name in ("psh", "csd", "CmpId")
        },
    },
)


@dataclass(frozen=True)
class Model:
    """Hold one Iso3D of a file, with its name and the keys that stand beside it."""

    name: str
    table: dict[str, Any]
    beside: tuple[str, ...]


def read(source: Source) -> Reading:
    """Read a model. Raises FirsthitError where the file has none, or not all that a surface needs."""
    models, parametric = _models(_loaded(source))
    if not models:
        told = "it has parametric surfaces, which no equation describes" if parametric else "it has no Iso3D"
        source.fail(f"the file has no isosurface: {told}")
    entries = [(model, i) for model in models for i in range(len(_texts(source, model, "Fxyz")))]
    names = [_entry_name(source, model, i) for model, i in entries]
    model, which = entries[source.choose(names, "surface")] if entries else source.fail("Fxyz is empty")
    return _reading(source, model, which, names[entries.index((model, which))])


def _reading(source: Source, model: Model, which: int, name: str) -> Reading:
    """Return what is read of a component, with time as a parameter where the surface moves."""
    still = _Iso(source, model, rational(0)).reading(which, name)
    if not re.search(r"(?<![A-Za-z_0-9])t(?![A-Za-z_0-9])", json.dumps(model.table)):
        return still
    later = _Iso(source, model, rational(1)).reading(which, name)
    with suppress(FirsthitError):  # which is raised where the surface is made
        if formula.parse(still.formula) != formula.parse(later.formula):
            source.remark("t is time, and a parameter here: 0 unless another moment is given")
            moving = _Iso(source, model, word("t")).reading(which, name)
            return replace(moving, parameters={"t": "0"})
    return still


def _loaded(source: Source) -> Any:
    """Return the file's JSON; line ends inside texts are let through. Raises FirsthitError where it is none."""
    try:
        return json.loads(source.text, strict=False)
    except json.JSONDecodeError as error:
        source.fail(f"this is no JSON: {error.msg}", error.lineno)
    except (RecursionError, ValueError) as error:
        source.fail(f"this is no JSON that is read: {str(error)[:80] or 'nested too deep'}")


def _models(content: Any) -> tuple[list[Model], bool]:
    """Return all isosurfaces of a file, and whether it has parametric surfaces too."""
    found: list[Model] = []
    parametric = False
    todo: list[Any] = [content]
    while todo:
        item = todo.pop(0)
        if isinstance(item, list):
            todo = [*item, *todo]
        elif isinstance(item, dict):
            parametric |= any(key.startswith("Param") for key in item)
            todo = [*(item[key] for key in ("MathModels", "ParIso") if key in item), *todo]
            table = item.get("Iso3D") if "Iso3D" in item else item if "Fxyz" in item else None
            if isinstance(table, dict):
                beside = tuple(key for key in item if key != "Iso3D") if table is not item else ()
                names = table.get("Name", "")
                name = names[0] if isinstance(names, list) and names else names
                found.append(Model(name.strip() if isinstance(name, str) else "", table, beside))
    return found, parametric


def _texts(source: Source, model: Model, key: str) -> list[str]:
    """Return the texts of a key, which are a list or one alone; none where there is no such key."""
    value = model.table.get(key, [])
    values = [value] if isinstance(value, str | int | float) else value
    if not isinstance(values, list) or not all(isinstance(v, str | int | float) for v in values):
        source.fail(f"{key} of {model.name or 'the model'} is a list of texts")
    return [_POINT.sub(".", str(v)) for v in values]


def _entry_name(source: Source, model: Model, which: int) -> str:
    """Return the name of a model's component: the model's alone where it has one component."""
    components = [text.strip() for text in _texts(source, model, "Component")]
    name = components[which] if which < len(components) else str(which + 1)
    if len(_texts(source, model, "Fxyz")) == 1:
        return model.name or name
    return f"{model.name}/{name}" if model.name else name


class _Iso:
    """Read one model: its constants and functions, and then a component."""

    def __init__(self, source: Source, model: Model, time: Text) -> None:
        self.source, self.model = source, model
        self.parts = Parts()
        self.parts.define("fmod", Text(("a - b*trunc(a/b)",), SUM), ("a", "b"))
        self.parts.define("nearest", Text(("sign(a)*floor(abs(a) + 0.5)",), SUM), ("a",))
        self.scope = Scope({**coordinates(), "t": time}, {}, set("xyzt") | {"fmod", "nearest"})
        for text in _texts(source, model, "Const"):
            name, value = self._named(text, "Const")
            self.scope.values[name] = self.parts.define(self.scope.fresh(name), self._parsed(value, self.scope, name))
        for text in _texts(source, model, "Funct"):
            name, value = self._named(text, "Funct")
            self._function(name, value)

    def _function(self, name: str, text: str) -> None:
        """Read a function of (x, y, z, t); one of the same name that stands before is what a call in it means."""
        called = self.scope.fresh(name)
        time = self.scope.fresh("t")
        inner = Scope({**self.scope.values, **coordinates(), "t": word(time)}, self.scope.functions, self.scope.taken)
        self.parts.define(called, number(self._parsed(text, inner, name)), ("x", "y", "z", time))
        self.scope.taken.discard(time.lower())
        self.scope.functions[name] = 4, called

    def _named(self, text: str, key: str) -> tuple[str, str]:
        """Return the name and the value of "N = 5". Raises FirsthitError for any other text."""
        name, equals, value = text.partition("=")
        if not equals or not re.fullmatch(r"[A-Za-z_][A-Za-z_0-9]*", name.strip()):
            self.source.fail(f"{key} has NAME=VALUE, not {text[:60]!r}")
        return name.strip(), value

    def _parsed(self, text: str, scope: Scope, what: str) -> Text:
        """Parse an expression. An error names what it is of, since the lines of a file say little here."""
        inner = Source(self.source.path, text, remarks=self.source.remarks)
        words = [Token(token.kind, token.text, 0) for token in tokens(inner)]
        parser = Parser(Labelled(self.source, what[:40]), words, DIALECT, scope)
        return parser.whole()

    def reading(self, which: int, name: str) -> Reading:
        """Return what is read of a component. Raises FirsthitError where it has no limits."""
        equation = _texts(self.source, self.model, "Fxyz")[which]
        value = number(self._parsed(equation, self.scope, f"Fxyz of {name}"))
        limits = [self._limit(key, which) for key in _LIMITS]
        lower, upper = limits[::2], limits[1::2]
        left = [key for key in (*self.model.table, *self.model.beside) if key not in (*_KEYS, *_SILENT, "Name")]
        conditions = _texts(self.source, self.model, "Cnd")
        if which < len(conditions) and conditions[which].strip():
            self.source.remark(f"left out: Cnd {conditions[which].strip()[:60]!r} (it cuts the surface)")
        self.source.left_out((key for key in left if key != "Cnd"), "how it looks and moves")
        box = Box((lower[0], lower[1], lower[2]), (upper[0], upper[1], upper[2]))
        return Reading(self.parts.formula(value), box, name=name, title=name)

    def _limit(self, key: str, which: int) -> float:
        """Return a limit of a component."""
        texts = _texts(self.source, self.model, key)
        if which >= len(texts):
            self.source.fail(f"{key} has no entry for {self.model.name or 'component'} {which + 1}")
        still = Scope({**self.scope.values, "t": rational(0)}, self.scope.functions, self.scope.taken)
        return self.parts.constant(self.source, self._parsed(texts[which], still, key), key, None)


class Labelled(Source):
    """Hold a source whose errors name a part of it instead of a line."""

    def __init__(self, source: Source, label: str) -> None:
        super().__init__(source.path, source.text, source.part, source.remarks)
        self.label = label

    def fail(self, message: str, _line: int | None = None) -> NoReturn:
        """Raise FirsthitError with the file's name and the label."""
        super().fail(f"{self.label}: {message}")
