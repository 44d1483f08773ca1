"""Expands a selection of cases and codes into jobs, and makes the keys of their results.

May import: base, scene, ask, case, codes, store.
"""
