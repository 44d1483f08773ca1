"""Runs the kernel of a system: prepares its arguments and makes a path of its output."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

import numpy as np

from vv.engines.exact.kernel import (
    BEYOND,
    CROWDED,
    ENDED,
    FULL,
    MEETING,
    ORDER,
    follow_system,
)
from vv.engines.exact.path import Path
from vv.engines.exact.reachability import RefusedError
from vv.engines.exact.stopped import StoppedError
from vv.engines.exact.system import System
from vv.engines.kernels.compiled import entry

MOST_EVENTS = 50_000  # in one run; with more, events are said to accumulate
MOST_STEPS = 200_000  # in one run, and more where fewer unknowns are moved
MOST_NUMBERS = 40_000_000  # in arrays of so many steps, or 320 MB: a million steps of one unknown
FEW = 64  # pieces for which arrays have room at first
Outcome = tuple[int, int, float, int]  # what `follow_system` returns


def most_steps(system: System) -> int:
    """The number of steps that a run may take: a step stores a Taylor series of each unknown."""
    _, velocity, lengths, states = system.start
    numbers = 3 + len(states) + len(lengths) + (ORDER + 1) * len(velocity)
    return max(MOST_STEPS, MOST_NUMBERS // numbers)


class SystemFlow:
    """A system whose motion over a duration [s] can be computed as often as wanted."""

    def __init__(self, system: System, duration: float) -> None:
        self.system, self.duration = system, duration
        self.most = most_steps(system)
        self.room = min(FEW, self.most)
        self.filled = self._filled()

    def warm(self) -> None:
        """Load or compile the kernel."""
        self._kernel  # noqa: B018 - a cached property

    def follow(self) -> Outcome:
        """Run the kernel, which is what is timed; raises as `Flow.follow`."""
        while True:
            outcome = self._kernel(*self._initial(), self.duration, MOST_EVENTS, *self.filled)
            if outcome[0] == ENDED:
                return outcome
            if outcome[0] != FULL:
                raise StoppedError(self._why(outcome))
            if self.room >= self.most:
                raise RefusedError(
                    "the duration is too long for so fast a motion: more than "
                    f"{self.most} steps by t = {outcome[2]:.6g} s"
                )
            self.room = min(4 * self.room, self.most)
            self.filled = self._filled()

    def path(self, outcome: Outcome) -> Path:
        """The motion, made from the outcome of `follow`."""
        starts, states, lengths, series = (array[: outcome[1]] for array in self.filled)
        start, h, end = starts.T
        return Path(self.system, start, h, end, series, states, lengths)

    @functools.cached_property
    def _kernel(self) -> Callable[..., Outcome]:
        arguments = (*self._initial(), self.duration, MOST_EVENTS, *self.filled)
        return entry(follow_system, arguments)

    def _initial(self) -> tuple[Any, ...]:
        """The equations, and the state at t = 0, which the kernel overwrites."""
        equations, velocity, lengths, states = self.system.start
        return equations, velocity.copy(), lengths.copy(), states.copy()

    def _filled(self) -> tuple[Any, ...]:
        """The arrays that the kernel fills."""
        _, velocity, lengths, states = self.system.start
        return (
            np.empty((self.room, 3)),
            np.empty((self.room, len(states)), np.int64),
            np.empty((self.room, len(lengths))),
            np.empty((self.room, ORDER + 1, len(velocity))),
        )

    def _why(self, outcome: Outcome) -> str:
        """The reason for which the motion stops early."""
        code, _, t, contact = outcome
        if code == MEETING:
            names = self.system.names + self.system.bond_springs.names
            bodies = "bodies {} and {}".format(*names[contact])
            return f"the centres of {bodies} meet at t = {t:.6g} s"
        return {
            BEYOND: f"the motion exceeds the range of floating-point numbers at t = {t:.6g} s",
            CROWDED: f"events accumulate: more than {MOST_EVENTS} by t = {t:.6g} s",
        }[code]


def follow(system: System, duration: float) -> Path:
    """The motion of any system over a duration [s]; raises as `Flow.follow`."""
    flow = SystemFlow(system, duration)
    return flow.path(flow.follow())
