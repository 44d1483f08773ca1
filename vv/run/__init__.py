"""One invocation: jobs answered from the store or by workers, measured, timed, written down.

May import: base, scene, ask, case, codes, records, store, plan, gate.
"""
