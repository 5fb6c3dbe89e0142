"""What `firsthit` does, a module per group of commands. Each adds its parsers and names the function that runs."""
