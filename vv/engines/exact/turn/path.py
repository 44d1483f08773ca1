"""The exact motion of a slip that changes direction, as a sequence of Taylor polynomials."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from vv.engines.exact.path import taylor_sum
from vv.engines.exact.roots import EPS
from vv.engines.exact.slide.system import TurningSlider
from vv.scene import Vector

NEXT = 1e-6  # largest distance of a time from the end of its piece, over the piece


@dataclass(frozen=True, eq=False)
class Turn:
    """A motion of p pieces: position and time are sum over k of series[k] x^k, with x in [0, end].

    start [s], end: (p,); series: (p, ORDER + 1, 3), two components of slip [m] and the time since
    the start of the piece [s]; slips: (p,) whether the body slips.
    """

    slider: TurningSlider
    start: Vector
    end: Vector
    series: Vector
    slips: npt.NDArray[np.bool_]

    def __len__(self) -> int:
        return len(self.start)

    @property
    def changes(self) -> Vector:
        """The times (c,) [s] at which the body begins to slip or comes to rest."""
        pairs = itertools.pairwise(self.slips.tolist())
        return self.start[1:][[before is not after for before, after in pairs]]

    def at(self, times: Vector) -> tuple[Vector, Vector]:
        """Slip (t, 2) [m] and its velocity (t, 2) [m/s] at times (t,) [s]."""
        piece = np.maximum(np.searchsorted(self.start, times, side="right") - 1, 0)
        curve, rate = taylor_sum(self.series[piece], self._where(piece, times - self.start[piece]))
        return curve[:, :2], rate[:, :2] / rate[:, 2:]

    def _where(self, piece: npt.NDArray[np.intp], elapsed: Vector) -> Vector:
        """The parameters x (t,) of pieces (t,) at times (t,) [s] since their start.

        They follow by Newton's method with bisection, since time grows with x.
        """
        clocks = self.series[piece, :, 2:]
        low, high = np.zeros(len(piece)), self.end[piece] * (1 + NEXT)
        x = high * np.minimum(elapsed / taylor_sum(clocks, high)[0][:, 0], 1.0)
        for _ in range(60):
            time, rate = (part[:, 0] for part in taylor_sum(clocks, x))
            late = time - elapsed
            high, low = np.where(late > 0, x, high), np.where(late > 0, low, x)
            guess = x - late / rate
            x = np.where((guess >= low) & (guess <= high), guess, (low + high) / 2)
            if (np.abs(late) <= 4 * EPS * (elapsed + np.abs(x * rate))).all():
                break
        return x

    def of(self, sphere: int, times: Vector) -> tuple[Vector, Vector]:
        """Displacement and velocity (t, 3) [m, m/s] of the body at times (t,) [s]."""
        return self.motion_in_space(*self.at(times), times)

    def motion_in_space(self, place: Vector, speed: Vector, times: Vector) -> tuple[Vector, Vector]:
        """Displacement and velocity (t, 3) of the body: those of its slip and of the wall."""
        axes = self.slider.axes
        return with_wall(self.slider, place @ axes, speed @ axes, times)


def with_wall(
    slider: TurningSlider, slip: Vector, speed: Vector, times: Vector
) -> tuple[Vector, Vector]:
    """Displacement and velocity (t, 3) of a body from those of its slip, with those of its wall."""
    angle = np.outer(times, 2 * np.pi * slider.frequency) + slider.phase
    rates = 2 * np.pi * slider.frequency[:, None] * slider.base
    return (
        slip + (np.sin(angle) - np.sin(slider.phase)) @ slider.base,
        speed + np.cos(angle) @ rates,
    )
