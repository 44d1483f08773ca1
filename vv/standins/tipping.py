"""The forces of rigid contact at the corners of a block that begins to tip from rest."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from vv.scene import Block, Mask, Scene, Vector, Wall
from vv.standins.penalty_springs import (
    STILL,
    acceleration_of,
    base_acceleration,
    base_velocity,
    fastest,
)

MOST_ITERATIONS = 100  # for the direction of slip, which converges in a few
ROUNDING = 1e-9  # of the largest acceleration, or of a unit direction of slip


@dataclass(frozen=True, eq=False)
class Hinge:
    """The k corners of a block that begins to tip, and its equation of motion at them.

    The accelerations of the corners relative to the wall are gives @ forces + free (3k,) [m/s2],
    for forces (3k,) [N] on them. arms: (k, 3) corners relative to the centroid [m]; gives:
    (3k, 3k) [1/kg], in the block's free directions; free: (3k,) [m/s2] without contact forces.
    """

    arms: Vector
    gives: Vector
    free: Vector

    def only(self, kept: Mask) -> Hinge:
        """The same for some of the corners only."""
        rows = np.repeat(kept, 3)
        return Hinge(self.arms[kept], self.gives[np.ix_(rows, rows)], self.free[rows])


def tipping(block: Block, wall: Wall, scene: Scene, corners: Vector, shares: Vector) -> Vector:
    """The forces (k, 3) [N] of a wall on the corners of a block at rest.

    All are zero if it moves, or if no solution is found. shares: (k,) parts of the load if the
    block stood; corners with a negative share lose contact. If several sets of forces have the
    same effect, as on an edge, the smallest is taken, which shares the load equally.
    """
    force, slip = np.zeros((len(corners), 3)), block.velocity - base_velocity(wall.motion)
    if np.linalg.norm(slip) > STILL * (np.linalg.norm(block.velocity) + fastest(wall.motion)):
        return force
    hinge, held = _hinge(block, wall, scene, corners), shares > 0
    force[held] = _forces(hinge.only(held), wall.normal, scene.contact.mu)
    moved = (hinge.gives @ force.ravel() + hinge.free).reshape(-1, 3) @ wall.normal
    largest = float(np.abs(hinge.free).max())
    sound = (force @ wall.normal >= 0).all() and (moved >= -ROUNDING * largest).all()
    return force if sound else np.zeros_like(force)


def _hinge(block: Block, wall: Wall, scene: Scene, corners: Vector) -> Hinge:
    along, about = scene.axes[block.free], scene.axes[block.free_spin]
    light = along.T @ along / block.mass
    turns = about.T @ np.linalg.solve(about @ block.inertia @ about.T, about)
    arms = corners - block.centroid()
    moves = np.array([[[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]] for x, y, z in arms])
    spun = np.concatenate(moves)  # displacements of the corners by rotations of the block
    field = scene.gravity + acceleration_of(scene.wave) - base_acceleration(wall.motion)
    pulled = light @ (block.mass * field + block.load)
    gives = np.tile(light, (len(arms), len(arms))) + spun @ turns @ spun.T
    return Hinge(arms, gives, np.tile(pulled, len(arms)))


def _forces(hinge: Hinge, normal: Vector, mu: float) -> Vector:
    """The forces (k, 3) [N] that keep all corners on the wall, whether they stick or slip."""
    count = len(hinge.arms)
    stuck = -_least(hinge.gives, hinge.free).reshape(count, 3)
    total = stuck.sum(axis=0)
    press = float(total @ normal)
    across = total - press * normal
    if np.linalg.norm(across) <= mu * press:
        return stuck
    slip = np.tile(-across / np.linalg.norm(across), (count, 1))
    outward = np.kron(np.eye(count), normal)
    for _ in range(MOST_ITERATIONS):
        pushes = np.kron(np.eye(count), np.ones((3, 1))) * (normal - mu * slip).reshape(-1, 1)
        pressed = -_least(outward @ hinge.gives @ pushes, outward @ hinge.free)
        moved = (hinge.gives @ pushes @ pressed + hinge.free).reshape(count, 3)
        moved -= np.outer(moved @ normal, normal)
        speed = np.linalg.norm(moved, axis=1, keepdims=True)
        turned = np.where(speed > 0, moved / np.where(speed > 0, speed, 1.0), slip)
        if np.abs(turned - slip).max() < ROUNDING:
            break
        slip = turned
    return np.asarray((pushes @ pressed).reshape(count, 3))


def _least(matrix: Vector, right: Vector) -> Vector:
    """The solution of least norm of a linear system that may have many solutions."""
    return np.asarray(np.linalg.lstsq(matrix, right, rcond=1e-10)[0])
