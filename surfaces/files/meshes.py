"""Tell meshes and other files that hold no equation, by how they begin."""

from __future__ import annotations

import re

SUFFIXES: tuple[str, ...] = (
    ".stl",
    ".obj",
    ".ply",
    ".off",
    ".gltf",
    ".glb",
    ".3mf",
    ".amf",
    ".vtk",
    ".vtp",
    ".vtu",
    ".fbx",
    ".dae",
)
PATCHES = (".step", ".stp", ".iges", ".igs")
WHAT_TO_DO = (
    "Take the formula that it was made from, or fit a function to it with another program and bring that function's "
    "formula or tape"
)


def refusal(kind: str) -> str:
    """Say why a file of a kind that `kind_of` returns is no implicit surface, and what to do."""
    if f".{kind.split()[-1].lower()}" in PATCHES:
        return f"{kind}; its patches are given by parameters u and v and by no equation of x, y and z. {WHAT_TO_DO}"
    return f"{kind}; a mesh is no implicit surface: it has triangles and no equation. {WHAT_TO_DO}"


def kind_of(content: bytes, suffix: str) -> str | None:
    """Return what kind of mesh a file is, by its first bytes and its suffix; None for a text that may be a formula."""
    head = content[:512]
    text = head.decode("latin-1").lstrip("\ufeff \t\r\n")
    facets = int.from_bytes(content[80:84], "little") if len(content) >= 84 else 0
    if facets and len(content) == 84 + 50 * facets:
        return "a binary STL"
    if re.match(r"solid\b", text) and re.search(r"\bfacet\b", content[:4096].decode("latin-1")):
        return "an STL"
    if re.match(r"ply\s", text):
        return "a PLY"
    if re.match(r"(?:ST)?C?N?4?OFF\b", text):
        return "an OFF"
    if head.startswith(b"glTF") or (text.startswith("{") and b'"asset"' in content and b'"meshes"' in content):
        return "a glTF"
    if head.startswith(b"PK\x03\x04"):
        return "a 3MF" if suffix == ".3mf" else "an archive"
    if re.search(r"^v\s+[-+.0-9]", text, re.MULTILINE) and re.search(rb"^f\s+[0-9]", content, re.MULTILINE):
        return "an OBJ"
    return f"a {suffix[1:].upper()}" if suffix in SUFFIXES + PATCHES else None
