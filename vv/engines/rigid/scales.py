"""Finds the scales of acceleration and speed of a scene, to which tolerances are relative.

Tolerances in m/s and m/s2 would make the answer depend on the units and on the size of gravity.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from vv.scene import Block, Harmonic, Scene, Vector


@dataclass(frozen=True)
class Scales:
    """Scales of a scene's motion.

    weight: the acceleration by gravity and loads [m/s2], or by shaking and moving walls if there
    are neither; pull: by all together [m/s2]; braking: by friction under it [m/s2], at most as
    large. speed: that a block has or soon gains [m/s]; fall:
    that of a fall by the size of the smallest block [m/s]. quick: the least ratio of acceleration
    to velocity [1/s], which does not change if all accelerations and velocities are scaled;
    given: the initial speed plus that of shaking and moving walls [m/s].
    """

    weight: float
    pull: float
    braking: float
    speed: float
    fall: float
    quick: float
    given: float


def scales(scene: Scene) -> Scales:
    """The scales of a scene, from its forces, prescribed motions, velocities at t = 0 and sizes."""
    blocks, walls = scene.blocks, [wall.motion for wall in scene.walls]
    forces = [math.hypot(*(scene.gravity + block.load / block.mass)) for block in blocks]
    shaken, moved = _rate(scene.wave, 0), max((_rate(one, 2) for one in walls), default=0.0)
    weight, swung = float(max(forces)), _rate(scene.wave, -1)
    pull = weight + shaken + moved
    sizes = [size_of_motion(block, scene.axes) for block in blocks]
    thrown = [
        math.hypot(*block.velocity) + math.hypot(*block.spin) * size
        for block, size in zip(blocks, sizes, strict=True)
    ]
    carried = max((_rate(one, 1) for one in walls), default=0.0)
    speed = float(max(thrown) + carried + np.sqrt(pull * min(sizes)))
    fall = math.sqrt((weight or pull) * min(sizes))
    turns = [(weight, max(thrown)), (shaken + moved, swung + carried)]
    quick = min((gain / rate for gain, rate in turns if rate > 0.0), default=0.0)
    braking, given = pull * min(scene.contact.mu, 1.0), float(sum(rate for _, rate in turns))
    return Scales(weight or pull, pull, braking, speed, fall, quick, given)


def size_of_motion(block: Block, axes: Vector) -> float:
    """The largest extent [m] of a block along those axes (rows of (3, 3)) on which it can move.

    How deep a block is across the plane of its motion changes nothing in that motion.
    """
    extents = np.ptp(block.vertices @ axes.T, axis=0)
    return float(extents[block.free].max() if block.free.any() else extents.max())


def _rate(motion: Harmonic | None, times: int) -> float:
    """An upper bound on a motion's time derivative of order `times`; -1 means its integral."""
    if motion is None:
        return 0.0
    turns = motion.frequency > 0.0
    rates = (2 * np.pi * np.where(turns, motion.frequency, 1.0)) ** float(times)
    return float(np.abs(motion.amplitude * rates)[turns | (times == 0)].sum())
