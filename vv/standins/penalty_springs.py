"""Replaces blocks by spheres and rigid contact by penalty springs, for codes with springs."""

from __future__ import annotations

import dataclasses
import functools

import numpy as np

from vv.scene import Block, Harmonic, Scene, Spheres, Vector

TOUCHING = 1e-9  # a gap below this part of a block's size is a contact
STILL = 1e-12  # a slip below this part of the speeds of a body and its wall is rounding
# All codes and schemes need the stand-ins of the same frozen scenes, so that they are cached.
found_once = functools.lru_cache(maxsize=128)


def why_no_point(scene: Scene) -> str | None:
    """Why spheres without rotations cannot represent a scene's blocks; None if they can."""
    for block in scene.blocks:
        if block.free_spin.any():
            return f"block '{block.name}' may turn; a sphere would roll"
        if block.spin.any():
            return f"block '{block.name}' spins at a prescribed rate; a sphere would not"
        if block.elastic:
            return f"block '{block.name}' is elastic; a sphere in its place would be rigid"
        if len(scene.walls) != 1:
            return f"block '{block.name}' stands between {len(scene.walls)} walls; a sphere has one"
    if scene.blocks and len(scene.spheres):
        return "a block that may touch spheres has faces; a sphere in its place has none"
    return None


@found_once
def as_spheres(scene: Scene) -> Scene:
    """The scene with each block as a sphere at its centroid, with the block's gap to the wall.

    A block that cannot rotate and meets one wall, and no other block, moves as a point does. Raises
    ValueError with the reason if that is not so; whether blocks may meet each other is not checked.
    """
    reason = why_no_point(scene)
    if reason is not None:
        raise ValueError(reason)
    bodies = tuple(_sphere(g, scene) if isinstance(g, Block) else g for g in scene.bodies)
    return dataclasses.replace(scene, bodies=bodies)


def _sphere(block: Block, scene: Scene) -> Spheres:
    wall = scene.walls[0]
    centre = block.centroid()
    gap = float(((block.vertices - wall.point) @ wall.normal).min())
    size = float(np.ptp(block.vertices, axis=0).max())
    gap = 0.0 if abs(gap) < TOUCHING * size else gap
    return Spheres(
        position=centre[None],
        velocity=block.velocity[None],
        radius=np.array([float((centre - wall.point) @ wall.normal) - gap]),
        mass=np.array([block.mass]),
        free=block.free[None],
        load=block.load[None],
    )


def softened(scene: Scene, kn: float, shear: float = 1.0) -> Scene:
    """The scene with springs kn and ks = shear kn [N/m] in place of rigid contact.

    Spheres that touch a wall start with the overlap at which the spring balances the normal force
    at t = 0: weight, load, shaking, and the wall's own acceleration. Scenes whose contact has a
    stiffness are left as they are.
    """
    if not scene.contact.rigid:
        return scene
    ks = shear * kn if scene.contact.mu > 0 else 0.0
    contact = dataclasses.replace(scene.contact, kn=kn, ks=ks)
    bodies = tuple(
        _pressed(group, scene, kn) if isinstance(group, Spheres) else group
        for group in scene.bodies
    )
    return dataclasses.replace(scene, bodies=bodies, contact=contact)


def _pressed(spheres: Spheres, scene: Scene, kn: float) -> Spheres:
    position = np.array(spheres.position)
    field = scene.gravity + acceleration_of(scene.wave)
    for wall in scene.walls:
        gap = (position - wall.point) @ wall.normal - spheres.radius
        touching = np.abs(gap) <= TOUCHING * spheres.radius
        ground = base_acceleration(wall.motion)
        pressing = -(spheres.mass[:, None] * (field - ground) + spheres.load) @ wall.normal
        overlap = np.where(touching, np.maximum(pressing, 0.0) / kn, 0.0)
        position -= overlap[:, None] * wall.normal
    return dataclasses.replace(spheres, position=position)


def friction_at_start(scene: Scene) -> Vector:
    """The friction (n, 3) [N] that the wall exerts on each sphere in rigid contact at t = 0.

    A sphere that slips feels mu N against the slip; one at rest on the wall feels the force that
    keeps it there, at most mu N. A rigid scene does not define the initial force of the shear
    springs that represent it. From zero, a block on a slope would first accelerate until the spring
    holds it: it would then oscillate, or slide on too fast by an error of order kn^-1/2. With this
    initial force, springs are in the state to which they tend as they become rigid, with an error
    of order 1/kn. Raises ValueError unless there is one wall.
    """
    (wall,) = scene.walls
    s, n = scene.spheres, wall.normal
    field = scene.gravity + acceleration_of(scene.wave) - base_acceleration(wall.motion)
    needed = -(s.mass[:, None] * field + s.load)
    touching = np.abs((s.position - wall.point) @ n - s.radius) <= TOUCHING * s.radius
    cap = scene.contact.mu * np.where(touching, np.maximum(needed @ n, 0.0), 0.0)[:, None]
    ground = base_velocity(wall.motion)
    slip = _in_plane(s.velocity - ground, n, scene)
    speed = np.linalg.norm(slip, axis=1, keepdims=True)
    speeds = np.linalg.norm(s.velocity, axis=1, keepdims=True) + fastest(wall.motion)
    needed = _in_plane(needed, n, scene)
    size = np.linalg.norm(needed, axis=1, keepdims=True)
    resting = needed * np.minimum(1.0, cap / np.where(size > 0, size, 1.0))
    slipping = -cap * slip / np.where(speed > 0, speed, 1.0)
    return np.asarray(np.where(speed > STILL * speeds, slipping, resting))


def _in_plane(vectors: Vector, normal: Vector, scene: Scene) -> Vector:
    """The components (n, 3) of vectors along the wall and along the spheres' free directions."""
    along = vectors - np.outer(vectors @ normal, normal)
    return np.asarray((along @ scene.axes.T * scene.spheres.free) @ scene.axes)


def acceleration_of(shaking: Harmonic | None, t: float = 0.0) -> Vector:
    """The acceleration (3,) [m/s2] by shaking at time t [s]."""
    if shaking is None:
        return np.zeros(3)
    angle = 2 * np.pi * shaking.frequency * t + shaking.phase
    return np.asarray((shaking.amplitude * np.sin(angle)) @ shaking.axes)


def base_acceleration(motion: Harmonic | None, t: float = 0.0) -> Vector:
    """The acceleration (3,) [m/s2] of a wall with a prescribed motion at time t [s]."""
    if motion is None:
        return np.zeros(3)
    rate = 2 * np.pi * motion.frequency
    return np.asarray(
        (-(rate**2) * motion.amplitude * np.sin(rate * t + motion.phase)) @ motion.axes
    )


def base_velocity(motion: Harmonic | None, t: float = 0.0) -> Vector:
    """The velocity (3,) [m/s] of a wall with a prescribed motion at time t [s]."""
    if motion is None:
        return np.zeros(3)
    rate = 2 * np.pi * motion.frequency
    return np.asarray((rate * motion.amplitude * np.cos(rate * t + motion.phase)) @ motion.axes)


def fastest(motion: Harmonic | None) -> float:
    """An upper bound on the speed of a wall [m/s]."""
    if motion is None:
        return 0.0
    return float(2 * np.pi * np.abs(motion.frequency * motion.amplitude).sum())
