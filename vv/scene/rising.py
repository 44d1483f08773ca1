"""A wall that rises into a block which cannot give way: rigid contact has no answer there."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from vv.scene.arrays import Vector
from vv.scene.block import Block
from vv.scene.bodies import Wall

ACROSS = 1e-9  # sine of the angle below which a direction holds no part of a normal
SLACK = 1e-6  # of the block's size: a rise that is no rounding


def rises_into(walls: Sequence[Wall], blocks: Sequence[Block], axes: Vector) -> str | None:
    """Which wall may rise, along its normal, further than a block that is held there allows."""
    for number, wall in enumerate(walls):
        rise = highest_rise(wall)
        for block in blocks:
            gap = float(((block.vertices - wall.point) @ wall.normal).min())
            slack = SLACK * float(np.ptp(block.vertices, axis=0).max())
            if rise > slack and rise > gap + slack and not gives_way(block, wall.normal, axes):
                return (
                    f"wall {number} rises by up to {rise:.6g} m along its normal, and block "
                    f"'{block.name}', {gap:.6g} m above it at t = 0, is locked along that; rigid "
                    "contact has no answer where a wall rises into what cannot give way"
                )
    return None


def highest_rise(wall: Wall) -> float:
    """How far a wall rises above its place at t = 0, along its normal [m], if it moves for ever.

    Sines of one frequency are summed with their phases; of unlike ones it is taken that they come
    to their tops together, as they do if no frequency is a multiple of another's.
    """
    if wall.motion is None:
        return 0.0
    at_start, tops = 0.0, dict[float, complex]()
    for along, frequency, phase in wall.motion.sines():
        part = float(along @ wall.normal) * complex(np.cos(phase), np.sin(phase))
        if frequency > 0:
            at_start += part.imag
            tops[frequency] = tops.get(frequency, 0.0) + part
    return sum(abs(top) for top in tops.values()) - at_start


def gives_way(block: Block, normal: Vector, axes: Vector) -> bool:
    """Whether a block is free to move along a normal, or to turn out of it."""
    shifts, turns = axes[block.free], axes[block.free_spin]
    return bool((np.abs(shifts @ normal) > ACROSS).any()) or bool(
        (np.linalg.norm(np.cross(turns, normal), axis=-1) > ACROSS).any()
    )
