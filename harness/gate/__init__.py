"""Hold a config's rows against a blessed baseline, so that CI fails where a method gets worse.

`checked` runs a config's cells without timing them. `entries` makes of their rows what a baseline keeps. `baseline`
reads and writes the file. `judge` compares the two, and `outputs` tells people and CI servers of it. `against` holds a
config against another git revision instead, whose programs `revision` gets by running `export` there; `race` compares
the speed of both.
"""
