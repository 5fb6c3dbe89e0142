"""Scenes: surface instances with transforms, meshes among them, and one view. Nothing more: no materials, no lights but
the headlight.

A mesh is a surface that a method of triangles draws; so the oracle knows what it should be.
"""

from harness.scenes.choice import PlacedChoice, SceneChoice, cut, scenes_of
from harness.scenes.model import Group, Scene, single

__all__ = ["Group", "PlacedChoice", "Scene", "SceneChoice", "cut", "scenes_of", "single"]
