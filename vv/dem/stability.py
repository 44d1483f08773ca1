"""The largest stable step of a scene: 2/w_max of its contacts or bonds, less where drag lags."""

from __future__ import annotations

import functools
import math
from collections.abc import Iterator

import numpy as np

from vv.dem.bonded import bonded, highest_square
from vv.dem.leapfrog import Leapfrog
from vv.dem.line import line
from vv.dem.space import Contacts, SpaceState, space
from vv.scene import Scene, Vector

TOUCHING = 1e-9  # gap over radius up to which a contact counts as closed at t = 0


@functools.lru_cache(maxsize=64)  # asked several times a rung for one scene
def critical_step(scene: Scene, leapfrog: Leapfrog) -> float:
    """The step [s] beyond which a closed contact makes the leapfrog unstable; inf if none can.

    Without drag, or with drag at the midpoint, 2/w; with lagged drag 2 (sqrt(n^2 + w^2) - n)/w^2,
    n = eta/2m. w is the highest frequency of the contacts closed at t = 0 taken together, or of
    any one contact that may close, if that is higher, or that of all bonds; m the least mass.
    """
    hung = bonded(scene)
    one = None if hung is not None else line(scene)
    if hung is not None:
        mass, square = float(hung.state.mass.min(initial=math.inf)), highest_square(hung.state)
    elif one is not None:
        stiffness = one.state.normal or one.state.friction
        mass = one.state.mass
        square = 0.0 if stiffness is None else stiffness[0] / mass
    else:
        state = space(scene).state
        mass, square = float(state.mass.min(initial=math.inf)), _highest_square(state)
    n = scene.eta / (2.0 * mass) * (2.0 * leapfrog.lag - 1.0)
    if square > 0.0:
        # the same as 2 (sqrt(n^2 + w^2) - n)/w^2, free of cancellation
        return 2.0 / (math.sqrt(n * n + square) + n)
    return 1.0 / n if n > 0.0 else math.inf


def _highest_square(state: SpaceState) -> float:
    """w_max^2 [1/s2]: the largest eigenvalue of M^-1/2 K M^-1/2."""
    rows = list(_contacts(state))
    alone = [float(np.linalg.eigvalsh(b @ b.T)[-1]) for _, b in rows]
    closed = [b for gap, b in rows if gap <= TOUCHING]
    together = np.concatenate(closed) if closed else np.zeros((1, 1))
    return max([float(np.linalg.norm(together, 2)) ** 2, *alone])


def _contacts(state: SpaceState) -> Iterator[tuple[float, Vector]]:
    """Relative gap, and K^1/2 B M^-1/2 (3, 6 m) of every contact; B gives the relative motion."""
    for contacts in (state.pairs, state.walls):
        if contacts is not None:
            for p in range(len(contacts[0])):
                yield _contact(state, contacts, p)


def _contact(state: SpaceState, contacts: Contacts, p: int) -> tuple[float, Vector]:
    rows, direction, gap, radius = (np.atleast_1d(array[p]) for array in contacts)
    n = direction / np.linalg.norm(direction)
    ks = 0.0 if state.friction is None else state.friction[0]
    root = math.sqrt(ks) * np.eye(3) + (math.sqrt(state.kn) - math.sqrt(ks)) * np.outer(n, n)
    m = len(state.mass)
    b = np.zeros((3, 2, m, 3))
    signs = (-1.0, 1.0) if len(rows) == 2 else (1.0,)
    for row, sign, r in zip(rows, signs, radius, strict=True):
        if row < m:
            b[:, 0, row] = sign * root @ _held(state.hold, row) / math.sqrt(state.mass[row])
            if state.spin is not None:
                arm = root @ np.cross(np.eye(3), n) @ _held(state.hold_spin, row)
                b[:, 1, row] = r * arm / math.sqrt(state.inertia[row])
    return float(gap[0] / radius.min()), b.reshape(3, 6 * m)


def _held(hold: Vector | None, row: int) -> Vector:
    return np.eye(3) if hold is None else hold[row]
