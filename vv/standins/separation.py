"""Decides whether blocks on a wall can meet; if they cannot, each moves as if it were alone."""

from __future__ import annotations

import numpy as np

from vv.ask import Ask
from vv.scene import Block, Harmonic, Scene, Vector, Wall
from vv.standins.penalty_springs import base_velocity


def why_not_apart(ask: Ask) -> str | None:
    """Why blocks on one wall, or the spheres that represent them, may meet; None if they cannot.

    The radius of such a sphere is the height of the centroid, so that spheres may meet where
    blocks do not.
    """
    blocks, (wall,) = ask.scene.blocks, ask.scene.walls
    extents = np.array([[_extent(block, along) for along in ask.scene.axes] for block in blocks])
    travels = np.array([_travel_bounds(block, wall, ask) for block in blocks])
    if (pair := _first_that_meet(extents, travels)) is not None:
        names = " and ".join(f"'{blocks[i].name}'" for i in pair)
        return f"blocks {names} may touch each other face to face; spheres have no faces"
    centres = np.array([block.centroid() for block in blocks])
    heights = (centres - wall.point) @ wall.normal
    balls = np.stack([centres @ ask.scene.axes.T] * 2, axis=2)
    balls += np.multiply.outer(heights, np.array([-1.0, 1.0]))[:, None]
    if (pair := _first_that_meet(balls, np.zeros_like(travels))) is not None:
        names = " and ".join(f"'{blocks[i].name}'" for i in pair)
        return f"blocks {names} are too close for spheres with the heights of the centres as radii"
    return None


def _extent(block: Block, along: Vector) -> tuple[float, float]:
    """The least and the largest coordinate [m] of a block along a direction."""
    places = block.vertices @ along
    return float(places.min()), float(places.max())


def _first_that_meet(extents: Vector, travels: Vector) -> tuple[int, int] | None:
    """The first two bodies whose extents can overlap in all three directions.

    extents: (n, 3, 2) least and largest coordinates at t = 0 [m]; travels: (n, 3) upper bounds on
    the displacement of any part of a body [m].
    """
    low, high = extents[:, :, 0] - travels, extents[:, :, 1] + travels
    clear = (low[:, None] > high[None]).any(axis=2)
    meet = np.argwhere(np.triu(~(clear | clear.T), 1))
    return (int(meet[0, 0]), int(meet[0, 1])) if len(meet) else None


def _travel_bounds(block: Block, wall: Wall, ask: Ask) -> Vector:
    """Upper bounds (3,) on the displacement [m] of any part of a block along the scene's axes.

    In the frame of the wall, contact only dissipates energy. After a time T under a force m a, the
    speed of the centroid is therefore at most u = u0 + a T, and the spin at most u sqrt(m/I), where
    m u0^2/2 is the initial kinetic energy. If the block cannot rotate, this holds along each
    direction separately.
    """
    scene, time = ask.scene, ask.goal.duration
    speed, pull = _speed_and_pull(block, wall, scene)
    if not block.free_spin.any():
        return np.where(block.free, speed * time + 0.5 * pull * time**2, 0.0)
    spin = block.spin @ block.inertia @ block.spin / block.mass
    start = np.sqrt((np.linalg.norm(speed)) ** 2 + spin)
    travel = start * time + 0.5 * float(np.linalg.norm(pull)) * time**2
    arm = np.linalg.norm(block.vertices - block.centroid(), axis=1).max()
    least = float(np.linalg.eigvalsh(block.inertia)[0])
    return np.full(3, travel * (1.0 + arm * np.sqrt(block.mass / least)))


def _speed_and_pull(block: Block, wall: Wall, scene: Scene) -> tuple[Vector, Vector]:
    """Speeds (3,) [m/s] at t = 0 and largest accelerations (3,) [m/s2], relative to the wall."""
    axes = scene.axes
    speed = np.abs(axes @ (block.velocity - base_velocity(wall.motion)))
    steady = np.abs(axes @ (scene.gravity + block.load / block.mass))
    shaken = _peaks(scene.wave, axes, 0) + _peaks(wall.motion, axes, 2)
    return speed, np.asarray(steady + shaken)


def _peaks(motion: Harmonic | None, axes: Vector, order: int) -> Vector:
    """Upper bounds (3,) on a sum of sines, or on its time derivative of the given order."""
    total = np.zeros(3)
    for along, f, _ in motion.sines() if motion else ():
        total += np.abs(axes @ along) * (2 * np.pi * f) ** order
    return total
