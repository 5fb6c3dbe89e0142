"""State what commands answer with --json, in dataclasses, of which docs/machine.md and `firsthit schema --of` are made.

A field is added by stating it, with its meaning in the docstring, and by filling it in the command. A field that is
taken away or changes its meaning raises FORMAT of harness/commands/machine.py. `table` lists the commands.
"""
