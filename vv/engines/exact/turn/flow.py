"""Runs the kernel of a slip that changes direction: its arguments, and a path of its output."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

import numpy as np

from vv.engines.exact.guards import GUARD_ROUNDING
from vv.engines.exact.reachability import RefusedError
from vv.engines.exact.roots import EPS
from vv.engines.exact.slide.system import TurningSlider
from vv.engines.exact.stopped import StoppedError
from vv.engines.exact.turn.kernel import ENDED, FULL, REST, follow_turning
from vv.engines.exact.turn.path import Turn
from vv.engines.exact.turn.series import ORDER
from vv.engines.exact.turn.slipping import padded_count
from vv.engines.kernels.compiled import entry
from vv.scene import Vector

FEW, MOST = 1_024, 262_144  # pieces for which arrays have room at first, and in one run
STILL = 64 * EPS  # over the greatest velocity: a slower slip is at rest


class TurningFlow:
    """A slider whose motion over a duration [s] can be computed as often as wanted."""

    def __init__(self, slider: TurningSlider, duration: float) -> None:
        self.slider, self.duration, self.room = slider, duration, FEW
        self.filled = self._filled()

    def warm(self) -> None:
        """Load or compile the kernel."""
        self._kernel  # noqa: B018 - a cached property

    def follow(self) -> int:
        """Run the kernel, which is what is timed: the number of pieces; raises as `Flow.follow`."""
        while True:
            outcome, count, t = self._kernel(*self._arguments, *self.filled)
            if outcome == ENDED:
                return count
            if outcome != FULL:
                raise StoppedError(
                    f"the force along the wall reaches the friction limit at t = {t:.6g} s without "
                    "rising above it in first order"
                )
            if self.room >= MOST:
                raise RefusedError(
                    f"the duration is too long for so fast a motion: more than {MOST} steps by "
                    f"t = {t:.6g} s"
                )
            self.room *= 4
            self.filled = self._filled()

    def path(self, count: int) -> Turn:
        """The motion, made from the number of pieces that `follow` returned."""
        starts, states, series = (array[:count] for array in self.filled)
        return Turn(self.slider, starts[:, 0], starts[:, 1], series, states != REST)

    @functools.cached_property
    def _arguments(self) -> tuple[Any, ...]:
        """The arguments of the kernel that describe the slider."""
        slider = self.slider
        rows = np.vstack((slider.relative_drive, slider.mu * slider.pressing))
        size, omega = np.abs(rows).sum(axis=1), 2 * np.pi * slider.frequency
        quickest = float(omega.max(initial=0.0))
        span = min(self.duration, 1 / quickest) if quickest > 0 else self.duration
        still = STILL * float(np.linalg.norm(slider.slip) + size.sum() * span)
        band = GUARD_ROUNDING * float((size**2).sum())
        return (*_padded(rows, slider), slider.slip, still, band, self.duration)

    @functools.cached_property
    def _kernel(self) -> Callable[..., tuple[int, int, float]]:
        """The machine code of the kernel."""
        return entry(follow_turning, (*self._arguments, *self.filled))

    def _filled(self) -> tuple[Vector, Vector, Vector]:
        """The arrays that the kernel fills."""
        room = self.room
        return np.empty((room, 2)), np.empty(room), np.empty((room, ORDER + 1, 3))


def _padded(rows: Vector, slider: TurningSlider) -> tuple[Vector, Vector]:
    """Rows and sines in the form of `expand_slip`, which may need sines of zero amplitude."""
    short = slider.frequency.astype(np.float32).astype(float)
    omega = 2 * np.pi * slider.frequency
    sines = np.stack((short, slider.frequency - short, slider.phase, omega), axis=1)
    more = padded_count(len(sines)) - len(sines)
    return np.pad(rows, ((0, 0), (0, more))), np.pad(sines, ((0, more), (0, 0)))
