"""What is kept of results: runs, records, manifests, and where each came from.

May import: base, scene, ask, records.
"""
