"""Scenes made from scenes: the same physics elsewhere, or in other lengths, times and masses."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np

from vv.scene import Block, Contact, Harmonic, Scene, Spheres, Vector, Wall

POWERS = {  # of the units of length, time and mass in what a scene is made of
    "position": (1, 0, 0),
    "vertices": (1, 0, 0),
    "point": (1, 0, 0),
    "radius": (1, 0, 0),
    "length": (1, 0, 0),
    "velocity": (1, -1, 0),
    "spin": (0, -1, 0),
    "mass": (0, 0, 1),
    "inertia": (2, 0, 1),
    "load": (1, -2, 1),
    "kn": (0, -2, 1),
    "ks": (0, -2, 1),
    "tension": (1, -2, 1),
    "shear": (1, -2, 1),
    "eta": (0, -1, 1),
    "eta_n": (0, -1, 1),
    "gravity": (1, -2, 0),
    "young": (-1, -2, 1),
    "modulus": (-1, -2, 1),
    "shear_modulus": (-1, -2, 1),
    "density": (-3, 0, 1),
    "viscosity": (-1, -1, 1),
    "frequency": (0, -1, 0),
}
SHAKEN, MOVED = (1, -2, 0), (1, 0, 0)  # of an amplitude, which is an acceleration or a length


def shifted(scene: Scene, by: Vector) -> Scene:
    """The scene moved as a whole by a vector (3,) [m]."""
    return dataclasses.replace(scene, bodies=tuple(_shifted(group, by) for group in scene.bodies))


def _shifted(group: Spheres | Wall | Block, by: Vector) -> Spheres | Wall | Block:
    if isinstance(group, Wall):
        return dataclasses.replace(group, point=group.point + by)
    place = "vertices" if isinstance(group, Block) else "position"
    return dataclasses.replace(group, **{place: getattr(group, place) + by})


def rescaled(scene: Scene, length: float, time: float, mass: float) -> Scene:
    """The same physics in a world whose lengths, times and masses are so many times as large."""
    units = length, time, mass
    bodies = tuple(_body(group, units) for group in scene.bodies)
    scaled: Scene = dataclasses.replace(
        _rescaled(scene, units),
        bodies=bodies,
        contact=_contact(scene.contact, units),
        shaking=_in_units(scene.wave, units, SHAKEN),
        bonds=scene.bonds and _rescaled(scene.bonds, units),
        fluid=scene.fluid and _rescaled(scene.fluid, units),
    )
    return scaled


def _body(group: Spheres | Wall | Block, units: tuple[float, ...]) -> Any:
    scaled = _rescaled(group, units)
    if isinstance(group, Wall):
        return dataclasses.replace(scaled, motion=_in_units(group.motion, units, MOVED))
    if isinstance(group, Block) and group.elastic:
        return dataclasses.replace(scaled, elastic=_rescaled(group.elastic, units))
    return scaled


def _contact(contact: Contact, units: tuple[float, ...]) -> Contact:
    scaled: Contact = _rescaled(contact, units)
    return dataclasses.replace(scaled, hertz=contact.hertz and _rescaled(contact.hertz, units))


def _in_units(
    motion: Harmonic | None, units: tuple[float, ...], powers: tuple[int, ...]
) -> Harmonic | None:
    if motion is None:
        return None
    amplitude = motion.amplitude * _factor(units, powers)
    scaled: Harmonic = dataclasses.replace(_rescaled(motion, units), amplitude=amplitude)
    return scaled


def _rescaled(part: Any, units: tuple[float, ...]) -> Any:
    """A dataclass with every field that has units multiplied by what they make of it."""
    names = [field.name for field in dataclasses.fields(part) if field.name in POWERS]
    changed = {name: getattr(part, name) * _factor(units, POWERS[name]) for name in names}
    return dataclasses.replace(part, **changed)


def _factor(units: tuple[float, ...], powers: tuple[int, ...]) -> float:
    """What a quantity of these powers of length, time and mass is multiplied by."""
    return float(np.prod([unit**power for unit, power in zip(units, powers, strict=True)]))
