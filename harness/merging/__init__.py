"""Join runs of one config, of several machines or shards, to one run, and clear a run's folder of what is left over.

Rows are evidence: they are taken over byte for byte, and what is told otherwise (the name of a device that stands for
several) stands in plan.json alone.
"""
