"""The judgement of records: tolerances, known disagreements, accepted results, speed.

May import: base, scene, ask, case, codes, records, store, plan.
"""
