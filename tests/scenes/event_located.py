"""Small plane scenes integrated by scipy from event to event: the second route to exact runs.

Written from the contact law alone, with all freedoms of the plane and distances as they are; it
shares no code with any engine.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

import numpy as np
from scipy.integrate import DOP853
from scipy.optimize import brentq

from vv.scene import Scene, Vector

OPEN, STICK, FORWARD, BACKWARD, PARTED = range(5)
SIGN = {FORWARD: 1, BACKWARD: -1}
SLACK = 1e-15  # m, m/s: guards fall this far below zero, so that what has just begun does not end
SAMPLES = 9  # of each guard over a step, between which its minima are looked for
Guard = tuple[int, int, Callable[[Vector], float]]  # contact, mode to ask for, falling function


class Plane:
    """A scene in the x-y plane: y = (displacements, velocities, shear stretches), all flat."""

    def __init__(self, scene: Scene) -> None:
        spheres, self.scene = scene.spheres, scene
        self.n = len(spheres)
        self.x0, self.radius = spheres.position[:, :2], spheres.radius
        self.weight = spheres.mass[:, None] * scene.gravity[:2] + spheres.load[:, :2]
        self.mobility = spheres.free[:, :2] / spheres.mass[:, None]
        self.walls = [
            (i, wall.normal[:2], np.array([-wall.normal[1], wall.normal[0]]), wall.point[:2])
            for wall in scene.walls
            for i in range(self.n)
        ]
        self.pairs = [(i, j) for j in range(self.n) for i in range(j)]
        self.rough = scene.contact.ks * scene.contact.mu > 0
        self.ratio = scene.contact.mu * scene.contact.kn / scene.contact.ks if self.rough else 0.0
        slack = np.zeros(len(self.walls))
        self.start = np.concatenate((0 * self.x0.ravel(), spheres.velocity[:, :2].ravel(), slack))
        contacts = range(len(self.walls) + len(self.pairs))
        self.modes = [STICK if self.gap(k, self.start) < -1e-14 else OPEN for k in contacts]
        for k, mode in enumerate(self.modes):
            if mode == STICK and self.press(k, self.start) < 0:
                self.modes[k] = PARTED

    def gap(self, k: int, y: Vector) -> float:
        """The gap of contact k: walls first, then pairs."""
        if k < len(self.walls):
            i, normal, _, point = self.walls[k]
            still = float((self.x0[i] - point) @ normal - self.radius[i])
            return still + float(y[2 * i : 2 * i + 2] @ normal)
        i, j = self.pairs[k - len(self.walls)]
        return math.hypot(*self.offset(i, j, y)) - float(self.radius[i] + self.radius[j])

    def offset(self, i: int, j: int, y: Vector) -> Vector:
        """From the centre of sphere i to that of sphere j."""
        offset: Vector = self.x0[j] - self.x0[i] + (y[2 * j : 2 * j + 2] - y[2 * i : 2 * i + 2])
        return offset

    def derivative(self, time: float, y: Vector) -> Vector:
        """dy/dt while the modes stay."""
        law, n = self.scene.contact, self.n
        v = y[2 * n : 4 * n].reshape(-1, 2)
        force: Vector = self.weight - self.scene.eta * v
        rates = np.zeros(len(self.walls))
        for k, (i, normal, tangent, _) in enumerate(self.walls):
            if (mode := self.modes[k]) in (OPEN, PARTED):
                continue
            press = self.press(k, y)
            force[i] += press * normal
            if self.rough and mode == STICK:
                force[i] -= law.ks * y[4 * n + k] * tangent
                rates[k] = v[i] @ tangent
            elif self.rough:
                force[i] -= SIGN[mode] * law.mu * press * tangent
        for k, (i, j) in enumerate(self.pairs, len(self.walls)):
            if self.modes[k] not in (OPEN, PARTED):
                offset = self.offset(i, j, y)
                push = self.press(k, y) * offset / math.hypot(*offset)
                force[j] += push
                force[i] -= push
        return np.concatenate((v.ravel(), (force * self.mobility).ravel(), rates))

    def guards(self) -> list[Guard]:
        """What ends the present modes."""
        found: list[Guard] = []
        for k, mode in enumerate(self.modes):
            if mode == OPEN:
                found.append((k, STICK, partial(self.gap, k)))
                continue
            if mode == PARTED:
                found.append((k, STICK, partial(self.pulled, k)))
            elif self.scene.contact.eta_n > 0:
                found.append((k, PARTED, partial(self.pushed, k)))
            if mode == PARTED or not self.scene.contact.eta_n > 0:
                found.append((k, OPEN, partial(self.overlap, k)))
            if k < len(self.walls) and self.rough and mode == STICK:
                found += [(k, after, partial(self.reserve, k, SIGN[after])) for after in SIGN]
            elif k < len(self.walls) and self.rough and mode in SIGN:
                found.append((k, STICK, partial(self.slip, k, SIGN[mode])))
        return found

    def press(self, k: int, y: Vector) -> float:
        """The force kn U + eta_n U' of contact k, which may be less than nothing."""
        law, v = self.scene.contact, y[2 * self.n : 4 * self.n].reshape(-1, 2)
        if k < len(self.walls):
            i, normal, _, _ = self.walls[k]
            rate = float(v[i] @ normal)
        else:
            i, j = self.pairs[k - len(self.walls)]
            offset = self.offset(i, j, y)
            rate = float((v[j] - v[i]) @ offset) / math.hypot(*offset)
        return -law.kn * self.gap(k, y) - law.eta_n * rate

    def pushed(self, k: int, y: Vector) -> float:
        """The overlap at which a spring alone would push as much as contact k."""
        return self.press(k, y) / self.scene.contact.kn

    def pulled(self, k: int, y: Vector) -> float:
        """Its opposite."""
        return -self.pushed(k, y)

    def overlap(self, k: int, y: Vector) -> float:
        """The overlap of contact k."""
        return -self.gap(k, y)

    def reserve(self, k: int, sign: int, y: Vector) -> float:
        """How much further the shear spring of contact k can stretch in a direction."""
        return self.most(k, y) - sign * float(y[4 * self.n + k])

    def most(self, k: int, y: Vector) -> float:
        """How far the shear spring of contact k can stretch: up to mu times all that presses."""
        if self.scene.contact.eta_n > 0:
            return self.ratio * self.pushed(k, y)
        return -self.ratio * self.gap(k, y)

    def slip(self, k: int, sign: int, y: Vector) -> float:
        """How fast contact k slips in a direction, less what the change of the cap takes up."""
        i, normal, tangent, _ = self.walls[k]
        here, law = slice(2 * self.n + 2 * i, 2 * self.n + 2 * i + 2), self.scene.contact
        v, sinks = y[here], float(y[here] @ normal)
        if law.eta_n > 0:
            sinks += law.eta_n / law.kn * float(self.derivative(0.0, y)[here] @ normal)
        return sign * float(v @ tangent) + self.ratio * sinks

    def switch(self, k: int, after: int, y: Vector) -> None:
        """Put contact k into its next mode; one that closes slips at once if the cap is slower."""
        before, self.modes[k] = self.modes[k], after
        if k >= len(self.walls) or not self.rough or after in SIGN:
            return
        y[4 * self.n + k] = SIGN.get(before, 0) * self.most(k, y)
        if before == OPEN and not self.scene.contact.eta_n > 0:
            slipping = [mode for mode, sign in SIGN.items() if self.slip(k, sign, y) > 0]
            self.modes[k] = slipping[0] if slipping else STICK


def event_located(scene: Scene, times: Vector, step: float) -> Vector:
    """Displacements (times, n, 2) [m] at times from 0; `step` [s] bounds the steps."""
    plane = Plane(scene)
    t, y = 0.0, plane.start
    found = [y]
    for end in times[1:]:
        while t < end:
            t, y = _until_event(plane, t, y, float(end), step)
        found.append(y)
    return np.array(found)[:, : 2 * plane.n].reshape(len(times), plane.n, 2)


def _until_event(
    plane: Plane, t: float, y: Vector, end: float, step: float
) -> tuple[float, Vector]:
    """Integrate to the next event, or to `end`."""
    guards = plane.guards()
    solver = _solver(plane, t, y, end, step)
    while solver.status == "running":
        before = solver.y.copy()
        solver.step()
        falls = _falls(guards, solver.dense_output(), solver.t_old, solver.t)
        if falls:
            when, which = min(falls)
            exactly = _solver(plane, solver.t_old, before, when, step)  # not by interpolation
            while exactly.status == "running":
                exactly.step()
            plane.switch(*guards[which][:2], exactly.y)
            return when, exactly.y
    return end, solver.y


def _solver(plane: Plane, t: float, y: Vector, end: float, step: float) -> DOP853:
    return DOP853(plane.derivative, t, y, end, max_step=step, rtol=1e-12, atol=1e-14)


def _falls(
    guards: list[Guard], y: Callable[[Vector | float], Vector], start: float, end: float
) -> list[tuple[float, int]]:
    """When each guard that falls below zero within a step first does so."""
    t = np.linspace(start, end, SAMPLES)
    states = y(t).T
    found = []
    for which, (_, _, value) in enumerate(guards):

        def at(time: float, value: Callable[[Vector], float] = value) -> float:
            return value(y(time)) + SLACK

        seen = [value(state) + SLACK for state in states]
        for m in range(1, SAMPLES):
            low = t[m] if seen[m] < 0 else _minimum(seen[m - 1 : m + 2], t[m], t[1] - t[0])
            if low is not None and at(low) < 0:
                found.append((float(brentq(at, t[m - 1], low, xtol=1e-17, rtol=1e-15)), which))
                break
    return found


def _minimum(seen: list[float], t: float, apart: float) -> float | None:
    """Where a parabola through three values around t is least, None if the middle one is not."""
    if len(seen) < 3 or seen[1] >= min(seen[0], seen[2]):
        return None
    bend = seen[2] - 2 * seen[1] + seen[0]
    return t + apart * (seen[0] - seen[2]) / (2 * bend)
