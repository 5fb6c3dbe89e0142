"""Write a method's program for a surface out of the harness, for programs of somebody else's.

`program` puts the text together from the sections that the harness itself casts, and `pruned` leaves out what nothing
calls. `package` adds a head that says what it is, an example that draws it, and the licence. `trial` runs the text on a
device beside the harness's own program, and holds the answers of both against each other, bit for bit.
"""
