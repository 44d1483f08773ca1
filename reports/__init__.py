"""Turns what an invocation left behind into a page that people read.

May import: base, scene, ask, case, store, records, gate, insight, output.
"""
