"""How two spheres, or a sphere and a wall, came to touch: what the law of contacts is told of them.

The relations are those of `vv.engines.dem.contact`, of positions in place of displacements.
"""

from __future__ import annotations

import math

from vv.engines.dem.bulk.grains import BEFORE, RADIUS, SPUN, V, W
from vv.engines.dem.contact.pairs import last_step
from vv.engines.dem.contact.touch import Touch
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, cross, dot
from vv.scene import Vector


@inlined
def part(row: Vector, i: int, first: int) -> Triple:
    """Three columns of row i of an array, from `first` on."""
    return row[i, first], row[i, first + 1], row[i, first + 2]


@inlined
def pair_touch(
    row: Vector, turns: Vector | None, i: int, j: int, d: Triple, square: float, dt: float
) -> tuple[Touch, float]:
    """The contact of spheres i and j, whose centres lie d [m] apart, and its reduced radius [m].

    square: d . d; turns: None if no sphere turns.
    """
    first, second, length = row[i, RADIUS], row[j, RADIUS], math.sqrt(square)
    overlap, n = first + second - length, add_scaled(NOWHERE, 1.0 / length, d)
    relative = add_scaled(part(row, j, V), -1.0, part(row, i, V))
    changed = add_scaled(
        relative, -1.0, add_scaled(part(row, j, BEFORE), -1.0, part(row, i, BEFORE))
    )
    n_before, m, opened = last_step(d, length, relative, dt)
    rates = (
        dot(n_before, add_scaled(relative, -0.5, changed)),
        dot(n, add_scaled(relative, 0.5, changed)),
    )
    reduced = first * second / (first + second)
    if turns is not None:
        inside = 0.5 * (overlap + 0.5 * opened)
        at_i, at_j, w, v = first - inside, second - inside, part(row, i, W), part(row, j, W)
        rolled = add_scaled(add_scaled(NOWHERE, at_i, w), at_j, v)
        rolled_before = add_scaled(
            add_scaled(NOWHERE, at_i, part(row, i, SPUN)), at_j, part(row, j, SPUN)
        )
        relative = add_scaled(relative, -1.0, cross(rolled, m))
        changed = add_scaled(changed, -1.0, cross(add_scaled(rolled, -1.0, rolled_before), m))
        twist = 0.5 * dt * dot(add_scaled(w, 1.0, v), m)
    else:
        twist = None
    return Touch(overlap, opened, n, n_before, m, rates, relative, changed, twist), reduced


@inlined
def wall_touch(
    row: Vector, turns: Vector | None, i: int, n: Triple, overlap: float, dt: float
) -> Touch:
    """The contact of sphere i with a wall of outward normal n."""
    relative = part(row, i, V)
    changed = add_scaled(relative, -1.0, part(row, i, BEFORE))
    opened, more = dt * dot(n, relative), 0.5 * dot(n, changed)
    rates = dot(n, relative) - more, dot(n, relative) + more
    if turns is not None:
        arm, w = 0.5 * (overlap + 0.5 * opened) - row[i, RADIUS], part(row, i, W)
        relative = add_scaled(relative, arm, cross(w, n))
        changed = add_scaled(changed, arm, cross(add_scaled(w, -1.0, part(row, i, SPUN)), n))
        twist = 0.5 * dt * dot(w, n)
    else:
        twist = None
    return Touch(overlap, opened, n, n, n, rates, relative, changed, twist)
