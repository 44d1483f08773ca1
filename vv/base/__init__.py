"""Helpers without mechanics: digests, writing files, imports of a source, norms, errors.

May import: nothing of ours.
"""
