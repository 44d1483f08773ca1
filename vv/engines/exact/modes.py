"""Kernels of the linear equations of motion that hold while no contact changes its state."""

from __future__ import annotations

import enum
import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from vv.engines.kernels.bundles import bundle
from vv.engines.kernels.compiled import lent
from vv.scene import Vector

Index = npt.NDArray[np.int64]
OPEN, PARTED, STUCK, FORWARD, BACKWARD = range(5)


class State(enum.Enum):
    """The state of a contact; STUCK is also the closed state of a contact without friction.

    PARTED: the bodies still overlap, but the normal force is zero, since with viscosity it would
    be tensile. Kernels use the place of a state in this order as its number.
    """

    OPEN = "open"
    PARTED = "parted"
    STUCK = "stuck"
    SLIP_FORWARD = "slips forward"
    SLIP_BACKWARD = "slips backward"

    @property
    def sign(self) -> int:
        """The sign of slip along the contact's tangent, 0 without slip."""
        return (self is State.SLIP_FORWARD) - (self is State.SLIP_BACKWARD)


States = tuple[State, ...]
STATES: States = tuple(State)
WITHOUT_FORCE = frozenset({State.OPEN, State.PARTED})


@bundle
class Equations(NamedTuple):
    """A System in the form that kernels use: n unknowns, c contacts, s shear and h bond springs.

    mass (n,) [kg]; load (n,): weights and loads [N]; normal (c, n), tangent (s, n), tied (h, n):
    rows from unknowns to gaps and to stretches of shear and bond springs; spring (c,): the shear
    spring of a contact, or -1; depth (c,) [m]; length (b,) of bonds [m]; stiffness (h,) of bond
    springs [N/m]. kn, ks [N/m]; mu; ratio mu kn/ks; eta, eta_n [N s/m].
    """

    mass: Vector
    load: Vector
    normal: Vector
    tangent: Vector
    tied: Vector
    spring: Index
    depth: Vector
    length: Vector
    stiffness: Vector
    kn: float
    ks: float
    mu: float
    ratio: float
    eta: float
    eta_n: float


@lent
def sign_of(state: int) -> float:
    """The sign of slip along a contact's tangent, 0 without slip."""
    return 1.0 if state == FORWARD else -1.0 if state == BACKWARD else 0.0


@lent
def press(equations: Equations, states: Index, lengths: Vector, force: Vector) -> None:
    """Fill force (n,) [N] with the spring forces at given gaps and stretches (c + s + h,) [m].

    The normal force is kn U, the shear force ks s in a stuck contact and sigma mu kn U in slip.
    """
    count, first = len(equations.normal), len(equations.normal) + len(equations.tangent)
    force[:] = 0.0
    for c in range(count):
        if states[c] > PARTED:
            _add(force, -equations.kn * lengths[c], equations.normal, c)
            s = equations.spring[c]
            if s >= 0 and states[c] == STUCK:
                _add(force, -equations.ks * lengths[count + s], equations.tangent, s)
            elif s >= 0:
                part = sign_of(states[c]) * equations.mu * equations.kn * lengths[c]
                _add(force, part, equations.tangent, s)
    for b in range(len(equations.tied)):
        _add(force, -equations.stiffness[b] * lengths[first + b], equations.tied, b)


@lent
def slow(equations: Equations, states: Index, velocity: Vector, force: Vector) -> None:
    """Fill force (n,) [N] with the drag and viscous contact forces at a velocity (n,) [m/s]."""
    for a in range(len(force)):
        force[a] = equations.eta * velocity[a]
    if equations.eta_n > 0:
        for c in range(len(equations.normal)):
            if states[c] > PARTED:
                closing = _along(equations.normal, c, velocity)
                _add(force, equations.eta_n * closing, equations.normal, c)


@lent
def stretch(equations: Equations, moved: Vector, lengths: Vector) -> None:
    """Fill lengths (c + s + h,) with the changes of gaps and stretches by a displacement (n,)."""
    count, first = len(equations.normal), len(equations.normal) + len(equations.tangent)
    for c in range(count):
        lengths[c] = _along(equations.normal, c, moved)
    for s in range(len(equations.tangent)):
        lengths[count + s] = _along(equations.tangent, s, moved)
    for b in range(len(equations.tied)):
        lengths[first + b] = _along(equations.tied, b, moved)


@lent
def step(equations: Equations, states: Index, stiff: Vector, drag: Vector) -> float:
    """The step h [s] at which |K/m| h^2/4 + |D/m| h = 1 in the maximum norm, or infinity.

    stiff, drag: (n, n), overwritten by K [N/m] and D [N s/m].
    """
    stiff[:, :] = 0.0
    drag[:, :] = 0.0
    for c in range(len(equations.normal)):
        if states[c] > PARTED:
            _add_product(stiff, equations.kn, equations.normal, c, equations.normal, c)
            _add_product(drag, equations.eta_n, equations.normal, c, equations.normal, c)
            s = equations.spring[c]
            if s >= 0 and states[c] == STUCK:
                _add_product(stiff, equations.ks, equations.tangent, s, equations.tangent, s)
            elif s >= 0:
                part = -sign_of(states[c]) * equations.mu * equations.kn
                _add_product(stiff, part, equations.tangent, s, equations.normal, c)
    for b in range(len(equations.tied)):
        _add_product(stiff, equations.stiffness[b], equations.tied, b, equations.tied, b)
    stiffest = slowest = 0.0
    for a in range(len(equations.mass)):
        drag[a, a] += equations.eta
        pulls = slows = 0.0
        for b in range(len(equations.mass)):
            pulls += abs(stiff[a, b])
            slows += abs(drag[a, b])
        stiffest = max(stiffest, pulls / equations.mass[a])
        slowest = max(slowest, slows / equations.mass[a])
    rate = slowest + math.sqrt(slowest * slowest + stiffest)
    return 2 / rate if rate > 0 else math.inf


@lent
def _add(force: Vector, part: float, rows: Vector, row: int) -> None:
    for a in range(len(force)):
        force[a] += part * rows[row, a]


@lent
def _along(rows: Vector, row: int, vector: Vector) -> float:
    total = 0.0
    for a in range(len(vector)):
        total += rows[row, a] * vector[a]
    return total


@lent
def _add_product(matrix: Vector, part: float, left: Vector, i: int, right: Vector, j: int) -> None:
    for a in range(len(matrix)):
        for b in range(len(matrix)):
            matrix[a, b] += part * left[i, a] * right[j, b]
