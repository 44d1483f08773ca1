"""How a block on a slope begins to move: the chart of modes, and the acceleration in each.

psi is the angle of the slope plus the angle between the vertical and the resultant of the weight
and a horizontal force, phi the friction angle, and tan(delta) = b/h for the half sides b along the
slope and h across it [any unit of length]. All accelerations are divided by the acceleration g' due
to the resultant. With mu = tan(phi), k^2 = (b^2 + h^2)/3 and the vector r = (h, b) from the lower
edge to the centre, down the slope and out of it, the acceleration a of the centre and
the normal force n per mass are

slides                 a = (sin psi - mu cos psi, 0)
topples                a = q (h, b), q = (h sin psi - b cos psi)/(4 k^2)
slides and topples     n = cos psi/(1 - (mu h - b) b/k^2), q = (mu h - b) n/k^2,
                       a = (sin psi - mu n, n - cos psi)

The block slides for phi < psi and phi <= delta, topples for psi > delta and phi >= phi_c, does both
for psi > delta and delta < phi < phi_c, and stays otherwise; at phi = phi_c toppling alone needs
exactly the available friction (Hoek and Bray, with the borders of Yeung 1991 and of Yagoda-Biran
and Hatzor 2013).

In space Coulomb's law may permit other motions of the lower edge, in which the block also turns
about the normal of the slope (`may_turn_aside`). Angles are in degrees. Every function raises
ValueError for angles outside their ranges.
"""

from enum import IntEnum
from math import atan, cos, degrees, hypot, radians, sin, tan

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Mode(IntEnum):
    """The first motion of a block."""

    STAYS = 0
    SLIDES = 1
    TOPPLES = 2
    SLIDES_AND_TOPPLES = 3


def critical(psi: float, delta: float) -> float:
    """phi_c [degrees], below which a toppling block also slides; delta <= psi is required."""
    _require(psi=psi, delta=delta)
    if not delta <= psi:
        raise ValueError(f"delta = {delta} degrees; a block topples for delta <= psi = {psi} only")
    p, d = radians(psi), radians(delta)
    pull = sin(p) + 3.0 * sin(d) * cos(p - d)
    return degrees(atan(pull / (cos(p) + 3.0 * cos(d) * cos(p - d))))


def slip_joins(phi: float, delta: float) -> float:
    """psi [degrees] above which a toppling block also slides; delta < phi is required.

    There phi_c = phi, and tan(phi_c - delta) = tan(psi - delta)/4.
    """
    _require(phi=phi, delta=delta)
    if not delta < phi:
        raise ValueError(f"delta = {delta} degrees; it must be below phi = {phi}")
    return delta + degrees(atan(4.0 * tan(radians(phi - delta))))


def mode(*, psi: float, phi: float, delta: float) -> Mode:
    """The first motion of the block."""
    _require(psi=psi, phi=phi, delta=delta)
    if psi <= delta or phi <= delta:
        return Mode.SLIDES if phi < psi and phi <= delta else Mode.STAYS
    return Mode.SLIDES_AND_TOPPLES if phi < critical(psi, delta) else Mode.TOPPLES


def acceleration(which: Mode, *, psi: float, phi: float, delta: float) -> Array:
    """The acceleration a (2,) of the centre over g' in a mode, whether or not that mode occurs."""
    _require(psi=psi, phi=phi, delta=delta)
    p, mu = radians(psi), tan(radians(phi))
    b, h = sin(radians(delta)), cos(radians(delta))  # for a half diagonal of 1, so that k^2 = 1/3
    if which is Mode.STAYS:
        return np.zeros(2)
    if which is Mode.SLIDES:
        return np.array([sin(p) - mu * cos(p), 0.0])
    if which is Mode.TOPPLES:
        return 0.75 * (h * sin(p) - b * cos(p)) * np.array([h, b])
    n = cos(p) / (1.0 - 3.0 * (mu * h - b) * b)
    return np.array([sin(p) - mu * n, n - cos(p)])


def may_turn_aside(*, psi: float, phi: float, delta: float, half: float) -> bool:
    """Whether a block in space that topples may turn aside, so that its motion is not unique.

    half: half of its length along the lower edge, for a half diagonal of 1.
    """
    _require(psi=psi, phi=phi, delta=delta)
    if not half > 0.0:
        raise ValueError(f"half = {half!r}; it must be positive")
    return delta < min(psi, phi) and (
        _one_corner_holds(psi, phi, delta, half) or _slip_is_unstable(psi, phi, delta, half)
    )


def _one_corner_holds(psi: float, phi: float, delta: float, half: float) -> bool:
    """Whether one corner of the lower edge may stick while the other slips down.

    With the mean slip s of the corners, the sums x, n of their forces down and out of the slope,
    and the difference d of the normal forces, the edge neither rises nor rolls nor moves along
    itself, and the slipping corner bears mu (n - d)/2.
    """
    p, mu = radians(psi), tan(radians(phi))
    b, h = sin(radians(delta)), cos(radians(delta))
    yaw = (b * b + half * half) / 3.0 + b * b  # moment of inertia over the mass, about the edge
    rows = [
        [1.0, -1.0 - 3.0 * h * h, -3.0 * h * b],
        [0.0, 3.0 * h * b, 1.0 + 3.0 * b * b],
        [yaw - mu * h * b, half**2, mu * half**2],
    ]
    slip, along, push = np.linalg.solve(rows, [sin(p), cos(p), 0.0]).tolist()
    more = h * b * slip / half**2
    light, heavy = (push - more) / 2.0, (push + more) / 2.0
    needed = hypot(along + mu * light, b * slip / half)
    return bool(slip > 0.0 and light >= 0.0 and needed <= mu * heavy)


def _slip_is_unstable(psi: float, phi: float, delta: float, half: float) -> bool:
    """Whether a turn of slip down the slope shifts load between the corners so that it grows.

    The turn r needs the moment (b^2 + half^2) r/3 about the normal. Friction across the slope,
    mu n f, keeps the edge in place: b r = f (s + mu n) by size. Its lever arm is b, and the roll
    that it would cause shifts normal forces whose friction has the arm mu h.
    """
    p, mu = radians(psi), tan(radians(phi))
    b, h = sin(radians(delta)), cos(radians(delta))
    push = cos(p) / (1.0 - 3.0 * (mu * h - b) * b)
    slip = sin(p) - mu * push - 3.0 * h * (mu * h - b) * push
    turning = (b * b + half * half) / 3.0 * (1.0 + slip / (mu * push))
    return slip > 0.0 and push > 0.0 and (mu * h - b) * b > turning


def _require(**angles: float) -> None:
    for name, value in angles.items():
        if not 0.0 < value < 90.0:
            raise ValueError(f"{name} = {value} degrees; it must lie between 0 and 90")
