"""Tangential spring of a contact with Coulomb friction; the functions are inlined into kernels."""

from __future__ import annotations

import math

from vv.engines.dem.contact.touch import Touch
from vv.engines.kernels.arrays import square_of
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, cross, dot

SMALL = 0.01  # below this x, coth(x/2)/2 - 1/x loses digits, and its series is used


@inlined
def share_closed(overlap: float, opened: float) -> float:
    """The fraction of a step in which a contact was closed that has an overlap [m] at its end.

    The tangential spring is charged only in this fraction: charged over the whole step, the force
    would be of first order in dt.
    """
    return 1.0 if overlap + opened >= 0.0 else -overlap / opened


@inlined
def slide_in_step(touch: Touch, dt: float) -> tuple[Triple, Triple]:
    """The slide [m] in the closed part of a step, and its change since the previous step [m]."""
    share = dt * share_closed(touch.overlap, touch.opened)
    m, relative, changed = touch.midway, touch.relative, touch.changed
    slide = add_scaled(NOWHERE, share, add_scaled(relative, -dot(m, relative), m))
    return slide, add_scaled(NOWHERE, share, add_scaled(changed, -dot(m, changed), m))


@inlined
def rotated(s: Triple, n: Triple, angle: float) -> Triple:
    """The vector s, perpendicular to n, rotated about n by a small angle [rad].

    The length of s is preserved exactly.
    """
    square = 0.25 * angle * angle
    cosine, sine = (1.0 - square) / (1.0 + square), angle / (1.0 + square)
    return add_scaled(add_scaled(NOWHERE, cosine, s), sine, cross(n, s))


@inlined
def shear_force(
    spring: Triple, touch: Touch, ks: float, caps: tuple[float, float], dt: float
) -> tuple[Triple, float]:
    """The tangential force [N] after a step of dt [s], and the energy [J] dissipated by friction.

    Arguments as for `shear_force_after`.
    """
    slide, change = slide_in_step(touch, dt)
    return shear_force_after(spring, touch, slide, change, ks, caps)


@inlined
def shear_force_after(
    spring: Triple,
    touch: Touch,
    slide: Triple,
    change: Triple,
    ks: float,
    caps: tuple[float, float],
) -> tuple[Triple, float]:
    """The tangential force [N] after a step, and the energy [J] dissipated by friction in the step.

    spring, slide, ks: as for `trial_force`; caps: the Coulomb limits mu Fn [N] before and after the
    step; change: slide minus that of the previous step [m].
    """
    old, slide, trial = trial_force(spring, touch, slide, ks)
    if dot(trial, trial) <= caps[1] * caps[1]:
        return trial, 0.0
    return slip_force(old, trial, slide, change, ks, caps)


@inlined
def trial_force(
    spring: Triple, touch: Touch, slide: Triple, ks: float
) -> tuple[Triple, Triple, Triple]:
    """The old tangential force rotated [N], the slide in the new plane [m], the trial force [N].

    spring: the tangential force before the step. It rotates with the contact plane from n_before to
    n, and by the twist about n, both exactly. The trial force adds -ks times the slide in the
    plane; it is the new force unless it exceeds the limit mu Fn (Li 2018, Eqs. 5-8, with the sign
    that Eq. 8 leaves out).
    """
    n, n_before = touch.n, touch.n_before
    old = add_scaled(
        spring, -dot(n, spring) / (1.0 + dot(n, n_before)), add_scaled(n, 1.0, n_before)
    )
    old, slide = twist_both(old, slide, n, touch.twist)
    slide = add_scaled(slide, -dot(n, slide), n)
    return old, slide, add_scaled(old, -ks, slide)


@inlined
def slip_force(
    old: Triple,
    trial: Triple,
    slide: Triple,
    change: Triple,
    ks: float,
    caps: tuple[float, float],
) -> tuple[Triple, float]:
    """The tangential force [N] of a slipping contact, and the energy [J] dissipated by friction."""
    turn = slip_number(slide, ks, caps)
    return slip_force_with(old, trial, slide, change, ks, caps, turn, math.exp(-turn))


@inlined
def slip_number(slide: Triple, ks: float, caps: tuple[float, float]) -> float:
    """The dimensionless slip x = ks |s| dt/cap, which determines how far a force rotates."""
    return 2.0 * ks * math.sqrt(dot(slide, slide)) / (caps[0] + caps[1])


@inlined
def slip_force_with(
    old: Triple,
    trial: Triple,
    slide: Triple,
    change: Triple,
    ks: float,
    caps: tuple[float, float],
    x: float,
    fading: float,
) -> tuple[Triple, float]:
    """As `slip_force`, with x from `slip_number` and fading = exp(-x) given.

    The dissipated energy is the slip (the slide minus its elastic part) times the mean of the old
    and the new force. Where the slide reverses, the direction from `slip_direction` could make this
    negative. Then the new force is taken along the trial force, which dissipates energy also where
    the old force is below the limit after the step. If it is above that limit, since the contact
    opens, and the trial force points against it, the mean force is along the slip for any new force
    within the limit: the energy is then negative, by at most mu kn (v dt)^2/8.
    """
    new, taken = at_limit(
        old, slip_direction(old, trial, slide, change, caps, x, fading), slide, ks, caps[1]
    )
    other, lost = at_limit(old, trial, slide, ks, caps[1])
    return (new, taken) if taken >= 0.0 else (other, lost)


@inlined
def twist_both(old: Triple, slide: Triple, n: Triple, twist: float | None) -> tuple[Triple, Triple]:
    """The force rotated about n by the twist, and the slide rotated by half of it.

    Both are returned unchanged where no sphere rotates.
    """
    if twist is None:
        return old, slide
    return rotated(old, n, twist), add_scaled(slide, 0.5 * twist, cross(n, slide))


@inlined
def at_limit(
    old: Triple, pull: Triple, slide: Triple, ks: float, cap: float
) -> tuple[Triple, float]:
    """The force of size `cap` [N] in the direction of `pull`, and the energy [J] dissipated."""
    new = add_scaled(NOWHERE, cap / math.sqrt(dot(pull, pull)), pull)
    slip = add_scaled(slide, 1.0 / ks, add_scaled(new, -1.0, old))
    return new, -0.5 * dot(add_scaled(old, 1.0, new), slip)


@inlined
def slip_direction(
    old: Triple,
    trial: Triple,
    slide: Triple,
    change: Triple,
    caps: tuple[float, float],
    x: float,
    fading: float,
) -> Triple:
    """A vector in the direction of the tangential force of a slipping contact after a step.

    Slip rotates the force: the angle t between the force and minus the sliding velocity s obeys t'
    = -(ks |s|/cap) sin t, so that a step multiplies tan(t/2) by E = exp(-x), x = ks |s| dt/cap. The
    trial force obeys this to first order only. For a constant direction d = -s/|s|, the exact new
    direction is that of 2 E f + (1 - E^2 + cos t (1 - E)^2) d, f = F/|F| (Krieg and Krieg 1977, for
    plasticity). Where s rotates, d is evaluated coth(x/2)/2 - 1/x steps after the middle of the
    step, which gives the effect of the whole step to second order.
    """
    moved = dot(slide, slide)
    if moved == 0.0 or dot(old, trial) <= 0.0:
        return trial
    late = 0.5 * (1.0 + fading) / (1.0 - fading) - 1.0 / x if x > SMALL else x / 12.0
    across = add_scaled(change, -dot(change, slide) / moved, slide)
    aim = add_scaled(slide, late, across)
    longer, size = math.sqrt(dot(aim, aim)), math.sqrt(dot(old, old))
    cosine = -dot(old, aim) / (longer * size)
    # an old force that is still below the limit gets less weight than one at the limit
    kept = 2.0 * fading / (caps[0] if cosine > 0.0 else size)
    gained = 1.0 - fading * fading + cosine * square_of(1.0 - fading)
    return add_scaled(add_scaled(NOWHERE, kept, old), -gained / longer, aim)
