import re
from pathlib import Path

import numpy as np
import pytest

import surfaces
from harness.contract import FirsthitError, Program, Section
from harness.devices.interface import BuildError, map_rows
from harness.kernels.assemble import map_program, method_program
from harness.kernels.complaints import explained
from harness.kernels.sections import KERNELS, file_section, literal, table_section
from harness.plugins import BUILT_IN, find_methods


def _program(method="newton", surface="torus", precision="float32", language="glsl", entry="rays", **knobs):
    plugin = find_methods().get(method)
    return method_program(
        plugin.method, plugin.folder, plugin.variant(knobs), surfaces.get(surface), precision, language, entry
    )


def test_every_section_opens_with_its_file_and_lines_lead_back_to_it():
    program = _program()
    lines = program.text.split("\n")
    for section in program.sections:
        start = lines.index(f"// ==== {section.origin} ====")
        for offset, line in enumerate(section.text.rstrip().split("\n"), 1):
            assert lines[start + offset] == line
            assert program.locate(start + offset + 1) == (section.origin, offset)


def test_the_hash_follows_parameters_precision_language_and_text():
    hashes = [
        _program().hash,
        _program(EPSILON=0.002).hash,
        _program(precision="float64").hash,
        _program(language="cl").hash,
        _program(entry="camera").hash,
        _program(surface="sphere").hash,
        _program(method="null").hash,
    ]
    assert len(set(hashes)) == len(hashes)
    assert _program().hash == hashes[0]


@pytest.mark.parametrize(
    ("value", "precision", "language", "text"),
    [
        (0.1, "float32", "glsl", "0.1f"),
        (0.1, "float64", "glsl", "0.1lf"),
        (0.1, "float64", "cl", "0.1"),
        (1e-30, "float32", "cl", "1.0e-30f"),
        (-2.0, "float32", "cl", "(-2.0f)"),
        (100, "float64", "glsl", "100"),
    ],
)
def test_literals_keep_every_digit(value, precision, language, text):
    assert literal(value, precision, language) == text


def test_a_compile_error_names_the_sections_own_file_and_line(device):
    broken = Section(
        "methods/mine/kernel.glsl",
        "#define INPUTS 1\n#define OUTPUTS 1\nvoid map_item(IN real x[INPUTS], "
        "OUT real y[OUTPUTS]) {\n    y[0] = undeclared_name;\n}",
    )
    program = map_program(broken, "float32", device.language)
    with pytest.raises(BuildError, match=r"methods/mine/kernel\.glsl:4") as caught:
        device.build(program)
    assert "undeclared_name" in str(caught.value)


def test_log_lines_outside_any_section_do_not_break_the_explanation():
    program = Program("glsl", "float32", "map", (Section("a.glsl", "x"),))
    assert explained(program, "0:2(1): error: y\n0:99(1): z") == "a.glsl:1: y\n    | x\nend of program:0: z"


def test_an_unknown_library_is_named():
    with pytest.raises(FirsthitError, match="no kernel library 'nonesuch'"):
        map_program(Section("x", ""), "float32", "cl", libraries=("nonesuch",))


def test_a_map_program_runs_rows(device, rng):
    section = Section(
        "twice",
        "#define INPUTS 2\n#define OUTPUTS 1\n"
        "void map_item(IN real x[INPUTS], OUT real y[OUTPUTS]) { y[0] = x[0] + 2.0 * x[1]; }",
    )
    rows = rng.integers(-100, 100, (1000, 2)).astype(np.float32)
    result = map_rows(device, map_program(section, "float32", device.language), rows, 1)
    assert np.array_equal(result[:, 0], rows[:, 0] + 2 * rows[:, 1])


def test_a_table_reaches_the_kernel_bit_for_bit(device):
    values = [float(np.float32(v)) for v in (1 / 3, -2e-7, 1e30, 0.0)]
    section = Section(
        "lookup",
        "#define INPUTS 1\n#define OUTPUTS 4\nvoid map_item(IN real x[INPUTS], OUT real y[OUTPUTS]) {\n"
        "    for (int i = 0; i < 4; i++) y[i] = NUMBERS[i];\n}",
    )
    table = table_section("NUMBERS", values, "float32", device.language)
    result = map_rows(device, map_program((table, section), "float32", device.language), np.zeros((1, 1)), 4)
    assert result[0].tolist() == values


def _kernel_texts():
    files = [*KERNELS.rglob("*.glsl"), *BUILT_IN.glob("*/kernel.glsl")]
    return {path.relative_to(KERNELS.parents[2]): path.read_text() for path in files}


def _array_passed_twice(text: str) -> list[str]:
    arrays = set(re.findall(r"\breal\s+(\w+)\s*\[", text))
    calls = re.findall(r"\b\w+\(([^(){};]*)\)", text)
    return [call for call in calls for name in arrays if [a.strip() for a in call.split(",")].count(name) > 1]


@pytest.mark.parametrize(
    ("path", "text"), [pytest.param(*kernel, id=str(kernel[0])) for kernel in _kernel_texts().items()]
)
def test_no_array_is_passed_twice_in_a_call(path: Path, text: str):
    assert not _array_passed_twice(text), path


def test_the_scan_for_arrays_passed_twice_sees_one():
    assert _array_passed_twice("real c[5]; void f() { halve(c, 0.5, c); }")


@pytest.mark.parametrize("path", sorted(BUILT_IN.glob("*/kernel.glsl")), ids=lambda p: p.parent.name)
def test_methods_have_no_conditional_compilation_and_exact_literals(path: Path):
    text = re.sub(r"//.*", "", path.read_text())
    assert not re.search(r"#\s*(if|ifdef|else|pragma)", text)
    for number in re.findall(r"(?<![\w.])\d+\.\d*(?:e-?\d+)?", text):
        assert float(np.float32(float(number))) == float(number), f"{number} is not exact in binary32"


def test_a_kernel_that_is_edited_while_python_runs_is_read_anew(tmp_path):
    path = tmp_path / "kernel.glsl"
    for text in ("first", "second"):
        path.write_text(text)
        assert file_section(path).text == text
