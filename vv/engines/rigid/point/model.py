"""Builds the smallest model: one block that cannot rotate, on at most one wall, as a point mass."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from vv.engines.blocks.single_block import Lone, lone
from vv.engines.rigid.limits import FINEST, TOUCHING
from vv.engines.rigid.scales import scales
from vv.scene import Scene, Term, Vector


@dataclass(frozen=True, eq=False)
class Point:
    """The translation of a single block."""

    lone: Lone
    scene: Scene
    terms: frozenset[Term]

    @property
    def unknowns(self) -> int:
        """The number of free translations."""
        return int(self.lone.block.free.sum())

    @property
    def closes(self) -> bool:
        """Whether the energy balance holds to rounding: always."""
        return True

    @property
    def words(self) -> str:
        """A description of the model."""
        return f"{self.unknowns} translations of a point mass with one contact"

    def outputs(self, rows: int, watched: tuple[int, ...]) -> tuple[Vector, ...]:
        """The arrays that the kernel fills: path, energy, report and reaction."""
        walls = np.zeros((rows, 1, 3))
        return np.empty((rows, 6)), np.empty((rows, 8)), np.empty((rows, 4)), walls

    def arguments(self, dt: float) -> tuple[Any, ...]:
        """The arguments of the kernel that describe the scene, for a step dt [s]."""
        from vv.engines.kernels.drive import NO_MOTION, drive
        from vv.engines.rigid.point.trial import Ground

        block, wall, hold = self.lone.block, self.lone.wall, self.lone.hold
        scene, held, known = self.scene, self.lone.gap, scales(self.scene)
        size = np.ptp(block.vertices, axis=0).max()
        ground = Ground(
            gravity=_triple(hold @ scene.gravity),
            load=_triple(hold @ block.load / block.mass),
            normal=_triple(wall.normal),
            gap=held if abs(held) > TOUCHING * size else 0.0,
            mu=scene.contact.mu,
            base=drive(wall.motion or NO_MOTION),
            shaking=drive(scene.shaking or NO_MOTION),
            hold=hold,
            pull=known.pull,
            braking=known.braking,
            fine=FINEST * (known.given + known.pull * dt),
            quick=known.quick,
        )
        return _triple(hold @ block.velocity), ground

    def kernel(self) -> Callable[..., int]:
        """The compiled kernel; the first call imports numba."""
        from vv.engines.rigid.point.kernel import move_point

        return move_point

    def watched(self, path: Vector, index: int) -> Vector:
        """Displacement and velocity (k, 6) of the block observed as the index-th."""
        return path

    def joules(self, energy: Vector) -> Vector:
        """The energies (k, 8) [J], from those of the kernel per mass; the load joins gravity."""
        held = energy * self.lone.block.mass
        held[:, 5] += held[:, 6]
        held[:, 6], held[:, 7] = held[:, 7], 0.0  # a point mass has no lever arms
        return held

    def newtons(self, reaction: Vector) -> Vector:
        """Forces of the walls on the blocks (k, w, 3) [N]."""
        return reaction * self.lone.block.mass


def point(scene: Scene) -> Point | None:
    """The model of a point mass, or None if the scene needs the general model."""
    found = lone(scene)
    return None if found is None else Point(found, scene, scene.terms() - {Term.ROTATION})


def _triple(vector: Vector) -> tuple[float, float, float]:
    return float(vector[0]), float(vector[1]), float(vector[2])
