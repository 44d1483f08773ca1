"""What many records say together: cost of an error, largest steps, history, comparison.

May import: base, scene, ask, case, records, store, plan, gate.
"""
