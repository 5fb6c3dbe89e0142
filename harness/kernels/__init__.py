"""Program text: whole files below `glsl/`, and sections that are generated for a surface, put in order.

`assemble` makes the programs; `functions` writes what a kernel may call of a surface; `fitting`, `rounding` and `reach`
compute the numbers that such text holds; `costs` counts its operations."""
