"""The motion of a system: what its kernel is given, and what became of it."""

from __future__ import annotations

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
from vv.engines.exact.system import System

MOST_EVENTS = 50_000  # in one run; more are taken for an accumulation
MOST_STEPS = 200_000  # in one run
FEW = 64  # pieces for which there is room at first


class StoppedError(Exception):
    """The motion cannot be followed further; the message is the reason."""


def follow(system: System, duration: float) -> Path:
    """The motion of a system over a duration [s]; raises StoppedError if it cannot be followed."""
    room, (equations, velocity, lengths, states) = min(FEW, MOST_STEPS), system.start
    while True:
        starts, series = np.empty((room, 3)), np.empty((room, ORDER + 1, len(system.mass)))
        kept, began = np.empty((room, len(states)), np.int64), np.empty((room, len(lengths)))
        outcome, count, t, contact = follow_system(
            equations, velocity.copy(), lengths.copy(), states.copy(), duration,
            MOST_EVENTS, starts, kept, began, series,
        )  # fmt: skip
        if outcome == ENDED:
            start, h, end = starts[:count].T
            return Path(system, start, h, end, series[:count], kept[:count], began[:count])
        if outcome != FULL or room >= MOST_STEPS:
            raise StoppedError(_why(system, outcome, t, contact))
        room = min(4 * room, MOST_STEPS)


def _why(system: System, outcome: int, t: float, contact: int) -> str:
    if outcome == MEETING:
        bodies = "bodies {} and {}".format(*(system.names + system.bond_springs.names)[contact])
        return f"the centres of {bodies} meet at t = {t:.6g} s"
    return {
        BEYOND: f"the motion leaves the range of numbers at t = {t:.6g} s",
        CROWDED: f"events accumulate: more than {MOST_EVENTS} by t = {t:.6g} s",
        FULL: "the duration is too long for so fast a motion: more than "
        f"{MOST_STEPS} steps by t = {t:.6g} s",
    }[outcome]
