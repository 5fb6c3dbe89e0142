"""A frame of tiles whose stages share nothing: Newton's method casts each pixel by itself, wherever a stage answers it.

It says what the harness must do for a method that casts tiles, whatever that method does: launch the stages, hand over
listed rays, and read answers. Which stage answers a pixel follows from its place alone (`expected_stages`), but for the
tiles whose rays all pass the domain by.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from harness.contract import Program, Section
from harness.experiment.kinds.tiles import CHECKED, TIMED
from harness.kernels.assemble import STAGES
from harness.kernels.sections import cast_sections, early_libraries, files, kept_loops, method_sections, ray_sections
from harness.plugins import find_methods
from harness.scenes.camera import meets, rays_of

METHOD = "newton"
SHAPE = {
    "TILE": 16,
    "LEVELS": 2,
    "GRID": 0,
    "OPEN_RECORD": 1,
    "SINGLE_RECORD": 1,
    "QUEUE_RECORD": 2,
    "TILE_ITEMS": 1,
    "TILE_GROUP": 1,
    "TILE_TURNS": 1,
}
BUFFERS = (
    ("camera", "float", "readonly"),
    ("t", "real", ""),
    ("answer", "int", ""),
    ("queue", "int", ""),
    ("counts", "int", ""),
    ("entries", "real", ""),
    ("fourths", "real", "readonly"),
    ("rays", "float", "readonly"),
)
NUMBERS = ("nx", "ny", "size", "tile", "level", "ratio")
# `G` stands for what a function is handed of the frame, and `A` hands it on. Counters 0 to 7 count lists, 8 to 15 what
# is taken of them. A level's lists begin at `first_of` in the queue.
COMMON = """
vec3 vector(G int k) { return vec3(real(camera[k]), real(camera[k + 1]), real(camera[k + 2])); }

Ray pixel_ray(G int i, int j) {
    int middle = (ratio - 1) / 2;
    if (LISTED == 0 || i % ratio != middle || j % ratio != middle || max(i, j) >= size) {
        return camera_ray(vector(A 0), vector(A 3), vector(A 6), vector(A 9), i, j, size, size);
    }
    int k = 6 * ((j / ratio) * (size / ratio) + i / ratio);
    return make_ray(vec3(real(rays[k]), real(rays[k + 1]), real(rays[k + 2])),
                    vec3(real(rays[k + 3]), real(rays[k + 4]), real(rays[k + 5])));
}

int across(int size, int side) { return (size + side - 1) / side; }

int first_of(int size, int level) {
    return level == 0 ? 0 : 2 * across(size, 16) * across(size, 16);
}

void cast_pixel(G int i, int j, int stage) {
    if (max(i, j) >= size) return;
    Cast result = cast_ray(pixel_ray(A i, j));
    int p = j * size + i;
    if (LISTED == 1) {
        t[2 * p] = result.shift;
        t[2 * p + 1] = result.hit.t;
    } else {
        t[p] = result.shift + result.hit.t;
    }
    answer[p] = is_answer(result.hit.status, result.hit.evaluations)
                    ? (result.hit.evaluations * 32 + stage) * 4 + result.hit.status : NO_ANSWER;
}

bool passes_by(G int i, int j) {
    Ray ray = pixel_ray(A i, j);
    Span span = domain_span(advanced_ray(ray, own_shift(ray)));
    return span.lo > span.hi;
}

void isolate_stage(G int nothing) {
    int count = level == 0 ? across(size, tile) * across(size, tile) : 4 * counts[0];
    int e = ADD(counts[8 + level], 1);
    while (e < count) {
        int x = e % across(size, tile);
        int y = e / across(size, tile);
        if (level > 0) {
            int cell = queue[e / 4];
            x = 2 * (cell & 0xffff) + (e & 1);
            y = 2 * (cell >> 16) + ((e >> 1) & 1);
        }
        bool empty = true;
        for (int k = 0; k < tile * tile; k++) {
            if (!passes_by(A x * tile + k % tile, y * tile + k / tile)) empty = false;
        }
        if (max(x, y) * tile < size) {
            if (empty) {
                for (int k = 0; k < tile * tile; k++) {
                    int i = x * tile + k % tile;
                    int j = y * tile + k / tile;
                    if (max(i, j) < size) answer[j * size + i] = level * 4;
                }
            } else if ((level == 0 ? x + y : x) % 2 == 0) {
                int slot = ADD(counts[2 + level], 1);
                queue[first_of(size, level) + across(size, tile) * across(size, tile) + slot] = x | (y << 16);
            } else {
                int slot = ADD(counts[level], 1);
                queue[first_of(size, level) + slot] = x | (y << 16);
            }
        }
        e = ADD(counts[8 + level], 1);
    }
}

void finish_stage(G int nothing) {
    int e = ADD(counts[10 + level], 1);
    while (e < counts[2 + level] * tile * tile) {
        int cell = queue[first_of(size, level) + across(size, tile) * across(size, tile) + e / (tile * tile)];
        int k = e % (tile * tile);
        cast_pixel(A (cell & 0xffff) * tile + k % tile, (cell >> 16) * tile + k / tile, 2 + level);
        e = ADD(counts[10 + level], 1);
    }
}

void packets_stage(G int nothing) {
    int e = ADD(counts[12], 1);
    while (e < counts[1] * 64) {
        int cell = queue[first_of(size, 1) + e / 64];
        int i = (cell & 0xffff) * 8 + e % 8;
        int j = (cell >> 16) * 8 + (e / 8) % 8;
        if ((i / 4 + j / 4) % 2 == 0) {
            cast_pixel(A i, j, 4);
        } else if (max(i, j) < size) {
            int slot = ADD(counts[4], 1);
            queue[first_of(size, 1) + 2 * across(size, 8) * across(size, 8) + slot] = j * size + i;
        }
        e = ADD(counts[12], 1);
    }
}

void rest_stage(G int nothing) {
    int e = ADD(counts[13], 1);
    while (e < counts[4]) {
        int p = queue[first_of(size, 1) + 2 * across(size, 8) * across(size, 8) + e];
        cast_pixel(A p % size, p / size, 5);
        e = ADD(counts[13], 1);
    }
}
"""


def stage_program(method, _folder, variant, surface, precision, language, stage, listed, rest, _lanes):
    """Return the program of a stage, as harness.kernels.tiles.stage_program does."""
    sections = ray_sections(surface, method.needs, precision, language, early_libraries(method))
    sections += method_sections(method, rest, variant, surface, precision, language)
    shape = SHAPE | {"LISTED": int(listed), "TILE_GROUP": 1 if language == "cl" else 8}
    shape["TILE_GROUP"] = 64 if stage == "rest" else shape["TILE_GROUP"]
    lines = [f"#define {name} {value}" for name, value in shape.items()]
    sections += [Section("stand-in: shape", "\n".join(lines)), *cast_sections("nearest"), *files("rays/camera.glsl")]
    if language == "cl":
        handed = [f"__global {'const ' if how else ''}{kind} *{name}" for name, kind, how in BUFFERS]
        handed += [f"int {name}" for name in NUMBERS]
        names = [name for name, _, _ in BUFFERS] + list(NUMBERS)
        text = COMMON.replace("(G ", f"({', '.join(handed)}, ").replace("(A ", f"({', '.join(names)}, ")
        text = text.replace("ADD(", "atomic_add(&")
        start = f"__kernel void {stage}({', '.join(handed)})"
        ids, run = "get_global_id(0)", f"{stage}_stage({', '.join(names)}, 0);"
    else:
        sections.insert(1, kept_loops())
        buffers = [
            f"layout(std430, binding = {k}) {how} buffer Buffer{k} {{ {kind} {name}[]; }};"
            for k, (name, kind, how) in enumerate(BUFFERS)
        ]
        uniforms = [f"uniform int {name};" for name in NUMBERS]
        head = ["layout(local_size_x = TILE_GROUP) in;", *buffers, *uniforms]
        text = "\n".join(head) + COMMON.replace("(G ", "(").replace("(A ", "(").replace("ADD(", "atomicAdd(")
        start, ids, run = "void main()", "gl_GlobalInvocationID.x", f"{stage}_stage(0);"
    clear = f"if (level < 0) {{ if ({ids} < 64) counts[{ids}] = 0; return; }}"
    sections.append(Section("stand-in: stages", f"{text}\n{start} {{ {clear} {run} }}"))
    return Program(language, precision, stage, tuple(sections))


def programs(surface, precision, language, listed, **knobs):
    """Return a frame's programs, of listed rays or not."""
    plugin = find_methods().get(METHOD)
    stated = plugin.method, plugin.folder, plugin.variant(knobs), surface, precision, language
    made = (stage_program(*stated, *STAGES[entry], plugin.folder, None) for entry in (CHECKED if listed else TIMED))
    return tuple(made)


def stand_in():
    """Return a method that casts tiles, to be run with this module's `stage_program`."""
    return replace(find_methods().get(METHOD).method, name="stand_in", casts="tiles", rest=METHOD)


def expected_stages(surface, camera, size):
    """Return uint8[size, size], the stage that answers each pixel of a frame, from the pattern above."""
    inside = np.zeros((-(-size // 16) * 16,) * 2, bool)
    inside[:size, :size] = meets(surface.domain, rays_of(camera, size)).reshape(size, size)
    y, x = np.mgrid[:size, :size]

    def met(side):
        blocks = inside.reshape(len(inside) // side, side, -1, side).any(axis=(1, 3))
        return blocks.repeat(side, 0).repeat(side, 1)[:size, :size]

    packets = np.where((x // 4 + y // 4) % 2 == 0, 4, 5)
    smaller = np.where(~met(8), 1, np.where(x // 8 % 2 == 0, 3, packets))
    return np.where(~met(16), 0, np.where((x // 16 + y // 16) % 2 == 0, 2, smaller)).astype(np.uint8)
