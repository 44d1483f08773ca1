"""Tiny scenes of a block that does not rotate: in flight, loaded, sliding down a rigid wall."""

from __future__ import annotations

import numpy as np

from vv.codes.tiny_scenes.flights import LOAD, PULL, THROWN
from vv.codes.tiny_scenes.tiny_scene import (
    FREE,
    KN,
    MASS,
    PLACE,
    Motion,
    Terms,
    TinyScene,
    Z,
    steady,
    thrown,
)
from vv.scene import Block, Contact, Scene, Term, Vector, Wall, box_geometry

HALF = np.array([0.1, 0.15, 0.05])  # m
ACROSS = np.array([0.6, 0.8, 0.0])  # the direction of slip
DOWN, PRESSED, ROUGH = 6.0, 8.0, 0.4  # m/s2 along the slip and into the wall; -
STANDS_FOR_RIGID = MASS * 30.0**2  # N/m: a step of a hundredth of a second is stable


def flight(terms: Terms) -> TinyScene:
    """A thrown block, with gravity if the scheme has it."""
    pull = PULL if Term.GRAVITY in terms else np.zeros(3)
    scene = Scene((_block(THROWN),), _law(terms), gravity=pull)
    wrong = {
        "gravity is left out": steady(THROWN),
        "gravity is reversed": thrown(-PULL, THROWN),
        "gravity is taken twice": thrown(2 * PULL, THROWN),
    }
    return _shown("flight of a block", scene, thrown(pull, THROWN), wrong if pull.any() else {})


def laden(terms: Terms) -> TinyScene:
    """A thrown block under a dead load."""
    wrong = {
        "the load is left out": steady(THROWN),
        "the load is reversed": thrown(-LOAD / MASS, THROWN),
    }
    scene = Scene((_block(THROWN, LOAD),), _law(terms))
    return _shown("dead load on a block", scene, thrown(LOAD / MASS, THROWN), wrong)


def slide(terms: Terms) -> TinyScene:
    """A block that is pulled along a wall and slides, with friction if the scheme has it."""
    mu = ROUGH if Term.FRICTION in terms else 0.0
    pull = DOWN * ACROSS - PRESSED * Z
    weight = Term.GRAVITY in terms
    block = _block(ACROSS, np.zeros(3) if weight else MASS * pull)
    scene = Scene(
        (Wall(PLACE - HALF[2] * Z, Z), block),
        Contact(np.inf, mu=mu),
        gravity=pull if weight else np.zeros(3),
    )
    wrong = {
        "contact is left out": thrown(pull, ACROSS),
        "friction is left out": _sliding(0.0),
        "friction is twice as strong": _sliding(2 * ROUGH),
        "friction is half as strong": _sliding(ROUGH / 2),
        "friction pulls along": _sliding(-ROUGH),
    }
    if not mu:
        wrong = {"contact is left out": thrown(pull, ACROSS)}
    return _shown("slide of a block", scene, _sliding(mu), wrong)


def _sliding(mu: float) -> Motion:
    return thrown((DOWN - mu * PRESSED) * ACROSS, ACROSS)


def _law(terms: Terms) -> Contact:
    """The contact law: rigid if the scheme has that, as codes for blocks usually do."""
    return Contact(np.inf if Term.RIGID_CONTACT in terms else KN)


def _shown(name: str, scene: Scene, motion: Motion, wrong: dict[str, Motion]) -> TinyScene:
    return TinyScene(name, scene, 1.0, motion, wrong, kn=STANDS_FOR_RIGID)


def _block(speed: Vector, load: Vector = np.zeros(3)) -> Block:  # noqa: B008
    """A box of unequal sides that does not rotate."""
    vertices, faces = box_geometry(PLACE, HALF, np.eye(3))
    inertia = np.diag(MASS / 3 * ((HALF**2).sum() - HALF**2))
    return Block("block", vertices, faces, MASS, inertia, speed, FREE, ~FREE, load=load)
