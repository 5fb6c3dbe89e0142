"""Hold a config's rows against a blessed baseline, so that CI fails where a method gets worse.

`checked` runs a config's cells without timing them, of which `chosen` chooses those that --only names. `entries` makes
of their rows what a baseline keeps. `baseline` reads and writes the file. `comparable` chooses what a row is held
against and by which rule, and `foretold` tells before anything runs what cannot be compared. `judge` compares the two.
`outputs` tells people of it and `servers` tells CI servers; `about` says of each row how to get it again, and
`pictures` gathers what its wrong rays are drawn from. `against` holds a config against another git revision instead,
whose programs `revision` gets by running `export` there; `race` compares the speed of both. `keep` keeps what `checked`
found by commit, which `repository` names.
"""
