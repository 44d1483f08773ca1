"""A gas of frictionless spheres in a box: its rates of collision, and how it cools.

Equal spheres of mass m with contact springs kn, with or without dashpots, fill a box of side L. The
temperature T is a third of the mean of m v v [J]. Spheres fly freely between contacts, and contacts
are short. The spheres therefore collide like hard spheres whose diameter is smaller by sqrt(pi T/2
kn), to first order in the overlap (Barker and Henderson 1967).

In the interior the gas has the equation of state of Carnahan and Starling (1969), which implies
Enskog's rate of collisions with their pair correlation. At walls it has the surface tension of
Henderson and Plischke (1987, Proceedings of the Royal Society A 410, 409-420), and where two walls
meet a line tension of second order in the density, 2/15 d^5 n^2/2 T, from a count of the pairs that
a corner keeps apart. These tensions determine the adsorption of gas at the walls, hence its density
in the interior, and its pressure on the walls. The virial theorem then gives the rates of contacts
between spheres and with walls.

A contact of two spheres dissipates 1 - e^2 of the energy of approach, whose mean over collisions is
T, and a contact with a wall 1 - w^2, where w is closer to one since the mass is not the reduced
one. The square root of the energy then falls as 1/(1 + t/tau) (Haff 1983, Journal of Fluid
Mechanics 134, 401-430). The lower temperature at walls and the correlation of velocities are
neglected, which is an error of the order of 1 - e^2 times the share of the walls.
"""

from __future__ import annotations

from math import pi, sqrt
from typing import NamedTuple

from reference_solutions.contact.dashpot import restitution
from reference_solutions.parameters import require_positive

HALVINGS, NUDGE = 60, 1e-6


class Gas(NamedTuple):
    """Solid fraction in the interior, and the rates of contacts of two and with walls [1/s]."""

    filled: float
    pairs: float
    walls: float


def gas(count: int, *, side: float, d: float, m: float, kn: float, temperature: float) -> Gas:
    """The gas of this many spheres of diameter d [m] in a box of the given side [m]."""
    require_positive("in SI units", side=side, d=d, m=m, kn=kn, temperature=temperature)
    soft = sqrt(pi * temperature / (2.0 * kn))
    hard = d - soft
    room = (side - d + 2.0 * soft) / hard  # range of the centres along an axis, in diameters
    filled = _filled(count, room)
    n = 6.0 * filled / pi
    inside = 3.0 * n * _pressure(filled) * room**3
    push = inside - 12.0 * room**2 * _tension(filled) - 12.0 * room * _edge(filled)
    speed = sqrt(temperature / (pi * m)) / hard
    return Gas(filled, (push - 3.0 * count) * speed, sqrt(2.0) * push / room * speed)


def touching(found: Gas, *, m: float, kn: float) -> float:
    """The mean number of contacts at a time, walls included, of spheres without dashpots."""
    return (found.pairs / sqrt(2.0) + found.walls) * pi * sqrt(m / kn)


def cooling(count: int, found: Gas, z: float) -> float:
    """The rate of cooling 1/tau [1/s] for a damping ratio z in contacts of two spheres."""
    lost = found.pairs * (1.0 - restitution(z) ** 2)
    lost += found.walls * (1.0 - restitution(z / sqrt(2.0)) ** 2)
    return lost / (3.0 * count)


def flatness(count: int) -> float:
    """The mean of v^4 over the square of the mean of v^2, for this many spheres of a given energy.

    All velocities of the same energy are equally likely. For many spheres this tends to 5/3, the
    value of Maxwell's distribution.
    """
    return 5.0 * count / (3.0 * count + 2.0)


def _filled(count: int, room: float) -> float:
    """The interior solid fraction of this many spheres, some of which lie at walls and edges."""
    low, high = 0.0, 0.6
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if _held(middle, room) > count:
            high = middle
        else:
            low = middle
    return 0.5 * (low + high)


def _held(filled: float, room: float) -> float:
    """The number of spheres in the box at an interior solid fraction, -d Omega/d mu (Gibbs)."""
    n, more, less = 6.0 * filled / pi, filled * (1.0 + NUDGE), filled * (1.0 - NUDGE)
    with_mu = n * pi / 6.0 / _stiffness(filled) / (more - less)
    faces = with_mu * (_tension(less) - _tension(more))
    edges = with_mu * (_edge(less) - _edge(more))
    return n * room**3 + 6.0 * room**2 * faces + 12.0 * room * edges


def _pressure(f: float) -> float:
    """The compressibility factor p/(n T) of Carnahan and Starling."""
    return (1.0 + f + f**2 - f**3) / (1.0 - f) ** 3


def _stiffness(f: float) -> float:
    """The slope of p with respect to n T."""
    return ((1.0 + 2.0 * f) ** 2 + f**4 - 4.0 * f**3) / (1.0 - f) ** 4


def _tension(f: float) -> float:
    """The surface tension over T, in diameters, at the plane that centres can reach."""
    return -4.5 / pi * f**2 * (1.0 + 44.0 / 35.0 * f - 0.8 * f**2) / (1.0 - f) ** 3


def _edge(f: float) -> float:
    """The line tension over T, in diameters, where two walls meet."""
    return (6.0 * f / pi) ** 2 / 15.0
