"""Carries out an invocation: jobs are answered, measured, timed, judged and stored.

May import: base, scene, ask, case, codes, records, store, plan, gate.
"""
