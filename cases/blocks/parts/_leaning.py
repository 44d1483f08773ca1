"""A block that leans about a corner: its shape, its centre, and its lean computed from a run."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from vv.ask import Displacement, Run, Velocity
from vv.scene import Block, Vector, polyhedron_inertia

CENTRE, MOVING = Displacement(1), Velocity(1)
DEEP, DENSITY = 0.3, 2500.0  # m, half the depth; kg/m3
OUTLINE = ((0, 1, 2, 3), (7, 6, 5, 4), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0))
Y = np.eye(3)[1]


@dataclass(frozen=True)
class Leaning:
    """A block of half sides b and h [m], which leans by `start` [rad] at t = 0."""

    b: float
    h: float
    start: float = 0.0

    @property
    def alpha(self) -> float:
        """The lean [rad] at which its centre is above its corner."""
        return math.atan2(self.b, self.h)

    @property
    def arm(self) -> float:
        """Distance from its centre to its corner [m]."""
        return math.hypot(self.b, self.h)

    def place(self, lean: Vector) -> Vector:
        """Where the centre is, (k, 2) along the floor and above it [m], at leans (k,) [rad]."""
        side, rest = np.where(lean < 0, -1.0, 1.0), self.alpha - np.abs(lean)
        sideways = side * (self.b - self.arm * np.sin(rest))
        return np.stack([sideways, self.arm * np.cos(rest)], axis=1)

    def initial_centre(self) -> Vector:
        """Where the centre is at t = 0, (2,) [m]."""
        return np.asarray(self.place(np.array([self.start]))[0])

    def block(self) -> Block:
        """The prism, which leans about its corner at x = b."""
        b, h = self.b, self.h
        upright = np.array([[-2 * b, 0.0], [0.0, 0.0], [0.0, 2 * h], [-2 * b, 2 * h]])
        c, s = math.cos(self.start), math.sin(self.start)
        flat = np.insert(upright @ np.array([[c, -s], [s, c]]) + [b, 0.0], 1, 0.0, axis=1)
        vertices = np.concatenate([flat - DEEP * Y, flat + DEEP * Y])
        mass, inertia = polyhedron_inertia(vertices, OUTLINE, DENSITY)
        return Block("block", vertices, OUTLINE, mass, inertia, np.zeros(3), free=Y == 0,
                     free_spin=Y != 0)  # fmt: skip

    def lean(self, run: Run) -> tuple[Vector, Vector]:
        """The lean (k,) [rad] and its rate [1/s], from the position and velocity of the centre."""
        x, z = (run.values[CENTRE][:, [0, 2]] + self.initial_centre()).T
        side = np.where(x < 0, -1.0, 1.0)
        rest = np.arctan2(self.b - side * x, z)
        v, up = run.values[MOVING][:, [0, 2]].T
        return side * (self.alpha - rest), (v * np.cos(rest) + side * up * np.sin(rest)) / self.arm
