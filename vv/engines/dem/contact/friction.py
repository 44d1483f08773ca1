"""The shear spring of a contact and its Coulomb cap, inlined into kernels."""

from __future__ import annotations

import math

from vv.engines.dem.contact.touch import Touch
from vv.engines.kernels.arrays import square_of
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, cross, dot

SMALL = 0.01  # an exponent below which 1/x - 1/x' would cancel


@inlined
def share_closed(overlap: float, opened: float) -> float:
    """The share of a step in which a contact was closed that has an overlap [m] at its end.

    Only then is the shear spring charged: a whole step would make the force first order in dt.
    """
    return 1.0 if overlap + opened >= 0.0 else -overlap / opened


@inlined
def slid(touch: Touch, dt: float) -> tuple[Triple, Triple]:
    """How far the surfaces slid while they touched in a step, and how much more than before [m]."""
    share = dt * share_closed(touch.overlap, touch.opened)
    m, relative, changed = touch.midway, touch.relative, touch.changed
    slide = add_scaled(NOWHERE, share, add_scaled(relative, -dot(m, relative), m))
    return slide, add_scaled(NOWHERE, share, add_scaled(changed, -dot(m, changed), m))


@inlined
def turned(s: Triple, n: Triple, angle: float) -> Triple:
    """s turned about n, to which it is perpendicular, by a small angle [rad]; keeps its length."""
    square = 0.25 * angle * angle
    cosine, sine = (1.0 - square) / (1.0 + square), angle / (1.0 + square)
    return add_scaled(add_scaled(NOWHERE, cosine, s), sine, cross(n, s))


@inlined
def rub(
    spring: Triple, touch: Touch, ks: float, caps: tuple[float, float], dt: float
) -> tuple[Triple, float]:
    """The shear force [N] after a step of dt [s], and the energy [J] that friction took in it.

    The arguments are those of `sheared`.
    """
    slide, change = slid(touch, dt)
    return sheared(spring, touch, slide, change, ks, caps)


@inlined
def sheared(
    spring: Triple,
    touch: Touch,
    slide: Triple,
    change: Triple,
    ks: float,
    caps: tuple[float, float],
) -> tuple[Triple, float]:
    """The shear force [N] after a step, and the energy [J] that friction took in it.

    spring, slide, ks: as for `tried`; caps: mu Fn [N] before and after the step; change: slide
    less that of the step before.
    """
    old, slide, trial = tried(spring, touch, slide, ks)
    if dot(trial, trial) <= caps[1] * caps[1]:
        return trial, 0.0
    return slipped(old, trial, slide, change, ks, caps)


@inlined
def tried(spring: Triple, touch: Touch, slide: Triple, ks: float) -> tuple[Triple, Triple, Triple]:
    """The shear force [N] before a step, turned, the slide [m], and the force if nothing slips.

    spring: the force before. It turns with the contact plane from n_before to n and by the twist
    about n, both exactly. Then it grows by -ks times the slide in the plane, up to the cap mu Fn
    (Li 2018, Eqs. 5-8, with the sign that Eq. 8 leaves out).
    """
    n, n_before = touch.n, touch.n_before
    old = add_scaled(
        spring, -dot(n, spring) / (1.0 + dot(n, n_before)), add_scaled(n, 1.0, n_before)
    )
    old, slide = twisted(old, slide, n, touch.twist)
    slide = add_scaled(slide, -dot(n, slide), n)
    return old, slide, add_scaled(old, -ks, slide)


@inlined
def slipped(
    old: Triple,
    trial: Triple,
    slide: Triple,
    change: Triple,
    ks: float,
    caps: tuple[float, float],
) -> tuple[Triple, float]:
    """The shear force of a contact that slips, and the energy that friction took."""
    turn = turns(slide, ks, caps)
    return turned_by_slip(old, trial, slide, change, ks, caps, turn, math.exp(-turn))


@inlined
def turns(slide: Triple, ks: float, caps: tuple[float, float]) -> float:
    """x = ks |s| dt/cap, by which `slipping` turns a force."""
    return 2.0 * ks * math.sqrt(dot(slide, slide)) / (caps[0] + caps[1])


@inlined
def turned_by_slip(
    old: Triple,
    trial: Triple,
    slide: Triple,
    change: Triple,
    ks: float,
    caps: tuple[float, float],
    x: float,
    fading: float,
) -> tuple[Triple, float]:
    """As `slipped`, with x of `turns` and exp(-x).

    The energy is the slip, which is the slide without its elastic part, times the mean of the old
    and the new force. Where the slide turns back, what `slipping` says would give energy: then the
    force is along the trial force, which takes some whenever the old force is below the cap, too.
    """
    new, taken = capped(
        old, slipping(old, trial, slide, change, caps, x, fading), slide, ks, caps[1]
    )
    other, lost = capped(old, trial, slide, ks, caps[1])
    return (new, taken) if taken >= 0.0 else (other, lost)


@inlined
def twisted(old: Triple, slide: Triple, n: Triple, twist: float | None) -> tuple[Triple, Triple]:
    """A force turned about n by a twist, if anything turns, and a slide that charges it."""
    if twist is None:
        return old, slide
    return turned(old, n, twist), add_scaled(slide, 0.5 * twist, cross(n, slide))


@inlined
def capped(old: Triple, pull: Triple, slide: Triple, ks: float, cap: float) -> tuple[Triple, float]:
    """The force along `pull` at the cap, and the energy that friction took to bring it there."""
    new = add_scaled(NOWHERE, cap / math.sqrt(dot(pull, pull)), pull)
    slip = add_scaled(slide, 1.0 / ks, add_scaled(new, -1.0, old))
    return new, -0.5 * dot(add_scaled(old, 1.0, new), slip)


@inlined
def slipping(
    old: Triple,
    trial: Triple,
    slide: Triple,
    change: Triple,
    caps: tuple[float, float],
    x: float,
    fading: float,
) -> Triple:
    """A vector along the force of a slipping contact after a step.

    A contact that slips turns its force: with the angle t between the force and minus the rate
    of slide s, t' = -(ks |s|/cap) sin t, so that tan(t/2) falls by E = exp(-x) in a step with
    x = ks |s| dt/cap. The trial force obeys this to first order only. Exact for a steady
    direction d = -s/|s| is the direction of 2 E f + (1 - E^2 + cos t (1 - E)^2) d, f = F/|F|
    (Krieg and Krieg 1977, for plasticity). Where s turns, d is taken at the moment that has the
    effect of the whole step: coth(x/2)/2 - 1/x steps after its middle.
    """
    moved = dot(slide, slide)
    if moved == 0.0 or dot(old, trial) <= 0.0:
        return trial
    late = 0.5 * (1.0 + fading) / (1.0 - fading) - 1.0 / x if x > SMALL else x / 12.0
    across = add_scaled(change, -dot(change, slide) / moved, slide)
    aim = add_scaled(slide, late, across)
    longer, size = math.sqrt(dot(aim, aim)), math.sqrt(dot(old, old))
    cosine = -dot(old, aim) / (longer * size)
    # a force that has not reached the cap yet counts for less than one that turns at the cap
    kept = 2.0 * fading / (caps[0] if cosine > 0.0 else size)
    gained = 1.0 - fading * fading + cosine * square_of(1.0 - fading)
    return add_scaled(add_scaled(NOWHERE, kept, old), -gained / longer, aim)
