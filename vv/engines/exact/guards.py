"""Finds the first event in a step, where a guard that is positive until then falls to zero."""

from __future__ import annotations

import math

from vv.engines.exact.modes import (
    BACKWARD,
    FORWARD,
    OPEN,
    PARTED,
    STUCK,
    Equations,
    Index,
    sign_of,
)
from vv.engines.exact.roots import EPS, first_descent
from vv.engines.kernels.compiled import lent
from vv.scene import Vector

GUARD_ROUNDING = 512 * EPS  # a guard below zero by less than this part of its lengths is zero
MET, NONE = -1, -2  # in place of a state: the centres meet, where the motion ends; no change


@lent
def next_event(  # noqa: PLR0912 - a branch per guard
    equations: Equations,
    states: Index,
    lengths: Vector,
    sizes: Vector,
    rates: Vector,
    h: float,
    end: float,
    work: Vector,
) -> tuple[int, int, float]:
    """The contact that changes first, its next state, and the part x of the step until then.

    lengths (c + s + h, ORDER + 1): series of gaps and stretches in the step of h [s]; sizes,
    rates (c + s + h,): scales of their rounding and of that of their rates [m]; work:
    (ORDER + 1,). Without a change the state is NONE and x is `end`. Bonds are numbered after
    the contacts.

    The guards [m]. Open contact: the gap. Closed contact: the overlap U and, for two spheres and
    for a bond, the distance of the centres. Viscous contact: U + tau U', tau = eta_n/kn, in place
    of U, and its opposite once parted. Stuck contact: r U - s and r U + s for a stretch s, r = mu
    kn/ks. Slip along sigma: the rate sigma x' - r U' of slip, for a tangential travel x. It is one
    function since it is one table of guards, read in the order of states.
    """
    found, after = 0, NONE
    count, r = len(states), equations.ratio
    first, delay = count + len(equations.tangent), equations.eta_n / equations.kn / h
    for c in range(count):
        state, spring = states[c], equations.spring[c]
        s = count + spring if spring >= 0 else c
        for guard in range(4):
            one, other, offset, part, pace, then = 0.0, 0.0, 0.0, 1.0, 0.0, NONE
            if guard == 0:
                if state == OPEN:
                    one, then = 1.0, STUCK
                elif state == PARTED:
                    one, pace, then = 1.0, delay, STUCK
                elif equations.eta_n > 0:
                    one, pace, then = -1.0, delay, PARTED
                else:
                    one, then = -1.0, OPEN
            elif state == OPEN:
                break
            elif guard == 1 and state == PARTED:
                one, then = -1.0, OPEN
            elif guard == 2 and math.isfinite(equations.depth[c]):
                one, offset, then = 1.0, equations.depth[c], MET
            elif guard == 1 and spring >= 0 and state == STUCK:
                one, other, then = -r, -1.0, FORWARD
            elif guard == 3 and spring >= 0 and state == STUCK:
                one, other, then = -r, 1.0, BACKWARD
            elif guard == 3 and spring >= 0:
                one, other, part, pace, then = r, sign_of(state), 0.0, 1.0, STUCK
            if then != NONE:
                fall = _fall(lengths, sizes, rates, c, one, s, other, offset, part, pace, end, work)
                if fall <= end:
                    found, after, end = c, then, fall
    for b in range(len(equations.length)):
        k = first + b
        offset = equations.length[b]
        fall = _fall(lengths, sizes, rates, k, 1.0, k, 0.0, offset, 1.0, 0.0, end, work)
        if fall <= end:
            found, after, end = count + b, MET, fall
    return found, after, end


@lent
def _fall(
    lengths: Vector,
    sizes: Vector,
    rates: Vector,
    c: int,
    one: float,
    s: int,
    other: float,
    offset: float,
    part: float,
    pace: float,
    end: float,
    work: Vector,
) -> float:
    """Where part (y + offset) + pace y' first falls below zero in [0, end], or a larger number.

    y = one length[c] + other length[s].
    """
    last = len(work) - 1
    rest = 0.0
    for k in range(last + 1):
        work[k] = part * (one * lengths[c, k] + other * lengths[s, k])
        if pace > 0 and k < last:
            rate = one * lengths[c, k + 1] + other * lengths[s, k + 1]
            work[k] += pace * (k + 1) * rate
    work[0] += part * offset
    for k in range(1, last + 1):
        rest += abs(work[k])
    band = part * (abs(one) * sizes[c] + abs(other) * sizes[s])
    band = GUARD_ROUNDING * (band + pace * (abs(one) * rates[c] + abs(other) * rates[s]))
    if rest <= work[0] + band:
        return 1e300
    return first_descent(work, band, end)
