"""Scenes of blocks for the tests of DDA, and what they ask."""

from __future__ import annotations

import dataclasses
import math

import numpy as np

from vv.ask import Ask, Displacement, History, Knobs, Run, Status, Velocity
from vv.engines.dda import Formulation, solve
from vv.engines.dda.general.model import General
from vv.engines.dda.solve import PreparedBlocks
from vv.scene import (
    Block,
    Contact,
    Harmonic,
    Mask,
    Scene,
    Vector,
    Wall,
    box_geometry,
    polyhedron_inertia,
)

G = 9.81
DOWN = np.array([0.0, 0.0, -G])
FLOOR = Wall(np.zeros(3), np.array([0.0, 0.0, 1.0]))
ALL, NONE = np.ones(3, bool), np.zeros(3, bool)
ROUGH = Contact(math.inf, mu=0.6)


def box(
    half: tuple[float, float, float],
    density: float,
    centre: Vector | None = None,
    axes: Vector | None = None,
    free: Mask = ALL,
    free_spin: Mask = NONE,
    velocity: Vector | None = None,
    spin: Vector | None = None,
) -> Block:
    place = np.array([0.0, 0.0, half[2]]) if centre is None else centre
    vertices, faces = box_geometry(place, np.array(half), np.eye(3) if axes is None else axes)
    mass, inertia = polyhedron_inertia(vertices, faces, density)
    rate, turn = (np.zeros(3) if v is None else v for v in (velocity, spin))
    return Block("box", vertices, faces, mass, inertia, rate, free, free_spin, turn)


def slope(
    alpha: float,
    phi: float,
    A: float = 0.0,
    velocity: float = 0.0,
    spin: bool = False,
    free: Mask = ALL,
) -> Scene:
    """A box on a slope [degrees], axes down the dip, along the strike and out of the slope."""
    c, s = math.cos(math.radians(alpha)), math.sin(math.radians(alpha))
    axes = np.array([[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]])
    turns = ALL if spin else NONE
    start = velocity * axes[0]
    body = box((0.5, 0.5, 0.25), 2700.0, 0.25 * axes[2], axes, free, turns, start)
    shaking = Harmonic(np.array([A, 0, 0]), np.ones(3)) if A else None
    contact = Contact(math.inf, mu=math.tan(math.radians(phi)))
    wall = Wall(np.zeros(3), axes[2])
    return Scene((wall, body), contact, gravity=DOWN, axes=axes, shaking=shaking)


def shaken(D: tuple[float, float, float], f: tuple[float, float, float], mu: float) -> Scene:
    """The responding block of Yagoda-Biran (2016), Sec. 4.5, on a base D (1 - cos 2 pi f t)."""
    motion = Harmonic(-np.array(D), np.array(f), np.full(3, math.pi / 2))
    base = dataclasses.replace(FLOOR, motion=motion)
    return Scene((base, box((1.0, 1.0, 0.05), 2250.0)), Contact(math.inf, mu=mu), gravity=DOWN)


def asked(scene: Scene, dt: float, kn: float, duration: float, interval: float = 0.01) -> Ask:
    body = len(scene.walls)  # walls come first
    what = (Displacement(body), Velocity(body))
    return Ask(scene, History(duration, interval), what, Knobs(dt, kn))


def run(ask: Ask, way: Formulation) -> Run:
    done = solve(ask, way)
    assert done.status is Status.RAN, done.reason
    return done


def general(ask: Ask, way: Formulation) -> Run:
    program = PreparedBlocks(ask, way, General(ask.scene, way), np.arange(len(ask.scene.blocks)))
    done = program.run(program.solve())
    assert done.status is Status.RAN, done.reason
    return done


def moved(done: Run) -> Vector:
    return next(v for what, v in done.values.items() if isinstance(what, Displacement))


def rates(done: Run) -> Vector:
    return next(v for what, v in done.values.items() if isinstance(what, Velocity))


def stack(free_spin: Mask) -> Scene:
    """Two boxes of different sizes, one on the other, thrown along a rough floor."""
    low = box((0.5, 0.5, 0.2), 2000.0, free_spin=free_spin, velocity=np.array([0.8, 0.2, 0.0]))
    top = box((0.3, 0.3, 0.1), 2500.0, np.array([0.05, 0.02, 0.5]), free_spin=free_spin)
    return Scene((FLOOR, low, top), Contact(math.inf, mu=0.3), gravity=DOWN)


def watching(scene: Scene, bodies: tuple[int, ...], duration: float) -> Ask:
    what = tuple(Velocity(body) for body in bodies)
    return Ask(scene, History(duration, 0.01), what, Knobs(1e-3, 1e8))


def closes(done: Run) -> None:
    """The energy balance holds, no audit is exceeded, and no part of a step remains unconverged."""
    ledger = done.ledger
    assert ledger is not None
    assert ledger.bound is not None
    assert ledger.unaccounted <= ledger.bound
    for law, (seen, allowed) in ledger.audits.items():
        assert seen <= allowed, law
    assert done.model is not None
    assert " 0 parts of steps kept unconverged" in done.model.note
