"""The benchmarks: one file each, ending in CASE.

May import: scene, ask, case, reference_solutions.
"""
