"""The linear system for given states of all contacts: stiffness, Taylor maps and guards."""

from __future__ import annotations

import enum
import math
from dataclasses import dataclass

import numpy as np

from vv.engines.exact.system import System
from vv.scene import Vector

ORDER = 28  # of the Taylor series, whose terms fall like 2^k/k!: the last is 1e-21 of the state


class State(enum.Enum):
    """The state of a contact; STUCK is also the closed state of a contact without friction.

    PARTED: bodies still overlap, but the viscous force would pull and is zero.
    """

    OPEN = "open"
    PARTED = "parted"
    STUCK = "stuck"
    SLIP_FORWARD = "slips forward"
    SLIP_BACKWARD = "slips backward"

    @property
    def sign(self) -> int:
        """The direction of slip along the contact's tangent, 0 without slip."""
        return (self is State.SLIP_FORWARD) - (self is State.SLIP_BACKWARD)


States = tuple[State, ...]
WITHOUT_FORCE = frozenset({State.OPEN, State.PARTED})  # without force


@dataclass(frozen=True)
class Guard:
    """The contact that a guard watches, and its next state; None if the motion ends there.

    It ends where two centres coincide. Bonds are numbered after the contacts.
    """

    contact: int
    after: State | None


@dataclass(frozen=True, eq=False)
class Mode:
    """The linear system that holds while all contacts keep their states.

    drag: (n, n) [N s/m], forces are -drag @ v. h: step [s].

    lengths: (c + s + h,) gaps, and stretches of shear and bond springs [m]. The springs' forces
    are push @ lengths, (n, c + s + h) [N/m]. series: (ORDER n, 2n), from the first two Taylor
    coefficients of the displacements to those of order 1 to ORDER. Guards are positive:
    values @ lengths + offset, (g, c + s + h) and (g,), to which delay times the time derivative of
    values @ lengths is added, (g,) [s]; and rates @ (derivatives of the lengths), (r, c + s + h);
    guards: what these g + r rows watch.
    """

    states: States
    h: float
    push: Vector
    drag: Vector
    series: Vector
    values: Vector
    offset: Vector
    delay: Vector
    rates: Vector
    guards: tuple[Guard, ...]


def make_mode(system: System, states: States, longest: float) -> Mode:
    """The mode in which contacts are in these states; `longest` [s] bounds its step."""
    push = _push(system, states)
    drag = _drag(system, states)
    h = min(_step(system, push, drag), longest)
    pull = h * h / system.mass[:, None] * (push @ system.rows)
    series = _series(pull, h / system.mass[:, None] * drag)
    return Mode(states, h, push, drag, series, *_guards(system, states))


def quickest_step(system: System) -> float:
    """The step [s] while all contacts stick, the stiffest state; infinite without springs."""
    stuck = (State.STUCK,) * len(system.gap)
    return _step(system, _push(system, stuck), _drag(system, stuck))


def _step(system: System, push: Vector, drag: Vector) -> float:
    """The h [s] at which |K/m| h^2/4 + |D/m| h = 1 in the maximum norm, or infinity."""
    stiffness = np.abs(push @ system.rows).sum(axis=1) / system.mass
    slowing = float((np.abs(drag).sum(axis=1) / system.mass).max())
    rate = slowing + math.sqrt(slowing * slowing + float(stiffness.max()))
    return 2 / rate if rate > 0 else math.inf


def _push(system: System, states: States) -> Vector:
    """Forces on the unknowns per gap and per stretch: see Mode.

    The normal force is kn U, the shear force ks s while stuck and sigma mu kn U in slip.
    """
    count = len(states)
    push = np.zeros((len(system.mass), len(system.rows)))
    for c, state in enumerate(states):
        if state not in WITHOUT_FORCE:
            push[:, c] -= system.kn * system.normal[c]
    for s, c in enumerate(system.springs):
        if states[c] is State.STUCK:
            push[:, count + s] -= system.ks * system.tangent[s]
        else:
            push[:, c] += states[c].sign * system.mu * system.kn * system.tangent[s]
    push[:, count + len(system.springs) :] = (
        -system.bond_springs.stiffness * system.bond_springs.rows.T
    )
    return push


def _drag(system: System, states: States) -> Vector:
    """Drag of all unknowns and along the normals of closed contacts: see Mode."""
    drag = system.eta * np.eye(len(system.mass))
    if system.eta_n > 0:
        normal = system.normal[[state not in WITHOUT_FORCE for state in states]]
        drag += system.eta_n * normal.T @ normal
    return drag


def _series(pull: Vector, drag: Vector) -> Vector:
    """Taylor maps of y'' = pull y - drag y' + constant, in the scaled time of a step.

    The recurrence (k+1)(k+2) y[k+2] = pull y[k] - (k+1) drag y[k+1] holds from k = 1; the
    constant is in y[2].
    """
    n = len(pull)
    rows = np.zeros((ORDER, n, 2 * n))
    rows[0, :, :n] = rows[1, :, n:] = np.eye(n)
    last = ORDER - 1 if pull.any() or drag.any() else 1
    for k in range(1, last):
        turned = pull @ rows[k - 1] - (k + 1) * drag @ rows[k]
        rows[k + 1] = turned / ((k + 1) * (k + 2))
    return rows.reshape(ORDER * n, 2 * n)


Row = tuple[Guard, dict[int, float], float]  # what it watches, its entries and its offset
Guards = tuple[Vector, Vector, Vector, Vector, tuple[Guard, ...]]


def _guards(system: System, states: States) -> Guards:
    """The guards of a mode, all in metres and positive while it holds: see Mode.

    Open: the gap. Closed: the overlap U, and for two spheres the distance of their centres, as
    for a bond. Viscous: U + tau U' in place of U, tau = eta_n/kn, and its opposite once parted.
    Stuck: r U - s and r U + s for a stretch s, r = mu kn/ks. Slip along sigma: the rate
    sigma x' - r U' at which the contact slips, for a tangential travel x.
    """
    r = system.ratio
    spring = {c: len(states) + s for s, c in enumerate(system.springs)}
    values: list[Row] = []
    rates: list[Row] = []
    pushing: list[int] = []
    for c, state in enumerate(states):
        if state is State.OPEN:
            values.append((Guard(c, State.STUCK), {c: 1.0}, 0.0))
            continue
        if state is State.PARTED:
            pushing.append(len(values))
            values.append((Guard(c, State.STUCK), {c: 1.0}, 0.0))
        elif system.eta_n > 0:
            pushing.append(len(values))
            values.append((Guard(c, State.PARTED), {c: -1.0}, 0.0))
        if state is State.PARTED or not system.eta_n > 0:
            values.append((Guard(c, State.OPEN), {c: -1.0}, 0.0))
        if np.isfinite(system.depth[c]):
            values.append((Guard(c, None), {c: 1.0}, float(system.depth[c])))
        if c in spring and state is State.STUCK:
            values.append((Guard(c, State.SLIP_FORWARD), {c: -r, spring[c]: -1.0}, 0.0))
            values.append((Guard(c, State.SLIP_BACKWARD), {c: -r, spring[c]: 1.0}, 0.0))
        elif c in spring:
            rates.append((Guard(c, State.STUCK), {c: r, spring[c]: float(state.sign)}, 0.0))
    first = len(states) + len(spring)
    for b, length in enumerate(system.bond_springs.length.tolist()):
        values.append((Guard(len(states) + b, None), {first + b: 1.0}, length))
    width = len(system.rows)
    offset = np.array([row[2] for row in values])
    delay = np.zeros(len(values))
    delay[pushing] = system.eta_n / system.kn
    guards = tuple(row[0] for row in (*values, *rates))
    return _matrix(values, width), offset, delay, _matrix(rates, width), guards


def _matrix(rows: list[Row], width: int) -> Vector:
    matrix = np.zeros((len(rows), width))
    for line, (_, entries, _) in zip(matrix, rows, strict=True):
        for column, value in entries.items():
            line[column] = value
    return matrix
