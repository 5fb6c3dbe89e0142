"""Write surfaces as tapes (.vm), which `vm` reads."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from surfaces.evaluation import tape_of
from surfaces.files.wording import titled
from surfaces.model import FirsthitError, Surface
from surfaces.tape import walk

_PI, _E = "3.141592653589793", "2.718281828459045"


_SAME = ("abs", "sqrt", "exp", "sin", "cos", "tan", "floor", "add", "sub", "mul", "div", "min", "max", "neg", "atan2")


class Lines:
    """Write each operation as a line; the numbers of this system are the names of values."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self._known: dict[str, str] = {}

    def emit(self, *words: str) -> str:
        """Return the name of an operation's value; a line is added unless there is the same one."""
        text = " ".join(words)
        if text not in self._known:
            self._known[text] = f"_{len(self.lines):x}"
            self.lines.append(f"{self._known[text]} {text}")
        return self._known[text]

    def const(self, value: Fraction) -> str:
        top, bottom = value.numerator, value.denominator
        shift = 0
        while 10**shift % bottom and shift < 400:
            shift += 1
        if 10**shift % bottom:  # no finite decimal
            return self.emit("div", self.emit("const", str(top)), self.emit("const", str(bottom)))
        digits = str(abs(top) * 10**shift // bottom).rjust(shift + 1, "0")
        text = f"{digits[:-shift]}.{digits[-shift:]}" if shift else digits
        return self.emit("const", f"-{text}" if top < 0 else text)

    def pi(self) -> str:
        return self.emit("const", _PI)

    def e(self) -> str:
        return self.emit("const", _E)

    def sqr(self, a: str) -> str:
        return self.emit("square", a)

    def powi(self, a: str, n: int) -> str:
        if n <= 2:
            return self.sqr(a) if n == 2 else a
        half = self.sqr(self.powi(a, n // 2))
        return self.emit("mul", a, half) if n % 2 else half

    def powr(self, a: str, q: Fraction) -> str:
        if q.denominator != 2:
            raise FirsthitError(f"a tape has no power {q}; --as sympy has it")
        root = self.emit("sqrt", a)
        return self.powi(root, q.numerator)

    def below(self, a: str, b: str) -> str:
        one = self.emit("const", "1")
        return self.emit("min", self.emit("add", self.emit("compare", b, a), one), one)

    def select(self, c: str, p: str, q: str) -> str:
        return self.emit("or", self.emit("and", c, p), self.emit("and", self.emit("not", c), q))

    def log(self, a: str) -> str:
        return self.emit("ln", a)

    def __getattr__(self, name: str) -> Callable[..., str]:
        """Return what writes an operation that tapes have by our name. Raises AttributeError for any other."""
        if name not in _SAME:
            raise AttributeError(name)
        return lambda *inputs: self.emit(name, *inputs)


def text_of(surface: Surface) -> str:
    """Return a surface as a tape. Raises FirsthitError for a power that tapes do not have."""
    tape = tape_of(surface)
    lines = Lines()
    result = walk(tape, lines, lambda axis: lines.emit(f"var-{axis}"))[0]
    if lines.lines[-1].split()[0] != result:  # the last line is what is drawn
        lines.lines.append(f"_out add {result} {lines.emit('const', '0')}")
    constants = [f"{name} is the double next to it" for name in ("pi", "e") if any(op.name == name for op in tape.ops)]
    return "".join(f"# {line}\n" for line in [*titled(surface), *constants]) + "\n".join(lines.lines) + "\n"
