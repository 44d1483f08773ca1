"""The constant data and the state of rigid blocks for kernels, and their motion without contact."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vv.engines.blocks.geometry import Index, Planes, Shapes
from vv.engines.kernels.arrays import larger, same_rows, smaller, squares, zero_rows
from vv.engines.kernels.bundles import bundle
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.drive import Drive, mean, one_of, rate, travel
from vv.engines.kernels.triples import add_scaled, at, dot, put
from vv.engines.rigid.general.turning import held_inverse, turn_by, turned_inertia
from vv.engines.rigid.limits import GENTLY, ROUNDED, SLOWLY
from vv.engines.rigid.solver.assembly import Joints, times
from vv.scene import Mask, Vector

ZERO = (0.0, 0.0, 0.0)
FORECASTS = 3  # iterations in which free rotation conserves its angular momentum


@bundle
class Setting(NamedTuple):
    """The constant data of a scene of n blocks and w walls, b = n + w bodies.

    mass: (n,) [kg]; inertia: (n, 3, 3) at t = 0 [kg m2]; inverse: (b, 3, 3) projected inverse
    masses [1/kg]; hold_spin: (n, 3, 3) projectors on free spins; force: (n, 3) gravity and loads
    [N]; depth: (3,) see `depth_axis`; moves: (n,); mu; slack [m]: smaller gaps count as zero;
    step [s], which trials may take in parts; pull, braking [m/s2]: see `vv.engines.rigid.scales`;
    tolerance, finest [m/s]: the largest and the smallest residual asked, the latter of many blocks
    in the first step if they start at rest; fewest, most: numbers of sweeps;
    bends: iterations in which friction follows the direction of slip; drives: motions of the
    walls, and drive_start (w + 1,), where that of each begins; shaking; solver: the address of the
    kernel that solves the contacts of many blocks; zero for few.
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
    braking: float
    tolerance: float
    finest: float
    fewest: int
    most: int
    bends: int
    drives: Drive
    drive_start: Index
    shaking: Drive
    solver: int


@bundle
class State(NamedTuple):
    """The state of n blocks: centre (n, 3) [m], rotation (n, 3, 3), v and w (n, 3) [m/s, 1/s].

    moved: (n, 3) displacements [m]. In weak fields they are so small that differences of centres
    would be mostly rounding.
    """

    centre: Vector
    moved: Vector
    rotation: Vector
    v: Vector
    w: Vector


@bundle
class Past(NamedTuple):
    """The k contacts of the step before.

    key: (k,); force: (k, 3) mean forces [N]; still: (k,) whether a contact stuck at the end of the
    step, so that it has no direction of slip now; joints: at the end of the step.
    """

    key: Index
    force: Vector
    still: Mask
    joints: Joints


@called
def copy_of(state: State) -> State:
    """A copy of the state."""
    n = len(state.centre)
    rotation = squares(n)
    for i in range(n):
        for j in range(3):
            for k in range(3):
                rotation[i, j, k] = state.rotation[i, j, k]
    centre, moved = same_rows(state.centre, n), same_rows(state.moved, n)
    return State(centre, moved, rotation, same_rows(state.v, n), same_rows(state.w, n))


@called
def wall_rates(setting: Setting, time: float, v: Vector) -> None:
    """Write the velocities of the walls at a time [s] into the last rows of v (b, 3)."""
    n = len(setting.mass)
    for k in range(len(setting.planes.point)):
        put(v, n + k, rate(one_of(setting.drives, setting.drive_start, k), time))


@lent
def rates(setting: Setting, state: State, time: float, v: Vector, w: Vector) -> None:
    """Write the velocities of all bodies and the spins of blocks into v, w (b, 3)."""
    wall_rates(setting, time, v)
    for i in range(len(setting.mass)):
        put(v, i, at(state.v, i))
        put(w, i, at(state.w, i))


@called
def shift_at(setting: Setting, time: float) -> Vector:
    """The displacements (w, 3) of the walls at a time [s], in m."""
    shift = zero_rows(len(setting.planes.point))
    for k in range(len(setting.planes.point)):
        put(shift, k, travel(one_of(setting.drives, setting.drive_start, k), time))
    return shift


@called
def forecast(
    setting: Setting, state: State, span: float, rotation: Vector, w: Vector, inverse: Vector
) -> None:
    """Fill rotation (n, 3, 3), w (b, 3) and inverse inertia (b, 3, 3) after a step without contact.

    The angular momentum about free axes is conserved.
    """
    world, start = squares(1)[0], squares(1)
    for i in range(len(setting.mass)):
        spin = at(state.w, i)
        turned_inertia(setting.inertia[i], state.rotation[i], start[0])
        moment = times(start, 0, spin)
        put(w, i, spin)
        rounds = FORECASTS if dot(spin, spin) > 0.0 else 1
        for _ in range(rounds):
            middle = add_scaled(add_scaled(ZERO, 0.5 * span, spin), 0.5 * span, at(w, i))
            turn_by(middle, state.rotation[i], rotation[i])
            turned_inertia(setting.inertia[i], rotation[i], world)
            held_inverse(world, setting.hold_spin[i], inverse[i])
            if rounds > 1:
                put(w, i, times(inverse, i, moment))


@lent
def free_velocities(setting: Setting, state: State, now: float, span: float, v: Vector) -> None:
    """Fill v (b, 3) with the velocities after a step without contact."""
    shake = mean(setting.shaking, now, span)
    for i in range(len(setting.mass)):
        f = add_scaled(at(setting.force, i), setting.mass[i], shake)
        gain = times(setting.inverse, i, f)
        put(v, i, add_scaled(at(state.v, i), span, gain))
    wall_rates(setting, now + span, v)


@called
def fastest_speed(setting: Setting, state: State, now: float, span: float) -> float:
    """An estimate of the largest speed of any point within a step [m/s]."""
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
def residual_asked(setting: Setting, fastest: float, apart: float) -> float:
    """The residual [m/s] asked of a step in which speeds are up to `fastest` [m/s].

    apart: the velocity [m/s] that corresponds to rounding of gaps that close in the step.
    """
    rounding = larger(ROUNDED * fastest, apart)
    return smaller(setting.tolerance, larger(setting.finest, rounding))


@lent
def least_impact_speed(setting: Setting, dt: float) -> float:
    """The least velocity [m/s] of a contact that closes by an impact."""
    return larger(SLOWLY * setting.pull * dt, GENTLY * setting.tolerance)
