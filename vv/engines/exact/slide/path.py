"""The exact motion of a slider as a sequence of Taylor polynomials, with its events."""

from __future__ import annotations

import functools
import itertools
from dataclasses import dataclass

import numpy as np

from vv.engines.exact.modes import STATES, Index, States
from vv.engines.exact.path import Event, taylor_sum
from vv.engines.exact.slide.clock import Clock, Instant
from vv.engines.exact.slide.system import Slider
from vv.scene import Vector


@dataclass(frozen=True, eq=False)
class Slide:
    """A motion of p pieces: position = sum over k of series[k] x^k [m], x in [0, end] in cells.

    cell, part: (p,) the instant at which a piece starts; end: (p,) its length in cells; series:
    (p, order + 1); numbered: (p,) states as indices into STATES; last: the instant of the end.
    """

    slider: Slider
    clock: Clock
    cell: Index
    part: Vector
    end: Vector
    series: Vector
    numbered: Index
    last: Instant

    @functools.cached_property
    def states(self) -> States:
        """The state of the contact in each piece."""
        return tuple(STATES[state] for state in self.numbered.tolist())

    @functools.cached_property
    def waves(self) -> Vector:
        """The waves of the clock at the start of each piece and at the end: (p + 1, 1 + 2k)."""
        starts = zip(self.cell.tolist(), self.part.tolist(), strict=True)
        return np.array([self.clock.waves(instant) for instant in (*starts, self.last)])

    def series_of_row(self, row: Vector) -> Vector:
        """Taylor coefficients (p, order + 1) of row[0] + row[1:] @ sines in each piece."""
        return np.asarray(self.waves[:-1] @ self.clock.taylor(row).T)

    def __len__(self) -> int:
        return len(self.end)

    @functools.cached_property
    def events(self) -> tuple[Event, ...]:
        """All changes of the contact's state, in order of time."""
        starts = zip(self.cell.tolist(), self.part.tolist(), strict=True)
        held = list(zip(starts, self.states, strict=True))
        return tuple(
            Event(self.clock.time(start), self.slider.names, before, after)
            for (_, before), (start, after) in itertools.pairwise(held)
            if before is not after
        )

    def at(self, times: Vector) -> tuple[Vector, Vector]:
        """Position (t,) [m] and speed (t,) [m/s] along the slip at times (t,) [s]."""
        cell, part = self.clock.instants(times)
        piece = np.searchsorted(self.cell + self.part, cell + part, side="right") - 1
        piece = np.maximum(piece, 0)
        x = (cell - self.cell[piece]) + (part - self.part[piece])
        place, rate = taylor_sum(self.series[piece, :, None], x)
        return place[:, 0], rate[:, 0] * self.clock.rate

    def of(self, sphere: int, times: Vector) -> tuple[Vector, Vector]:
        """Displacement and velocity (t, 3) [m, m/s] of the body at times (t,) [s]."""
        return self.motion_in_space(*self.at(times), self.clock.waves_at(times))

    def motion_in_space(self, place: Vector, speed: Vector, waves: Vector) -> tuple[Vector, Vector]:
        """Displacement and velocity (t, 3) [m, m/s], whose normal parts are those of the wall."""
        slider, k = self.slider, len(self.slider.phase)
        lift = slider.base @ slider.normal
        sine, cosine = waves[:, 1 : k + 1] - np.sin(slider.phase), waves[:, k + 1 :]
        lifted, lifting = sine @ lift, cosine @ (2 * np.pi * slider.frequency * lift)
        return (
            np.outer(place, slider.along) + np.outer(lifted, slider.normal),
            np.outer(speed, slider.along) + np.outer(lifting, slider.normal),
        )
