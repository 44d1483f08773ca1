"""Scenes of spheres integrated by scipy from event to event: a second route to every code's runs.

Written from the contact law alone, in space and with all rotations, for contacts that stick until
they open; it shares no code with any engine.
"""

from __future__ import annotations

import functools
import itertools
from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

from vv.scene import Scene, Vector, Wall


class Touch(NamedTuple):
    """A sphere i, and the sphere j (None: the wall) that may push it."""

    i: int
    j: int | None
    wall: Wall | None


def touches(scene: Scene) -> list[Touch]:
    n = range(len(scene.spheres))
    walls = [Touch(i, None, wall) for wall in scene.walls for i in n]
    return walls + [Touch(i, j, None) for i, j in itertools.combinations(n, 2)]


class Law:
    """m u'' = m g + F + contacts - eta u', I w' = torques, each along the free directions.

    y = (u, v, w, shear force of every contact), all flat. A shear force grows by -ks times the
    velocity of the spheres' surfaces against each other, half the overlap in, and turns with
    the normal and with the mean spin of the two about it.
    """

    def __init__(self, scene: Scene) -> None:
        self.scene, self.touches = scene, touches(scene)
        s, axes = scene.spheres, scene.axes
        self.n = len(s)
        self.hold = np.einsum("ka,nk,kb->nab", axes, s.free, axes) / s.mass[:, None, None]
        self.hold_spin = np.einsum("ka,nk,kb->nab", axes, s.free_spin, axes)
        self.hold_spin /= s.inertia[:, None, None]

    def parts(self, y: Vector) -> list[Vector]:
        n = 3 * self.n
        return [part.reshape(-1, 3) for part in np.split(y, [n, 2 * n, 3 * n])]

    def facing(self, touch: Touch, u: Vector) -> tuple[float, Vector, float]:
        """The gap, the unit normal towards sphere i, and the distance over which it turns."""
        s = self.scene.spheres
        place = s.position[touch.i] + u[touch.i]
        if touch.wall is not None:
            n = touch.wall.normal
            return float((place - touch.wall.point) @ n - s.radius[touch.i]), n, np.inf
        offset = place - s.position[touch.j] - u[touch.j]
        length = float(np.linalg.norm(offset))
        return length - float(s.radius[touch.i] + s.radius[touch.j]), offset / length, length

    def gap(self, touch: Touch, time: float, y: Vector) -> float:
        return self.facing(touch, self.parts(y)[0])[0]

    def rate(self, closed: Iterable[int], time: float, y: Vector) -> Vector:
        """dy/dt while these contacts are closed and the others open."""
        scene, s = self.scene, self.scene.spheres
        u, v, w, shear = self.parts(y)
        push = s.mass[:, None] * scene.gravity + s.load - scene.eta * v
        turn, sheared = np.zeros_like(w), np.zeros_like(shear)
        for k in closed:
            i, j, _ = self.touches[k]
            gap, n, length = self.facing(self.touches[k], u)
            arm = s.radius + gap / 2
            slide, rolled, spin = v[i], arm[i] * w[i], w[i] / 2
            if j is not None:
                slide, rolled, spin = slide - v[j], rolled + arm[j] * w[j], spin + w[j] / 2
            across = slide - (slide @ n) * n
            sheared[k] = -scene.contact.ks * (across - np.cross(rolled, n))
            sheared[k] += (spin @ n) * np.cross(n, shear[k]) - (shear[k] @ across) / length * n
            force = -scene.contact.kn * gap * n + shear[k]
            for body, sign in ((i, 1.0), (j, -1.0)):
                if body is not None:
                    push[body] += sign * force
                    turn[body] += arm[body] * np.cross(force, n)
        rates = np.einsum("nab,nb->na", self.hold, push), self.hold_spin @ turn[..., None]
        return np.concatenate([v.ravel(), rates[0].ravel(), rates[1].ravel(), sheared.ravel()])


def reference(scene: Scene, times: Vector) -> Vector:
    """Displacements (times, n, 3) [m] at times from 0, by scipy from event to event."""
    law, s = Law(scene), scene.spheres
    shear = np.zeros((len(law.touches), 3))
    y = np.concatenate([0 * s.position, s.velocity, s.spin, shear]).ravel()
    shut = np.array([law.gap(touch, 0.0, y) < 0 for touch in law.touches], bool)
    t, found = 0.0, [y[: 3 * law.n]]
    while t < times[-1]:
        ends: list[Any] = [functools.partial(law.gap, touch) for touch in law.touches]
        for k, end in enumerate(ends):
            end.terminal, end.direction = True, 1.0 if shut[k] else -1.0
        part = solve_ivp(
            functools.partial(law.rate, np.flatnonzero(shut).tolist()), (t, times[-1]), y, "DOP853",
            events=ends, rtol=1e-9, atol=1e-12, max_step=times[-1] / 30, dense_output=True,
        )  # fmt: skip
        found += [part.sol(time)[: 3 * law.n] for time in times if t < time <= part.t[-1]]
        t, y = float(part.t[-1]), part.y[:, -1].copy()
        for k in (k for k, when in enumerate(part.t_events) if len(when)):
            shut[k] = not shut[k]
            y[9 * law.n + 3 * k :][:3] = 0.0
    return np.array(found).reshape(len(times), law.n, 3)
