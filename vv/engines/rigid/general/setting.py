"""What stays and what moves in a scene of rigid blocks, and where that goes without contact."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vv.engines.blocks.geometry import Index, Planes, Shapes
from vv.engines.kernels.arrays import larger, nil_rows, same_rows, smaller, squares
from vv.engines.kernels.bundles import bundle
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.drive import Drive, mean, one_of, rate, travel
from vv.engines.kernels.triples import add_scaled, at, dot, put
from vv.engines.rigid.general.turning import held_inverse, turn_by, turned_inertia
from vv.engines.rigid.limits import GENTLY, ROUNDED, SLOWLY
from vv.engines.rigid.solver.assembly import Joints, times
from vv.scene import Mask, Vector

NIL = (0.0, 0.0, 0.0)
FORECASTS = 3  # rounds in which free rotation keeps its moment of momentum


@bundle
class Setting(NamedTuple):
    """What stays: n blocks, w walls, b = n + w bodies.

    mass: (n,) [kg]; inertia: (n, 3, 3) in the starting pose [kg m2]; inverse: (b, 3, 3) [1/kg];
    hold_spin: (n, 3, 3) projectors; force: (n, 3) gravity and loads [N]; depth: (3,);
    moves: (n,); mu; slack [m]: gaps count from there on; step [s], of which trials may be parts;
    pull [m/s2]: see `vv.engines.rigid.scales`; tolerance, finest [m/s]: residuals asked at most and
    at least; sweeps to make, fewest and most; bends: rounds in which friction follows slip that
    turns; drives of the walls and where each begins (w + 1,); shaking.
    """

    shapes: Shapes
    planes: Planes
    depth: Vector
    moves: Mask
    mass: Vector
    inertia: Vector
    inverse: Vector
    hold_spin: Vector
    force: Vector
    mu: float
    slack: float
    step: float
    pull: float
    tolerance: float
    finest: float
    fewest: int
    most: int
    bends: int
    drives: Drive
    drive_start: Index
    shaking: Drive


@bundle
class State(NamedTuple):
    """centre (n, 3) [m], rotation (n, 3, 3), v, w (n, 3) [m/s, 1/s]."""

    centre: Vector
    rotation: Vector
    v: Vector
    w: Vector


@bundle
class Past(NamedTuple):
    """Contacts of the step before: key, force (k, 3) [N], and at its end joints and what stuck.

    What stuck has no direction of slip, though its arms have turned since.
    """

    key: Index
    force: Vector
    still: Mask
    joints: Joints


@called
def copied(state: State) -> State:
    """The state, in arrays of its own."""
    n = len(state.centre)
    rotation = squares(n)
    for i in range(n):
        for j in range(3):
            for k in range(3):
                rotation[i, j, k] = state.rotation[i, j, k]
    return State(same_rows(state.centre, n), rotation, same_rows(state.v, n), same_rows(state.w, n))


@called
def wall_rates(setting: Setting, time: float, v: Vector) -> None:
    """Write the velocities of the walls into the last rows of v (b, 3)."""
    n = len(setting.mass)
    for k in range(len(setting.planes.point)):
        put(v, n + k, rate(one_of(setting.drives, setting.drive_start, k), time))


@lent
def rates(setting: Setting, state: State, time: float, v: Vector, w: Vector) -> None:
    """Write the velocities of all bodies into v, w (b, 3); the spins of walls are left."""
    wall_rates(setting, time, v)
    for i in range(len(setting.mass)):
        put(v, i, at(state.v, i))
        put(w, i, at(state.w, i))


@called
def shift_at(setting: Setting, time: float) -> Vector:
    """The displacements (w, 3) of the walls [m]."""
    shift = nil_rows(len(setting.planes.point))
    for k in range(len(setting.planes.point)):
        put(shift, k, travel(one_of(setting.drives, setting.drive_start, k), time))
    return shift


@called
def forecast(
    setting: Setting, state: State, span: float, rotation: Vector, w: Vector, inverse: Vector
) -> None:
    """Fill rotation (n, 3, 3), w and inverse inertia (b, 3, 3) after a step without contact.

    The moment of momentum about free axes is kept.
    """
    world, start = squares(1)[0], squares(1)
    for i in range(len(setting.mass)):
        spin = at(state.w, i)
        turned_inertia(setting.inertia[i], state.rotation[i], start[0])
        moment = times(start, 0, spin)
        put(w, i, spin)
        rounds = FORECASTS if dot(spin, spin) > 0.0 else 1
        for _ in range(rounds):
            middle = add_scaled(add_scaled(NIL, 0.5 * span, spin), 0.5 * span, at(w, i))
            turn_by(middle, state.rotation[i], rotation[i])
            turned_inertia(setting.inertia[i], rotation[i], world)
            held_inverse(world, setting.hold_spin[i], inverse[i])
            if rounds > 1:
                put(w, i, times(inverse, i, moment))


@lent
def free_velocities(setting: Setting, state: State, now: float, span: float, v: Vector) -> None:
    """Fill v (b, 3) after a step without contact."""
    shake = mean(setting.shaking, now, span)
    for i in range(len(setting.mass)):
        f = add_scaled(at(setting.force, i), setting.mass[i], shake)
        gain = times(setting.inverse, i, f)
        put(v, i, add_scaled(at(state.v, i), span, gain))
    wall_rates(setting, now + span, v)


@called
def pace(setting: Setting, state: State, now: float, span: float) -> float:
    """A speed [m/s] that no point exceeds within a step."""
    fastest = 0.0
    for i in range(len(setting.mass)):
        speed = np.sqrt(dot(at(state.v, i), at(state.v, i)))
        spin = np.sqrt(dot(at(state.w, i), at(state.w, i)))
        push = np.sqrt(dot(at(setting.force, i), at(setting.force, i))) / setting.mass[i]
        fastest = larger(fastest, speed + spin * setting.shapes.size[i] + span * push)
    for k in range(len(setting.planes.point)):
        moving = rate(one_of(setting.drives, setting.drive_start, k), now)
        fastest = larger(fastest, np.sqrt(dot(moving, moving)))
    return fastest


@lent
def asked(setting: Setting, pace: float, apart: float) -> float:
    """The residual [m/s] asked of a step with these speeds [m/s], where contacts close.

    apart: the speed [m/s] that rounding of their gaps makes in the step.
    """
    rounding = larger(ROUNDED * pace, apart)
    return smaller(setting.tolerance, larger(setting.finest, rounding))


@lent
def felt(setting: Setting, dt: float) -> float:
    """A speed [m/s] whose loss in no time takes a blow."""
    return larger(SLOWLY * setting.pull * dt, GENTLY * setting.tolerance)
