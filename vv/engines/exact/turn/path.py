"""The exact motion of a slip that turns, as a sequence of Taylor polynomials."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from vv.engines.exact.guards import GUARD_ROUNDING
from vv.engines.exact.path import taylor_sum
from vv.engines.exact.roots import EPS
from vv.engines.exact.slide.system import TurningSlider
from vv.engines.exact.stopped import StoppedError
from vv.engines.exact.turn.kernel import ENDED, FULL, REST, follow_turning
from vv.engines.exact.turn.series import ORDER
from vv.scene import Vector

FEW, MOST = 1_024, 262_144  # pieces for which there is room at first, and in one run
STILL = 64 * EPS  # of the greatest velocity: a slip slower than that is at rest


@dataclass(frozen=True, eq=False)
class Turn:
    """A motion of p pieces: slip = sum over k of series[k] x^k [m], x = (t - start)/h in [0, end].

    start, h [s], end: (p,); series: (p, ORDER + 1, 2); slips: (p,) whether the body slips.
    """

    slider: TurningSlider
    start: Vector
    h: Vector
    end: Vector
    series: Vector
    slips: npt.NDArray[np.bool_]

    def __len__(self) -> int:
        return len(self.start)

    @property
    def changes(self) -> Vector:
        """When the body begins to slip or comes to rest (c,) [s]."""
        pairs = itertools.pairwise(self.slips.tolist())
        return self.start[1:][[before is not after for before, after in pairs]]

    def at(self, times: Vector) -> tuple[Vector, Vector]:
        """Slip (t, 2) [m] and its velocity (t, 2) [m/s] at times (t,) [s]."""
        piece = np.maximum(np.searchsorted(self.start, times, side="right") - 1, 0)
        place, rate = taylor_sum(self.series[piece], (times - self.start[piece]) / self.h[piece])
        return place, rate / self.h[piece, None]

    def of(self, sphere: int, times: Vector) -> tuple[Vector, Vector]:
        """Displacement and velocity (t, 3) [m, m/s] of the body at times (t,) [s]."""
        return self.motion_in_space(*self.at(times), times)

    def motion_in_space(self, place: Vector, speed: Vector, times: Vector) -> tuple[Vector, Vector]:
        """Displacement and velocity (t, 3) of a slip: those of the wall, as felt, are added."""
        slider = self.slider
        angle = np.outer(times, 2 * np.pi * slider.frequency) + slider.phase
        rates = 2 * np.pi * slider.frequency[:, None] * slider.base
        return (
            place @ slider.axes + (np.sin(angle) - np.sin(slider.phase)) @ slider.base,
            speed @ slider.axes + np.cos(angle) @ rates,
        )


def follow_turning_slider(slider: TurningSlider, duration: float) -> Turn:
    """The motion of a slider over a duration [s]; raises StoppedError if it cannot be followed."""
    rows = np.vstack((slider.relative_drive, slider.mu * slider.pressing))
    short = slider.frequency.astype(np.float32).astype(float)
    omega = 2 * np.pi * slider.frequency
    sines = np.stack((short, slider.frequency - short, slider.phase, omega), axis=1)
    size = np.abs(rows).sum(axis=1)
    quickest = float(omega.max(initial=0.0))
    span = min(duration, 1 / quickest) if quickest > 0 else duration
    still = STILL * float(np.linalg.norm(slider.slip) + size.sum() * span)
    band = GUARD_ROUNDING * float((size**2).sum())
    room = FEW
    while True:
        starts, states = np.empty((room, 3)), np.empty(room)
        series = np.empty((room, ORDER + 1, 2))
        outcome, count, t = follow_turning(
            rows, sines, slider.slip.copy(), still, band, duration, starts, states,
            series,
        )  # fmt: skip
        if outcome == ENDED:
            start, h, end = starts[:count].T
            return Turn(slider, start, h, end, series[:count], states[:count] != REST)
        if outcome != FULL:
            raise StoppedError(
                f"friction reaches its limit at t = {t:.6g} s and the drive does not rise above it"
            )
        if room >= MOST:
            raise StoppedError(
                f"the duration is too long for so fast a motion: more than {MOST} steps by "
                f"t = {t:.6g} s"
            )
        room *= 4


class TurningFlow:
    """A slider ready to be followed over a duration [s], as often as wanted."""

    def __init__(self, slider: TurningSlider, duration: float) -> None:
        self.slider, self.duration = slider, duration

    def warm(self) -> None:
        """Load the kernel, or compile it."""
        follow_turning_slider(self.slider, 1e-300)

    def follow(self) -> Turn:
        """Do what is timed; raises StoppedError if the motion cannot be followed."""
        return follow_turning_slider(self.slider, self.duration)

    def path(self, turn: Turn) -> Turn:
        """The motion of which `follow` told."""
        return turn
