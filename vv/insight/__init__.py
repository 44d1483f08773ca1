"""Evaluates many records together: cost of an error, largest steps, history, comparison.

May import: base, scene, ask, case, records, store, plan, gate.
"""
