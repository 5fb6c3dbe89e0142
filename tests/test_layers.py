"""Who may import whom: a room imports only from rooms below it, inside functions too; no circles."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
LAYERS = (  # from the ground up; what stands in one line does not import each other
    ("surfaces.visible",),
    ("surfaces.words", "surfaces.model"),
    ("surfaces.tape",),
    ("surfaces.numbers",),
    ("surfaces.language", "surfaces.lowering"),
    ("surfaces.formula",),
    ("surfaces.evaluation",),
    ("surfaces.proofs",),
    ("surfaces.entries",),
    ("surfaces.catalog", "surfaces.families", "surfaces.forms", "surfaces.gallery"),
    ("surfaces",),  # the package itself
    ("surfaces.files",),
    ("harness.stopping",),
    ("harness.escaping", "harness.limits", "harness.memory"),
    ("harness.schemas",),
    ("harness.contract", "harness.__init__"),
    ("harness.stated",),
    ("harness.hosting",),
    ("harness.plugins", "harness.results", "harness.spreading"),
    ("harness.terminal",),
    ("harness.console", "harness.hardcases"),
    ("harness.oracle",),
    ("harness.kernels",),
    ("harness.devices",),
    ("harness.scenes",),
    ("harness.studies",),
    ("harness.accuracy",),
    ("harness.experiment",),
    ("harness.conformance", "harness.running", "harness.shipping"),
    ("harness.cluster",),
    ("harness.gate", "harness.merging", "harness.recommend", "harness.verifying"),
    ("firsthit",),
    ("harness.commands",),
    ("harness.cli",),
    ("harness.start",),
)
REPORTS = (
    ("reports.wording", "reports.published", "reports.place"),
    ("reports.content", "reports.labels"),
    ("reports.reading",),
    ("reports.analysis",),
    ("reports.drawing", "reports.sentences"),
    ("reports.claims",),
    ("reports.material",),
    ("reports.parts", "reports.rendering"),
    ("reports.first_page", "reports.for_papers"),
    ("reports.report", "reports.compare", "reports.history", "reports.recommended", "reports.site"),
)
OTHERS = {  # rooms beside the tower, and all that they may import of ours
    "methods": (
        *("firsthit", "harness.contract", "harness.kernels", "surfaces"),
        *("harness.scenes.meshes", "harness.oracle.balls64"),  # meshes for the tessellated, balls for bounds of f
    ),
    "reports": ("harness.contract", "harness.escaping", "harness.results", "surfaces.model"),
}
FROM_ABOVE = {("harness.commands", "reports"), ("firsthit", "reports")}  # beside their own layers' rule
LONGEST = 400  # lines
KINDS = "harness/experiment/kinds/"
READS_CONFIGS = "harness/experiment/resolving.py"  # asks which lists a config gives, and casts nothing
ASKED = ("casts", "stage", "stages", "prepass", "prepasses", "family", "families")  # what only kinds may branch on

FILES = sorted(
    p for room in ("surfaces", "harness", "firsthit", "methods", "reports") for p in (ROOT / room).rglob("*.py")
)


def name_of(path: Path) -> str:
    """Return a file's module: `harness.oracle.cache`, or `harness.oracle.__init__`."""
    return ".".join(path.relative_to(ROOT).with_suffix("").parts)


MODULES = {name_of(path).removesuffix(".__init__"): path for path in FILES}


def imports(tree: ast.AST) -> Iterator[tuple[int, str]]:
    """Yield the line and the name of each module of ours that a file imports, at its top or inside functions."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, name.name) for name in node.names if name.name in MODULES)
        elif isinstance(node, ast.ImportFrom):
            assert node.module and not node.level, "an import from a relative place, which this walk does not follow"
            for name in node.names:
                full = f"{node.module}.{name.name}"
                if full in MODULES or node.module in MODULES:
                    yield node.lineno, full if full in MODULES else node.module


def within(module: str, room: str) -> bool:
    return module == room or module.startswith(f"{room}.")


def rank(module: str, layers: tuple[tuple[str, ...], ...]) -> tuple[int, str] | None:
    """Return a module's layer and room; None where it is in none."""
    at = [(i, room) for i, rooms in enumerate(layers) for room in rooms if within(module, room)]
    return max(at, key=lambda found: len(found[1]), default=None)


def allowed(importer: str, imported: str) -> bool:
    """Tell whether the table lets one module import the other."""
    room, other = importer.partition(".")[0], imported.partition(".")[0]
    if (room, other) in {("harness", "harness"), ("reports", "reports")} or room not in OTHERS:
        layers = REPORTS if room == "reports" else LAYERS
        if any(within(importer, a) and within(imported, b) for a, b in FROM_ABOVE):
            return True
        mine, theirs = rank(importer, layers), rank(imported, layers)
        return mine is not None and theirs is not None and (mine == theirs or theirs[0] < mine[0])
    return room == other == "methods" or any(within(imported, name) for name in OTHERS[room])


def broken(path: Path) -> list[str]:
    """List the imports of a file that the table does not allow, with their lines."""
    importer = (
        name_of(path)
        if path.name == "__init__.py" and path.parent.name == "harness"
        else name_of(path).removesuffix(".__init__")
    )
    found = imports(ast.parse(path.read_text(encoding="utf-8")))
    version = {"harness": "harness.__init__"}
    return [
        f"{path.relative_to(ROOT)}:{line}: {importer} may not import {name}"
        for line, name in found
        if not allowed(importer, version.get(name, name))
    ]


def test_rooms_import_only_from_rooms_below():
    assert not [line for path in FILES for line in broken(path)]


@pytest.mark.parametrize(
    ("importer", "imported"),
    [
        ("surfaces.tape", "harness.contract"),
        ("surfaces.language.reading", "surfaces.proofs.signs"),
        ("surfaces.gallery.blobs", "surfaces.files.own"),
        ("harness.kernels.functions", "harness.devices.worker"),
        ("harness.accuracy.check", "harness.experiment.config"),
        ("harness.gate.judge", "harness.recommend.search"),
        ("reports.analysis.derive", "reports.drawing.tables"),
        ("reports.parts.method_cards", "harness.plugins"),
        ("methods.newton.method", "harness.running.runner"),
        ("harness.running.runner", "reports.report"),
    ],
)
def test_the_table_forbids(importer, imported):
    assert not allowed(importer, imported)


def test_no_module_imports_itself_by_way_of_others():
    arrows = {
        name: {other for _, other in imports(ast.parse(path.read_text(encoding="utf-8"))) if other != name}
        for name, path in MODULES.items()
    }
    while leaves := {name for name, others in arrows.items() if not others & arrows.keys()}:
        arrows = {name: others for name, others in arrows.items() if name not in leaves}
    assert not {name: sorted(others & arrows.keys()) for name, others in arrows.items()}


def test_no_file_is_too_long():
    files = [*FILES, *(ROOT / "tests").rglob("*.py")]
    lengths = {str(p.relative_to(ROOT)): len(p.read_text(encoding="utf-8").splitlines()) for p in files}
    assert not {path: lines for path, lines in lengths.items() if lines > LONGEST}


def branches(tree: ast.AST) -> Iterator[tuple[int, str]]:
    """Yield the line and attribute of each condition on how a cell or a method is cast."""
    for node in ast.walk(tree):
        conditions: list[ast.expr] = []
        if isinstance(node, ast.If | ast.IfExp | ast.While | ast.Assert):
            conditions = [node.test]
        elif isinstance(node, ast.comprehension):
            conditions = node.ifs
        elif isinstance(node, ast.Compare | ast.BoolOp | ast.Match):
            conditions = [node.subject] if isinstance(node, ast.Match) else [node]
        elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
            conditions = [node.operand]
        for condition in conditions:
            for part in ast.walk(condition):
                if isinstance(part, ast.Attribute) and part.attr in ASKED:
                    yield part.lineno, part.attr


def test_only_kinds_branch_on_how_is_cast():
    found = {
        f"{path.relative_to(ROOT)}:{line}: {attribute}"
        for path in FILES
        if not path.is_relative_to(ROOT / KINDS) and not path.is_relative_to(ROOT / "reports")
        if path != ROOT / READS_CONFIGS
        for line, attribute in branches(ast.parse(path.read_text(encoding="utf-8")))
    }
    assert not found


def test_a_branch_is_seen():
    text = "x = 1 if cell.stage == 'raster' else 2\nif not cell.family: pass\n[p for p in q if p.cell.casts]"
    assert {attribute for _, attribute in branches(ast.parse(text))} == {"stage", "family", "casts"}
    assert not re.search("kinds", "".join(attribute for _, attribute in branches(ast.parse("f(cell.stage)"))))
