"""Claims of docs/findings.md: tables of its words, each with the runs or the test that show it."""
