"""Stores runs, records and manifests, with their provenance.

May import: base, scene, ask, records.
"""
