"""Prescribed motions of walls and shaking as arrays of sines, and kernels that evaluate them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from vv.engines.kernels.arrays import larger, smaller
from vv.engines.kernels.bundles import bundle
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.triples import Triple, add_scaled, at
from vv.scene import Harmonic, Pulse, Vector

Starts = npt.NDArray[np.int64]
NO_MOTION = Harmonic(np.zeros(3), np.zeros(3))


@bundle
class Drive(NamedTuple):
    """A sum of k sines: direction times amplitude (k, 3), omega (k,) [rad/s], phase (k,) [rad].

    start (k,): values of the sines at t = 0. until (k,): end of each sine [s], which only `value`
    and `mean` take into account.
    """

    direction: Vector
    omega: Vector
    phase: Vector
    start: Vector
    until: Vector


def drive(given: Harmonic | Pulse) -> Drive:
    """The sines of a motion with an amplitude other than zero."""
    motion = given.wave if isinstance(given, Pulse) else given
    until = given.until if isinstance(given, Pulse) else np.inf
    there = motion.amplitude != 0
    direction = (motion.amplitude[:, None] * motion.axes)[there]
    omega, phase = 2 * np.pi * motion.frequency[there], motion.phase[there]
    return Drive(direction, omega, phase, np.sin(phase), np.full(len(omega), until))


def drives(motions: tuple[Harmonic | None, ...]) -> tuple[Drive, Starts]:
    """The sines of several motions, and the index (w + 1,) of the first of each; None is none."""
    parts = [drive(motion or NO_MOTION) for motion in motions]
    starts = np.cumsum([0, *(len(part.omega) for part in parts)]).astype(np.int64)
    joined = [np.concatenate(arrays) for arrays in zip(drive(NO_MOTION), *parts, strict=True)]
    return Drive(*joined), starts


@called
def one_of(drive: Drive, start: Starts, k: int) -> Drive:
    """The motion k of several motions."""
    part = slice(start[k], start[k + 1])
    return Drive(
        drive.direction[part],
        drive.omega[part],
        drive.phase[part],
        drive.start[part],
        drive.until[part],
    )


@lent
def value(drive: Drive, time: float) -> Triple:
    """The motion at a time [s]."""
    total = (0.0, 0.0, 0.0)
    for k in range(len(drive.omega)):
        angle = drive.omega[k] * time + drive.phase[k]
        sine = np.sin(angle) if time <= drive.until[k] else 0.0
        total = add_scaled(total, sine, at(drive.direction, k))
    return total


@lent
def travel(drive: Drive, time: float) -> Triple:
    """The displacement since t = 0, motion(time) - motion(0)."""
    total = (0.0, 0.0, 0.0)
    for k in range(len(drive.omega)):
        since = np.sin(drive.omega[k] * time + drive.phase[k]) - drive.start[k]
        total = add_scaled(total, since, at(drive.direction, k))
    return total


@lent
def rate(drive: Drive, time: float) -> Triple:
    """The time derivative of the motion."""
    total = (0.0, 0.0, 0.0)
    for k in range(len(drive.omega)):
        turning = drive.omega[k] * np.cos(drive.omega[k] * time + drive.phase[k])
        total = add_scaled(total, turning, at(drive.direction, k))
    return total


@lent
def mean(drive: Drive, time: float, step: float) -> Triple:
    """The mean of the motion from time to time + step."""
    total = (0.0, 0.0, 0.0)
    for k in range(len(drive.omega)):
        lasts = smaller(larger(drive.until[k] - time, 0.0), step)
        half = 0.5 * drive.omega[k] * lasts
        smooth = lasts / step * (np.sin(half) / half if half > 0.0 else 1.0)
        middle = np.sin(drive.omega[k] * time + half + drive.phase[k])
        total = add_scaled(total, smooth * middle, at(drive.direction, k))
    return total
