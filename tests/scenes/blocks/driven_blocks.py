"""One block on a plane, driven by gravity, shaking or its base; how far a path of it is off."""

from __future__ import annotations

import dataclasses

import numpy as np

from vv.scene import Block, Contact, Harmonic, Scene, Vector, Wall, box_geometry, polyhedron_inertia

G = 9.81
UP = np.array([0.0, 0.0, 1.0])
Free = tuple[bool, bool, bool]
TWO, THREE = (True, False, True), (True, True, True)


def box(axes: Vector, free: Free, velocity: Vector | float = 0.0) -> Block:
    """A cube of 1 m and 2500 kg/m3 on the plane through the origin whose normal is axes[2]."""
    vertices, faces = box_geometry(0.5 * axes[2], np.full(3, 0.5), axes)
    mass, inertia = polyhedron_inertia(vertices, faces, 2500.0)
    fixed = np.zeros(3, bool)
    start = np.broadcast_to(velocity, 3)
    return Block("box", vertices, faces, mass, inertia, start, np.array(free), fixed)


def slope(
    alpha: float, phi: float, shaking: Harmonic | None = None, v0: float = 0.0, free: Free = TWO
) -> Scene:
    """A block on an incline [degrees]; axes: down the dip, along the strike, out of the plane."""
    s, c = np.sin(np.radians(alpha)), np.cos(np.radians(alpha))
    axes = np.array([[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]])
    bodies = Wall(np.zeros(3), axes[2]), box(axes, free, v0 * axes[0])
    law = Contact(np.inf, mu=float(np.tan(np.radians(phi))))
    return Scene(bodies, law, gravity=-G * UP, axes=axes, shaking=shaking)


def sines(*amplitude_and_frequency: tuple[float, float]) -> Harmonic:
    given = np.array([*amplitude_and_frequency, *[(0.0, 1.0)] * (3 - len(amplitude_and_frequency))])
    return Harmonic(given[:, 0], given[:, 1])


def carried(*base: tuple[float, float], mu: float = 0.6, free: Free = TWO) -> Scene:
    """A block on a base that moves by D (1 - cos 2 pi f t) along x, y, z; base: D [m], f [Hz]."""
    motion = sines(*((-D, f) for D, f in base))
    motion = dataclasses.replace(motion, phase=np.full(3, np.pi / 2))
    bodies = Wall(np.zeros(3), UP, motion), box(np.eye(3), free)
    return Scene(bodies, Contact(np.inf, mu=mu), gravity=-G * UP)


def off(y: Vector, exact: Vector) -> float:
    """max|e| / max|y|, of vectors in the last axis where there is one."""
    norm = np.abs if y.ndim == 1 else lambda a: np.linalg.norm(a, axis=-1)
    return float(norm(y - exact).max() / norm(exact).max())
