"""Evaluates many records together: cost of errors, stability, history, comparison.

May import: base, scene, ask, case, records, store, plan, gate.
"""
