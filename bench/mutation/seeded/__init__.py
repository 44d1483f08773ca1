"""Plausible bugs, a file per kind: each replaces one text, and names what should detect it."""
