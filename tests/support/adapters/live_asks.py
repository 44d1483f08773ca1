"""Asks for tests that run a program: single contacts, a flight, a sphere that rolls."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from cases.contact.single_contact import CASE
from vv.ask import Ask, Displacement, History, Knobs, Run, Status, Velocity
from vv.case import Series
from vv.codes import Adapter
from vv.scene import Contact, Scene, Spheres, Vector, Wall

VARIANTS = [variant.name for variant in CASE.variants]
TRIALS = {name: CASE.declare(name, CASE.defaults(name)) for name in VARIANTS}
COARSE, FINE = Knobs(dt=1e-3), Knobs(dt=1e-5)
Runs = dict[tuple[str, Knobs], Run]

G = 9.81
SEEN = (Displacement(0), Velocity(0))
FLOOR = Wall(np.zeros(3), np.array([0.0, 1.0, 0.0]))


def ran(
    adapter: Adapter, asks: Sequence[Ask], scheme: str, folder: Path, repeat: float = 0.0
) -> list[Run]:
    """The runs of asks, each of which must come to its end."""
    runs = list(adapter.run(asks, scheme, folder, repeat))
    assert [(run.status, run.reason) for run in runs] == [(Status.RAN, "")] * len(asks)
    return runs


def error(run: Run, variant: str) -> float:
    """max|e| / max|ref| of a run of a single contact."""
    (quantity,) = TRIALS[variant].quantities
    assert isinstance(quantity, Series)
    assert quantity.reference is not None
    exact = quantity.reference(run.times)
    return float(np.abs(quantity.observe(run) - exact).max() / np.abs(exact).max())


def ball(y: float, velocity: Sequence[float], **more: Any) -> Spheres:
    """One sphere of 2 kg and 0.1 m whose centre lies at height y, free unless said otherwise."""
    size, mass, free = np.array([0.1]), np.array([2.0]), np.ones((1, 3), bool)
    sphere = Spheres(np.array([[0, y, 0]]), np.array([velocity]), size, mass, free)
    return dataclasses.replace(sphere, **more)


def flight(eta: float) -> Scene:
    thrown = ball(0.0, [1, 2, 3], load=np.array([[1, 0, 2]]))
    return Scene((thrown,), Contact(1e6), eta, gravity=np.array([0, -G, 0]))


def rolling() -> Scene:
    """A sphere on a wall, in equilibrium with its weight, thrown along it without spin."""
    kn = 1e7
    thrown = ball(0.1 - 2.0 * G / kn, [1, 0, 0], free_spin=np.ones((1, 3), bool))
    return Scene((thrown, FLOOR), Contact(kn, kn, 0.3), gravity=np.array([0, -G, 0]))


def history(scene: Scene, dt: float, duration: float = 0.2) -> Ask:
    return Ask(scene, History(duration, 0.01), SEEN, Knobs(dt=dt))


def flown(times: Vector, n: float) -> tuple[Vector, Vector]:
    """Displacement and velocity of the flight with drag n = eta/m [1/s]."""
    v0, a, t = np.array([1.0, 2.0, 3.0]), np.array([0.5, -G, 1.0]), times[:, None]
    last, decay = a / n, -np.expm1(-n * t)
    return last * t + (v0 - last) * decay / n, v0 + (last - v0) * decay


def undamped(times: Vector) -> Vector:
    """Displacement of the flight without drag."""
    t = times[:, None]
    return np.asarray(t * np.array([1.0, 2.0, 3.0]) + t**2 / 2 * np.array([0.5, -G, 1.0]))
