"""Decides whether blocks on a wall can meet; if they cannot, each moves as if it were alone."""

from __future__ import annotations

import numpy as np

from vv.ask import Ask
from vv.scene import Block, Harmonic, Scene, Vector, Wall
from vv.standins.penalty_springs import base_velocity


def why_not_apart(ask: Ask) -> str | None:
    """Why blocks on one wall may meet, as bodies or as the spheres that represent them.

    Such spheres are at the height of the centres, and may meet where blocks do not.
    """
    blocks, (wall,) = ask.scene.blocks, ask.scene.walls
    extents = np.array([[_extent(block, along) for along in ask.scene.axes] for block in blocks])
    ways = np.array([_ways(block, wall, ask) for block in blocks])
    if (pair := _first_that_meet(extents, ways)) is not None:
        names = " and ".join(f"'{blocks[i].name}'" for i in pair)
        return f"blocks {names} may touch each other, with faces; spheres have none"
    centres = np.array([block.centroid() for block in blocks])
    heights = (centres - wall.point) @ wall.normal
    balls = np.stack([centres @ ask.scene.axes.T] * 2, axis=2)
    balls += np.multiply.outer(heights, np.array([-1.0, 1.0]))[:, None]
    if (pair := _first_that_meet(balls, np.zeros_like(ways))) is not None:
        names = " and ".join(f"'{blocks[i].name}'" for i in pair)
        return f"blocks {names} are nearer than spheres in their place, as high as their centres"
    return None


def _extent(block: Block, along: Vector) -> tuple[float, float]:
    """The least and the largest coordinate [m] of a block along a direction."""
    places = block.vertices @ along
    return float(places.min()), float(places.max())


def _first_that_meet(extents: Vector, ways: Vector) -> tuple[int, int] | None:
    """The first two bodies that no direction keeps apart.

    extents: (n, 3, 2), low and high along three directions [m]; ways: (n, 3), how far any part of
    a body may come along them [m].
    """
    low, high = extents[:, :, 0] - ways, extents[:, :, 1] + ways
    clear = (low[:, None] > high[None]).any(axis=2)
    meet = np.argwhere(np.triu(~(clear | clear.T), 1))
    return (int(meet[0, 0]), int(meet[0, 1])) if len(meet) else None


def _ways(block: Block, wall: Wall, ask: Ask) -> Vector:
    """Bounds (3,) on how far [m] any part of a block goes on its wall, along the scene's axes.

    Seen from the wall, contact takes energy only. What pulls with m a for a time T then leaves a
    speed of the centre of at most u = u0 + a T, and a spin of at most u sqrt(m/I), where u0 has the
    energy of the start. Of a block that cannot turn, this holds along every direction by itself.
    """
    scene, time = ask.scene, ask.goal.duration
    speed, pull = _drive(block, wall, scene)
    if not block.free_spin.any():
        return np.where(block.free, speed * time + 0.5 * pull * time**2, 0.0)
    spin = block.spin @ block.inertia @ block.spin / block.mass
    start = np.sqrt((np.linalg.norm(speed)) ** 2 + spin)
    way = start * time + 0.5 * float(np.linalg.norm(pull)) * time**2
    arm = np.linalg.norm(block.vertices - block.centroid(), axis=1).max()
    least = float(np.linalg.eigvalsh(block.inertia)[0])
    return np.full(3, way * (1.0 + arm * np.sqrt(block.mass / least)))


def _drive(block: Block, wall: Wall, scene: Scene) -> tuple[Vector, Vector]:
    """Speeds (3,) [m/s] at t = 0, and the largest pulls (3,) [m/s2], seen from the wall."""
    axes = scene.axes
    speed = np.abs(axes @ (block.velocity - base_velocity(wall.motion)))
    steady = np.abs(axes @ (scene.gravity + block.load / block.mass))
    shaken = _peaks(scene.wave, axes, 0) + _peaks(wall.motion, axes, 2)
    return speed, np.asarray(steady + shaken)


def _peaks(motion: Harmonic | None, axes: Vector, order: int) -> Vector:
    """The largest values (3,) of a sum of sines, or of its derivative of an order."""
    total = np.zeros(3)
    for along, f, _ in motion.sines() if motion else ():
        total += np.abs(axes @ along) * (2 * np.pi * f) ** order
    return total
