"""The laws of one contact point in an open-close iteration, for kernels."""

from __future__ import annotations

import numpy as np

from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, dot

OPEN, STICK, SLIDE = 0, 1, 2


@inlined
def respond(
    state: int,
    gap: float,
    slip: Triple,
    spring: Triple,
    direction: Triple,
    kn: float,
    ks: float | None,
    mu: float | None,
    hold: float,
    ease: float,
    coulomb: bool,
) -> tuple[int, float, Triple]:
    """The state, the normal force [N] and the direction of friction that a solved step calls for.

    Friction acts opposite to that direction. state, direction: the assumed state and direction;
    gap: at the end [m]; slip: tangential displacement in the step [m]; spring: tangential stretch
    at its beginning [m]. There is no tension; a contact slides if its spring would exceed mu N.
    ease: the stiffness [N/m] by which inertia resists slip, with which this is Newton's iteration
    for a block on a plane. coulomb: whether friction follows `return_mapping`, otherwise
    `lagged_friction`.
    """
    if gap >= 0.0:
        return OPEN, 0.0, NOWHERE
    push = -kn * gap
    if mu is None or ks is None:
        return SLIDE, push, NOWHERE
    if coulomb:
        now, along = return_mapping(state, mu * push, slip, spring, direction, ks, ease)
    else:
        now, along = lagged_friction(state, mu * push, slip, spring, direction, ks, hold, ease)
    return now, push, along


@inlined
def lagged_friction(
    state: int,
    cap: float,
    slip: Triple,
    spring: Triple,
    direction: Triple,
    ks: float,
    hold: float,
    ease: float,
) -> tuple[int, Triple]:
    """The state and the direction of friction, with a limit `cap` [N] that lags by an iteration.

    hold 1: springs carry friction while a contact slides; it sticks when they no longer exceed cap.
    hold 0: they are reset; a contact sticks when it slides back. The next direction is that of cap
    direction + ease (slip + hold spring), which in a converged step is that of its second part.
    """
    trial = add_scaled(spring, 1.0, slip)
    stretch = np.sqrt(dot(trial, trial))
    if state != SLIDE and ks * stretch > cap:
        return SLIDE, add_scaled(NOWHERE, 1.0 / stretch, trial)
    sticks = ks * stretch <= cap if hold > 0.0 else dot(direction, slip) < 0.0
    if state != SLIDE or sticks:
        return STICK, NOWHERE
    toward = add_scaled(add_scaled(NOWHERE, cap, direction), ease, add_scaled(slip, hold, spring))
    length = np.sqrt(dot(toward, toward))
    return SLIDE, (add_scaled(NOWHERE, 1.0 / length, toward) if length > 0.0 else direction)


@inlined
def return_mapping(
    state: int, cap: float, slip: Triple, spring: Triple, direction: Triple, ks: float, ease: float
) -> tuple[int, Triple]:
    """As `lagged_friction` with hold 1, but by Coulomb's law: a repeated state is a solution.

    The trial stretch spring + slip is returned to cap/ks in its own direction (Simo and Hughes
    1998, Sec. 2.5). A contact slides only if it goes on along `direction`, which `lagged_friction`
    does not require: along a slip that friction itself has reversed, friction would create energy.
    """
    trial = add_scaled(spring, 1.0, slip)
    toward = trial
    if state == SLIDE:
        toward = add_scaled(add_scaled(NOWHERE, cap, direction), ease, trial)
    length = np.sqrt(dot(toward, toward))
    if length == 0.0 or ks * dot(toward, trial) <= cap * length:
        return STICK, NOWHERE
    return SLIDE, add_scaled(NOWHERE, 1.0 / length, toward)


@inlined
def share_to_stop(start: float, slip: float) -> float:
    """The fraction of a step after which a slide stops, 1 if it goes on.

    start: its velocity at the beginning times the step [m]; slip: what it covers [m]. Velocity at
    the end is 2 slip - start over the step; a slide that is then reversed slowed down evenly. Where
    the contact sticks, this is a first guess.
    """
    if start > 0.0 and slip < 0.5 * start:
        return 0.5 * start / (start - slip)
    return 1.0
