"""Check stored rows again by what they say: a stranger's row, or one that lay on a disk for long.

A row names its surface, rays, samples and answers. So its counts, quantiles and times can be computed again, and the
truth that it was judged by can be certified anew. Nothing is cast, and no device is opened.

Reading a row holds it against its checksum, its declaration and itself (harness.results). `checks` lists what else is
done: `stated` (identity and columns), `times` (samples), `answers` (arrays), `truth` (the oracle) and `rungs` (the
oracle on families). Each takes a row and yields what does not hold, or says why it cannot tell.
"""
