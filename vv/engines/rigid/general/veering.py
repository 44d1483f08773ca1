"""Kernels that find for how long a slow slip keeps its direction within a step of rigid blocks."""

from __future__ import annotations

from vv.engines.blocks.contacts import Contacts
from vv.engines.kernels.arrays import smaller, square_of, zero_rows
from vv.engines.kernels.compiled import called
from vv.engines.kernels.triples import cross, dot
from vv.engines.rigid.general.bends import add_friction, flat, slips
from vv.engines.rigid.general.setting import Past, Setting, State, rates
from vv.engines.rigid.general.step import Trial, attempt
from vv.engines.rigid.limits import BRISK, LOITERS, VEERED
from vv.engines.rigid.solver.assembly import Bodies, Joints
from vv.engines.rigid.solver.problem import Friction
from vv.scene import Vector


@called
def time_of_even_slip(
    setting: Setting, state: State, past: Past, now: float, whole: float, dt: float,
    contacts: Contacts, trial: Trial,
) -> float:  # fmt: skip
    """The longest part [s] of a step, by halving, in which no slow slip turns (see `veers`).

    trial: that of the whole step. Where slip almost stops, its direction turns within a fraction of
    a step and friction changes the path.
    """
    v, w = zero_rows(len(trial.v)), zero_rows(len(trial.v))
    rates(setting, state, now, v, w)
    span = whole
    while span > BRISK * dt and veers(
        trial.joints, trial.bodies, trial.friction, trial.p, v, w, trial.v, trial.w
    ):
        span *= 0.5
        trial = attempt(setting, state, now, span, contacts, past, trial.gaps.slack)
    return span


@called
def veers(
    joints: Joints, bodies: Bodies, friction: Friction, p: Vector,
    v_old: Vector, w_old: Vector, v: Vector, w: Vector,
) -> bool:  # fmt: skip
    """Whether a slip turns in a step while it is so slow that friction changes it much.

    Impulses p lead from velocities v_old, w_old to v, w.
    """
    dv, dw = zero_rows(len(v)), zero_rows(len(w))
    add_friction(joints, bodies, friction, p, dv, dw)
    for c in range(len(p)):
        if not slips(joints, friction, p, c):
            continue
        before, after = flat(joints, c, v_old, w_old), flat(joints, c, v, w)
        out, pulled = cross(before, after), flat(joints, c, dv, dw)
        first, last = dot(before, before), dot(after, after)
        slow = smaller(first, last) < square_of(LOITERS) * dot(pulled, pulled)
        if slow and dot(out, out) > VEERED * first * last:
            return True
    return False
