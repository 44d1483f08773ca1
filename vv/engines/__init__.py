"""The in-house solvers, a folder each, and the compiled helpers that they share.

May import: nothing of ours.
"""
