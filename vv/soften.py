"""Rigid scenes for codes with springs: blocks as spheres, rigid contact as a penalty spring."""

from __future__ import annotations

import dataclasses

import numpy as np

from vv.scene import Block, Contact, Harmonic, Scene, Spheres, Vector

TOUCHING = 1e-9  # of a block's size: a gap below that is a contact


def why_no_point(scene: Scene) -> str | None:
    """Why a scene's blocks cannot be stood for by spheres that do not turn; None if they can."""
    for block in scene.blocks:
        if block.free_spin.any():
            return f"block '{block.name}' may turn; a sphere would roll"
        if len(scene.walls) != 1:
            return f"block '{block.name}' stands between {len(scene.walls)} walls; a sphere has one"
    if len(scene.blocks) + len(scene.spheres) > 1 and scene.blocks:
        return "blocks that may touch each other have faces; spheres have none"
    return None


def as_spheres(scene: Scene) -> Scene:
    """The scene with each block as a sphere at its centroid, with the block's gap to the wall.

    A block that cannot turn and meets one wall moves as a point does. Raises ValueError with the
    reason where that is not so.
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

    Spheres that touch a wall start where the spring carries what presses them on it at t = 0:
    weight, load, shaking, and the wall's own acceleration. Scenes whose contact has a stiffness
    are left as they are.
    """
    if np.isfinite(scene.contact.kn):
        return scene
    contact = Contact(kn, shear * kn if scene.contact.mu > 0 else 0.0, scene.contact.mu)
    bodies = tuple(
        _pressed(group, scene, kn) if isinstance(group, Spheres) else group
        for group in scene.bodies
    )
    return dataclasses.replace(scene, bodies=bodies, contact=contact)


def _pressed(spheres: Spheres, scene: Scene, kn: float) -> Spheres:
    position = np.array(spheres.position)
    field = scene.gravity + acceleration_of(scene.shaking)
    for wall in scene.walls:
        gap = (position - wall.point) @ wall.normal - spheres.radius
        touching = np.abs(gap) <= TOUCHING * spheres.radius
        ground = base_acceleration(wall.motion)
        pressing = -(spheres.mass[:, None] * (field - ground) + spheres.load) @ wall.normal
        overlap = np.where(touching, np.maximum(pressing, 0.0) / kn, 0.0)
        position -= overlap[:, None] * wall.normal
    return dataclasses.replace(spheres, position=position)


def acceleration_of(shaking: Harmonic | None, t: float = 0.0) -> Vector:
    """The body acceleration (3,) [m/s2] at a time."""
    if shaking is None:
        return np.zeros(3)
    angle = 2 * np.pi * shaking.frequency * t + shaking.phase
    return np.asarray((shaking.amplitude * np.sin(angle)) @ shaking.axes)


def base_acceleration(motion: Harmonic | None, t: float = 0.0) -> Vector:
    """The acceleration (3,) [m/s2] of a wall that moves as prescribed."""
    if motion is None:
        return np.zeros(3)
    rate = 2 * np.pi * motion.frequency
    return np.asarray(
        (-(rate**2) * motion.amplitude * np.sin(rate * t + motion.phase)) @ motion.axes
    )
