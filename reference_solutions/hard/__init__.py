"""References of cases that are hard for a code."""
