"""Load and ask hostile plugins, beside a good one and one of firsthit's own methods, on every device here.

A deed is done while method.py is read, or in one of the method's functions; or a field or an answer is what it may not
be, or a file of the plugin is no ordinary one. A quarter of the plugins are only odd: they do and state what is
strange and allowed, and their rows have to be good. Most trials ask in this process, since a plugin's code has one of
its own; some run a whole command, whose exit code is looked at.
"""

from __future__ import annotations

import contextlib
import functools
import io
import os
import random
import shutil
import subprocess
import sys
from collections import Counter
from pathlib import Path
from unittest.mock import patch

import surfaces
from harness import memory
from harness.cli import main
from harness.contract import FirsthitError
from harness.hosting import host
from harness.plugins import find_methods
from harness.stated import FUNCTIONS
from tests.campaigns import beside
from tests.campaigns.frame import Campaign, Fell, Place

ROOT = Path(__file__).parents[2]
SECONDS, BYTES = 4.0, 300_000_000  # what a plugin's process has in a trial
LIMITED = f"""import functools, sys
from harness import memory
from harness.hosting import host
host.LOAD_SECONDS = host.CALL_SECONDS = {SECONDS}
host.Watch = functools.partial(memory.Watch, share={BYTES} / memory.of_machine())
from harness.cli import main
sys.exit(main())
"""
COMMAND_SHARE = 0.3  # of trials that run a command too

HEAD = """import atexit, builtins, json, math, numpy, os, pickle, shutil, signal, sys, threading, time
from firsthit import Method, Parameter
from harness.contract import MeshRecipe

HERE = os.path.dirname(os.path.abspath(__file__))

class Evil:
    def __repr__(self): raise SystemExit
    __str__ = __bool__ = __float__ = __int__ = __hash__ = __repr__
    def __eq__(self, other):
        while True: pass

class Endless:
    def __len__(self): return 3
    def __contains__(self, _): return True
    def __iter__(self):
        while True: yield 1.0

class Nasty(BaseException):
    def __str__(self): raise self

class Text(str):
    def __eq__(self, other): raise SystemExit
    __hash__ = None

class Knob(Parameter):
    sweep = property(lambda _: 1 / 0)

def deep(): return deep()

def spin():
    while True: pass

"""
DEEDS = (
    *("sys.exit(0)", "sys.exit('no')", "raise SystemExit", "raise KeyboardInterrupt", "raise GeneratorExit"),
    *("raise MemoryError", "raise StopIteration", "raise Nasty()", "raise RecursionError", "deep()", "1 / 0"),
    *("raise OSError(28, 'full')", "raise BrokenPipeError", "raise Exception('::error::x\\n\\x1b[2J')"),
    *("os._exit(0)", "os._exit(1)", "os.abort()", "os.kill(os.getpid(), 9)", "os.kill(os.getpid(), 2)"),
    *("os.kill(os.getpid(), 19)", "os.killpg(0, 15)", "signal.alarm(1)", "spin()", "time.sleep(99)"),
    *("HELD = [bytes([1]) * 2**26 for _ in range(64)]", "HELD = numpy.ones(10**11)", "HELD = 'x' * 10**9"),
    *("os.closerange(0, 99)", "os.close(1); os.close(2)", "sys.stdout.close()", "sys.stdout = sys.stderr = None"),
    *("os.chdir('/')", "os.environ.clear()", "sys.path.clear()", "sys.modules.clear()", "sys.argv.clear()"),
    *("signal.signal(signal.SIGTERM, signal.SIG_IGN)", "sys.setrecursionlimit(30)", "sys.excepthook = None"),
    *("numpy.array = numpy.float64 = None", "builtins.len = builtins.print = None", "builtins.open = None"),
    *("json.dumps = lambda *_: 'x'", "json.dumps = lambda *_: '{}'", "os.write = lambda *_: 0", "pickle.load = spin"),
    *("atexit.register(os.abort)", "atexit.register(spin)", "threading.Thread(target=spin).start()", "os.fork()"),
    *("threading.Thread(target=spin, daemon=True).start()", "os.fork() or time.sleep(9)"),
    *("os.fork() or (os.setsid(), time.sleep(9))", "os.fork() or os._exit(0)", "print('x' * 10**6)", "print('\\x00')"),
    *("print('\\x1b[2J\\n::error::x\\n##[error]y')", "os.write(1, os.urandom(9999))", "os.write(2, b'y' * 10**6)"),
    *(
        "os.write(int(sys.argv[1]), b'{}\\n')",
        "os.write(int(sys.argv[1]), b'{')",
        "os.write(int(sys.argv[1]), b'[]\\n')",
    ),
    *("os.write(int(sys.argv[1]), os.urandom(99))", "os.write(int(sys.argv[1]), b'x' * 10**5)"),
    *("os.remove(__file__)", "os.remove(HERE + '/kernel.glsl')", "shutil.rmtree(HERE)", "os.chmod(HERE, 0)"),
    *("os.remove(HERE + '/kernel.glsl'); os.mkfifo(HERE + '/kernel.glsl')", "import no_such_module", "assert False"),
    "import harness.stated; harness.stated.plain_answer = lambda *_: (object(), None)",
    "import harness.contract; harness.contract.CLAIMS.clear(); Method.accepts = 3",
    "if True print(3)",
)
VALUES = (
    *("None", "True", "3", "-1", "0", "math.nan", "math.inf", "1e308 * 10", "10**400", "10**5000", "1j", "b'x'", "''"),
    *("'x'", "'\\ud800'", "'a\\n::error::b\\x1b[31m'", "'x' * 10**6", "[]", "{}", "()", "object()", "Evil()", "Evil"),
    *("Endless()", "Nasty()", "Text('x')", "(x for x in iter(int, 1))", "range(10**12)", "numpy.ones(3)", "spin"),
    *("numpy.array([math.nan])", "numpy.float32(2)", "numpy.int64(2)", "[None]", "[Evil()]", "['x']", "lambda *_: 3"),
    *("{'A': [1.0, 2]}", "{'A': Endless()}", "{'A': [math.nan]}", "{'A': range(10**9)}", "{'a b': [1.0]}", "{'A': []}"),
    *("{3: [1.0]}", "{'A': 'xyz'}", "{'A': numpy.ones((2, 2))}", "{Text('A'): [1.0]}", "{'A': [10**400]}"),
    *("{'main': [1.0]}", "{'real': [1.0]}", "{'first_hit': [1.0]}", "{'A': [1e-320, -0.0]}", "{'A': [1.0] * 99_000}"),
    *("MeshRecipe('contour', 8)", "MeshRecipe('contour', 10**9)", "MeshRecipe(3, 3)", "MeshRecipe('parametric', 2.5)"),
    *("Parameter('N', 1, 'n')", "(Parameter('N', 1, 'n'),)", "(Parameter('N', None, 'n'),)", "(Knob('N', 1, 'n'),)"),
    *("(Parameter('N', 1, 'n', sweep=tuple(range(999))), Parameter('M', 1, 'm', sweep=tuple(range(999))))", "('a',)"),
    *("frozenset({'no_missed_root'})", "{'a': {'N': 1}}", "{'a': {'N': math.nan}}", "{'a': {'M': 1}}", "{'a': Evil()}"),
    *("{'a\\nb': {'N': 1}}", "('surface_value',)", "('float64',)", "frozenset({Text('x')})", "('x' * 10**5,)"),
)
# What is odd and does no harm alone, in every place where a deed may be; and what is odd and may be stated or answered.
ODD_DEEDS = (
    *("os.chdir('/')", "os.environ.clear()", "sys.argv.clear()", "sys.excepthook = None", "atexit.register(os.abort)"),
    *("signal.signal(signal.SIGTERM, signal.SIG_IGN)", "sys.stdout = sys.stderr = None", "sys.stdout.close()"),
    *("atexit.register(spin)", "threading.Thread(target=spin, daemon=True).start()", "os.fork() or time.sleep(9)"),
    *("os.fork() or (os.setsid(), time.sleep(9))", "os.fork() or os._exit(0)", "print('x' * 10**6)", "print('\\x00')"),
    *("print('\\x1b[2J\\n::error::x\\n##[error]y')", "os.write(1, os.urandom(9999))", "os.write(2, b'y' * 10**6)"),
)
ODD_FIELDS = {
    "source": ("'x' * 100", "'Łoś & <b>, $1 \\\\ 2%'", "Text('t')"),
    "label": ("''", "'A_b*c'", "'Łoś'"),
    "needs": ("['surface_along', 'surface_value_along']", "('surface_value_along', 'surface_along', 'surface_value')"),
    "libraries": ("[]", "('interval',)"),
    "parameters": (
        *("[Parameter('N', 1, '')]", "(Parameter('N', 1e-30, 'n', sweep=(-1.0, 1e30)),)"),
        *("(Parameter('N', numpy.int64(2), 'n', sweep=tuple(range(999))),)", "(Parameter('N', 1, 'n', printed=2.0),)"),
    ),
    "settings": ("{'a': {}}", "{'a': {'N': 2}, 'b': {'N': numpy.float32(3)}}"),
    "claims": ("set()", "frozenset()"),
    "precisions": ("['float32']", "('float64', 'float32')"),
}
ODD_ANSWERS = {
    "accepts": ("None",),
    "tolerance": ("0", "1e30", "-1.0", "1e-320", "numpy.float32(2)", "10**30"),
    "tables": (
        *("{}", "{'A': [1.0, 2]}", "{'A': numpy.ones(3)}", "{'A': range(1, 4)}", "{'A': {1.0: 2}}", "{'A': [-0.0]}"),
        *("{'A': [1.0] * 999}", "{'A': [1], 'B': [2]}", "{'A': (numpy.float64(1),)}"),
    ),
    "mesh": ("MeshRecipe('contour', 8)", "MeshRecipe('parametric', 2.0**4)"),
}
ODD_SHARE = 0.25  # of plugins that are only odd
FIELDS = ("name", "source", "label", "needs", "libraries", "parameters", "settings", "claims", "answers", "precisions")
FILES = ("absent", "folder", "pipe", "circle", "huge", "binary", "empty", "unreadable", "to /dev/zero")


def _written(dice: random.Random) -> tuple[str, str]:
    """Return the text of a method.py, and where it is hostile; "odd" of one that does no harm."""
    odd = dice.random() < ODD_SHARE
    deed = dice.choice(ODD_DEEDS) if odd else "; ".join(dice.sample(DEEDS[:-1], dice.choice((1, 1, 2))))
    place = dice.choice(
        ("load", "load", "end", "function", "function", "function", "answer", "answer", "field", "field")
    )
    stated = {"name": "'bad'", "source": "'t'", "parameters": "(Parameter('N', 1, 'n', printed=2),)"}
    stated["needs"] = "('surface_along', 'surface_value_along')"  # which the kernel calls
    functions = ""
    if place in ("function", "answer"):
        for name in dice.sample(FUNCTIONS[:3], dice.choice((1, 1, 2))) + dice.choice(([], ["mesh"])):
            answer = dice.choice(VALUES if place == "answer" and not odd else ODD_ANSWERS[name])
            when = dice.choice(("True", "True", "given[0].name == 'torus'", "os.getpid() % 2"))
            does = deed if place == "function" else "pass"
            does = does if ";" not in does and " = " not in does else f"exec({does!r}, globals())"
            functions += f"def {name}(*given):\n    if {when}:\n        {does}\n    return {answer}\n\n"
            stated[name] = name
    elif place == "field":
        fields = sorted(ODD_FIELDS) if odd else (*FIELDS, "casts", *FUNCTIONS)
        for name in dice.sample(fields, dice.choice((1, 1, 2, 3))):
            stated[name] = dice.choice(ODD_FIELDS[name] if odd else VALUES)
    how = dice.choice(
        ("Method", "Method", "Method", "type('M', (Method,), {'label': property(lambda _: 1 / 0, lambda *_: None)})")
    )
    how = "Method" if odd else how
    method = f"METHOD = {how}({', '.join(f'{name}={value}' for name, value in stated.items())})\n"
    first, last = (deed + "\n" if place == one else "" for one in ("load", "end"))
    if not odd and dice.random() < 0.03:
        first = DEEDS[-1] + "\n"
    return HEAD + first + functions + method + last, "odd" if odd else place


def _odd_file(dice: random.Random, folder: Path) -> None:
    """Make a file of a plugin what it should not be."""
    path, how = folder / dice.choice(("method.py", "kernel.glsl")), dice.choice(FILES)
    if how == "unreadable":
        path.chmod(0)
        return
    path.unlink()
    if how == "folder":
        path.mkdir()
    elif how == "pipe":
        os.mkfifo(path)
    elif how in ("circle", "to /dev/zero"):
        path.symlink_to(path if how == "circle" else "/dev/zero")
    elif how != "absent":
        path.write_bytes({"huge": b"", "binary": dice.randbytes(999), "empty": b""}[how])
        if how == "huge":
            os.truncate(path, 2**30)


def _write(folder: Path, text: str) -> None:
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    (folder / "method.py").write_text(text, errors="surrogatepass")
    (folder / "kernel.glsl").write_text(beside.KERNEL.replace("STEPS", "50"))


def _trial(dice: random.Random, place: Place) -> Counter[str]:
    plugins = place.own / "plugins"
    beside.write_good(plugins)
    text, where = _written(dice)
    _write(plugins / "bad", text)
    if where != "odd" and dice.random() < 0.08:
        _odd_file(dice, plugins / "bad")
        where = "file"
    told = io.StringIO()
    watch = functools.partial(memory.Watch, share=BYTES / (memory.of_machine() or BYTES))
    limits = patch.multiple(host, LOAD_SECONDS=SECONDS, CALL_SECONDS=SECONDS, Watch=watch)
    try:
        with limits, contextlib.redirect_stdout(told), contextlib.redirect_stderr(told):
            _ask(plugins)
            if where != "file":
                _write(plugins / "bad", text)  # again, since it may have removed itself
            bad = beside.BAD + dice.choice(("", "deviations = true\n"))
            seen = beside.tried(place.own, plugins, place.shared, bad, good=where == "odd")
    except (Fell, FirsthitError) as error:
        raise Fell(f"{where}: {error}\n{text[len(HEAD) :]}") from None
    if "\x1b" in told.getvalue() or "\n::error" in told.getvalue():
        raise Fell(f"what it printed was not escaped:\n{text[len(HEAD) :]}")
    if dice.random() < COMMAND_SHARE:
        seen.update(_command(dice, place, plugins, text))
    while sum(seen.values()) < 3:  # as many cases as the frame counts; fewer devices than three
        seen["no such device"] += 1
    return seen


def _ask(plugins: Path) -> None:
    """Load the methods and call all functions of the hostile one. Only FirsthitError may come of it."""
    catalog = find_methods(plugins)
    if not {"good", "newton"} <= catalog.plugins.keys():
        raise Fell("another method was lost")
    if "bad" not in catalog.plugins:
        if not catalog.broken["bad"]:
            raise Fell("it is broken without a reason")
        return
    method = catalog.get("bad").method
    for surface in map(surfaces.get, ("torus", "sphere")):
        knobs = dict(catalog.get("bad").variant({}).parameters)
        calls = {"accepts": (surface,), "tolerance": (surface, knobs), "tables": (surface, knobs, "float32")}
        for name, given in (calls | {"mesh": (surface, knobs)}).items():
            if function := getattr(method, name):
                with contextlib.suppress(FirsthitError):
                    function(*given)


CODES = {"run": (0, 3), "plan": (0, 3), "gate": (0, 3), "list": (0,), "compile": (0,)}


def _command(dice: random.Random, place: Place, plugins: Path, text: str) -> Counter[str]:
    """Run a whole command, and hold its exit code and what it says against what is documented."""
    config = [str(place.own / "beside.toml"), "--runs", str(place.own / "commands"), "--device", "opencl:pocl"]
    lines = {
        "run": ["run", *config],
        "gate": ["gate", *config, "--junit", str(place.own / "gate.xml")],
        "plan": ["plan", *config[:3]],
        "list": ["list", "methods", "--json"],
        "compile": ["compile", "--method", "good", "--device", "opencl:pocl", "--surface", "torus"],
    }
    name = dice.choice(sorted(lines))
    if name == "gate":
        whole = (place.own / "beside.toml").read_text()
        (place.own / "beside.toml").write_text(beside.CONFIG.format(bad=""))
        if main(["bless", *config, "--plugins", str(place.shared / "plugins"), "--reason", "without the hostile one"]):
            raise Fell("the baseline cannot be made")
        (place.own / "beside.toml").write_text(whole)
    command = [sys.executable, "-c", LIMITED, *lines[name], "--plugins", str(plugins)]
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    done = subprocess.run(command, cwd=place.own, env=environment, capture_output=True, text=True, check=False)
    told = f"{' '.join(lines[name])} ended with {done.returncode}\n{done.stderr[-1500:]}\n{text[len(HEAD) :]}"
    if done.returncode not in CODES[name] or "Traceback" in done.stderr:
        raise Fell(told)
    if name == "gate" and not (place.own / "gate.xml").read_text().count("<testcase"):
        raise Fell(f"no JUnit file; {told}")
    return Counter({f"{name} {done.returncode}": 1})


CAMPAIGN = Campaign(
    name="plugins",
    tries="asks a hostile plugin beside a good one and one of firsthit's methods, on three devices",
    promise="no traceback, no wrong exit code, no hang, no row of another method lost or changed",
    trial=_trial,
    small=6,
    whole=900,
    each=3,
    block=5,
    prepare=beside.prepare,
    limit=180,
    first=8,  # of a hostile one, and of one that is only odd
)
