"""Convex blocks: their geometry, and detection of their contacts, for every solver of blocks.

May import: base, scene, ask, standins, engines.kernels.
"""
