"""Claims about what is kept of runs, and taken from there in place of running again."""
