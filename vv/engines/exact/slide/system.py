"""Builds the equations of motion of a body that slips on a rigid wall, in one or two directions."""

from __future__ import annotations

import functools
from dataclasses import dataclass
from typing import Any

import numpy as np

from vv.ask import Model
from vv.engines.exact.modelled import check_spheres, check_terms, count_in_words
from vv.engines.exact.reachability import (
    DIRECTION_ROUNDING,
    PossibleContact,
    RefusedError,
    possible_contacts,
    scaled,
    span,
)
from vv.scene import Harmonic, Scene, Vector
from vv.standins.penalty_springs import as_spheres


@dataclass(frozen=True, eq=False)
class Slider:
    """A body on a wall with one unknown, its displacement along the line on which it slips.

    names: body numbers of the wall and of the body; mass [kg]; mu; normal, along: (3,) unit
    vectors out of the wall and along the slip; speed: of the body along the slip at t = 0 [m/s];
    sign: of the slip at t = 0, 0 if the body moves with the wall; gravity (3,) [m/s2]; load (3,)
    [N]. The k sines have frequency [Hz] and phase [rad], (k,); shaking (k, 3) [m/s2] are their
    amplitudes in the acceleration of the body, and base (k, 3) [m] those in the displacement of
    the wall, restricted to the directions in which it acts on the body.

    A row (1 + k,) [m/s2] represents row[0] + row[1:] @ sines. A body that slips along sigma has
    the acceleration drive - sigma mu pressing. It sticks while |relative_drive| <= mu pressing,
    where relative_drive is drive minus the acceleration of the wall.
    """

    names: tuple[int, int]
    mass: float
    mu: float
    normal: Vector
    along: Vector
    speed: float
    sign: int
    gravity: Vector
    load: Vector
    frequency: Vector
    phase: Vector
    shaking: Vector
    base: Vector

    @functools.cached_property
    def drive(self) -> Vector:
        """The acceleration of the body along the slip without friction, as a row."""
        return forces(self) @ self.along

    @functools.cached_property
    def relative_drive(self) -> Vector:
        """The same relative to the wall."""
        return (forces(self) - ground(self)) @ self.along

    @functools.cached_property
    def pressing(self) -> Vector:
        """Contact pressure over the mass of the body, as a row."""
        return (ground(self) - forces(self)) @ self.normal


@dataclass(frozen=True, eq=False)
class TurningSlider:
    """A body on a wall whose slip can change direction, with two unknowns: its slip on the wall.

    Other attributes than those of Slider: axes (2, 3), unit vectors that span the wall; slip (2,)
    [m/s], the velocity relative to the wall at t = 0 along them.
    """

    names: tuple[int, int]
    mass: float
    mu: float
    normal: Vector
    axes: Vector
    slip: Vector
    gravity: Vector
    load: Vector
    frequency: Vector
    phase: Vector
    shaking: Vector
    base: Vector

    @functools.cached_property
    def relative_drive(self) -> Vector:
        """The acceleration relative to the wall without friction, as rows (2, 1 + k)."""
        return ((forces(self) - ground(self)) @ self.axes.T).T

    @functools.cached_property
    def pressing(self) -> Vector:
        """Contact pressure over the mass of the body, as a row."""
        return (ground(self) - forces(self)) @ self.normal


def forces(slider: Slider | TurningSlider) -> Vector:
    """The constant acceleration of the body and the amplitudes of its sines, (1 + k, 3) [m/s2]."""
    return np.vstack((slider.gravity + slider.load / slider.mass, slider.shaking))


def ground(slider: Slider | TurningSlider) -> Vector:
    """The same for the acceleration of the wall, (1 + k, 3) [m/s2]."""
    omega = 2 * np.pi * slider.frequency
    return np.vstack((np.zeros(3), -(omega[:, None] ** 2) * slider.base))


def assemble_slider(scene: Scene) -> Slider | TurningSlider:
    """The equations of motion of a scene; raises RefusedError if they are not of this kind."""
    check_terms(scene)
    try:
        scene = as_spheres(scene)
    except ValueError as reason:
        raise RefusedError(str(reason)) from None
    check_spheres(scene)
    contact = _closed_contact(scene)
    spheres, wall = scene.spheres, scene.walls[0]
    free = scene.axes[spheres.free[0]]
    shaking, base = _sines(scene.wave), _sines(wall.motion)
    axes = _directions(scene, contact, shaking[2], base[2])
    felt = [contact.normal, *axes] if scene.contact.mu > 0 else [contact.normal]
    _check_held(contact, axes, free, base[2])
    carried = base[2] @ np.transpose(felt) @ np.array(felt)
    slip = _slip(scene, contact, axes, base, carried)
    shared: dict[str, Any] = {
        "names": contact.names,
        "mass": float(spheres.mass[0]),
        "mu": scene.contact.mu,
        "normal": contact.normal,
        "gravity": scene.gravity,
        "load": spheres.load[0],
        "frequency": np.concatenate((shaking[0], base[0])),
        "phase": np.concatenate((shaking[1], base[1])),
        "shaking": np.vstack((shaking[2], 0 * base[2])),
        "base": np.vstack((0 * shaking[2], carried)),
    }
    if len(axes) == 2:
        return TurningSlider(axes=axes, slip=slip, **shared)
    speed = float(spheres.velocity[0] @ axes[0])
    return Slider(along=axes[0], speed=speed, sign=int(np.sign(slip[0])), **shared)


def describe_slider(scene: Scene, slider: Slider | TurningSlider) -> Model:
    """The model that a slider is."""
    freedoms = count_in_words(scene.unknowns(), "freedom")
    contact = "1 rigid contact with constant normal"
    sines = count_in_words(len(slider.phase), "sine")
    if isinstance(slider, Slider):
        note = f"1 displacement along a fixed direction, out of {freedoms}; {contact}; {sines}"
        return Model(1, scene.terms(), note)
    note = f"2 displacements in the plane of the wall, out of {freedoms}; {contact}; {sines}"
    return Model(2, scene.terms(), note)


Sines = tuple[Vector, Vector, Vector]  # frequencies (k,), phases (k,), amplitudes (k, 3)


def _sines(motion: Harmonic | None) -> Sines:
    """The sines of a motion with an amplitude other than zero."""
    if motion is None:
        return np.zeros(0), np.zeros(0), np.zeros((0, 3))
    there = motion.amplitude != 0
    amplitude = motion.amplitude[:, None] * motion.axes
    return motion.frequency[there], motion.phase[there], amplitude[there]


def _closed_contact(scene: Scene) -> PossibleContact:
    """The contact of one body with one wall, closed at t = 0; raises RefusedError otherwise."""
    bodies, walls = len(scene.spheres), len(scene.walls)
    if (bodies, walls) != (1, 1):
        raise RefusedError(
            "rigid contact is solved for one body on one wall; the scene has "
            f"bodies: {bodies}, walls: {walls}"
        )
    (contact,) = possible_contacts(scene)
    pair = "bodies {} and {}".format(*contact.names)
    if contact.gap > 0:
        raise RefusedError(f"{pair} are {contact.gap:.6g} m apart at t = 0; they must touch")
    if contact.gap < 0:
        raise RefusedError(f"{pair} overlap by {-contact.gap:.6g} m at t = 0; rigid bodies cannot")
    return contact


def _directions(scene: Scene, contact: PossibleContact, shaking: Vector, base: Vector) -> Vector:
    """Unit directions (d, 3) that span the slip of the body; any tangent if it cannot slip.

    Without friction, the tangential motion of the wall does not act on the body.
    """
    spheres = scene.spheres
    free = scene.axes[spheres.free[0]]
    weight, load = spheres.mass[0] * scene.gravity, spheres.load[0]
    size = float(np.linalg.norm(weight) + np.linalg.norm(load))
    pulls = [spheres.velocity[0], *shaking]
    causes = np.array([scaled(weight + load, size), *map(scaled, pulls)]) @ free.T @ free
    if scene.contact.mu > 0:
        causes = np.vstack((causes, *map(scaled, base)))
    across = causes - np.outer(causes @ contact.normal, contact.normal)
    found = span(across, contact.rounding)
    if len(found):
        return found
    if _negligible(base @ contact.normal, base):
        raise RefusedError("nothing in the scene moves")
    return np.asarray(np.linalg.svd(contact.normal[None])[2][1:2])


def _check_held(contact: PossibleContact, axes: Vector, free: Vector, base: Vector) -> None:
    """Refuse a body that is locked along the normal, or along a slip that the wall causes."""
    reason = "body {1} is locked {what} body {0}; the {force} force is not determined"
    if _outside(contact.normal, free, contact.rounding):
        raise RefusedError(reason.format(*contact.names, what="normal to", force="normal"))
    for along in axes:
        held = _outside(along, free, contact.rounding)
        if held and not _negligible(base @ along, base):
            raise RefusedError(
                reason.format(*contact.names, what="along the slip of", force="friction")
            )


def _outside(vector: Vector, free: Vector, rounding: float) -> bool:
    """Whether a unit vector lies outside the span of orthonormal rows, by more than rounding."""
    return bool(np.linalg.norm(vector - vector @ free.T @ free) > rounding)


def _negligible(parts: Vector, vectors: Vector) -> bool:
    """Whether parts (k,) of vectors (k, 3) are no more than rounding."""
    return bool((np.abs(parts) <= DIRECTION_ROUNDING * np.linalg.norm(vectors, axis=1)).all())


def _slip(
    scene: Scene, contact: PossibleContact, axes: Vector, base: Sines, carried: Vector
) -> Vector:
    """The velocity of slip (d,) [m/s] at t = 0 along axes (d, 3); zero if it is only rounding.

    Raises RefusedError if the body does not stay on the wall.
    """
    velocity, rates = scene.spheres.velocity[0], 2 * np.pi * base[0][:, None] * carried
    relative = velocity - np.cos(base[1]) @ rates
    rounding = DIRECTION_ROUNDING * (np.abs(velocity).sum() + np.abs(rates).sum())
    leaving, slip = float(relative @ contact.normal), axes @ relative
    if abs(leaving) > rounding:
        how = "leave each other" if leaving > 0 else "meet"
        raise RefusedError(
            "bodies {} and {} {how} at {:.6g} m/s at t = 0".format(
                *contact.names, abs(leaving), how=how
            )
        )
    return np.asarray(slip if np.linalg.norm(slip) > rounding else 0 * slip)
