"""Read compilers' logs: what is wrong where, with the line of the source and what to do, and nothing else.

Compilers word a mistake differently, and drivers print much around it. `explained` keeps the errors, each in the form

    mine/kernel.glsl:4:16: expected ';' at end of declaration
        | real a = t0
        |            ^
        do: what to write

which `complaints_in` reads again: rows keep it as the reason why a cell failed.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from harness.contract import Program, Section
from surfaces.words import suggestion

KERNEL = "kernel.glsl"  # the last part of the origin of a method's own text; stages of tiles may stand beside it
LIBRARIES = Path(__file__).parent / "glsl" / "lib"
MOST = 6  # complaints of one program; what follows them is mostly their consequence
ENTRIES = {  # what a method's kernel must define, by what its program is started as
    "rays": "Hit first_hit(Ray ray, real t0, real t1)",
    "camera": "Hit first_hit(Ray ray, real t0, real t1)",
    "raster": "Hit first_hit(Ray ray, real t0, real t1)",
    "beams": "void cast_cell(Work work, Cell cell)",
    "isolate": "void isolate_tiles(Work work, Frame frame)",
    "finish": "void finish_tiles(Work work, Frame frame)",
    "packets": "void cast_packets(Work work, Frame frame)",
    "rest": "Hit first_hit(Ray ray, real t0, real t1)",
    "mesh": "vec3 mesh_normal(vec3 p)",
}
ONE_COUNTER = (
    "in a program that is checked, the head of a `for` loop holds no comma outside brackets: count by one variable"
)
TALK = re.compile(  # what drivers print around the complaints
    r"^(Compilation (started|failed)|Device build (started|failed).*|Device .* failed to build.*|Failed to build.*"
    r"|Build on <.*|\(options: .*|(compute|vertex|fragment)_shader|=+|GLSL Compiler failed|\d+ errors? generated\."
    r"|.*\bBUILD_PROGRAM_FAILURE\b.*)?$"
)
_AT = re.compile(r"^(?P<head>.*?)(?:\b0:|<kernel>:|\binput\.cl:|\.cl:|\b\d+:)(?P<line>\d+)(?P<tail>[:(].*)$")
_NVIDIA = re.compile(r"^(?P<head>)0\((?P<line>\d+)\) (?P<tail>: .*)$")
_TAIL = re.compile(
    r"(?::(?P<column>\d+))?(?:\(\d+\))?\s*:?\s*(?:(?P<kind>fatal error|error|warning|note)(?: C\d+)?:)?(?P<words>.*)"
)
_UNKNOWN = re.compile(
    r"(?:undeclared identifier|declaration of function|unknown type name|no function with name) '(\w+)'"
    r"|`(\w+)' undeclared|(?:undefined variable|undefined function|overloaded function) \"(\w+)"
)
ONE_LANGUAGE = {  # words that one of the two languages keeps for itself, and a kernel may not use as names
    "OpenCL C": "half kernel global local constant private generic char short long unsigned signed size_t ptrdiff_t "
    "uchar ushort uint ulong auto register static extern inline restrict typedef union enum goto sizeof volatile pipe "
    "complex imaginary event_t sampler_t",
    "GLSL": "input output sample in out inout uniform varying attribute buffer shared flat smooth noperspective patch "
    "centroid invariant precise precision lowp mediump highp discard filter common partition active asm class "
    "namespace using template this resource fixed superp external interface cast layout subroutine noinline public "
    "readonly writeonly coherent",
}
ROOM = 160  # characters of a source line that are shown
_WRITTEN = re.compile(r"^(?P<file>\S.*?):(?P<line>\d+)(?::(?P<column>\d+))?: (?P<words>.*)$")


@dataclass(frozen=True)
class Complaint:
    """Hold one error of a compiler: its file and line, the column where the compiler tells it rightly, and its words.

    shown: the line of the source, with a caret below it where there is a column; no line for a text of another place
    advice: what to do; "" where only the compiler's words say it
    """

    file: str
    line: int
    column: int | None
    words: str
    shown: tuple[str, ...] = ()
    advice: str = ""

    @property
    def place(self) -> str:
        """Return file, line and column as editors read them."""
        return f"{self.file}:{self.line}" + (f":{self.column}" if self.column else "")

    def __str__(self) -> str:
        lines = [f"{self.place}: {self.words}", *(f"    | {line}" for line in self.shown)]
        return "\n".join([*lines, *([f"    do: {self.advice}"] if self.advice else [])])


def complaints_in(text: str) -> list[Complaint]:
    """Read the complaints that `explained` wrote; none where a text holds none."""
    found: list[Complaint] = []
    for line in text.splitlines():
        if found and line.startswith("    | "):
            found[-1] = replace(found[-1], shown=(*found[-1].shown, line[6:]))
        elif found and line.startswith("    do: "):
            found[-1] = replace(found[-1], advice=line[8:])
        elif match := _WRITTEN.match(line):
            column = int(match["column"]) if match["column"] else None
            found.append(Complaint(match["file"], int(match["line"]), column, match["words"]))
    return found


def explained(program: Program, log: str) -> str:
    """Return what a compiler's log says is wrong with a program, as the module's docstring shows it.

    If a log is of no known form, all its lines are returned but for drivers' talk.
    """
    found = list(_errors(program, log))
    kernels = _kernels(program)
    own = [complaint for complaint in found if complaint.file in {section.origin for section in kernels}]
    if kernels and not own:
        own = _blamed(program, kernels, found)
    if not found:
        return "\n".join(line for line in log.splitlines() if not TALK.match(line.strip())).strip() or log.strip()
    told = _first_of_each(own or found)
    if kernels:
        told[0] = replace(told[0], advice=told[0].advice or _advice(program, kernels, told, log))
    return "\n".join(map(str, told[:MOST]))


def _kernels(program: Program) -> list[Section]:
    """Return the sections that are the method's own files: its kernel, and those of the same folder."""
    folders = [s.origin.removesuffix(KERNEL) for s in program.sections if s.origin.endswith(KERNEL)]
    return [s for s in program.sections if any(s.origin.rpartition("/")[0] + "/" == folder for folder in folders)]


def _errors(program: Program, log: str) -> Iterator[Complaint]:
    """Yield each error of a log, at the place that it came from."""
    lines = program.text.split("\n")
    for told in log.splitlines():
        match = _NVIDIA.match(told) or _AT.match(told)
        parts = match and _TAIL.match(match["tail"])
        if not match or not parts:
            continue
        kind = parts["kind"] or ("warning" if "warning" in match["head"] else "error")
        if kind in ("warning", "note") or parts["words"].startswith("   "):  # the latter lists candidates
            continue
        number = int(match["line"])
        if number < 1:  # it is of no line: a remark on how the kernel was built, or on the program as a whole
            continue
        origin, line = program.locate(number)
        column = int(parts["column"]) if parts["column"] else None
        source = lines[number - 1].expandtabs(1) if 0 < number <= len(lines) and line else ""
        words = parts["words"].strip().replace("__private ", "").removesuffix("; candidates are:")
        yield Complaint(origin, line, column, words, _shown(source, column))


def _shown(source: str, column: int | None) -> tuple[str, ...]:
    """Return a source line without its indentation, and a caret below its column if there is one."""
    text = source.strip()
    if not text:
        return ()
    at = max(0, (column or 1) - 1 - (len(source) - len(source.lstrip())))
    if len(text) > ROOM:
        begins = max(0, min(at - ROOM // 2, len(text) - ROOM))
        cut = text[begins : begins + ROOM]
        text, at = (
            ("…" if begins else "") + cut + ("…" if begins + ROOM < len(text) else ""),
            at - begins + bool(begins),
        )
    return (text,) if column is None else (text, " " * at + "^")


def _first_of_each(found: Sequence[Complaint]) -> list[Complaint]:
    """Return the complaints without those that follow another one in its line, or say the same of other lines."""
    kept: list[Complaint] = []
    again: dict[str, list[int]] = {}
    for complaint in found:
        if same := next((one for one in kept if one.words == complaint.words), None):
            again.setdefault(complaint.words, []).extend([complaint.line] if complaint.line != same.line else [])
        elif unknown_names(complaint.words) or all(
            (one.file, one.line) != (complaint.file, complaint.line) for one in kept
        ):
            kept.append(complaint)
    lines = {words: ", ".join(map(str, dict.fromkeys(numbers))) for words, numbers in again.items() if numbers}
    return [replace(c, words=f"{c.words}; also in line {lines[c.words]}") if c.words in lines else c for c in kept]


def unknown_names(words: str) -> set[str]:
    """Return the names that a complaint calls unknown."""
    return {name for found in _UNKNOWN.findall(words) for name in found if name}


def _code(section: Section) -> str:
    """Return a kernel's text without comments; its lines stay where they are."""
    return re.sub(r"//[^\n]*|/\*.*?\*/", lambda match: "\n" * match[0].count("\n"), section.text, flags=re.DOTALL)


def _blamed(program: Program, kernels: Sequence[Section], found: Sequence[Complaint]) -> list[Complaint]:
    """Return the complaint that is the kernel's, where compilers stumbled behind it; none where that cannot be told."""
    wanted = ENTRIES.get(program.entry, "")
    name = wanted.partition("(")[0].rpartition(" ")[2]
    for kernel in kernels:
        if line := _unclosed(_code(kernel)):
            return [_at(kernel, line, f"the '{{' of line {line} is not closed", "write the missing '}'")]
    defined = {
        match[1]: (kernel, code.count("\n", 0, match.start(1)) + 1)
        for kernel, code in ((kernel, _code(kernel)) for kernel in kernels)
        for match in _DEFINED.finditer(code)
    }
    if name and name not in defined:
        near = suggestion(name, defined, otherwise=" ")
        at = next((at for other, at in defined.items() if repr(other) in near), (kernels[-1], 1))
        words = f"the kernel does not define {name}" + (f"; {near}" if near.strip() else "")
        return [_at(*at, words, f"define `{wanted} {{ … }}`")]
    if name and any(re.search(rf"\b{name}\s*\(", line) for complaint in found for line in complaint.shown[:1]):
        return [_at(*defined[name], f"{name} is called otherwise: {found[0].words}", f"define it as `{wanted}`")]
    return []


def _unclosed(code: str) -> int | None:
    """Return the line of the last '{' that no '}' closes; None if all are closed."""
    lines: list[int] = []
    for number, line in enumerate(code.split("\n"), 1):
        for sign in re.findall(r"[{}]", line):
            if sign == "{":
                lines.append(number)
            elif lines:
                lines.pop()
    return lines[-1] if lines else None


def recursion(kernel: Section) -> Complaint | None:
    """Return the complaint that a function of the kernel comes back to itself, on which some compilers die."""
    code = _code(kernel)
    heads = [head for head in _DEFINED.finditer(code) if head[1] != "if"]  # of `else if (…) {`
    ends = [*(head.start() for head in heads[1:]), len(code)][: len(heads)]  # none where no function is recognised
    bodies = {head[1]: (head.end(), code[head.end() : end]) for head, end in zip(heads, ends, strict=True)}
    calls = {name: [other for other in bodies if _calls(body, other)] for name, (_, body) in bodies.items()}
    for name, (begin, body) in bodies.items():
        by = next((other for other in calls[name] if name in _reached(calls, other)), None)
        if by and (call := re.search(rf"\b{by}\s*\(", body)):
            line = code.count("\n", 0, begin + call.start()) + 1
            words = f"{name} calls itself" + ("" if by == name else f", through {by}")
            return _at(kernel, line, words, "write a loop: no function of a kernel may call itself")
    return None


def _reached(calls: Mapping[str, Sequence[str]], name: str) -> set[str]:
    """Return a function and what it calls, directly or not."""
    reached, waiting = set[str](), [name]
    while waiting:
        if (other := waiting.pop()) not in reached:
            reached.add(other)
            waiting += calls[other]
    return reached


_DEFINED = re.compile(r"(?m)^\s*\w+\s+(\w+)\s*\([^;{]*\)\s*\{")


def _at(kernel: Section, line: int, words: str, advice: str) -> Complaint:
    return Complaint(kernel.origin, line, None, words, _shown(kernel.text.split("\n")[line - 1], None), advice)


def _advice(program: Program, kernels: Sequence[Section], told: Sequence[Complaint], log: str) -> str:
    """Say what to do about a kernel's complaints; "" where only the compiler's words say it."""
    from harness.kernels.functions import FUNCTIONS

    if re.search(r"\bmacro\b.{0,20}\bfor\b", log):
        return ONE_COUNTER
    others = "\n".join(section.text for section in program.sections if section not in kernels)
    code = "\n".join(map(_code, kernels))
    lacking = [name for name in FUNCTIONS if _calls(code, name) and not _calls(others, name)]
    if lacking:
        names = ", ".join(map(repr, lacking)).replace("'", '"')
        return f"add {names} to needs in method.py: only functions that are named there are generated"
    named = (name for complaint in told for name in sorted(unknown_names(complaint.words)))
    known = next((advice for name in named if (advice := _advice_for(name, program))), "")
    lines = next((_code(kernel).split("\n") for kernel in kernels if kernel.origin == told[0].file), None)
    return known or _advice_on_words(lines[told[0].line - 1] if lines else "")


def _advice_on_words(line: str) -> str:
    """Say which word of a kernel's line, which is given without comments, only one of the languages takes as a name."""
    for word in re.findall(r"[^\W\d]\w*", line):
        if not word.isascii():
            return f"write {word} in letters of ASCII: GLSL has names of these alone"
        for language, words in ONE_LANGUAGE.items():
            if word in words.split():
                return f"use another word than {word}, which is a word of {language}"
    return ""


def _calls(text: str, name: str) -> bool:
    return re.search(rf"\b{name}\s*\(", text) is not None


def _advice_for(name: str, program: Program) -> str:
    """Say what a name that the compiler does not know may be: a library's function, or a knob's name misspelt."""
    for path in sorted(LIBRARIES.glob("*.glsl")):
        if re.search(rf"(?m)^(\w+ {name}\s*\(|.*\bstruct {name}\b)", path.read_text(encoding="utf-8")):
            return f'add "{path.stem}" to libraries in method.py: {name} is of it'
    knobs = [
        knob
        for section in program.sections
        if section.origin.startswith("generated: parameters")
        for knob in re.findall(r"#define (\w+)", section.text)
    ]
    if name.isupper():
        hint = suggestion(name, knobs)
        return f"{name} is no knob of the method; {hint}" if knobs else f"state Parameter({name!r}, …) in method.py"
    return ""
