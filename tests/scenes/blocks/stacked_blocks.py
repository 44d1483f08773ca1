"""Two blocks on one another on a base that moves sideways: the scene, and its motion by events.

Per interface friction is Coulomb's; the blocks do not tip. Between events every acceleration is
the base's or constant, so that positions are closed forms and events are roots of these.
"""

from __future__ import annotations

import functools
import itertools
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from tests.scenes.blocks.block_scenes import DOWN, G, box
from vv.scene import Contact, Harmonic, Scene, Vector, Wall

MU, D, F = 0.5, 0.05, 2.0  # -, m, Hz: 0.8 g, at which both interfaces slip
OMEGA = 2 * np.pi * F
LIFTED = 0.5  # of the upper block's weight: without, both interfaces would slip at once
AFTER, GRID = 1e-7, 1e-3  # s: how soon a mode must hold; between looks for an event


def scene() -> Scene:
    """A wide block below, a small one above, which a dead load partly lifts."""
    motion = Harmonic(np.array([D, 0.0, 0.0]), np.array([F, 0.0, 0.0]), np.full(3, -np.pi / 2))
    base = Wall(np.zeros(3), np.array([0.0, 0.0, 1.0]), motion)
    lower = box("lower", [0.0, 0.0, 0.1], [0.8, 0.5, 0.1])
    upper = box("upper", [0.0, 0.0, 0.3], [0.4, 0.3, 0.1])
    lift = np.array([0.0, 0.0, LIFTED * upper.mass * G])
    upper = box("upper", [0.0, 0.0, 0.3], [0.4, 0.3, 0.1], load=lift)
    return Scene((base, lower, upper), Contact(np.inf, mu=MU), gravity=DOWN)


def base(t: float, order: int = 0) -> float:
    """The base's displacement D (1 - cos wt), or a derivative of it."""
    moved = -D * OMEGA**order * np.cos(OMEGA * t + order * np.pi / 2)
    return float(moved + (D if order == 0 else 0.0))


@dataclass(frozen=True)
class Phase:
    """From `start` on, while the slips (of the lower, of the upper) keep these signs or are none.

    x, v: (2,) positions [m] and velocities [m/s] of the blocks at the start.
    """

    start: float
    slips: tuple[int, int]
    x: Vector
    v: Vector

    def pushes(self, t: float) -> tuple[Vector, Vector]:
        """Accelerations of the blocks, and what friction there must be below each [N]."""
        m, most = masses(), caps()
        one, two = self.slips
        if two:
            a2 = -two * most[1] / m[1]
            a1 = (-one * most[0] - m[1] * a2) / m[0] if one else base(t, 2)
        else:
            a1 = a2 = -one * most[0] / m.sum() if one else base(t, 2)
        return np.array([a1, a2]), np.array([m[0] * a1 + m[1] * a2, m[1] * a2])

    def follows(self) -> Vector:
        """Which blocks (2,) move with the base."""
        return np.array([not self.slips[0], not any(self.slips)])

    def at(self, t: float) -> tuple[Vector, Vector]:
        """Positions and velocities at a time in the phase."""
        s, a = t - self.start, self.pushes(self.start)[0]
        along, rate = base(t) - base(self.start), base(t, 1) - base(self.start, 1)
        carried = along - base(self.start, 1) * s
        x = self.x + self.v * s + np.where(self.follows(), carried, 0.5 * a * s**2)
        return x, self.v + np.where(self.follows(), rate, a * s)

    def slip(self, t: float) -> Vector:
        """Velocities of the lower relative to the base and of the upper relative to the lower."""
        v = self.at(t)[1]
        return np.array([v[0] - base(t, 1), v[1] - v[0]])

    def slack(self, t: float) -> Vector:
        """What is left (2,) before the mode ends: of slip, or of friction that is not used."""
        left = caps() - np.abs(self.pushes(t)[1])
        return np.where(self.slips, np.array(self.slips) * self.slip(t), left)


@functools.cache
def masses() -> Vector:
    """Of the lower and the upper block [kg]."""
    return np.array([block.mass for block in scene().blocks])


@functools.cache
def caps() -> Vector:
    """The most that friction holds below each block [N]."""
    m = masses()
    upper = (1 - LIFTED) * m[1] * G
    return MU * np.array([m[0] * G + upper, upper])


def following(t: float, x: Vector, v: Vector, stuck: Vector) -> Phase:
    """The phase that follows an event; stuck: the interfaces (2,) whose slip is nil then."""
    slip = np.where(stuck, 0.0, [v[0] - base(t, 1), v[1] - v[0]])
    v = base(t, 1) + np.cumsum(slip)
    for slips in sorted(itertools.product((0, -1, 1), (0, -1, 1)), key=np.count_nonzero):
        phase = Phase(t, slips, x, v)
        right = all(s == np.sign(w) for s, w in zip(slips, slip, strict=True) if w != 0)
        if right and (phase.slack(t + AFTER) > 0).all():
            return phase
    raise ArithmeticError(f"no mode goes on at t = {t} s")


def phases(end: float) -> Iterator[Phase]:
    """All phases until `end` [s], from rest."""
    phase = following(0.0, np.zeros(2), np.zeros(2), np.ones(2, bool))
    while True:
        yield phase
        times = phase.start + AFTER + GRID * np.arange(int((end - phase.start) / GRID) + 2)
        bad = [k for k, t in enumerate(times) if (phase.slack(t) <= 0).any()]
        if not bad:
            return
        over = int(np.argmin(phase.slack(times[bad[0]])))
        stop = brentq(lambda t: phase.slack(t)[over], times[bad[0] - 1], times[bad[0]], xtol=1e-15)  # noqa: B023
        stuck = np.array([s == 0 or i == over for i, s in enumerate(phase.slips)])
        phase = following(stop, *phase.at(stop), stuck)


def by_events(times: Vector) -> Vector:
    """Displacements (t, 2) of the lower and the upper block [m]."""
    found = list(phases(float(times[-1])))
    starts = np.array([phase.start for phase in found])
    which = np.searchsorted(starts, times, side="right") - 1
    return np.array([found[k].at(t)[0] for k, t in zip(which, times, strict=True)])
