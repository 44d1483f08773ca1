"""The motion of a system: what its kernels are given, and what became of it."""

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
from vv.engines.exact.stopped import StoppedError
from vv.engines.exact.system import System
from vv.engines.kernels.compiled import entry

MOST_EVENTS = 50_000  # in one run; more are taken for an accumulation
MOST_STEPS = 200_000  # in one run
FEW = 64  # pieces for which there is room at first
Outcome = tuple[int, int, float, int]  # of `follow_system`


class SystemFlow:
    """A system ready to be followed over a duration [s], as often as wanted."""

    def __init__(self, system: System, duration: float) -> None:
        self.system, self.duration = system, duration
        self.room = min(FEW, MOST_STEPS)
        self.filled = self._filled()

    def warm(self) -> None:
        """Load the kernel, or compile it."""
        self._kernel  # noqa: B018 - looked up, and kept

    def follow(self) -> Outcome:
        """Do what is timed; raises StoppedError if the motion cannot be followed."""
        while True:
            outcome = self._kernel(*self._begun(), self.duration, MOST_EVENTS, *self.filled)
            if outcome[0] == ENDED:
                return outcome
            if outcome[0] != FULL or self.room >= MOST_STEPS:
                raise StoppedError(self._why(outcome))
            self.room = min(4 * self.room, MOST_STEPS)
            self.filled = self._filled()

    def path(self, outcome: Outcome) -> Path:
        """The motion of which `follow` told."""
        starts, kept, began, series = (array[: outcome[1]] for array in self.filled)
        start, h, end = starts.T
        return Path(self.system, start, h, end, series, kept, began)

    @functools.cached_property
    def _kernel(self) -> Callable[..., Outcome]:
        arguments = (*self._begun(), self.duration, MOST_EVENTS, *self.filled)
        return entry(follow_system, arguments)

    def _begun(self) -> tuple[Any, ...]:
        """The equations, and the state at t = 0, which the kernel overwrites."""
        equations, velocity, lengths, states = self.system.start
        return equations, velocity.copy(), lengths.copy(), states.copy()

    def _filled(self) -> tuple[Any, ...]:
        """What the kernel fills."""
        _, velocity, lengths, states = self.system.start
        return (
            np.empty((self.room, 3)),
            np.empty((self.room, len(states)), np.int64),
            np.empty((self.room, len(lengths))),
            np.empty((self.room, ORDER + 1, len(velocity))),
        )

    def _why(self, outcome: Outcome) -> str:
        code, _, t, contact = outcome
        if code == MEETING:
            names = self.system.names + self.system.bond_springs.names
            bodies = "bodies {} and {}".format(*names[contact])
            return f"the centres of {bodies} meet at t = {t:.6g} s"
        return {
            BEYOND: f"the motion leaves the range of numbers at t = {t:.6g} s",
            CROWDED: f"events accumulate: more than {MOST_EVENTS} by t = {t:.6g} s",
            FULL: "the duration is too long for so fast a motion: more than "
            f"{MOST_STEPS} steps by t = {t:.6g} s",
        }[code]


def follow(system: System, duration: float) -> Path:
    """The motion of any system over a duration [s]; raises StoppedError where it stops."""
    flow = SystemFlow(system, duration)
    return flow.path(flow.follow())
