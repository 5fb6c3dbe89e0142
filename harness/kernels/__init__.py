"""Make the text of programs: whole files below `glsl/` and sections generated for a surface, in order.

`assemble` makes the programs of compute shaders, `raster` those of stage raster, `prepass` the one of a prepass, and
`tiles` those of the stages of tiles. `sections` has the parts that all of them are made of.
`functions` generates the functions of a surface that kernels may call, and `printing` turns their operations into
source text. `fitting`, `reach` and `rounding` compute numbers that such text holds. `costs` counts the operations of
the generated functions.

Nothing here knows a device: a program is text for a compiler, see `Program` in harness/contract.py.
"""
