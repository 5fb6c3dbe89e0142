"""What a cell leaves behind: its row, the files that rows are kept in, and the figures that are read from it."""
