"""Whether a facade stands, and the load on its bed, by linear programming: the second route.

Two blocks are in contact where an edge of one lies on an edge of the other, whatever the pattern of
the courses. A compressive force within Coulomb's cone acts at both ends of the segment that the
edges share, and each block is in equilibrium. If such forces exist, there is a load path by which
the facade can stand (Livesley 1978, International Journal for Numerical Methods in Engineering 12,
1853-1871).
"""

from itertools import combinations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
NEAR = 1e-9  # [m], tolerance on lengths of about 1 m


def area(corners: Array) -> float:
    """The area of a polygon (k, 2), by trapezoids under edges; positive if counter-clockwise."""
    x, y = corners.T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2.0


def centroid(corners: Array) -> Array:
    """The centroid of a convex polygon (k, 2), by triangles that share its first corner."""
    fan = [(corners[0], corners[i], corners[i + 1]) for i in range(1, len(corners) - 1)]
    return np.asarray(
        np.average(
            [sum(one) / 3.0 for one in fan], axis=0, weights=[area(np.array(o)) for o in fan]
        )
    )


def shared(one: Array, other: Array) -> list[tuple[Array, Array]]:
    """The ends (2,) of segments shared by edges of two polygons, and normals out of the first."""
    found = []
    for a, b in zip(one, np.roll(one, -1, axis=0), strict=True):
        length = float(np.linalg.norm(b - a))
        along = (b - a) / length
        normal = np.array([along[1], -along[0]])
        for c, d in zip(other, np.roll(other, -1, axis=0), strict=True):
            if max(abs((c - a) @ normal), abs((d - a) @ normal)) < NEAR:
                low, high = sorted(((c - a) @ along, (d - a) @ along))
                low, high = max(low, 0.0), min(high, length)
                if high - low > NEAR:
                    found += [(a + low * along, normal), (a + high * along, normal)]
    return found


def bed_load(blocks: list[Array], bed: Array, mu: float, thrust: float = 0.0) -> float | None:
    """The load on the bed from blocks of unit weight per area; None if they cannot stand.

    blocks, bed: corners (k, 2) [m], counter-clockwise; thrust: the force to the right that a block
    needs of its contacts, over its weight.
    """
    from scipy.optimize import linprog

    all_of_them = [bed, *blocks]
    columns, on_bed = [], []
    for i, j in combinations(range(len(all_of_them)), 2):
        for point, normal in shared(all_of_them[i], all_of_them[j]):
            for side in (1.0, -1.0):  # the two edges of the friction cone
                force = normal + side * mu * np.array([-normal[1], normal[0]])
                column = np.zeros((len(all_of_them), 3))
                for k, sign in ((i, -1.0), (j, 1.0)):
                    arm = point - centroid(all_of_them[k])
                    column[k] = sign * np.array([*force, arm[0] * force[1] - arm[1] * force[0]])
                columns.append(column[1:].ravel())
                on_bed.append(force[1] if i == 0 else 0.0)
    weights = np.array([[thrust * area(block), area(block), 0.0] for block in blocks]).ravel()
    answer = linprog(np.zeros(len(columns)), A_eq=np.array(columns).T, b_eq=weights)
    return float(answer.x @ on_bed) if answer.success else None
