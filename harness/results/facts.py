"""List the facts of a device that a config may name in [gate] same."""

FACTS = ("title", "driver", "compiler", "processor")
