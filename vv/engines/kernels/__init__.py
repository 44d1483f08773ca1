"""Shared parts of the kernels of all engines: compilation, vectors of three, prescribed motions.

May import: base, scene.
"""
