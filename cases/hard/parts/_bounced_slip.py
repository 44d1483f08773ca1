"""How far a contact that friction holds slips while it bounces on springs that start slack."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vv.scene import Vector


class Held(NamedTuple):
    """A contact that rigid friction would hold, at the times t [s].

    limit: the acceleration [m/s2] that friction could give. needed: the part of it that is needed.
    """

    t: Vector
    limit: Vector
    needed: Vector


def slipped(held: Held, w: float, dt: float) -> float:
    """The most that it slips [m] on springs of the frequency w [1/s] in implicit steps dt [s].

    The springs start slack, so that the normal force varies as 1 - f cos wt and the shear force
    needs up to 1 + f times what it does at rest, f being what implicit steps have left of the
    oscillation: they damp it by (1 + (w dt)^2/2)^(-1/2) a step. When friction does not suffice, the
    contact slips as a block does on a shaken base (Newmark): under the acceleration f cos wt - k of
    the limit, k = 1 - r (1 + f) with the part r that is needed. In a period that is at most
    2 pi (f - k)^2/(f w^2) of the limit: exactly so at k = 0, and 0.72 of it as k approaches f. A
    negative k counts as nil, since friction suffices on average.
    """
    left = (1.0 + (w * dt) ** 2 / 2.0) ** (-held.t / (2.0 * dt))
    lacks = np.clip(left - 1.0 + held.needed * (1.0 + left), 0.0, left)
    return float(np.trapezoid(held.limit * lacks**2 / np.maximum(left, 1e-300), held.t) / w)
