"""Builds the reduced model of DDA: one block that cannot rotate, on one wall or none."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from vv.engines.blocks.geometry import depth_axis
from vv.engines.blocks.single_block import Lone, lone
from vv.engines.dda.formulation import Formulation
from vv.engines.dda.limits import FLOAT
from vv.engines.dda.springs import Springs
from vv.engines.dda.stepping import Steps
from vv.scene import Scene, Term, Vector

LEVEL = 1e-9  # relative to a block's size: vertices this close to the lowest touch a wall too
SAME = 1e-6  # relative to a block's size: points closer than this in a prism's plane are one


@dataclass(frozen=True, eq=False)
class Sliding:
    """One block that cannot rotate, on one wall; points: how many of its vertices touch it."""

    scene: Scene
    lone: Lone
    points: int
    formulation: Formulation

    @property
    def unknowns(self) -> int:
        """The number of free translations."""
        return int(self.lone.block.free.sum())

    @property
    def terms(self) -> frozenset[Term]:
        """The terms of the scene, all of which are modelled."""
        return self.scene.terms()

    @property
    def words(self) -> str:
        """The description of the model."""
        return f"{self.unknowns} translations of one block with {self.points} points of contact"

    def outputs(self, rows: int, watched: tuple[int, ...]) -> tuple[Vector, ...]:
        """The arrays that the kernel fills."""
        return np.empty((rows, 6)), np.empty((rows, 13)), np.empty((rows, 9))

    def arguments(self, steps: Steps, law: Springs) -> tuple[Any, ...]:
        """The arguments of the kernel after the outputs."""
        from vv.engines.dda.point.block import Block, Drives, Friction, Rule
        from vv.engines.kernels.drive import NO_MOTION, drive

        block, wall, hold = self.lone.block, self.lone.wall, self.lone.hold
        choices, scene = self.formulation, self.scene
        shaking, drives = drive(scene.shaking or NO_MOTION), None
        if wall.motion is not None or scene.shaking is not None:
            along_free = shaking._replace(direction=shaking.direction @ hold)
            base = drive(wall.motion or NO_MOTION)
            most = float(np.linalg.norm(base.direction, axis=1) @ base.omega**2)
            drives = Drives(base, along_free, most)
        gravity, load = hold @ scene.gravity, hold @ block.load
        told = Block(
            block.mass, self.points, law.kn, _triple(gravity), _triple(load),
            _triple(load + block.mass * gravity), _triple(wall.normal), self.lone.gap, drives,
        )  # fmt: skip
        rule = Rule(
            choices.tolerance, choices.iterations, float(choices.charged), choices.dd,
            choices.shaking_at,
        )  # fmt: skip
        rough = None if law.ks is None or law.mu is None else Friction(law.ks, law.mu)
        return (
            steps,
            rule,
            _triple(hold @ block.velocity),
            choices.pressed and self._rests(law),
            told,
            rough,
        )

    def _rests(self, law: Springs) -> bool:
        """Whether the block is so close to its wall that it is supported, as `FLOAT` defines it."""
        load = self.lone.block.mass * self.scene.gravity + self.lone.block.load
        return self.lone.gap <= FLOAT * float(np.linalg.norm(load)) / law.kn

    def kernel(self) -> Callable[..., int]:
        """The compiled kernel; the first call imports numba."""
        from vv.engines.dda.point.kernel import slide_point

        return slide_point

    def watched(self, path: Vector, index: int) -> Vector:
        """Displacement and velocity (k, 6) of the index-th observed block."""
        return path

    def strains(self, path: Vector, index: int) -> Vector:
        """Normal strains (k, 3): zeros, since the block is rigid."""
        return np.zeros((len(path), 3))


def sliding(scene: Scene, formulation: Formulation) -> Sliding | None:
    """The reduced model, or None if it does not serve the scene."""
    found = lone(scene)
    if found is None or found.block.elastic:
        return None
    return Sliding(scene, found, _points(found, depth_axis(scene)), formulation)


def _points(lone: Lone, depth: Vector) -> int:
    """The number of points that touch first; points behind one another in a plane scene are one."""
    block, wall = lone.block, lone.wall
    size = float(np.ptp(block.vertices, axis=0).max())
    height = block.vertices @ wall.normal
    lowest = block.vertices[height <= height.min() + LEVEL * size]
    flat = lowest - np.outer(lowest @ depth, depth)
    apart = np.linalg.norm(flat[:, None] - flat[None], axis=2)
    return int((np.triu(apart <= SAME * size, 1).sum(axis=0) == 0).sum())


def _triple(vector: Vector) -> tuple[float, float, float]:
    return float(vector[0]), float(vector[1]), float(vector[2])
