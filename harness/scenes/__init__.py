"""Describe what is seen and from where: scenes of surfaces, cameras, sets of views, and meshes.

A scene (`model`) is instances of surfaces, each with a place, a turn and a scale, and one view. It has no materials,
and no light but a headlight. `choice` reads scenes from a config, `generate` makes scenes of any size. `camera` turns a
view into a camera and rays; `views` makes sets of views. `records` turns instances into what a device reads. `meshes`
makes triangles of a surface for the methods that draw triangles, so that the oracle knows what they should look like.
"""
