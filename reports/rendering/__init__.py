"""Render a report's content as PDF and as HTML."""
