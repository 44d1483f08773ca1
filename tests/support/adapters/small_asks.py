"""Small asks for tests of adapter input: of a single contact, a sphere, a block."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np

from cases.contact.single_contact import CASE
from vv.ask import Ask, Displacement, History, Knobs
from vv.scene import Contact, Scene, Spheres, Wall

DT = 1e-3
FREE = np.ones((1, 3), bool)
UP = Wall(np.zeros(3), np.array([0.0, 1.0, 0.0]))


def case_ask(variant: str, dt: float = DT) -> Ask:
    return CASE.declare(variant, CASE.defaults(variant)).study.ask(Knobs(dt=dt))


def ball(**changes: Any) -> Spheres:
    """One free sphere of 2 kg and 0.1 m, resting at the origin."""
    still = Spheres(np.zeros((1, 3)), np.zeros((1, 3)), np.array([0.1]), np.array([2.0]), FREE)
    return dataclasses.replace(still, **changes)


def ball_ask(*bodies: Spheres | Wall, body: int = 0, **scene: Any) -> Ask:
    whole = Scene(bodies, Contact(1e6, 1e6, 0.5), **scene)
    return Ask(whole, History(0.1, 0.01), (Displacement(body),), Knobs(dt=DT))


def block_ask(scene: Scene, kn: float | None = 1e9) -> Ask:
    return Ask(scene, History(0.1, 0.01), (Displacement(1),), Knobs(DT, kn))
