"""Hold devices behind one interface, and run the worker processes that open them."""
