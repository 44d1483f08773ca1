"""Rigid blocks with exact Coulomb friction, without penalty springs.

May import: base, scene, ask, standins, engines.kernels, engines.blocks.
"""

from vv.engines.rigid.solve import PreparedRigidBlocks, prepare, refuses, solve

__all__ = ["PreparedRigidBlocks", "prepare", "refuses", "solve"]
