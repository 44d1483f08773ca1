"""Blocks that rigid contact keeps on a wall, in any frame, and a second route to their motion."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from vv.scene import (
    Block,
    Contact,
    Harmonic,
    Mask,
    Scene,
    Vector,
    Wall,
    box_geometry,
    polyhedron_inertia,
)

G = 9.81
FREE, LOCKED = np.ones(3, bool), np.zeros(3, bool)


@dataclass(frozen=True)
class Frame:
    """Where a slope of alpha [degrees] faces: turned about z [rad], its dip mirrored or not."""

    alpha: float
    turn: float = 0.0
    mirrored: bool = False

    @property
    def level(self) -> Vector:
        """The horizontal direction (3,) towards which the slope falls."""
        sign = -1.0 if self.mirrored else 1.0
        return sign * np.array([np.cos(self.turn), np.sin(self.turn), 0.0])

    @property
    def dip(self) -> Vector:
        """The direction (3,) straight down the slope."""
        a = np.radians(self.alpha)
        return np.asarray(np.cos(a) * self.level - np.sin(a) * np.array([0.0, 0.0, 1.0]))

    @property
    def normal(self) -> Vector:
        """Out of the slope (3,)."""
        a = np.radians(self.alpha)
        return np.asarray(np.sin(a) * self.level + np.cos(a) * np.array([0.0, 0.0, 1.0]))

    @property
    def axes(self) -> Vector:
        """Rows: dip, strike and normal."""
        return np.array([self.dip, np.cross(self.normal, self.dip), self.normal])


def block(frame: Frame, velocity: Vector, free: Mask = FREE, **changed: object) -> Block:
    """A box of 2500 kg/m3 whose base lies on the slope."""
    half = np.array([0.5, 0.3, 0.4])
    centre = frame.normal * half[2] + 3 * frame.dip
    vertices, faces = box_geometry(centre, half, frame.axes)
    mass, inertia = polyhedron_inertia(vertices, faces, 2500.0)
    data = {"free_spin": LOCKED, **changed}
    return Block("box", vertices, faces, mass, inertia, velocity, free, **data)  # type: ignore[arg-type]


def wall(frame: Frame, motion: Harmonic | None = None) -> Wall:
    return Wall(np.zeros(3), frame.normal / np.linalg.norm(frame.normal), motion)


def incline(frame: Frame, phi: float, A: float = 0.0, f: float = 1.0, v0: float = 0.0) -> Scene:
    """A block on a slope of friction angle phi [degrees], shaken horizontally, moving at v0."""
    level = np.array([frame.level, np.cross([0, 0, 1], frame.level), [0, 0, 1]])
    shaking = Harmonic((A, 0, 0), (f, f, f), axes=level) if A else None  # type: ignore[arg-type]
    law = Contact(np.inf, mu=float(np.tan(np.radians(phi))))
    gravity = np.array([0.0, 0.0, -G])
    bodies = (wall(frame), block(frame, v0 * frame.dip))
    return Scene(bodies, law, gravity=gravity, shaking=shaking)


def responding(D: float, f: float, mu: float, turn: float = 0.0) -> Scene:
    """A block on a level wall that moves by D (1 - cos 2 pi f t)."""
    frame = Frame(0.0, turn)
    phase = np.full(3, -np.pi / 2)
    motion = Harmonic((D, 0, 0), (f, f, f), phase, frame.axes)  # type: ignore[arg-type]
    bodies = (wall(frame, motion), block(frame, np.zeros(3)))
    return Scene(bodies, Contact(np.inf, mu=mu), gravity=np.array([0.0, 0.0, -G]))


def random_scene(seed: int) -> tuple[Scene, Frame]:
    """A slope that moves along its dip and normal, with shaking, a load and a start of its own."""
    r = np.random.default_rng(seed)
    frame = Frame(r.uniform(0, 35), r.uniform(0, 6.3), bool(r.integers(2)))
    f = r.uniform(0.5, 4.0, 6)
    along, across = r.uniform(1, 6) / (2 * np.pi * f[0]) ** 2, 1.5 / (2 * np.pi * f[2]) ** 2
    phase = r.uniform(0, 6.3, 3)
    motion = Harmonic((along, 0, across), f[:3], phase, frame.axes)  # type: ignore[arg-type]
    shaking = Harmonic((r.uniform(0, 6), 0, 1.5), f[3:], r.uniform(0, 6.3, 3), frame.axes)  # type: ignore[arg-type]
    start = 2 * np.pi * across * f[2] * np.cos(phase[2]) * frame.normal
    start += r.uniform(-0.5, 0.5) * frame.dip
    held = r.integers(2)
    free = np.array([True, not held, True])
    box = block(frame, start, free, load=r.uniform(-3000, 3000) * frame.dip - 2000 * frame.normal)
    law = Contact(np.inf, mu=r.uniform(0.1, 1.0))
    gravity = np.array([0.0, 0.0, -G])
    bodies = (wall(frame, motion), box)
    return Scene(bodies, law, 0.0, gravity, frame.axes, shaking), frame


def by_scipy(scene: Scene, frame: Frame, times: Vector) -> Vector:
    """The displacement (t, 3) of the block: scipy from event to event in the frame of the wall."""
    (box,), motion, mu = scene.blocks, scene.walls[0].motion, scene.contact.mu

    def pull_and_press(t: float) -> tuple[float, float]:
        field = scene.gravity + box.load / box.mass + _sum(scene.wave, t, 0) - _sum(motion, t, 2)
        return float(field @ frame.dip), -float(field @ frame.normal)

    def slack(t: float) -> float:
        pull, press = pull_and_press(t)
        return mu * press - abs(pull)

    t, w, s, found = 0.0, float((box.velocity - _sum(motion, 0.0, 1)) @ frame.dip), 0.0, []
    while t < times[-1]:
        if w == 0 and slack(t) > 0:
            end = _end_of_rest(slack, t, times[-1])
            found += [(x, s) for x in times if t <= x <= end]
            t = end + 1e-8  # where the slip is under way, and has moved by nothing
            continue
        # a first step short of any slip: scipy takes a start from rest for its end
        sign = np.sign(w or pull_and_press(t)[0])

        def rate(t: float, y: Vector, sign: float = sign) -> list[float]:
            pull, press = pull_and_press(t)
            return [y[1], pull - sign * mu * press]

        def stops(t: float, y: Vector, sign: float = sign) -> float:
            return float(sign * y[1])

        stops.terminal, stops.direction = True, -1  # type: ignore[attr-defined]
        run = solve_ivp(
            rate, (t, times[-1]), [s, w], "DOP853", events=stops, dense_output=True,
            rtol=1e-12, atol=1e-13, max_step=0.01, first_step=min(1e-4, times[-1] - t),
        )  # fmt: skip
        path: Callable[[float], Vector] = run.sol
        found += [(x, float(path(x)[0])) for x in times if t <= x <= run.t[-1]]
        t, s, w = float(run.t[-1]), float(run.y[0, -1]), 0.0
    slip = dict(found)
    moved = [_sum(motion, x, 0) - _sum(motion, 0.0, 0) + slip[x] * frame.dip for x in times]
    return np.array(moved)


def _end_of_rest(slack: Callable[[float], float], begin: float, last: float) -> float:
    """When friction first has no slack left; the last time if it always has."""
    grid = np.linspace(begin, last, 4000)
    low = next((i for i, x in enumerate(grid) if slack(x) < 0), None)
    return last if low is None else float(brentq(slack, grid[low - 1], grid[low], xtol=1e-15))


def _sum(motion: Harmonic | None, t: float, order: int) -> Vector:
    """A motion or one of its derivatives, (3,)."""
    if motion is None:
        return np.zeros(3)
    omega = 2 * np.pi * motion.frequency
    angle = omega * t + motion.phase + order * np.pi / 2
    return np.asarray((motion.amplitude * omega**order * np.sin(angle)) @ motion.axes)
