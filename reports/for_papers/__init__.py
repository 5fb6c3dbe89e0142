"""Make what an author puts into a paper of a run: figures one column wide, pictures, and tables for LaTeX."""
