"""Typed results of jobs: measured, compared with references, written and read as JSON.

May import: base, scene, ask, case.
"""
