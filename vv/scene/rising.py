"""Detects a wall that rises into a block that cannot move: rigid contact has no answer there."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction

import numpy as np

from vv.scene.arrays import Vector
from vv.scene.block import Block
from vv.scene.bodies import Wall

ACROSS = 1e-9  # sine of the angle to the wall below which a direction is parallel to the wall
HIGHEST, SAMPLES = 64, 256  # the highest multiple of a frequency, and samples in a period of it
ALIKE = 1e-12  # relative difference from a multiple that counts as rounding
SLACK = 1e-6  # fraction of the block's size; a smaller rise counts as rounding


def rises_into(walls: Sequence[Wall], blocks: Sequence[Block], axes: Vector) -> str | None:
    """Why rigid contact has no answer: a wall rises into a locked block; None if no wall does."""
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
    """The largest rise [m] of a wall along its normal since t = 0, over all times.

    Sines of one frequency are summed with their phases. If all frequencies are multiples of one,
    the maximum over a period is taken. Otherwise the sum of all maxima is, since it is approached
    in the long run.
    """
    if wall.motion is None:
        return 0.0
    at_start, tops = 0.0, dict[float, complex]()
    for along, frequency, phase in wall.motion.sines():
        part = float(along @ wall.normal) * complex(np.cos(phase), np.sin(phase))
        if frequency > 0 and part != 0:
            at_start += part.imag
            tops[frequency] = tops.get(frequency, 0.0) + part
    multiples = harmonics(list(tops))
    if len(tops) < 2 or multiples is None:
        return sum(abs(top) for top in tops.values()) - at_start
    return top_of_period(list(tops.values()), multiples) - at_start


def harmonics(frequencies: Sequence[float]) -> list[int] | None:
    """The frequencies as multiples of a common one; None if a multiple would exceed `HIGHEST`."""
    if not frequencies:
        return None
    first = min(frequencies)
    ratios = [Fraction(one / first).limit_denominator(HIGHEST) for one in frequencies]
    common = math.lcm(*(ratio.denominator for ratio in ratios))
    multiples = [int(ratio * common) for ratio in ratios]
    exact = all(
        abs(one / first - ratio) <= ALIKE * ratio
        for one, ratio in zip(frequencies, ratios, strict=True)
    )
    return multiples if exact and max(multiples) <= HIGHEST else None


def top_of_period(tops: Sequence[complex], multiples: Sequence[int]) -> float:
    """The maximum of a sum of sines, the imaginary parts of top exp(i n x), over all x.

    It is the vertex of a parabola through the highest of many samples and its two neighbours,
    accurate to 1e-8.
    """
    x = np.linspace(0.0, 2 * np.pi, SAMPLES * max(multiples), endpoint=False)
    height = sum(
        (top * np.exp(1j * n * x)).imag for top, n in zip(tops, multiples, strict=True)
    ) + np.zeros(len(x))
    best = int(np.argmax(height))
    before, most, after = (float(height[(best + k) % len(x)]) for k in (-1, 0, 1))
    bend = 2 * most - before - after
    return most + ((after - before) ** 2 / (8 * bend) if bend > 0 else 0.0)


def gives_way(block: Block, normal: Vector, axes: Vector) -> bool:
    """Whether a block is free to move along a normal, or to rotate away from it."""
    shifts, turns = axes[block.free], axes[block.free_spin]
    return bool((np.abs(shifts @ normal) > ACROSS).any()) or bool(
        (np.linalg.norm(np.cross(turns, normal), axis=-1) > ACROSS).any()
    )
