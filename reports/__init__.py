"""Writes the HTML report of an invocation from its manifest and the store.

May import: base, scene, ask, case, store, records, gate, insight, output.
"""
