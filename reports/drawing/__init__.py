"""Draw the figures and pictures of a report, and make the tables that several parts share."""
