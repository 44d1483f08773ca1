"""The exact motion of a slider as a sequence of Taylor polynomials, with its events."""

from __future__ import annotations

import functools
import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from vv.engines.exact.modes import State
from vv.engines.exact.path import Event, taylor_sum
from vv.engines.exact.slide.clock import Clock, Instant
from vv.engines.exact.slide.system import Slider
from vv.scene import Vector


class SlidePiece(NamedTuple):
    """Place = sum over k of series[k] x^k [m] for x in [0, end], in cells of the clock.

    start: the instant of x = 0; state; waves: (1 + 2k,), those at its start.
    """

    start: Instant
    end: float
    series: Vector
    state: State
    waves: Vector


@dataclass(frozen=True, eq=False)
class Slide:
    """A motion of p pieces, with the fields of SlidePiece stacked.

    cell, part, end: (p,); series: (p, order + 1); waves: (p + 1, 1 + 2k), the last at the end.
    """

    slider: Slider
    clock: Clock
    cell: npt.NDArray[np.int64]
    part: Vector
    end: Vector
    series: Vector
    states: tuple[State, ...]
    waves: Vector

    @classmethod
    def joined(
        cls, slider: Slider, clock: Clock, pieces: Sequence[SlidePiece], last: Instant
    ) -> Slide:
        """The path that pieces make, in order of time, to the last instant."""
        return cls(
            slider=slider,
            clock=clock,
            cell=np.array([piece.start[0] for piece in pieces]),
            part=np.array([piece.start[1] for piece in pieces]),
            end=np.array([piece.end for piece in pieces]),
            series=np.array([piece.series for piece in pieces]),
            states=tuple(piece.state for piece in pieces),
            waves=np.array([*(piece.waves for piece in pieces), clock.waves(last)]),
        )

    def __len__(self) -> int:
        return len(self.states)

    @functools.cached_property
    def events(self) -> tuple[Event, ...]:
        """Every change of the contact's state, in order of time."""
        starts = zip(self.cell.tolist(), self.part.tolist(), strict=True)
        held = list(zip(starts, self.states, strict=True))
        return tuple(
            Event(self.clock.time(start), self.slider.names, before, after)
            for (_, before), (start, after) in itertools.pairwise(held)
            if before is not after
        )

    def at(self, times: Vector) -> tuple[Vector, Vector]:
        """Place (t,) [m] and speed (t,) [m/s] along the slip at times (t,) [s]."""
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
        """Displacement and velocity (t, 3), of which the wall alone decides the normal parts."""
        slider, k = self.slider, len(self.slider.phase)
        lift = slider.base @ slider.normal
        sine, cosine = waves[:, 1 : k + 1] - np.sin(slider.phase), waves[:, k + 1 :]
        lifted, lifting = sine @ lift, cosine @ (2 * np.pi * slider.frequency * lift)
        return (
            np.outer(place, slider.along) + np.outer(lifted, slider.normal),
            np.outer(speed, slider.along) + np.outer(lifting, slider.normal),
        )
