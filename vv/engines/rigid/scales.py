"""What is large in a scene: the acceleration and the speed that limits of convergence are parts of.

Limits in m/s and m/s2 would make the answer depend on the units, and on how weak gravity is.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from vv.scene import Harmonic, Scene


@dataclass(frozen=True)
class Scales:
    """weight, pull: what forces, and what forces and drives together, make of a block [m/s2].

    speed: how fast it is at least soon [m/s]; fall: what falling makes over the size of the
    smallest [m/s]. Without forces the drives count as weight. quick: how often a motion turns
    about [1/s], by its own measure, so that a motion a thousandth as large, under a thousandth of
    all accelerations, is followed the same way; given: the speed that it has at the start, and
    that drives alone make [m/s].
    """

    weight: float
    pull: float
    speed: float
    fall: float
    quick: float
    given: float


def scales(scene: Scene) -> Scales:
    """Those of a scene: weights and loads, drives, velocities at the start, sizes of blocks."""
    blocks, walls = scene.blocks, [wall.motion for wall in scene.walls]
    forces = [math.hypot(*(scene.gravity + block.load / block.mass)) for block in blocks]
    shaken, moved = _rate(scene.wave, 0), max((_rate(one, 2) for one in walls), default=0.0)
    weight, swung = float(max(forces)), _rate(scene.wave, -1)
    pull = weight + shaken + moved
    sizes = [np.ptp(block.vertices, axis=0).max() for block in blocks]
    thrown = [
        math.hypot(*block.velocity) + math.hypot(*block.spin) * size
        for block, size in zip(blocks, sizes, strict=True)
    ]
    carried = max((_rate(one, 1) for one in walls), default=0.0)
    speed = float(max(thrown) + carried + np.sqrt(pull * min(sizes)))
    fall = math.sqrt((weight or pull) * min(sizes))
    turns = [(weight, max(thrown)), (shaken + moved, swung + carried)]
    quick = min((gain / rate for gain, rate in turns if rate > 0.0), default=0.0)
    return Scales(weight or pull, pull, speed, fall, quick, float(sum(rate for _, rate in turns)))


def _rate(motion: Harmonic | None, times: int) -> float:
    """The most that a motion, differentiated so many times, can be; -1 stands for its integral."""
    if motion is None:
        return 0.0
    turns = motion.frequency > 0.0
    rates = (2 * np.pi * np.where(turns, motion.frequency, 1.0)) ** float(times)
    return float(np.abs(motion.amplitude * rates)[turns | (times == 0)].sum())
