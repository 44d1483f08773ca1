"""Scenes of rigid boxes for the tests of the block engines."""

from __future__ import annotations

from typing import Any

import numpy as np

from vv.scene import Block, Contact, Harmonic, Scene, Vector, Wall, box_geometry, polyhedron_inertia

G = 9.81
DOWN = np.array([0.0, 0.0, -G])
FLOOR = Wall(np.zeros(3), np.array([0.0, 0.0, 1.0]))
HELD, FREE = np.zeros(3, bool), np.ones(3, bool)
ACROSS = np.array([False, True, False])  # spin about the depth of a plane scene in x and z
IN_PLANE = np.array([True, False, True])


def box(name: str, centre: Any, half: Any, axes: Any = None, **given: Any) -> Block:
    """A uniform box of 1000 kg/m3, free in everything unless told otherwise."""
    turned = np.eye(3) if axes is None else np.asarray(axes, float)
    vertices, faces = box_geometry(np.asarray(centre, float), np.asarray(half, float), turned)
    mass, inertia = polyhedron_inertia(vertices, faces, 1000.0)
    data: dict[str, Any] = {"velocity": np.zeros(3), "free": FREE, "free_spin": FREE, **given}
    return Block(name, vertices, faces, mass, inertia, **data)


def slope(alpha: float) -> tuple[Vector, Wall]:
    """Axes (3, 3) down the dip, along the strike and normal, and the plane [degrees]."""
    a = np.radians(alpha)
    normal, dip = np.array([np.sin(a), 0.0, np.cos(a)]), np.array([np.cos(a), 0.0, -np.sin(a)])
    return np.array([dip, np.cross(normal, dip), normal]), Wall(np.zeros(3), normal)


def incline(
    alpha: float,
    phi: float,
    shaking: Harmonic | None = None,
    v0: float = 0.0,
    half: Any = (0.5, 0.5, 0.5),
    **given: Any,
) -> Scene:
    """A box on a slope; friction angle phi [degrees]; v0 down the dip [m/s]."""
    axes, wall = slope(alpha)
    block = box("block", half[2] * axes[2], half, axes, velocity=v0 * axes[0], **given)
    friction = Contact(np.inf, mu=np.tan(np.radians(phi)))
    return Scene((wall, block), friction, gravity=DOWN, axes=axes, shaking=shaking)


def responding(amplitude: Any, frequency: Any, mu: float, **given: Any) -> Scene:
    """A box on a base whose displacement is amplitude (1 - cos 2 pi f t) along x, y, z."""
    motion = Harmonic(amplitude, frequency, np.full(3, -np.pi / 2))
    base = Wall(np.zeros(3), np.array([0.0, 0.0, 1.0]), motion)
    block = box("block", [0.0, 0.0, 0.5], [0.5, 0.5, 0.5], **given)
    return Scene((base, block), Contact(np.inf, mu=mu), gravity=DOWN)


def running_bond(
    columns: int, courses: int, amplitude: float = 0.0, frequency: float = 1.0
) -> Scene:
    """A dry wall on a base that may shake it along; half blocks end every second course.

    Blocks of 0.4 x 0.3 x 0.2 m, friction 0.6; the base moves by amplitude (1 - cos 2 pi f t).
    """
    blocks = []
    for course in range(courses):
        lengths = np.full(columns, 0.4) if course % 2 == 0 else np.full(columns + 1, 0.4)
        if course % 2:
            lengths[[0, -1]] = 0.2
        middles = np.cumsum(lengths) - lengths / 2
        for i, (length, x) in enumerate(zip(lengths, middles, strict=True)):
            centre = [x, 0.0, 0.2 * course + 0.1]
            blocks.append(box(f"{course}-{i}", centre, [length / 2, 0.15, 0.1]))
    along = np.array([1.0, 0.0, 0.0])
    motion = Harmonic(amplitude * along, frequency * along, np.full(3, -np.pi / 2))
    base = Wall(FLOOR.point, FLOOR.normal, motion if amplitude else None)
    return Scene((base, *blocks), Contact(np.inf, mu=0.6), gravity=DOWN)
