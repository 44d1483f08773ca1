"""How stiff springs must be for a pass to leave little of what moves a block most easily.

In a groove that opens by xi, the springs of the sides resist a block that sinks sin^2(xi/2) times
as much as one that crosses the groove. Springs that are stiff beside its inertia across the groove
alone let it sink, and carry so little meanwhile that multipliers seem to have found all forces.
"""

from __future__ import annotations

import numpy as np

from vv.engines.dda.general.bodies import Bodies
from vv.engines.dda.general.contact import Touch
from vv.engines.dda.general.iterate import inertia_stiffness
from vv.engines.dda.general.setting import Part
from vv.engines.dda.limits import FIRM, UNLIKE
from vv.engines.kernels.arrays import larger, smaller, square_of, zero_rows
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, at, dot, put
from vv.scene import Vector


@called
def firm_springs(touch: Touch, bodies: Bodies, part: Part, kn: float) -> tuple[float, float]:
    """The stiffness of normal springs [N/m], and shear springs over ks, with which passes begin.

    Both exceed the inertia of contacts FIRM times, normal springs in the direction too in which
    they resist a block least. Shear springs act along a groove with all of their stiffness.
    """
    firm = kn
    for light in inertia_stiffness(touch, touch.state, bodies, part.length, part.weight):
        firm = larger(firm, FIRM * light)
    return firm / least_share(touch, bodies), firm / kn


@called
def least_share(touch: Touch, bodies: Bodies) -> float:
    """The stiffness of normal springs in the direction that they resist least, over their sum.

    It is the least of all blocks, for displacements without rotation that contacts resist at all.
    Of two sides whose normals enclose an angle it is (1 - |cos|)/2. Of more it is an estimate, to a
    factor of about eight: passes stiffen springs further where that leaves too much.
    """
    blocks = len(bodies.mass)
    one, two, least = zero_rows(blocks), zero_rows(blocks), 1.0
    for count in range(3):
        other = other_directions(touch, bodies, one, two)
        for i in range(blocks):
            square = dot(at(other, i), at(other, i))
            if square > square_of(UNLIKE):
                whole = 2.0 + 2.0 * np.sqrt(larger(0.0, 1.0 - square))
                least = smaller(least, square / whole if count > 0 else square)
                put(two, i, at(one, i))
                put(one, i, add_scaled(NOWHERE, 1.0 / np.sqrt(square), at(other, i)))
    return least


@called
def other_directions(touch: Touch, bodies: Bodies, one: Vector, two: Vector) -> Vector:
    """The longest parts (n, 3) of the normals at each block that are normal to one and two (n, 3).

    They lie in the free directions of the block.
    """
    longest = zero_rows(len(bodies.mass))
    for k in range(len(touch.key)):
        keep_longer(longest, touch.second[k], at(touch.normal, k), bodies, one, two)
        if touch.wall[k] < 0:
            keep_longer(longest, touch.first[k], at(touch.normal, k), bodies, one, two)
    return longest


@lent
def keep_longer(
    longest: Vector, i: int, n: Triple, bodies: Bodies, one: Vector, two: Vector
) -> None:
    """Replace row i of `longest` by that part of a normal at block i, if it is longer."""
    part = NOWHERE
    for a in range(bodies.start[i], bodies.start[i + 1]):
        line = at(bodies.line, a)
        part = add_scaled(part, dot(line, n), line)
    for _ in range(2):  # what rounding left of a part is small beside all, and not beside the rest
        part = add_scaled(part, -dot(part, at(one, i)), at(one, i))
        part = add_scaled(part, -dot(part, at(two, i)), at(two, i))
    if dot(part, part) > dot(at(longest, i), at(longest, i)):
        put(longest, i, part)
