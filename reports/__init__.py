"""Turns what an invocation left behind into a page that people read."""
