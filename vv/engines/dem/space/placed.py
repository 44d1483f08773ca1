"""A scene of spheres with their rows in arrays, from which terms are built."""

from __future__ import annotations

import functools
from dataclasses import dataclass

import numpy as np

from vv.engines.dem.bonds.layout import Bonded, bonds_of, search_data
from vv.engines.dem.contact.law import NO_FRICTION, Law, law_of
from vv.engines.dem.rows import Index
from vv.engines.dem.space.neighbours import Near
from vv.scene import Mask, Scene, Vector


@dataclass(frozen=True, eq=False)
class Placed:
    """A scene, which of its spheres move (n,), and the row of each (n,), m for spheres at rest.

    carried: (m, 3) steady velocities [m/s]; charged: (m, 3) tangential force at the wall at t = 0
    [N], or None; bonds: those with at least one moving end; near: data of the neighbour search, or
    None.
    """

    scene: Scene
    moves: Mask
    row: Index
    carried: Vector
    charged: Vector | None
    bonds: Bonded
    near: Near | None

    @property
    def may_touch(self) -> bool:
        """Whether a moving sphere can touch a wall or another sphere."""
        return bool(self.moves.any()) and (len(self.scene.walls) > 0 or len(self.scene.spheres) > 1)

    @property
    def decides_at_run_time(self) -> bool:
        """Whether every step decides at run time if there are friction and rotation.

        This is so where a step takes so long that the decision costs next to nothing; then fewer
        kernels are compiled.
        """
        dear = self.walls_move or self.scene.contact.viscous
        return dear and self.scene.bonds is None

    @functools.cached_property
    def law(self) -> Law:
        """The contact law."""
        law = law_of(self.scene)
        return (
            law._replace(friction=law.friction or NO_FRICTION, at_run_time=0)
            if self.decides_at_run_time
            else law
        )

    @property
    def walls_move(self) -> bool:
        """Whether any wall moves, if there are moving spheres."""
        return bool(self.moves.any()) and any(wall.motion for wall in self.scene.walls)


def placed(scene: Scene, charged: Vector | None = None) -> Placed:
    """Assign rows to the spheres of a scene that can move; charged: (n, 3), see `Placed`."""
    spheres, carried = scene.spheres, scene.locked_velocity
    moves: Mask = np.any([spheres.free, spheres.free_spin, carried != 0.0], axis=(0, 2))
    row = np.where(moves, np.cumsum(moves) - 1, moves.sum())
    started = charged[moves] if charged is not None else None
    bonds = bonds_of(scene, moves, row)
    close = search_data(scene, moves, row, bonds.state)
    return Placed(scene, moves, row, carried[moves], started, bonds, close)
