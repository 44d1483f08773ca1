"""Recognises one block that cannot rotate, on one wall or none: it moves like a point mass."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from vv.scene import Block, Harmonic, Scene, Vector, Wall

ALONG = 1e-9  # part of a vector below which its component is rounding
AWAY = Wall(np.array([0.0, 0.0, -1e30]), np.array([0.0, 0.0, 1.0]))  # for a block without a wall


@dataclass(frozen=True, eq=False)
class Lone:
    """The block, its wall and their gap [m]; hold: projector (3, 3) on the free directions."""

    block: Block
    wall: Wall
    gap: float
    hold: Vector


def lone(scene: Scene) -> Lone | None:
    """The single block of a scene that cannot rotate, or None if the scene is another.

    The normal and the motion of the wall must lie in the free directions, so that contact forces
    accelerate the same mass in all directions in which they act.
    """
    if len(scene.blocks) != 1 or len(scene.walls) > 1:
        return None
    block = scene.blocks[0]
    if block.free_spin.any() or block.spin.any():
        return None
    rows = scene.axes[block.free]
    hold = rows.T @ rows
    wall = scene.walls[0] if scene.walls else AWAY
    if scene.walls and not (_inside(wall.normal, hold) and _moves_inside(wall.motion, hold)):
        return None
    gap = float(((block.vertices - wall.point) @ wall.normal).min())
    return Lone(block, wall, gap, hold)


def _moves_inside(motion: Harmonic | None, hold: Vector) -> bool:
    if motion is None:
        return True
    there = motion.amplitude != 0
    return all(_inside(axis, hold) for axis in motion.axes[there])


def _inside(vector: Vector, hold: Vector) -> bool:
    return bool(np.linalg.norm(vector - hold @ vector) <= ALONG * np.linalg.norm(vector))
