"""Whether an arch of straight or round voussoirs stands, by linear programming: the second route.

At each joint of the whole arch a compressive force acts at each of its two edges, with friction of
any size or within Coulomb's limit, and each voussoir is in equilibrium. Neither symmetry nor hinges
are assumed.
"""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def outlines(n: int, t: float) -> list[Array]:
    """The corners (4, 2) of each voussoir from the springing: inner, outer, outer, inner."""
    angles = np.linspace(0.0, np.pi, n + 1)
    edges = np.array([[np.cos(angles), np.sin(angles)]]).T[:, :, 0]
    inner, outer = (1.0 - t / 2.0) * edges, (1.0 + t / 2.0) * edges
    return [np.array([inner[k], outer[k], outer[k + 1], inner[k + 1]]) for k in range(n)]


def centroid(corners: Array) -> Array:
    """The centroid (2,) of a polygon (k, 2), by triangles that share its first corner."""
    fan = [(corners[0], corners[i], corners[i + 1]) for i in range(1, len(corners) - 1)]
    areas = [np.linalg.det(np.array([b - a, c - a])) for a, b, c in fan]  # signed, if not convex
    middles = [(a + b + c) / 3.0 for a, b, c in fan]
    return np.asarray(np.average(middles, axis=0, weights=areas))


def thinnest(n: int, fine: int = 1) -> float:
    """The least thickness over mean radius at which the arch stands; fine: chords per edge."""
    low, high = 0.02, 0.5
    for _ in range(45):
        t = (low + high) / 2.0
        low, high = (low, t) if _stands(n, t, fine) else (t, high)
    return high


def least_friction(n: int, t: float) -> float:
    """The least coefficient of friction at which the arch stands, if it is thick enough."""
    low, high = 0.0, 10.0
    for _ in range(40):
        mu = (low + high) / 2.0
        low, high = (low, mu) if _stands(n, t, 1, mu) else (mu, high)
    return high


def _stands(n: int, t: float, fine: int, mu: float = np.inf) -> bool:
    from scipy.optimize import linprog

    blocks, parts = outlines(n, t), outlines(n * fine, t)
    middles = [
        centroid(np.concatenate([[p[0] for p in some], [some[-1][3], some[-1][2]],
                                 [p[1] for p in some[::-1]]]))
        for some in (parts[k * fine : (k + 1) * fine] for k in range(n))
    ]  # fmt: skip
    balance = np.zeros((n, 3, n + 1, 2, 3))  # blocks, components, joints, edges, forces
    for k, corners in enumerate(blocks):
        for joint, edges, sign in ((k, corners[:2], 1.0), (k + 1, corners[[3, 2]], -1.0)):
            angle = np.pi * joint / n
            through = np.array([-np.sin(angle), np.cos(angle)])
            along = np.array([np.cos(angle), np.sin(angle)])
            ways = [through, along, -along]
            if mu < np.inf:  # edges of the friction cone
                ways = [through, through + mu * along, through - mu * along]
            for e, point in enumerate(edges):
                arm = point - middles[k]
                for d, way in enumerate(ways):
                    push = sign * way
                    turn = arm[0] * push[1] - arm[1] * push[0]
                    balance[k, :, joint, e, d] = *push, turn
    weight = np.tile([0.0, 1.0, 0.0], n)
    rows = balance.reshape(3 * n, -1)
    found = linprog(np.zeros(rows.shape[1]), A_eq=rows, b_eq=weight, bounds=(0.0, None))
    return bool(found.status == 0)
