"""The data of the reduced model of DDA, and its state that changes from step to step."""

from __future__ import annotations

from typing import NamedTuple

from vv.engines.kernels.drive import Drive
from vv.engines.kernels.triples import Triple


class Rule(NamedTuple):
    """The choices of the formulation that the kernel needs.

    tolerance, iterations, dd, shaking_at: see `Formulation`; hold: 1 where its `charged` is true,
    else 0.
    """

    tolerance: float
    iterations: int
    hold: float
    dd: float
    shaking_at: float


class Friction(NamedTuple):
    """The shear spring ks [N/m] of each point of contact, and the coefficient of friction."""

    ks: float
    mu: float


class Drives(NamedTuple):
    """The motion of the wall and the shaking; a motion that is absent has no sines.

    most: an upper bound of the acceleration of the wall [m/s2].
    """

    base: Drive
    shaking: Drive
    most: float


class Block(NamedTuple):
    """The data that are the same in all steps.

    points: how many contact points share the load, each with a spring kn [N/m]; gravity, load,
    shaking: components in the free directions, which contain the normal and the motion of the wall;
    constant_load: m gravity + load [N]; gap [m] at t = 0. drives is None if nothing is driven, for
    which a kernel is compiled: drives at rest would cost 8 % of a step.
    """

    mass: float
    points: int
    kn: float
    gravity: Triple
    load: Triple
    constant_load: Triple
    normal: Triple
    gap: float
    drives: Drives | None


class Motion(NamedTuple):
    """Displacement x, its rounding error, the displacement of the wall [m], and velocity v [m/s].

    Without the rounding error, 1e5 steps would add up to 1e-12 of x.
    """

    x: Triple
    rounded: Triple
    v: Triple
    shift: Triple


class Contact(NamedTuple):
    """The state, the normal force [N], the direction that friction opposes, and the stretch [m]."""

    state: int
    push: float
    direction: Triple
    spring: Triple
