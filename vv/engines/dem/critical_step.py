"""The largest stable step of a scene: 2/w_max of its springs, less with lagged drag."""

from __future__ import annotations

import dataclasses
import functools
import math

import numpy as np

from vv.engines.dem.leapfrog import Leapfrog
from vv.engines.dem.line.model import line
from vv.engines.dem.rows import Index
from vv.engines.dem.space.bodies import Bodies
from vv.engines.dem.space.model import SpaceState, space
from vv.engines.dem.space.springs import Springs
from vv.scene import Mask, Scene, Vector

DENSE = 300  # the most unknowns for which a full matrix is used
CLOSE = 1e-4  # relative tolerance of the eigenvalue of a sparse matrix, found from below


@functools.lru_cache(maxsize=64)  # asked several times per setting of a scene
def critical_step(scene: Scene, leapfrog: Leapfrog) -> float:
    """The step [s] above which a closed contact makes the leapfrog unstable; inf if none can.

    Without drag, or with drag at the midpoint, it is 2/w; with lagged drag it is 2 (sqrt(n^2 + w^2)
    - n)/w^2 with n = eta/2m + d w^2/2, where d is the `delay` of viscous contacts. w is the highest
    frequency of all bonds and contacts closed at t = 0 together, or that of a single contact that
    may close, if it is higher; m is the smallest mass.
    """
    mass, square = _stiffest(scene)
    slowed = scene.eta / mass + delay(scene, square) * square
    n = 0.5 * slowed * (2.0 * leapfrog.lag - 1.0)
    if square > 0.0:
        # the same as 2 (sqrt(n^2 + w^2) - n)/w^2, free of cancellation
        return 2.0 / (math.sqrt(n * n + square) + n)
    return 1.0 / n if n > 0.0 else math.inf


def delay(scene: Scene, square: float) -> float:
    """The largest ratio of viscosity to stiffness [s] of a contact: eta_n/kn, with Hertz 2 z/w."""
    law = scene.contact
    if law.hertz is None:
        return law.eta_n / law.kn
    return 2.0 * law.hertz.damping / math.sqrt(square) if square > 0.0 else 0.0


def highest_delay(scene: Scene) -> float:
    """The `delay` of the stiffest contact of a scene."""
    return delay(scene, _stiffest(scene)[1])


@functools.lru_cache(maxsize=32)  # asked for every setting and scheme
def _stiffest(scene: Scene) -> tuple[float, float]:
    """The smallest mass [kg] and w_max^2 [1/s2] of the model that a scene is solved with."""
    one = line(scene)
    if one is not None:
        stiffness = one.state.normal or one.state.friction
        return one.state.mass, 0.0 if stiffness is None else stiffness[0] / one.state.mass
    state = space(dataclasses.replace(scene, shaking=None)).state  # which has no effect on springs
    return float(state.bodies.mass.min(initial=math.inf)), highest_square(state)


def highest_square(state: SpaceState) -> float:
    """w_max^2 [1/s2]: the largest eigenvalue of M^-1/2 K M^-1/2."""
    springs, closed = _springs(state)
    parts = _spring_matrices(state.bodies, springs)
    alone = np.linalg.eigvalsh(np.einsum("kasb,kcsb->kac", parts, parts))[:, -1]
    together = _largest_eigenvalue(parts[closed], springs.rows[closed], len(state.bodies.mass))
    rules = state.of_each_term("highest_square", 0.0, state.near, state.bodies)
    return float(max(together, alone.max(initial=0.0), *rules))


def _springs(state: SpaceState) -> tuple[Springs, Mask]:
    """The springs of all bonds and listed contacts, and which of them exist at t = 0."""
    springs = [one for one in state.of_each_term("springs", None, state.near) if one is not None]
    two, k = np.zeros((0, 2)), np.zeros(0)
    none = Springs(two.astype(np.intp), np.zeros((0, 3)), k, k, two)
    joined = (
        np.concatenate(arrays) for arrays in zip(none, *(one for one, _ in springs), strict=True)
    )
    return Springs(*joined), np.concatenate([np.zeros(0, bool), *(closed for _, closed in springs)])


def _spring_matrices(bodies: Bodies, springs: Springs) -> Vector:
    """The matrices K^1/2 B M^-1/2 (k, 3, 2, 6) of springs; B gives the relative motion of ends."""
    m, n = len(bodies.mass), springs.n
    soft, stiff = np.sqrt(springs.ks)[:, None, None], np.sqrt(springs.kn)[:, None, None]
    root = soft * np.eye(3) + (stiff - soft) * n[:, :, None] * n[:, None, :]
    parts = np.zeros((len(n), 3, 2, 6))
    for end, sign in enumerate((-1.0, 1.0)):
        row = np.minimum(springs.rows[:, end], m - 1)
        there = springs.rows[:, end] < m
        free = bodies.hold[row] if len(bodies.hold) else np.eye(3)
        size = there / np.sqrt(bodies.mass[row])
        parts[:, :, end, :3] = sign * size[:, None, None] * root @ free
        if bodies.turns:
            free = bodies.hold_spin[row] if len(bodies.hold_spin) else np.eye(3)
            size = there * springs.arms[:, end] / np.sqrt(bodies.inertia[row])
            lever = np.cross(np.eye(3)[None], n[:, None, :])
            parts[:, :, end, 3:] = size[:, None, None] * root @ lever @ free
    return parts


def _largest_eigenvalue(parts: Vector, rows: Index, m: int) -> float:
    """The largest eigenvalue of B^T B, B assembled from parts of springs; rows >= m are fixed."""
    there = rows < m
    which, end = np.nonzero(there)
    columns = 6 * rows[which, end][:, None, None] + np.arange(6)
    lines = 3 * which[:, None, None] + np.arange(3)[:, None]
    lines, columns = np.broadcast_arrays(lines, columns)
    values = parts[which, :, end]
    if not values.any():  # no spring has a moving end
        return 0.0
    if 6 * m <= DENSE:
        whole = np.zeros((3 * len(parts), 6 * m))
        whole[lines, columns] = values
        return float(np.linalg.norm(whole, 2)) ** 2
    from scipy.sparse import coo_array
    from scipy.sparse.linalg import eigsh

    data = values.ravel(), (lines.ravel(), columns.ravel())
    sparse = coo_array(data, shape=(3 * len(parts), 6 * m)).tocsr()
    start = np.ones(6 * m) + np.arange(6 * m) % 7  # any start serves, if always the same
    return float(eigsh(sparse.T @ sparse, 1, v0=start, tol=CLOSE, return_eigenvectors=False)[0])
