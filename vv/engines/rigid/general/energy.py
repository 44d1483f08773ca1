"""Kernels for the energies of rigid blocks: kinetic energy, and the work of impulses in a step.

An impulse acts on the mean lever arms at the mean velocities of a step. Where a block turns about a
corner at rest, the velocity of that corner from these means is not quite zero, since the mean of
products is not the product of means. The work by this difference is a separate term of the ledger:
it is of second order, of either sign, and neither friction nor impact.
"""

from __future__ import annotations

from vv.engines.kernels.arrays import squares, zero_rows
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.drive import mean
from vv.engines.kernels.triples import Triple, add_scaled, at, cross, dot, put
from vv.engines.rigid.general.lever_arms import turned_back
from vv.engines.rigid.general.setting import Setting, State, wall_rates
from vv.engines.rigid.general.step import Trial
from vv.engines.rigid.general.turning import turned_inertia
from vv.engines.rigid.solver.assembly import Joints, relative
from vv.scene import Vector

ZERO = (0.0, 0.0, 0.0)
RUBBED, HIT, BASE, SHAKEN, DRIVEN, SHOVED, TURNED = range(7)


@lent
def add_work(
    account: Vector, joints: Joints, c: int, p: Triple, v: Vector, w: Vector, blocks: int,
    apart: Triple,
) -> None:  # fmt: skip
    """Add to account (7,) [J] the work of an impulse p at contact c at mean velocities v, w (b, 3).

    apart: the correction of the contact's velocity by `arm_covariance` [m/s].
    """
    n, u = at(joints.normal, c), add_scaled(relative(joints, c, v, w), 1.0, apart)
    account[TURNED] += dot(p, apart)
    normal = dot(p, n)
    account[HIT] -= normal * dot(u, n)
    account[RUBBED] -= dot(p, u) - normal * dot(u, n)
    if joints.first[c] >= blocks:
        account[BASE] += dot(p, at(v, joints.first[c]))


@lent
def arm_covariance(trial: Trial, c: int, gained: Vector) -> Triple:
    """The mean of spin x arm over a step minus the product of their means, at contact c [m/s].

    gained: (b, 3) [1/s], half the change of spins in the step; half the change of arms is that from
    mid-step to the end.
    """
    a, b = trial.joints.first[c], trial.joints.second[c]
    one = add_scaled(at(trial.joints.arm_first, c), -1.0, at(trial.middle.arm_first, c))
    two = add_scaled(at(trial.joints.arm_second, c), -1.0, at(trial.middle.arm_second, c))
    return add_scaled(cross(at(gained, b), two), -1.0, cross(at(gained, a), one))


@called
def add_works(
    account: Vector, setting: Setting, state: State, trial: Trial, now: float, span: float,
    impact: bool,
) -> None:  # fmt: skip
    """Add to account (7,) [J] the work of contacts, walls, shaking and forces in a step.

    In an impact, all energy lost in contacts counts as lost by impact: the slip of a
    corner may reverse within it, so that friction returns energy that the normal impulse has taken,
    and only their sum has a definite sign.
    """
    rubbed = account[RUBBED]
    n, b = len(setting.mass), len(trial.v)
    v_mid, w_mid, gained = zero_rows(b), zero_rows(b), zero_rows(b)
    wall_rates(setting, now, v_mid)
    for i in range(b):
        had = at(state.v, i) if i < n else at(v_mid, i)
        put(v_mid, i, add_scaled(add_scaled(ZERO, 0.5, had), 0.5, at(trial.v, i)))
        if i < n:
            put(w_mid, i, add_scaled(add_scaled(ZERO, 0.5, at(state.w, i)), 0.5, at(trial.w, i)))
            put(gained, i, add_scaled(at(trial.w, i), -1.0, at(w_mid, i)))
    for c in range(len(trial.p)):
        p = turned_back(trial.turn, c, at(trial.acted, c))
        add_work(account, trial.middle, c, p, v_mid, w_mid, n, arm_covariance(trial, c, gained))
        rest = add_scaled(at(trial.p, c), -1.0, at(trial.acted, c))
        add_work(account, trial.joints, c, rest, v_mid, w_mid, n, ZERO)
    if impact:
        account[HIT] += account[RUBBED] - rubbed
        account[RUBBED] = rubbed
    shake = mean(setting.shaking, now, span)
    for i in range(n):
        account[SHAKEN] += span * setting.mass[i] * dot(shake, at(v_mid, i))
        account[DRIVEN] += span * dot(at(setting.force, i), at(v_mid, i))


@called
def kinetic(setting: Setting, state: State) -> float:
    """The kinetic energy of all blocks [J]."""
    total, world = 0.0, squares(1)[0]
    for i in range(len(setting.mass)):
        total += 0.5 * setting.mass[i] * dot(at(state.v, i), at(state.v, i))
        turned_inertia(setting.inertia[i], state.rotation[i], world)
        for j in range(3):
            for k in range(3):
                total += 0.5 * state.w[i, j] * world[j, k] * state.w[i, k]
    return total
