"""Tiny scenes of a sphere without contact: gravity, loads, locks, drag, shaking."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable

import numpy as np

from vv.codes.tiny_scenes.tiny_scene import (
    KN,
    MASS,
    PLACE,
    RADIUS,
    Motion,
    Terms,
    TinyScene,
    Y,
    Z,
    along,
    both,
    sphere,
    steady,
    thrown,
)
from vv.scene import Contact, Fluid, Harmonic, Pulse, Scene, Term, Vector, Wall

ETA = 6.0  # N s/m
FLUID = Fluid(density=50.0, viscosity=2.0)  # kg/m3, Pa s: a Reynolds number of 19 at first
POINTS = 30  # steps of the integration
THROWN = np.array([1.0, 2.0, 3.0])  # m/s
PULL = np.array([-4.0, -10.0, 6.0])  # m/s2
LOAD = np.array([9.0, -6.0, 12.0])  # N
TURNED = np.array([[0.6, 0.0, 0.8], [0.0, 1.0, 0.0], [-0.8, 0.0, 0.6]])  # axes of locks
SHAKEN = np.array([30.0, -40.0, 20.0])  # m/s2
FREQUENCY, PHASE, UNTIL = 1.5, 0.7, 0.5  # Hz, rad, s


def flight(terms: Terms) -> TinyScene:
    """A thrown sphere, with gravity if the scheme has it."""
    pull = _pull(terms)
    scene = Scene((sphere(THROWN),), Contact(KN), gravity=pull)
    wrong = {
        "gravity is left out": steady(THROWN),
        "gravity is reversed": thrown(-PULL, THROWN),
        "gravity is taken twice": thrown(2 * PULL, THROWN),
        "gravity is a force, not an acceleration": thrown(PULL / MASS, THROWN),
    }
    return TinyScene("free flight", scene, 1.0, thrown(pull, THROWN), wrong if pull.any() else {})


def laden(terms: Terms) -> TinyScene:
    """A thrown sphere under a dead load."""
    body = dataclasses.replace(sphere(THROWN), load=LOAD[None])
    wrong = {
        "the load is left out": steady(THROWN),
        "the load is reversed": thrown(-LOAD / MASS, THROWN),
        "the load is taken twice": thrown(2 * LOAD / MASS, THROWN),
        "the load is an acceleration, not a force": thrown(LOAD, THROWN),
    }
    scene = Scene((body,), Contact(KN))
    return TinyScene("dead load", scene, 1.0, thrown(LOAD / MASS, THROWN), wrong)


def lock(terms: Terms) -> TinyScene:
    """A sphere that is free along y only, with a transverse load, or else the force of a wall."""
    free, speed, pull = Y > 0, 2.0 * Y, _pull(terms)
    if pull.any():
        scene = Scene((sphere(speed, free),), Contact(KN), gravity=pull)
        kept, loose = thrown(pull * free, speed), thrown(pull, speed)
        return TinyScene("lock", scene, 1.0, kept, {"the lock is not kept": loose})
    depth = 0.01
    scene = Scene((Wall(PLACE - (RADIUS - depth) * Z, Z), sphere(speed, free)), Contact(KN))
    return TinyScene("lock", scene, 0.15, steady(speed))


def oblique(terms: Terms) -> TinyScene:
    """A sphere that is free along one oblique direction only, with a transverse force."""
    way, pull = TURNED[0], _pull(terms)
    body = sphere(way, np.array([True, False, False]))
    scene = Scene((body,), Contact(KN), gravity=pull, axes=TURNED)
    kept = thrown(float(pull @ way) * way, way)
    wrong = {"the lock is not kept": thrown(pull, way)} if pull.any() else {}
    return TinyScene("oblique lock", scene, 1.0, kept, wrong)


def carried(terms: Terms) -> TinyScene:
    """A sphere that is free along y only, and moves steadily along the other axes."""
    free, pull = Y > 0, _pull(terms)
    scene = Scene((sphere(THROWN, free),), Contact(KN), gravity=pull)
    wrong = {"locked directions stand still": thrown(pull * free, THROWN * free)}
    return TinyScene("carried", scene, 1.0, thrown(pull * free, THROWN), wrong)


def drag(terms: Terms) -> TinyScene:
    """A thrown sphere that drag slows down."""

    def slowed(eta: float) -> Motion:
        rate = eta / MASS

        def motion(t: Vector) -> tuple[Vector, Vector]:
            left = np.exp(-rate * t)
            return np.outer((1 - left) / rate, THROWN), np.outer(left, THROWN)

        return motion

    wrong = {
        "drag is left out": steady(THROWN),
        "drag is twice as strong": slowed(2 * ETA),
        "drag is half as strong": slowed(ETA / 2),
        "drag is a rate, not divided by the mass": slowed(ETA * MASS),
    }
    scene = Scene((sphere(THROWN),), Contact(KN), ETA)
    return TinyScene("drag", scene, 1.0, slowed(ETA), wrong)


def fluid(terms: Terms) -> TinyScene:
    """A thrown sphere that a fluid slows down, with twice the drag of the linear term."""

    def slowed(by: float, share: float) -> Motion:
        return along(THROWN / np.linalg.norm(THROWN), _in_fluid(by, share))

    wrong = {
        "the fluid is left out": steady(THROWN),
        "drag grows as the speed alone": slowed(1.0, 0.0),
        "drag of the fluid is twice as strong": slowed(2.0, 1.0),
        "drag of the fluid is half as strong": slowed(0.5, 1.0),
    }
    scene = Scene((sphere(THROWN),), Contact(KN), fluid=FLUID)
    return TinyScene("fluid", scene, 1.0, slowed(1.0, 1.0), wrong)


def shaken(terms: Terms) -> TinyScene:
    """A thrown sphere under a sine, which does not start at zero."""
    scene = Scene((sphere(THROWN),), Contact(KN), shaking=_sine())
    wrong = {
        "shaking is left out": steady(THROWN),
        "shaking is reversed": _under(-SHAKEN, PHASE, np.inf),
        "the phase of shaking is left out": _under(SHAKEN, 0.0, np.inf),
    }
    return TinyScene("shaking", scene, 1.0, _under(SHAKEN, PHASE, np.inf), wrong)


def pulse(terms: Terms) -> TinyScene:
    """A thrown sphere under a sine that ends."""
    scene = Scene((sphere(THROWN),), Contact(KN), shaking=Pulse(_sine(), UNTIL))
    wrong = {"the pulse does not end": _under(SHAKEN, PHASE, np.inf)}
    moved = _under(SHAKEN, PHASE, UNTIL)
    return TinyScene("pulse", scene, 1.0, moved, wrong, smooth=False)


def _in_fluid(by: float, share: float) -> Callable[[Vector], tuple[Vector, Vector]]:
    """The path and speed for v' = -k v (1 + c v^q), by which v^-q + c grows exponentially.

    by: times k; share: times c.
    """
    q, size = 0.687, float(np.linalg.norm(THROWN))
    k = by * 6.0 * np.pi * FLUID.viscosity * RADIUS / MASS
    c = share * 0.15 * (2.0 * FLUID.density * RADIUS / FLUID.viscosity) ** q
    places, weights = np.polynomial.legendre.leggauss(POINTS)

    def speed(t: Vector) -> Vector:
        return np.asarray(((size**-q + c) * np.exp(q * k * t) - c) ** (-1.0 / q))

    def way(t: Vector) -> tuple[Vector, Vector]:
        parts = speed(np.outer(t, 0.5 + 0.5 * places))
        return 0.5 * t * (parts @ weights), speed(t)

    return way


def _pull(terms: Terms) -> Vector:
    return PULL if Term.GRAVITY in terms else np.zeros(3)


def _sine() -> Harmonic:
    return Harmonic(SHAKEN, np.full(3, FREQUENCY), np.full(3, PHASE))


def _under(size: Vector, phase: float, until: float) -> Motion:
    """The path of a thrown sphere under `size` sin(rate t + phase) [m/s2] until a time."""
    rate = 2 * np.pi * FREQUENCY

    def way(t: Vector) -> tuple[Vector, Vector]:
        on, after = np.minimum(t, until), np.maximum(t - until, 0.0)
        speed = (np.cos(phase) - np.cos(rate * on + phase)) / rate
        moved = (on * np.cos(phase) - (np.sin(rate * on + phase) - np.sin(phase)) / rate) / rate
        return moved + after * speed, speed

    return both(steady(THROWN), along(size, way))
