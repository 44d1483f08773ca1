"""Measures time in quarter periods of the fastest sine, so that phases lose no digits."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
import numpy.typing as npt

from vv.scene import Vector

CELLS = 4  # per period of the fastest sine: angles of at most pi/2, for which series are short
ORDER = 24  # of the Taylor series of a sine over a cell; the last term is (pi/2)^24/24! = 1e-19
Instant = tuple[int, float]  # number of completed cells, and fraction of the present one


@dataclass(frozen=True, eq=False)
class Clock:
    """Divides time into cells of 1/rate [s], and evaluates k sines in them.

    rate [1/s]; turns: the cycles a/b of each sine in a cell, as integers (a, b); frequency (k,)
    [Hz]; phase (k,) [rad]. An instant is as accurate after a million periods as at t = 0.
    """

    rate: float
    turns: tuple[tuple[int, int], ...]
    frequency: Vector
    phase: Vector

    @classmethod
    def of(cls, frequency: Vector, phase: Vector, duration: float) -> Clock:
        """The clock for sines of frequencies (k,) [Hz]; without any, the duration is one cell."""
        quickest = float(frequency.max(initial=0.0))
        if quickest == 0:
            return cls(1 / duration, ((0, 1),) * len(phase), frequency, phase)
        parts = [Fraction(f) / Fraction(CELLS * quickest) for f in frequency.tolist()]
        turns = tuple((part.numerator, part.denominator) for part in parts)
        return cls(CELLS * quickest, turns, frequency, phase)

    def instant(self, time: float) -> Instant:
        """The instant of a time [s]."""
        cell, part = self.instants(np.array([time]))
        return int(cell[0]), float(part[0])

    def instants(self, times: Vector) -> tuple[npt.NDArray[np.int64], Vector]:
        """The instants of times (t,) [s], as (t,) cells and (t,) parts."""
        exact = times.astype(np.longdouble) * self.rate
        cells = np.floor(exact)
        return cells.astype(np.int64), (exact - cells).astype(float)

    def time(self, instant: Instant) -> float:
        """The time of an instant [s]."""
        return (instant[0] + instant[1]) / self.rate

    def waves(self, instant: Instant) -> Vector:
        """1, the k sines and the k cosines at an instant: (1 + 2k,)."""
        cell, part = instant
        angles = [
            2 * math.pi * ((a * cell) % b / b + a / b * part) + phase
            for (a, b), phase in zip(self.turns, self.phase.tolist(), strict=True)
        ]
        return np.array([1.0, *map(math.sin, angles), *map(math.cos, angles)])

    @functools.cached_property
    def turn(self) -> Vector:
        """The change of each sine's phase in a cell (k,) [rad]."""
        return 2 * np.pi * np.array([a / b for a, b in self.turns]).reshape(len(self.phase))

    def angles(self, cells: int) -> Vector:
        """The phases of the sines at the start of each cell (cells, k) [rad], without loss."""
        cell = np.arange(cells)
        start = np.empty((cells, len(self.phase)))
        for i, (a, b) in enumerate(self.turns):
            fits = max(a, b) * cells < 2**63
            whole = (a * cell) % b if fits else [(a * n) % b for n in range(cells)]
            start[:, i] = 2 * np.pi * (np.asarray(whole, float) / b) + self.phase[i]
        return start

    def waves_at(self, times: Vector) -> Vector:
        """The same as `waves`, at times (t,) [s]: (t, 1 + 2k)."""
        turns = times.astype(np.longdouble)[:, None] * self.frequency
        angles = 2 * np.pi * (turns - np.floor(turns)).astype(float) + self.phase
        return np.hstack((np.ones((len(times), 1)), np.sin(angles), np.cos(angles)))

    def taylor(self, row: Vector) -> Vector:
        """The matrix (ORDER + 1, 1 + 2k) from `waves` to the series of row[0] + row[1:] @ sines.

        The variable x of the series counts cells: sin(b + c x) = sin b cos c x + cos b sin c x.
        """
        rank = np.arange(ORDER + 1)
        size = (
            self.turn ** rank[:, None] / np.array([float(math.factorial(n)) for n in rank])[:, None]
        )
        size *= np.where(rank // 2 % 2, -1.0, 1.0)[:, None]
        even = (rank % 2 == 0)[:, None]
        maps = np.hstack((np.zeros((ORDER + 1, 1)), row[1:] * size * even, row[1:] * size * ~even))
        maps[0, 0] = row[0]
        return np.asarray(maps)
