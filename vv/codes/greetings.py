"""Tiny scenes with answers known by heart, and what a wrong answer to them looks like."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np

from vv.ask import Ask, Displacement, History, Knobs, Observable, Run, Velocity
from vv.codes.adapter import Scheme
from vv.scene import Contact, Mask, Scene, Spheres, Term, Vector, Wall

Motion = Callable[[Vector], tuple[Vector, Vector]]  # t (k,) [s] -> displacement, velocity (k, 3)

X, Y, Z = np.eye(3)
RADIUS, MASS, KN, ETA = 0.1, 3.0, 3e3, 6.0  # m, kg, N/m, N s/m
THROWN = np.array([1.0, 2.0, 3.0])  # m/s
PULL = np.array([-4.0, -10.0, 6.0])  # m/s2
PLACE = np.array([0.3, 0.2, 0.1])  # m; not the origin, which would hide a mistake
FREE = np.ones(3, bool)
OUTPUTS = 20
STEPS = (100, 200, 400)  # of a run; three, so that an order can be seen
ALIKE = 0.02  # of the largest way: how well an answer must fit what it is taken for


@dataclass(frozen=True)
class Greeting:
    """A tiny scene: how its last body moves, and how it would if something were left out."""

    name: str
    scene: Scene
    duration: float
    motion: Motion
    mistakes: Mapping[str, Motion] = field(default_factory=dict)

    @property
    def body(self) -> int:
        """The number of the body that is looked at."""
        return sum(len(group) for group in self.scene.bodies) - 1

    def asks(self, scheme: Scheme) -> list[Ask]:
        """The question at several steps, the longest first; one if the scheme has no step."""
        goal = History(self.duration, self.duration / OUTPUTS)
        steps = [self.duration / n for n in STEPS] if "dt" in scheme.knobs else [None]
        both = (Displacement(self.body), Velocity(self.body))
        seen = tuple(what for what in both if type(what) in scheme.observables)
        return [Ask(self.scene, goal, seen, Knobs(dt=dt)) for dt in steps]


def greetings(scheme: Scheme) -> list[Greeting]:
    """The tiny scenes that a scheme declares it can solve."""
    pulled = Term.GRAVITY in scheme.terms
    offered = (_flight(pulled), _bounce(), _collision(), _lock(pulled), _drag())
    seen = {Displacement, Velocity} & scheme.observables
    return [one for one in offered if seen and one.scene.terms() <= scheme.terms]


def error(greeting: Greeting, run: Run) -> float:
    """The largest error of what a run reports, relative to the largest value of its kind."""
    moved, speed = greeting.motion(run.times)
    exact: dict[Observable, Vector] = {
        Displacement(greeting.body): moved,
        Velocity(greeting.body): speed,
    }
    return max(
        float(np.abs(values - exact[what]).max() / np.abs(exact[what]).max())
        for what, values in run.values.items()
        if what in exact
    )


def likeness(greeting: Greeting, run: Run) -> str:
    """What a wrong answer looks like, in words; empty if it looks like nothing known."""
    values = run.values.get(Displacement(greeting.body))
    if values is None:
        return ""
    scale = float(np.abs(greeting.motion(run.times)[0]).max())
    for words, wrong in _mistakes(greeting, run.times):
        if np.abs(values - wrong).max() <= ALIKE * max(scale, float(np.abs(wrong).max())):
            return words
    return ""


def _mistakes(greeting: Greeting, t: Vector) -> Iterator[tuple[str, Vector]]:
    """What would be reported after each mistake: words -> displacements (k, 3)."""
    exact, velocity = greeting.motion(t)
    for words, motion in greeting.mistakes.items():
        yield words, motion(t)[0]
    start = greeting.scene.spheres.position[-1]
    yield "nothing moves", 0 * exact
    yield "all signs are reversed", -exact
    yield "positions are written, and displacements since t = 0 asked for", exact + start
    yield "velocities are written in place of displacements", velocity
    yield "rows are one output late", np.concatenate([exact[:1], exact[:-1]])
    yield "rows are one output early", greeting.motion(t + t[1])[0]
    yield "time runs at half its pace", greeting.motion(t / 2)[0]
    for order in itertools.permutations(range(3)):
        yield f"x, y, z are {', '.join('xyz'[i] for i in order)}", exact[:, order]


def _sphere(velocity: Vector, free: Mask = FREE, place: Vector = PLACE) -> Spheres:
    size, mass = np.array([RADIUS]), np.array([MASS])
    return Spheres(place[None], velocity[None], size, mass, free[None])


def _thrown(pull: Vector, speed: Vector = THROWN) -> Motion:
    """The path of what is thrown with a speed (3,) [m/s] and pulled by (3,) [m/s2]."""

    def motion(t: Vector) -> tuple[Vector, Vector]:
        return np.outer(t, speed) + np.outer(t**2 / 2, pull), speed + np.outer(t, pull)

    return motion


def _flight(pulled: bool) -> Greeting:
    pull = PULL if pulled else np.zeros(3)
    scene = Scene((_sphere(THROWN),), Contact(KN), gravity=pull)
    wrong = {
        "gravity is left out": _thrown(0 * PULL),
        "gravity is reversed": _thrown(-PULL),
        "gravity is taken twice": _thrown(2 * PULL),
        "gravity is a force, not an acceleration": _thrown(PULL / MASS),
    }
    return Greeting("free flight", scene, 1.0, _thrown(pull), wrong if pulled else {})


def _rebound(rate: float, along: Vector, speed: float = 1.0) -> Motion:
    """The path of what meets a spring at t = 0 and flies off; rate: its angular frequency."""

    def motion(t: Vector) -> tuple[Vector, Vector]:
        off = np.pi / rate
        way = np.where(t < off, -speed / rate * np.sin(rate * t), speed * (t - off))
        return np.outer(way, along), np.outer(
            np.where(t < off, -speed * np.cos(rate * t), speed), along
        )

    return motion


def _met(along: Vector) -> Mapping[str, Motion]:
    rate = np.sqrt(KN / MASS)
    return {
        "contact is left out": _thrown(np.zeros(3), -along),
        "contact is twice as stiff": _rebound(np.sqrt(2) * rate, along),
        "contact is half as stiff": _rebound(np.sqrt(0.5) * rate, along),
        "contact has another mass, such as that of a radius and a density": _rebound(
            np.sqrt(KN / (4 / 3 * np.pi * RADIUS**3)), along
        ),
    }


def _bounce() -> Greeting:
    """A sphere that touches a wall flies into it, along no axis of the frame."""
    along = np.array([0.6, 0.0, 0.8])
    scene = Scene((Wall(PLACE - RADIUS * along, along), _sphere(-along)), Contact(KN))
    return Greeting("bounce", scene, 0.15, _rebound(np.sqrt(KN / MASS), along), _met(along))


def _collision() -> Greeting:
    """A sphere that touches another, which is fixed, flies into it."""
    held, flying = _sphere(0 * Z, ~FREE, PLACE - 2 * RADIUS * Z), _sphere(-Z)
    scene = Scene((held, flying), Contact(KN))
    return Greeting("collision", scene, 0.15, _rebound(np.sqrt(KN / MASS), Z), _met(Z))


def _lock(pulled: bool) -> Greeting:
    """A sphere free along y alone, with a pull across, or else the push of a wall."""
    free, speed = Y > 0, 2.0 * Y
    if pulled:
        scene = Scene((_sphere(speed, free),), Contact(KN), gravity=PULL)
        kept, loose = _thrown(PULL * free, speed), _thrown(PULL, speed)
        return Greeting("lock", scene, 1.0, kept, {"the lock is not kept": loose})
    depth = 0.01
    scene = Scene((Wall(PLACE - (RADIUS - depth) * Z, Z), _sphere(speed, free)), Contact(KN))
    return Greeting("lock", scene, 0.15, _thrown(0 * Z, speed))


def _drag() -> Greeting:
    """A thrown sphere that drag slows down."""

    def slowed(eta: float) -> Motion:
        rate = eta / MASS

        def motion(t: Vector) -> tuple[Vector, Vector]:
            left = np.exp(-rate * t)
            return np.outer((1 - left) / rate, THROWN), np.outer(left, THROWN)

        return motion

    wrong = {
        "drag is left out": _thrown(0 * THROWN),
        "drag is twice as strong": slowed(2 * ETA),
        "drag is half as strong": slowed(ETA / 2),
        "drag is a rate, not divided by the mass": slowed(ETA * MASS),
    }
    scene = Scene((_sphere(THROWN),), Contact(KN), ETA)
    return Greeting("drag", scene, 1.0, slowed(ETA), wrong)
