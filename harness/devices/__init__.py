"""Devices behind one interface, and the worker processes that hold them."""
