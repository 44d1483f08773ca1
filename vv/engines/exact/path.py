"""An exact motion as a sequence of Taylor polynomials in time, with its events."""

from __future__ import annotations

import functools
from dataclasses import dataclass

import numpy as np

from vv.engines.exact.modes import STATES, Index, State, States
from vv.engines.exact.system import System
from vv.scene import Vector


@dataclass(frozen=True)
class Event:
    """A change of a contact's state at a time [s]; bodies: the numbers of its two bodies."""

    time: float
    bodies: tuple[int, int]
    before: State
    after: State


@dataclass(frozen=True, eq=False)
class Path:
    """An exact motion of p pieces: q = sum over k of series[k] x^k, x = (t - start)/h in [0, end].

    start, h [s], end: (p,); series: (p, order + 1, n) [m]; numbered: (p, c) states of the contacts
    as indices into STATES; lengths: (p, c + s + h) gaps and stretches of shear and bond springs
    at the start of a piece [m].
    """

    system: System
    start: Vector
    h: Vector
    end: Vector
    series: Vector
    numbered: Index
    lengths: Vector

    @functools.cached_property
    def states(self) -> tuple[States, ...]:
        """The states of the contacts in each piece."""
        return tuple(tuple(STATES[state] for state in row) for row in self.numbered.tolist())

    def __len__(self) -> int:
        return len(self.start)

    @functools.cached_property
    def events(self) -> tuple[Event, ...]:
        """All changes of a contact's state, in order of time."""
        found = []
        for time, before, after in zip(self.start[1:], self.states, self.states[1:], strict=False):
            for bodies, old, new in zip(self.system.names, before, after, strict=True):
                if old is not new:
                    found.append(Event(float(time), bodies, old, new))
        return tuple(found)

    def at(self, times: Vector) -> tuple[Vector, Vector]:
        """Displacements (k, n) [m] and velocities (k, n) [m/s] of the unknowns at times (k,)."""
        piece = np.maximum(np.searchsorted(self.start, times, side="right") - 1, 0)
        x = (times - self.start[piece]) / self.h[piece]
        q, rate = taylor_sum(self.series[piece], x)
        return q, rate / self.h[piece, None]

    def of(self, sphere: int, times: Vector) -> tuple[Vector, Vector]:
        """Displacement and velocity (k, 3) [m, m/s] of a sphere at times (k,) [s]."""
        q, v = self.at(times)
        own = self.system.owner == sphere
        direction = self.system.direction[own]
        return q[:, own] @ direction, v[:, own] @ direction


def taylor_sum(series: Vector, x: Vector) -> tuple[Vector, Vector]:
    """Values and derivatives, (k, n), of polynomials (k, order + 1, n) at x (k,)."""
    x = x[:, None]
    q = series[:, -1]
    rate = np.zeros_like(q)
    for k in range(series.shape[1] - 2, -1, -1):
        rate = rate * x + q
        q = q * x + series[:, k]
    return q, rate
