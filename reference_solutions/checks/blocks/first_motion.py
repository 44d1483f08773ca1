"""How a block on a slope begins to move, by trying all modes of two edges: the second route.

Each edge is open, sticks, slips down or slips up. Of the 16 pairs of these states the solution is
the one with compressive forces within Coulomb's law and without penetration of the slope. Where
both edges stick the forces are not unique, and any forces in equilibrium suffice.
"""

from itertools import product
from math import cos, radians, sin, tan

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
SMALL = 1e-12  # of g'


def acceleration(*, psi: float, phi: float, delta: float) -> Array:
    """The acceleration (3,) of the centre over g', for a half diagonal of 1.

    It consists of the components down the slope and out of it and of the forward rotation.
    """
    p, mu = radians(psi), tan(radians(phi))
    b, h = sin(radians(delta)), cos(radians(delta))
    pull = np.array([sin(p), -cos(p), 0.0])
    if _may_rest(pull, mu, b, h):
        return np.zeros(3)
    for states in product(("off", "stick", "down", "up"), repeat=2):
        found = None if states == ("stick", "stick") else _tried(states, pull, mu, (b, -b), h)
        if found is not None:
            return found
    raise ValueError(f"psi, phi, delta = {psi}, {phi}, {delta} degrees: no mode is consistent")


def may_turn_aside(*, psi: float, phi: float, delta: float, half: float) -> bool:
    """Whether a toppling block in space may turn, by equations for both corners of its edge."""
    p, d, mu = radians(psi), radians(delta), tan(radians(phi))
    mobile, free = _corners(d, half), np.tile([sin(p), 0.0, -cos(p)], 2)

    def moved(one: Array, two: Array, kept: list[int]) -> tuple[Array, Array]:
        """Forces and accelerations (6,) where `kept` do not move; rows are directions of force."""
        pushes = np.zeros((len(one) + len(two), 6))
        pushes[: len(one), :3], pushes[len(one) :, 3:] = one, two
        force = pushes.T @ np.linalg.solve((mobile @ pushes.T)[kept], -free[kept])
        return force, mobile @ force + free

    rubbing = [np.array([[-mu * cos(a), -mu * sin(a), 1.0]]) for a in (0.0, 1e-6)]
    force, went = moved(np.eye(3), rubbing[0], [0, 1, 2, 5])
    holds = went[3] > 0.0 and min(force[2], force[5]) >= 0.0
    if holds and np.hypot(*force[:2]) <= mu * force[2]:
        return True
    force, straight = moved(rubbing[0], rubbing[0], [2, 5])
    _, bent = moved(rubbing[1], rubbing[0], [2, 5])
    # slip turned at one corner turns both, and as much if turned at the other: it grows with both
    own, other = bent[1] / bent[0] / 1e-6, bent[4] / bent[3] / 1e-6
    return bool(straight[0] > 0.0 and force[2] > 0.0 and (own - 1.0) + other > 0.0)


def _corners(d: float, half: float) -> Array:
    """The accelerations (6, 6) of the two corners of the lower edge by forces on them."""
    b, h = sin(d), cos(d)
    at = [np.array([b, side * half, -h]) for side in (1.0, -1.0)]
    inertia = np.array([half**2 + h * h, 1.0, b * b + half**2]) / 3.0
    turns = [np.cross(np.eye(3), arm) for arm in at]  # rows: rotation about each axis
    return np.vstack([
        np.hstack([np.eye(3) + own.T @ (other / inertia[:, None]) for other in turns])
        for own in turns
    ])  # fmt: skip


def _tried(
    states: tuple[str, ...], pull: Array, mu: float, at: tuple[float, ...], h: float
) -> Array | None:
    """The acceleration in a mode; None where the mode is inconsistent."""
    rows, right = [np.hstack([np.eye(3), -_levers(at, h)])], [pull]
    for i, state in enumerate(states):
        normal, along = np.zeros(7), np.zeros(7)
        if state == "off":
            normal[3 + 2 * i] = along[4 + 2 * i] = 1.0
        else:
            normal[[1, 2]] = 1.0, -at[i]
            along[[0, 2]] = 1.0, -h
            if state != "stick":
                along = np.zeros(7)
                along[3 + 2 * i], along[4 + 2 * i] = (mu if state == "down" else -mu), 1.0
        rows += [normal[None], along[None]]
        right += [np.zeros(1), np.zeros(1)]
    matrix = np.vstack(rows)
    if abs(np.linalg.det(matrix)) < SMALL:
        return None
    x: Array = np.linalg.solve(matrix, np.concatenate(right))
    return x[:3] if all(_holds(s, x, mu, at[i], h, i) for i, s in enumerate(states)) else None


def _levers(at: tuple[float, ...], h: float) -> Array:
    """The accelerations (3, 4) by unit normal and friction forces of both edges; k^2 = 1/3."""
    columns = [column for x in at for column in ((0.0, 1.0, -3.0 * x), (1.0, 0.0, -3.0 * h))]
    return np.array(columns).T


def _holds(state: str, x: Array, mu: float, at: float, h: float, i: int) -> bool:
    """Whether the solution agrees with the assumed state of an edge."""
    rises, slips = x[1] - at * x[2], x[0] - h * x[2]
    push, rub = x[3 + 2 * i], x[4 + 2 * i]
    if state == "off":
        return bool(rises >= -SMALL)
    if state == "stick":
        return bool(push >= -SMALL and abs(rub) <= mu * push + SMALL)
    return bool(push >= -SMALL and (slips >= -SMALL if state == "down" else slips <= SMALL))


def _may_rest(pull: Array, mu: float, b: float, h: float) -> bool:
    """Whether contact forces within Coulomb's law can keep the block in equilibrium."""
    from scipy.optimize import linprog

    cone = [[-mu, 1.0, 0.0, 0.0], [-mu, -1.0, 0.0, 0.0]]
    limits = np.array(cone + [row[2:] + row[:2] for row in cone])
    pushes = [(0.0, None), (None, None)] * 2
    found = linprog(np.zeros(4), limits, np.zeros(4), _levers((b, -b), h), -pull, pushes)
    return bool(found.status == 0)
