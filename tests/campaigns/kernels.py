"""Compile and cast hostile kernels, beside a good one and one of firsthit's own methods, on every device here."""

from __future__ import annotations

import contextlib
import io
import random
from collections import Counter

from harness.contract import FirsthitError
from tests.campaigns import beside
from tests.campaigns.frame import Campaign, Fell, Place

METHOD = """from firsthit import Method, Parameter

METHOD = Method("bad", "t", needs=("surface_along", "surface_value_along"), parameters=(Parameter("STEPS", 50, "n"),))
"""
BOMB = "#define A0 (1.0 + 1.0)\n" + "".join(f"#define A{i + 1} (A{i} + A{i})\n" for i in range(24))
CIRCLE = "#define B0 B1\n#define B1 B0\nreal circle() { real B0 = 1.0; return B0; }\n"
ABOVE = (  # what stands above first_hit
    *("#error no", "#line 99999", '#line 7 "/etc/passwd"', "#pragma nonsense", "#pragma OPENCL EXTENSION all : enable"),
    *("#extension GL_none : require", "#version 100", "#if 0", "#if 1", "#endif", "#else", "#", "\\", "/*", "*/", '"'),
    *("#define real int", "#define real float4", "#define first_hit", "#define first_hit second_hit", "#undef STEPS"),
    *("#define HIT 0", "#define MISS 1", "#define if while", "#define while if", "#define return", "#define Hit Ray"),
    *("#define STEPS 1000000000", "#define t0 t1", "#define hit_at(a, b) a", "#define t answer", "#define answer t"),
    *("#define int float", "#define main none", "#define __kernel", "#define uint uint64_t", "#undef DOMAIN_RADIUS"),
    *("#define M(x) M(x x)\n#define N M(M(M(1)))", CIRCLE, "struct Hit { int a; };", "struct S { struct S s; };"),
    *("real surface_value_along(Along along, real t) { return 0.0; }", "Hit no_hit(real t) { Hit h; return h; }"),
    *(
        "void main() {}",
        "__kernel void rays() {}",
        "kernel void x(global float *p) { p[1 << 30] = 1.0f; }",
        "int real;",
    ),
    *("int f(int n) { return n < 1 ? 1 : f(n - 1); }", "int f(int n);\nint g(int n) { return f(n); }\nint f(int n) "),
    *("real huge[1 << 28];", "__constant float TABLE[3] = {1, 2};", "uniform int answer[];", "shared float s[99999];"),
    *("layout(local_size_x = 99999) in;", "__attribute__((reqd_work_group_size(9999, 1, 1)))", "goto x;", "asm();"),
    *("typedef float real;", "precision lowp float;", "discard;", "int 变量 = 3;", "\0", "\x1b[31m", "}", "{", ";;;;"),
    *("x" * 100_000, "/* " + "y" * 500_000 + " */", "// \\\n#error a", "??=error x", "int a = 0x;", "\r\rint b;\r"),
    *("real z(real x) { return x; }\n" * 3000, "(" * 3000, "{" * 3000, "real y = " + "-" * 5000 + "1.0;"),
)
WITHIN = (  # what stands in first_hit, before its search
    *("while (true) { hit.evaluations += 1; }", "for (int i = 0; i >= 0; i += 0) { t1 = t1 + 1e-9; }", "for (;;) {}"),
    *("for (int i = 0; i < 2000000000; i++) { t1 = sin(t1); } if (t1 == 0.5) return hit_at(hit, t1);",),
    *("do { t0 = t0 * 0.5; } while (t0 != t0 + 1.0);", "int z = int(t0) - int(t0); return hit_at(hit, real(7 / z));"),
    *("real a[4]; for (int i = 0; i < 100000; i++) { a[i * 37] = t0; } return hit_at(hit, a[2]);",),
    *("real a[4]; return hit_at(hit, a[int(t1 * 1e9)]);", "real a[4]; a[-900] = 1.0; return hit_at(hit, a[0]);"),
    *("real a[3000000]; a[int(t0)] = 1.0; return hit_at(hit, a[int(t1)]);", "return hit_at(hit, t0 / 0.0);"),
    *("return hit_at(hit, sqrt(-1.0 - t0 * t0));", "return hit_at(hit, t1 * 100.0);", "return hit_at(hit, -t1);"),
    *("hit.status = 77; return hit;", "hit.evaluations = -5; return missed(hit);", "hit.evaluations = 2147483647;"),
    *("return hit;", "Hit h; return h;", "return missed(hit);", "hit.t = -0.0; hit.status = HIT; return hit;"),
    *(
        "t[0] = 3.0; t[1] = 3.0; answer[0] = 1;",
        "for (int k = 0; k < 256; k++) { answer[k] = 65; t[2 * k + 1] = 1.0; }",
    ),
    *("answer[1000000000] = 1;", "ray_data[0] = 1.0;", 'printf("::error::%d\\n", 1);', 'printf("\\x1b[2J%n", 1);'),
    *(
        'asm("hlt");',
        '__asm__ volatile("ud2");',
        "barrier();",
        "barrier(CLK_LOCAL_MEM_FENCE);",
        "atomicAdd(answer[0], 1);",
    ),
    *(
        "int i = get_global_id(0); if (i == 3) { while (true) {} }",
        "discard;",
        "return 3;",
        "return;",
        "exit(0);",
        "abort();",
    ),
    *(
        "gl_FragDepth = 1.0;",
        "imageStore(0, 0, 0);",
        "__builtin_trap();",
        "__builtin_unreachable();",
        "first_hit(ray, t0, t1);",
    ),
    *("*(int*)0 = 1;", "*((__global int*)1234567) = 1;", "((void(*)())0)();", "int *p = &hit.status; p[99999999] = 1;"),
    *(
        "int n = 1 << 40; return hit_at(hit, real(n));",
        "real q = 1e400; return hit_at(hit, q);",
        "hit.t = 1e-45; return hit;",
    ),
    *("return hit_at(hit, A24);", "switch (1) { default: break; case 1: case 1: break; }", "{ { { real t0; } } }"),
    *("{" * 800 + "}" * 800, "if (t0 > 0.0) " * 800 + ";", "t1 = " + "(" * 900 + "t1" + ")" * 900 + ";"),
    *("t1 = t1 + sin(t0);\n" * 4000, "real v = " + " + ".join(["t0"] * 5000) + ";", "wait_group_events(0, 0);"),
)


def _kernel(dice: random.Random) -> str:
    """Return a hostile kernel: parts above, within and below the good one."""
    text = beside.KERNEL
    which = dice.choice(("above", "within", "within", "both", "below", "text"))
    if which in ("above", "both"):
        text = "\n".join([*dice.sample(ABOVE, dice.choice((1, 1, 2, 3))), text])
    if which in ("within", "both"):
        part = dice.choice(WITHIN)
        text = (BOMB if "A24" in part else "") + text.replace("    Along along", f"    {part}\n    Along along", 1)
    if which == "below":
        text += dice.choice(ABOVE) + dice.choice(("", "\n"))
    if which == "text":
        for _ in range(dice.choice((1, 3, 30))):
            at = dice.randrange(len(text))
            text = (
                text[:at] + dice.choice(("", "(", "}", ";", "#", "0", "\\", "\n", "*", "é", "real ")) + text[at + 1 :]
            )
    return text


def _trial(dice: random.Random, place: Place) -> Counter[str]:
    plugins, text = place.own / "plugins", _kernel(dice)
    beside.write_good(plugins)
    (plugins / "bad").mkdir()
    (plugins / "bad" / "method.py").write_text(METHOD)
    (plugins / "bad" / "kernel.glsl").write_bytes(text.encode())
    try:
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            seen = beside.tried(place.own, plugins, place.shared)
    except (Fell, FirsthitError) as error:
        raise Fell(f"{error}\n{text[:3000]}") from None
    return seen


CAMPAIGN = Campaign(
    name="kernels",
    tries="casts a hostile kernel beside a good one and one of firsthit's methods, on three devices",
    promise="no traceback, no hang beyond the time-out, no failure without a reason, no row of others lost or changed",
    trial=_trial,
    small=3,
    whole=900,
    each=3,
    block=5,
    prepare=beside.prepare,
    limit=300,
)
