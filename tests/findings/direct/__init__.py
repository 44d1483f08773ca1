"""Claims of docs/findings.md on many runs together, which are no rows of a table."""
