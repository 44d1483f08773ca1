"""Scenes and what may be done to them without changing what happens: moved, turned, renumbered."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from cases.blocks.incline import CASE as INCLINE
from cases.blocks.responding_block import CASE as RESPONDING
from cases.contact.bounce import CASE as BOUNCE
from cases.contact.single_contact import CASE as SINGLE_CONTACT
from cases.hard.wedge import CASE as WEDGE
from tests.scenes.blocks import stacked_blocks
from tests.scenes.other_worlds import rescaled, shifted
from vv.ask import Ask, Displacement, History, Knobs, Run, Velocity
from vv.case import Case
from vv.scene import Scene, Spheres, Vector, rotated, with_bodies_reversed

EPS = float(np.finfo(float).eps)
FAR = 1e6  # m
LOOSE = 1e-2  # of the motion: a shift that may cost more says nothing
WAY = np.array([1.0, -0.5, 0.25])


def _turn() -> Vector:
    """A rotation (3, 3) about no axis of the frame."""
    axis, angle = np.array([0.36, 0.48, 0.8]), 0.9
    cross = np.cross(np.eye(3), -axis)
    return np.asarray(np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross)


TURN = _turn()


@dataclass(frozen=True, eq=False)
class Twin:
    """Two asks whose answers are the same once `undo` has been applied to the second's.

    within: how far apart the displacements may be, in parts of the largest.
    """

    kind: str
    name: str
    ask: Ask
    other: Ask
    undo: Callable[[Vector], Vector]
    within: float


@dataclass(frozen=True, eq=False)
class Known:
    """A scene that has answers, and the smallest length [m] on which its forces depend."""

    ask: Ask
    smallest: float


@functools.cache
def known() -> dict[str, Known]:
    """One scene for each kind of contact, motion and drive."""
    return {
        "T2": _of(SINGLE_CONTACT, "T2", Knobs(1e-3), 4e-3),
        "T4": _of(SINGLE_CONTACT, "T4", Knobs(1e-3), 2e-2),
        "floor": _of(BOUNCE, "floor", Knobs(5e-7), 5e-7),
        "pair": _of(BOUNCE, "pair", Knobs(2e-5), 2e-5),
        "slope": _of(INCLINE, "newmark-30", Knobs(1e-3, 1e8), 2e-4, 1.0),
        "carried": _of(RESPONDING, "1d", Knobs(1e-3, 1e8), 2e-4, 1.0),
        "stack": Known(_stack(), 1e-4),
        "wedge": _of(WEDGE, "xi-1", Knobs(5e-3, 1e8), 1e-5, 0.2),
    }


def _of(case: Case, variant: str, knobs: Knobs, smallest: float, duration: float = 0.0) -> Known:
    study = case.declare(variant, case.defaults(variant)).study
    duration = duration or study.goal.duration
    goal = History(duration, duration / 20)
    return Known(Ask(study.scene, goal, study.observables, knobs), smallest)


def _stack() -> Ask:
    seen = (Displacement(1), Displacement(2))
    return Ask(stacked_blocks.scene(), History(0.3, 0.03), seen, Knobs(1e-3, 1e8))


def twins() -> Iterator[Twin]:
    """All scenes under all changes."""
    for name, one in known().items():
        yield from _shifts(name, one)
        yield from _units(name, one)
        scene, n = one.ask.scene, sum(len(group) for group in one.ask.scene.bodies)
        turned = _with(one.ask, rotated(scene, TURN))
        yield Twin("turned", name, one.ask, turned, lambda u: u @ TURN, ROUNDED)
        yield Twin("renumbered", name, one.ask, _renumbered(one.ask, n), _as_is, ROUNDED)


def _shifts(name: str, one: Known) -> Iterator[Twin]:
    for by in (1e3, FAR):
        within = 10 * EPS * by / one.smallest
        if within <= LOOSE:
            moved = _with(one.ask, shifted(one.ask.scene, by * WAY))
            yield Twin(f"shifted by {by:g} m", name, one.ask, moved, _as_is, within)


def _units(name: str, one: Known) -> Iterator[Twin]:
    for kind, unit in (("length", 0), ("time", 1), ("mass", 2)):
        for size in (1e-6, 1e6):
            units = (1.0,) * unit + (size,) + (1.0,) * (2 - unit)
            small = 1.0 / units[0]
            undo = functools.partial(np.multiply, small)
            yield Twin(f"{kind} x {size:g}", name, one.ask, in_units(one.ask, units), undo, ROUNDED)


def in_units(ask: Ask, units: tuple[float, ...]) -> Ask:
    """The ask in other units, its knobs and its times too."""
    length, time, mass = units
    knobs, goal = ask.knobs, ask.goal
    assert knobs.dt is not None
    kn = None if knobs.kn is None else knobs.kn * mass / time**2
    return dataclasses.replace(
        ask,
        scene=rescaled(ask.scene, length, time, mass),
        goal=History(goal.duration * time, goal.interval * time),
        knobs=dataclasses.replace(knobs, dt=knobs.dt * time, kn=kn),
    )


def _with(ask: Ask, scene: Scene) -> Ask:
    return dataclasses.replace(ask, scene=scene)


def _renumbered(ask: Ask, n: int) -> Ask:
    seen = tuple(dataclasses.replace(what, body=n - 1 - what.body) for what in ask.observables)
    return dataclasses.replace(ask, scene=with_bodies_reversed(ask.scene), observables=seen)


def _as_is(u: Vector) -> Vector:
    return u


def moved(run: Run) -> Vector:
    """All that was observed, (k, b, 3), in the order it was asked for."""
    return np.stack(list(run.values.values()), axis=1)


def apart(twin: Twin, one: Run, other: Run) -> float:
    """How far two answers differ, in parts of the largest value."""
    first, second = moved(one), twin.undo(moved(other))
    return float(np.abs(first - second).max() / np.abs(first).max())


def elastic() -> dict[str, Ask]:
    """Scenes without loss, for which time has no direction; velocities are observed too."""
    free, along = np.ones((2, 3), bool), np.array([1.0, 0.2, -0.1])
    pair = Spheres(
        np.array([[0.0, 0.0, 0.0], 0.31 / np.linalg.norm(along) * along]),
        np.array([[0.5, 0.1, 0.0], [-0.6, 0.2, 0.1]]),
        np.array([0.1, 0.2]), np.array([1.0, 3.0]), free,
    )  # fmt: skip
    contact = SINGLE_CONTACT.declare("T1", SINGLE_CONTACT.defaults("T1")).study.scene
    both = tuple(kind(body) for kind in (Displacement, Velocity) for body in (0, 1))
    soft = Scene((pair,), dataclasses.replace(contact.contact, kn=1e4))
    return {
        "T1": Ask(contact, History(0.4, 0.02), both, Knobs(1e-3)),
        "pair": Ask(soft, History(0.1, 0.005), both, Knobs(1e-4)),
    }


def backwards(ask: Ask, run: Run) -> Ask:
    """From where a run ended, with all velocities turned round."""
    ends = [run.values[kind(body)][-1] for kind in (Displacement, Velocity) for body in (0, 1)]
    (s,) = (group for group in ask.scene.bodies if isinstance(group, Spheres))
    there = dataclasses.replace(
        s, position=s.position + np.array(ends[:2]), velocity=-np.array(ends[2:])
    )
    return _with(ask, dataclasses.replace(ask.scene, bodies=(there,)))


ROUNDED = 1e-9
"""Of the motion: what rounding makes of a few hundred steps and a few events."""
