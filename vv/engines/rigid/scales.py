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
    smallest [m/s]. Without forces the drives count as weight.
    """

    weight: float
    pull: float
    speed: float
    fall: float


def scales(scene: Scene) -> Scales:
    """Those of a scene: weights and loads, drives, velocities at the start, sizes of blocks."""
    blocks, walls = scene.blocks, [wall.motion for wall in scene.walls]
    forces = [math.hypot(*(scene.gravity + block.load / block.mass)) for block in blocks]
    shaken, moved = _rate(scene.wave, 0), max((_rate(one, 2) for one in walls), default=0.0)
    weight = float(max(forces))
    pull = weight + shaken + moved
    sizes = [np.ptp(block.vertices, axis=0).max() for block in blocks]
    thrown = [
        math.hypot(*block.velocity) + math.hypot(*block.spin) * size
        for block, size in zip(blocks, sizes, strict=True)
    ]
    carried = max((_rate(one, 1) for one in walls), default=0.0)
    speed = float(max(thrown) + carried + np.sqrt(pull * min(sizes)))
    return Scales(weight or pull, pull, speed, math.sqrt((weight or pull) * min(sizes)))


def _rate(motion: Harmonic | None, times: int) -> float:
    """The most that a motion, differentiated so many times, can be."""
    if motion is None:
        return 0.0
    return float((np.abs(motion.amplitude) * (2 * np.pi * motion.frequency) ** times).sum())
