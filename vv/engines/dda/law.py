"""The laws of one point of contact in an open-close iteration, for kernels."""

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
    way: Triple,
    kn: float,
    ks: float | None,
    mu: float | None,
    hold: float,
    ease: float,
    coulomb: bool,
) -> tuple[int, float, Triple]:
    """The state, normal force [N] and direction of friction that a solved step calls for.

    state, way: what was assumed; gap: at the end [m]; slip: tangential motion over the step [m];
    spring: shear stretch at its begin [m]. No tension; a spring that would exceed mu N slides.
    ease: stiffness [N/m] by which inertia resists the slip, which makes this a Newton step for a
    block on a plane. coulomb: whether friction is what `returned` says; if not, what `lagged` does.
    """
    if gap >= 0.0:
        return OPEN, 0.0, NOWHERE
    push = -kn * gap
    if mu is None or ks is None:
        return SLIDE, push, NOWHERE
    if coulomb:
        now, along = returned(state, mu * push, slip, spring, way, ks, ease)
    else:
        now, along = lagged(state, mu * push, slip, spring, way, ks, hold, ease)
    return now, push, along


@inlined
def lagged(
    state: int,
    cap: float,
    slip: Triple,
    spring: Triple,
    way: Triple,
    ks: float,
    hold: float,
    ease: float,
) -> tuple[int, Triple]:
    """The state and direction of friction, which is `cap` [N] at most and lags behind the slip.

    hold 1: springs bear friction while a contact slides, which sticks when they would exceed the
    cap no more. hold 0: they are let go, and a contact that slides back sticks. Friction next
    points against cap way + ease (slip + hold spring), which is the latter once converged.
    """
    trial = add_scaled(spring, 1.0, slip)
    stretch = np.sqrt(dot(trial, trial))
    if state != SLIDE and ks * stretch > cap:
        return SLIDE, add_scaled(NOWHERE, 1.0 / stretch, trial)
    sticks = ks * stretch <= cap if hold > 0.0 else dot(way, slip) < 0.0
    if state != SLIDE or sticks:
        return STICK, NOWHERE
    toward = add_scaled(add_scaled(NOWHERE, cap, way), ease, add_scaled(slip, hold, spring))
    length = np.sqrt(dot(toward, toward))
    return SLIDE, (add_scaled(NOWHERE, 1.0 / length, toward) if length > 0.0 else way)


@inlined
def returned(
    state: int, cap: float, slip: Triple, spring: Triple, way: Triple, ks: float, ease: float
) -> tuple[int, Triple]:
    """As `lagged` with hold 1, by Coulomb's law itself: what it calls for twice is its solution.

    The trial stretch spring + slip is brought back to cap/ks in its own direction (Simo and Hughes
    1998, Sec. 2.5). A contact slides only if it goes on along `way`, which `lagged` does not ask:
    a slip that friction has turned round would be one along which friction gives energy.
    """
    trial = add_scaled(spring, 1.0, slip)
    toward = trial
    if state == SLIDE:
        toward = add_scaled(add_scaled(NOWHERE, cap, way), ease, trial)
    length = np.sqrt(dot(toward, toward))
    if length == 0.0 or ks * dot(toward, trial) <= cap * length:
        return STICK, NOWHERE
    return SLIDE, add_scaled(NOWHERE, 1.0 / length, toward)
