"""What the reduced model of DDA knows of its block, and what changes as it moves."""

from __future__ import annotations

from typing import NamedTuple

from vv.engines.kernels.drive import Drive
from vv.engines.kernels.triples import Triple


class Steps(NamedTuple):
    """A row of results is `stride` steps of dt [s]; drives rest in the `settling` steps before."""

    stride: int
    dt: float
    settling: int


class Rule(NamedTuple):
    """When iterations end, what springs hold, what a step keeps of velocity and feels of shaking.

    tolerance, hold, felt: see `move_blocks`.
    """

    tolerance: float
    iterations: int
    hold: float
    dd: float
    felt: float


class Friction(NamedTuple):
    """The shear spring ks [N/m] of each point of contact, and the coefficient of friction."""

    ks: float
    mu: float


class Drives(NamedTuple):
    """What moves the base and shakes all bodies; what is not there has no sines."""

    base: Drive
    shaking: Drive


class Block(NamedTuple):
    """What is the same in all steps.

    points: how many points of contact share the load, each with a spring kn [N/m]; gravity, load,
    shaking: their parts along the free directions, which hold the normal and all motion of the
    base; borne: m gravity + load [N]; gap [m] at t = 0. A kernel is compiled for scenes without
    drives, since these cost a step 8 % where nothing moves.
    """

    mass: float
    points: int
    kn: float
    gravity: Triple
    load: Triple
    borne: Triple
    normal: Triple
    gap: float
    drives: Drives | None


class Motion(NamedTuple):
    """Displacement x [m], what its sums lost to rounding, velocity v, and the base's shift [m].

    Without what was lost, 1e5 steps would make 1e-12 of x.
    """

    x: Triple
    rounded: Triple
    v: Triple
    shift: Triple


class Contact(NamedTuple):
    """Of each point: its state, force [N], direction of friction and shear stretch [m]."""

    state: int
    push: float
    way: Triple
    spring: Triple
