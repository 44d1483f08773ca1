"""A pulse in a chain: what is measured of it, and what a leapfrog makes of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from reference_solutions.contact import chain as closed
from vv.ask import History
from vv.case import remembered
from vv.scene import Vector

NEAR, FAR = 25, 75  # the spheres that are observed: one before the jump, one beyond it
TURN, RISE, FALL = 0.475, 0.075, 0.1  # of the time: see `returned_energy`
TRIED = (4.5, 3.0, 1.0, 0.25)  # times the coarsest step; a leapfrog is stable below 5
Measure = Callable[[Vector, Vector], "Vector | float"]


@dataclass(frozen=True)
class Pulse:
    """A pulse that starts with velocities thrown (N,) [m/s] in a chain of masses (N,) [kg].

    kn: stiffness of its springs [N/m]; goal: when it is observed.
    """

    thrown: Vector
    masses: Vector
    kn: float
    goal: History

    def path(self) -> Callable[[Vector], Vector]:
        """The exact velocities (k, 2) of the two spheres at times (k,)."""
        return remembered(lambda t: self._seen(closed.motion(t, *self._chain)[1]))

    def in_steps(self, t: Vector, dt: float) -> Vector:
        """The velocities (k, 2) that a leapfrog of step dt [s] gives at times (k,)."""
        return self._seen(closed.leapfrog(t, *self._chain, dt)[1])

    def error(self, measure: Measure, coarsest: float) -> float:
        """The error of a leapfrog in what is measured, at the coarsest step [s].

        It is the largest over some steps of the error times (coarsest/dt)^2, so that it also
        holds where the error does not grow by dt^2 alone. Outputs are at whole steps.
        """
        due, found = self.path(), []
        for part in TRIED:
            t = self.goal.times(part * coarsest)
            exact = measure(t, due(t)), measure(t, self.in_steps(t, part * coarsest))
            found.append(float(np.abs(np.subtract(*exact)).max()) / part**2)
        return max(found)

    @property
    def _chain(self) -> tuple[Vector, Vector, float]:
        return self.thrown, self.masses, self.kn

    @staticmethod
    def _seen(all_of_them: Vector) -> Vector:
        return all_of_them[:, [NEAR - 1, FAR - 1]]


def returned_energy(t: Vector, v: Vector, whole: float) -> float:
    """The sum of squared velocities (k, 2) after half of the time, over that before.

    whole: the time in which the chain is crossed [s]. The sums begin and end smoothly, within 7.5 %
    and 10 % of it: at a sharp end one output more or less would change what returns along
    equal masses by more than steps do.
    """
    share = t / whole
    late = _smooth((share - TURN) / RISE)
    squares = v[:, 0] ** 2
    back = late * _smooth((1.0 - share) / FALL)
    return float((back * squares).sum() / ((1.0 - late) * squares).sum())


def _smooth(x: Vector) -> Vector:
    """0 below 0, 1 above 1, with two derivatives that are zero at both."""
    x = np.clip(x, 0.0, 1.0)
    return np.asarray(x**3 * (10.0 - 15.0 * x + 6.0 * x**2))


def speed(t: Vector, v: Vector) -> float:
    """Spheres per second, from the mean times at which energy passes the two that are observed."""
    near, far = (t @ v**2 / (v**2).sum(axis=0)).tolist()
    return float((FAR - NEAR) / (far - near))
