"""What shakes the bodies and moves the walls, as arrays for the kernels."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from vv.scene import Harmonic, Vector

Index = npt.NDArray[np.intp]


class Drive(NamedTuple):
    """k sines: direction (k, 3) times amplitude, omega (k,) [rad/s], phase (k,) [rad].

    start (k,): their sines at t = 0. owner (k,): the wall each moves, 0 where they shake bodies.
    """

    direction: Vector
    omega: Vector
    phase: Vector
    start: Vector
    owner: Index


def drive(motions: tuple[Harmonic | None, ...], axes: Vector) -> Drive | None:
    """The sines that are not nil, along the unit rows of axes (3, 3); None if nothing moves."""
    parts = [_sines(motion, axes, k) for k, motion in enumerate(motions) if motion is not None]
    if not parts:
        return None
    return Drive(*(np.concatenate(arrays) for arrays in zip(*parts, strict=True)))


def _sines(motion: Harmonic, axes: Vector, owner: int) -> Drive:
    there = motion.amplitude != 0
    direction = (motion.amplitude[:, None] * motion.axes)[there] @ axes.T
    omega, phase = 2 * np.pi * motion.frequency[there], motion.phase[there]
    return Drive(direction, omega, phase, np.sin(phase), np.full(len(omega), owner, np.intp))
