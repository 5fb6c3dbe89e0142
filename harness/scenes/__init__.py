"""Scenes: surface instances with transforms, meshes among them, and one view. Nothing more: no materials, no lights but
the headlight.

A mesh is a surface that a method of triangles draws; so the oracle knows what it should be.
"""
