"""Write the sentences of the first page."""
