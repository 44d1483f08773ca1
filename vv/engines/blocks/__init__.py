"""Geometry and contact detection of convex blocks, for all engines that solve scenes of blocks.

May import: base, scene, ask, standins, engines.kernels.
"""
