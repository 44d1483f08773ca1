"""Spheres that keep a steady velocity along locked directions, and the work that this takes."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vv.engines.dem.space.bodies import Bodies, Motion
from vv.engines.dem.space.ledger import column
from vv.engines.dem.space.placed import Placed
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import at, dot
from vv.scene import Form, Vector

CARRYING = column(Form.CARRYING)
WORK, POWER = 0, 1  # places in the array of stored numbers


class Carried(NamedTuple):
    """steady: (m, 3) velocities [m/s]; eta: of drag [N s/m]; kept: work [J], present power [W]."""

    steady: Vector
    eta: float
    kept: Vector


def build(placed: Placed) -> Carried | None:
    """The spheres with a steady velocity; None if there are none and the scene has no bonds."""
    steady, eta = placed.carried, placed.scene.eta
    if steady.any():
        return Carried(steady, eta, np.zeros(2))
    return None if placed.scene.bonds is None else Carried(steady[:0], eta, np.zeros(2))


def forms(term: Carried) -> tuple[Form, ...]:
    """The forms of energy that this term reports."""
    return (Form.CARRYING,) if len(term.steady) else ()


@inlined
def begin(term: Carried, bodies: Bodies, motion: Motion) -> None:
    """Set the work to zero."""
    term.kept[WORK] = term.kept[POWER] = 0.0


@inlined
def after(term: Carried, bodies: Bodies, motion: Motion, dt: float) -> None:
    """Add the work of the step, by the trapezoidal rule."""
    term.kept[WORK] += 0.5 * dt * term.kept[POWER]
    term.kept[POWER] = carrying_power(motion.push, term.steady, term.eta)
    term.kept[WORK] += 0.5 * dt * term.kept[POWER]


@inlined
def carrying_power(push: Vector, steady: Vector, eta: float) -> float:
    """The power [W] that keeps bodies at their steady velocities (m, 3) against push [N]."""
    power = 0.0
    for i in range(len(steady)):
        c = at(steady, i)
        power -= dot(c, at(push, i))
        power += eta * dot(c, c)
    return power


@inlined
def book(term: Carried, bodies: Bodies, motion: Motion, energy: Vector, row: int) -> tuple[float]:
    """Write the work done since t = 0 [J]."""
    if len(term.steady):
        energy[row, CARRYING] = term.kept[WORK]
    return (term.kept[WORK],)
