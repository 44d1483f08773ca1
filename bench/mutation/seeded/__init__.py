"""Plausible bugs, a file per kind: each is one text replaced by another, and who is to see it."""
