"""A report's content → PDF and HTML."""
