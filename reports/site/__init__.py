"""Make a static site from many runs: who wins where, with a page for each surface, method and run."""
