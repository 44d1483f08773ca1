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

TURNS = 100  # of the direction of slip, which settles in a few
NIL = 1e-9  # of the largest acceleration or force: less than that is rounding


@dataclass(frozen=True, eq=False)
class Hinge:
    """Corners (k, 3) about which a block turns as it begins to tip, in the freedoms it has.

    arms: corners from the centroid, (k, 3); gives: accelerations (3k, 3k) of the corners by forces
    on them; free: those (3k,) [m/s2] that it would have without any, seen from the wall.
    """

    arms: Vector
    gives: Vector
    free: Vector

    def only(self, kept: Mask) -> Hinge:
        """The hinge of some of its corners."""
        rows = np.repeat(kept, 3)
        return Hinge(self.arms[kept], self.gives[np.ix_(rows, rows)], self.free[rows])


def tipping(block: Block, wall: Wall, scene: Scene, corners: Vector, shares: Vector) -> Vector:
    """The forces (k, 3) [N] of a wall on the corners of a block at rest.

    All are nil if it moves, or if none are found. shares: (k,) parts of the load as they would be
    if the block stood; those below nil part. Of many forces that do the same, as on an edge, the
    least are taken, which are alike.
    """
    force, slip = np.zeros((len(corners), 3)), block.velocity - base_velocity(wall.motion)
    if np.linalg.norm(slip) > STILL * (np.linalg.norm(block.velocity) + fastest(wall.motion)):
        return force
    hinge, held = _hinge(block, wall, scene, corners), shares > 0
    force[held] = _forces(hinge.only(held), wall.normal, scene.contact.mu)
    moved = (hinge.gives @ force.ravel() + hinge.free).reshape(-1, 3) @ wall.normal
    largest = float(np.abs(hinge.free).max())
    sound = (force @ wall.normal >= 0).all() and (moved >= -NIL * largest).all()
    return force if sound else np.zeros_like(force)


def _hinge(block: Block, wall: Wall, scene: Scene, corners: Vector) -> Hinge:
    along, about = scene.axes[block.free], scene.axes[block.free_spin]
    light = along.T @ along / block.mass
    turns = about.T @ np.linalg.solve(about @ block.inertia @ about.T, about)
    arms = corners - block.centroid()
    moves = np.array([[[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]] for x, y, z in arms])
    spun = np.concatenate(moves)  # how corners move as the block turns
    field = scene.gravity + acceleration_of(scene.wave) - base_acceleration(wall.motion)
    pulled = light @ (block.mass * field + block.load)
    gives = np.tile(light, (len(arms), len(arms))) + spun @ turns @ spun.T
    return Hinge(arms, gives, np.tile(pulled, len(arms)))


def _forces(hinge: Hinge, normal: Vector, mu: float) -> Vector:
    """The forces (k, 3) [N] that keep corners on the wall, where they stick or slip."""
    count = len(hinge.arms)
    stuck = -_least(hinge.gives, hinge.free).reshape(count, 3)
    total = stuck.sum(axis=0)
    press = float(total @ normal)
    across = total - press * normal
    if np.linalg.norm(across) <= mu * press:
        return stuck
    slip = np.tile(-across / np.linalg.norm(across), (count, 1))
    outward = np.kron(np.eye(count), normal)
    for _ in range(TURNS):
        pushes = np.kron(np.eye(count), np.ones((3, 1))) * (normal - mu * slip).reshape(-1, 1)
        pressed = -_least(outward @ hinge.gives @ pushes, outward @ hinge.free)
        moved = (hinge.gives @ pushes @ pressed + hinge.free).reshape(count, 3)
        moved -= np.outer(moved @ normal, normal)
        speed = np.linalg.norm(moved, axis=1, keepdims=True)
        turned = np.where(speed > 0, moved / np.where(speed > 0, speed, 1.0), slip)
        if np.abs(turned - slip).max() < NIL:
            break
        slip = turned
    return np.asarray((pushes @ pressed).reshape(count, 3))


def _least(matrix: Vector, right: Vector) -> Vector:
    """The least solution of a system that may have many."""
    return np.asarray(np.linalg.lstsq(matrix, right, rcond=1e-10)[0])
