"""Scenes: surface instances with transforms, meshes, and one view. Nothing more: no materials, and a headlight only."""

from harness.scenes.model import Group, Scene, single

__all__ = ["Group", "Scene", "single"]
