"""Hold a config's rows against a blessed baseline, so that CI fails where a method gets worse.

`checked` runs a config's cells without timing them. `entries` makes of their rows what a baseline keeps. `baseline`
reads and writes the file. `comparable` chooses what a row is held against and by which rule, and `foretold` tells
before anything runs what cannot be compared. `judge` compares the two, and `outputs` tells people and CI servers of it.
`against` compares speed with another git revision, whose programs `revision` gets by running `export` there.
"""
