"""The scene of an oblique impact on a wall of a spring, a dashpot and friction."""

from __future__ import annotations

import dataclasses
from math import sqrt

import numpy as np

from reference_solutions.contact.oblique_dashpot import Impact
from vv.scene import Contact, Harmonic, Scene, Spheres, Wall

RADIUS = 0.1
UP = np.array([0.0, 1.0, 0.0])


def oblique(impact: Impact) -> Scene:
    """A sphere that does not turn, thrown at t = 0 where it touches the wall."""
    sphere = Spheres(
        RADIUS * UP[None], np.array([[impact.along, -impact.v, 0.0]]), np.array([RADIUS]),
        np.array([impact.m]), np.array([[True, True, False]]),
    )  # fmt: skip
    viscous = 2 * impact.z * sqrt(impact.kn * impact.m)
    return Scene((Wall(0 * UP, UP), sphere), Contact(impact.kn, impact.ks, impact.mu, viscous))


def on_moving_wall(scene: Scene, wave: Harmonic) -> Scene:
    """The same with a wall that moves."""
    wall, *others = scene.bodies
    assert isinstance(wall, Wall)
    return dataclasses.replace(scene, bodies=(dataclasses.replace(wall, motion=wave), *others))


def seen_from_it(scene: Scene, wave: Harmonic) -> Scene:
    """What a wall that moves so would see: itself at rest, and all else shaken."""
    wall, spheres = scene.bodies
    assert isinstance(spheres, Spheres)
    quick = 2 * np.pi * wave.frequency
    start = (quick * wave.amplitude * np.cos(wave.phase)) @ wave.axes
    slower = dataclasses.replace(spheres, velocity=spheres.velocity - start)
    shaking = Harmonic(wave.amplitude * quick**2, wave.frequency, wave.phase, wave.axes)
    return dataclasses.replace(scene, bodies=(wall, slower), shaking=shaking)
