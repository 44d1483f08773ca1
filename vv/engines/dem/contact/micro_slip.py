"""Contact of elastic spheres with micro-slip: Hertz and Mindlin, by a row of tangential springs.

The normal force is that of Hertz. Tangentially, the contact is represented by springs along a line,
each of which closes, sticks and slips separately (Popov and Hess 2015; Jaeger 1993). This gives the
slip annuli of Cattaneo and Mindlin for any history of normal force and slip.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from vv.engines.dem.contact.friction import twist_both
from vv.engines.dem.contact.hertz import elastic_law
from vv.engines.dem.contact.hertz import normal_force as pressed_by_hertz
from vv.engines.dem.contact.touch import Touch
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, at, dot
from vv.scene import Hertz, Scene, Vector

SPRINGS = 513  # number of springs on half of the line of the deepest contact
ROOM = 1.01  # factor on the half length that a contact is expected to need
FIRST = 4  # column of the first spring, after the force (3) and the spacing (1)


class MicroSlip(NamedTuple):
    """The parameters, as in `vv.engines.dem.contact.hertz.Elastic`; damping is not used."""

    modulus: float
    friction: tuple[float, float] | None
    damping: float | None
    stiffness: tuple[float, float]
    at_run_time: int | None = None

    @property
    def columns(self) -> int:
        """The count of numbers stored per contact: force [N], spacing [m^0.5], stretches [m]."""
        return FIRST + 3 * SPRINGS


def micro_slip_law(scene: Scene, law: Hertz) -> MicroSlip:
    """The contact law of a scene with micro-slip."""
    return MicroSlip(*elastic_law(scene, law, rubs=True))


@inlined
def normal_force(law: MicroSlip, overlap: float, radius: float) -> tuple[float, float]:
    """The normal force [N] and its energy [J], as by Hertz."""
    return pressed_by_hertz(law, overlap, radius)  # type: ignore[arg-type]  # the same fields


@inlined
def damping_at(law: MicroSlip, before: float, overlap: float, radius: float, mass: float) -> float:
    """Zero: this law has no viscosity."""
    return 0.0


@inlined
def friction_force(
    law: MicroSlip, touch: Touch, radius: float, mass: float, kept: Vector, row: int, dt: float
) -> tuple[Triple, float, float]:
    """The force of all springs together [N], their energy, and the energy dissipated by slip [J].

    The spring at x = s sqrt(R) closes when U > s^2; from then on the slide stretches it, up to mu
    E/(4 G) (U - s^2). Between springs the stretch is taken as linear in s^2, which is exact where
    all springs slip. Where the slip changes direction, limiting the stretch is of first order.
    """
    shear, mu = law.friction  # type: ignore[misc]  # it always has friction
    overlap, before = touch.overlap, max(touch.overlap + touch.opened, 0.0)
    apart = spring_spacing(law, touch, radius, mass, kept, row)
    most, edge = 0.25 * mu * law.modulus / shear, math.sqrt(overlap)
    m, relative = touch.midway, touch.relative
    slide = add_scaled(NOWHERE, dt, add_scaled(relative, -dot(m, relative), m))
    stiff = 8.0 * shear * math.sqrt(radius)
    force, held, taken = NOWHERE, 0.0, 0.0
    last = int(edge / apart)
    for k in range(last + 1):
        depth = apart * k * apart * k
        share = 1.0 if depth <= before else (overlap - depth) / (overlap - before)
        old = NOWHERE if depth > before else stretch(kept, row, k)
        old, moved = rotated_with_plane(old, slide, touch)
        new = limited(add_scaled(old, share, moved), most * (overlap - depth))
        store_stretch(kept, row, k, new)
        weight = stiff * spring_weight(k, last, apart, edge)
        force = add_scaled(force, -weight, new)
        held += 0.5 * weight * dot(new, new)
        slipped = add_scaled(moved, -1.0, add_scaled(new, -1.0, old))
        taken += 0.5 * weight * dot(add_scaled(old, 1.0, new), slipped)
    return force, held, taken


@inlined
def spring_spacing(
    law: MicroSlip, touch: Touch, radius: float, mass: float, kept: Vector, row: int
) -> float:
    """The spacing of the springs [m^0.5] in s = x/sqrt(R); a new contact gets new springs.

    They cover the contact radius that the kinetic energy of the approach can cause. If a contact
    becomes larger than that, every second spring is dropped and the spacing is doubled.
    """
    overlap, force = touch.overlap, at(kept, row)
    if dot(force, force) == 0.0:
        held = 16.0 / 15.0 * law.modulus * math.sqrt(radius)
        deep = (math.sqrt(overlap) ** 5 + mass * touch.rates[1] ** 2 / held) ** 0.4
        kept[row, 3] = ROOM * math.sqrt(deep) / (SPRINGS - 1)
        for k in range(SPRINGS):
            store_stretch(kept, row, k, NOWHERE)
    while kept[row, 3] * (SPRINGS - 1) < math.sqrt(overlap):
        kept[row, 3] *= 2.0
        for k in range(SPRINGS):
            store_stretch(kept, row, k, stretch(kept, row, 2 * k) if 2 * k < SPRINGS else NOWHERE)
    return float(kept[row, 3])


@inlined
def stretch(kept: Vector, row: int, k: int) -> Triple:
    """The stretch of spring k [m]."""
    c = FIRST + 3 * k
    return kept[row, c], kept[row, c + 1], kept[row, c + 2]


@inlined
def store_stretch(kept: Vector, row: int, k: int, a: Triple) -> None:
    """Store the stretch of spring k [m]."""
    c = FIRST + 3 * k
    kept[row, c], kept[row, c + 1], kept[row, c + 2] = a


@inlined
def rotated_with_plane(old: Triple, slide: Triple, touch: Touch) -> tuple[Triple, Triple]:
    """The old stretch rotated with the contact plane, and the slide in the new plane."""
    n, n_before = touch.n, touch.n_before
    tilt = -dot(n, old) / (1.0 + dot(n, n_before))
    old, slide = twist_both(
        add_scaled(old, tilt, add_scaled(n, 1.0, n_before)), slide, n, touch.twist
    )
    return old, add_scaled(slide, -dot(n, slide), n)


@inlined
def limited(trial: Triple, most: float) -> Triple:
    """The trial stretch, limited to the length `most` [m] that friction allows."""
    size = math.sqrt(dot(trial, trial))
    return trial if size <= most else add_scaled(NOWHERE, most / size, trial)


@inlined
def spring_weight(k: int, last: int, apart: float, edge: float) -> float:
    """The integral over s [m^0.5] of the shape function of spring k.

    This is 1 at spring k, 0 at its neighbours and at the edge, and linear in s^2 between them.
    """
    inner = (3.0 * k - 2.0) / (6.0 * k - 3.0) if k else 0.0
    if k < last:
        return apart * (inner + (3.0 * k + 2.0) / (6.0 * k + 3.0))
    at_edge = apart * k
    return apart * inner + (edge - at_edge) * (2.0 * edge + at_edge) / (3.0 * (edge + at_edge))
