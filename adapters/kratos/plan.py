"""Translates an ask for Kratos: spheres, walls as faces, dead loads for oblique locks."""

from __future__ import annotations

from typing import Any

import numpy as np

from vv.ask import Ask
from vv.codes import behind_wall, no_sphere, turned_spin_lock
from vv.scene import (
    Contact,
    Hertz,
    Scene,
    Vector,
    Wall,
    initial_normal_forces,
    why_locks_need_more_than_loads,
    with_loads_for_locks,
)

LEAST = 100.0  # in radii: the least half side of a face
SPAN = 3.0  # in sizes of the scene: the least half side of a face


def refusal(ask: Ask) -> str | None:
    """Why Kratos cannot represent an ask although it has every term; None if it can."""
    scene = ask.scene
    return (
        no_sphere(ask, scene)
        or _locked_spin(scene)
        or why_locks_need_more_than_loads(scene)
        or turned_spin_lock(scene, "Kratos locks its own axes only")
        or behind_wall(scene)
        or _no_material(scene.contact)
    )


def _locked_spin(scene: Scene) -> str | None:
    spheres = scene.spheres
    if np.where(spheres.free_spin, 0.0, spheres.spin @ scene.axes.T).any():
        return "a sphere has a spin in a locked freedom, which Kratos would maintain"
    return None


def _no_material(contact: Contact) -> str | None:
    """Why no material has the contact's elastic moduli; None if one has, or there are springs."""
    law = contact.hertz
    if law is None or (3 * law.shear_modulus < law.modulus and _poisson(law) < 0.5):
        return None
    return (
        "Kratos derives contacts from materials, and none with a possible Poisson's ratio has "
        "these moduli"
    )


def plan(ask: Ask) -> dict[str, Any]:
    """The input of the driver: numbers, lists and strings, in SI units and the scene's frame.

    Without friction the tangential springs have no effect, and any ks serves.
    """
    scene = with_loads_for_locks(ask.scene)
    contact, spheres = scene.contact, scene.spheres
    force = spheres.mass[:, None] * scene.gravity + spheres.load
    columns = {
        "position": spheres.position,
        "velocity": spheres.velocity,
        "spin": spheres.spin,
        "radius": spheres.radius,
        "mass": spheres.mass,
        "inertia": spheres.inertia,
        "force": force,
        "start": force + initial_normal_forces(scene),
        "free": spheres.free,
        "free_spin": spheres.free_spin,
    }
    rows = zip(*(column.tolist() for column in columns.values()), strict=True)
    half = _half(ask, scene)
    return {
        "dt": ask.dt,
        "steps": ask.goal.steps(ask.dt),
        "stride": ask.goal.stride(ask.dt),
        "law": _springs(contact) if contact.hertz is None else _moduli(contact.hertz),
        "mu": float(contact.mu) if contact.carries_shear else 0.0,
        "spheres": [dict(zip(columns, row, strict=True)) for row in rows],
        "walls": [_corners(wall, half, scene).tolist() for wall in scene.walls],
        "observe": [
            [type(seen).__name__.lower(), scene.sphere_index(seen.body)] for seen in ask.observables
        ],
    }


def _springs(contact: Contact) -> dict[str, float]:
    return {"kn": contact.kn, "ks": contact.ks if contact.carries_shear else contact.kn}


def _moduli(hertz: Hertz) -> dict[str, float]:
    """Young's modulus [Pa] and Poisson's ratio of spheres and walls that give the contact's moduli.

    For two bodies of one material 1/E is 2 (1 - nu^2)/Young, and 1/G is 4 (2 - nu)(1 + nu)/Young.
    """
    poisson = _poisson(hertz)
    return {"young": 2.0 * hertz.modulus * (1.0 - poisson**2), "poisson": poisson}


def _poisson(hertz: Hertz) -> float:
    """Poisson's ratio, by G/E = (1 - nu)/(4 - 2 nu); 0 without tangential stiffness."""
    ratio = hertz.shear_modulus / hertz.modulus or 0.25
    return (1.0 - 4.0 * ratio) / (1.0 - 2.0 * ratio)


def _half(ask: Ask, scene: Scene) -> float:
    """Half the sides [m] of faces: far beyond where spheres can come in free flight."""
    spheres, t = scene.spheres, ask.goal.duration
    speed = float(np.linalg.norm(spheres.velocity, axis=1).max())
    pull = np.linalg.norm(scene.gravity + spheres.load / spheres.mass[:, None], axis=1).max()
    size = float(np.ptp(spheres.position, axis=0).max()) + LEAST * float(spheres.radius.max())
    return SPAN * (size + speed * t + 0.5 * float(pull) * t**2)


def _corners(wall: Wall, half: float, scene: Scene) -> Vector:
    """Corners (4, 3) of a face about the point of a wall closest to the spheres."""
    middle = scene.spheres.position.mean(axis=0)
    foot = middle - ((middle - wall.point) @ wall.normal) * wall.normal
    along = np.eye(3)[np.abs(wall.normal).argmin()]
    first = along - (along @ wall.normal) * wall.normal
    first /= np.linalg.norm(first)
    second = np.cross(wall.normal, first)
    turns = ((-1, -1), (1, -1), (1, 1), (-1, 1))
    return np.array([foot + half * (a * first + b * second) for a, b in turns])
