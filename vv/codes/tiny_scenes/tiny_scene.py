"""Defines tiny scenes: the exact motion of the last body, and its motion under known mistakes."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np

from vv.ask import Ask, Displacement, History, Knobs, Observable, Run, Velocity
from vv.codes.adapter import Scheme
from vv.scene import Mask, Scene, Spheres, Term, Vector

Motion = Callable[[Vector], tuple[Vector, Vector]]  # t (k,) [s] -> displacement, velocity (k, 3)
Way = Callable[[Vector], tuple[Vector, Vector]]  # t (k,) [s] -> way [m], speed [m/s] (k,)
Terms = frozenset[Term]

X, Y, Z = np.eye(3)
RADIUS, MASS, KN = 0.1, 3.0, 3e3  # m, kg, N/m
PLACE = np.array([0.3, 0.2, 0.1])  # m; not the origin, which would hide a mistake
FREE = np.ones(3, bool)
OUTPUTS = 20
STEPS = (100, 200, 400)  # of a run; three, so that an order can be seen
# Relative to the largest displacement: how near an answer must be to a known mistake. A code of
# first order adds an error of its own, which may be half of this where it is right.
ALIKE = 0.04


@dataclass(frozen=True)
class TinyScene:
    """A tiny scene, with the exact motion of its last body and that under known mistakes.

    kn: the stiffness that represents rigid contact [N/m]. smooth: whether an order in dt can be
    observed, which an abrupt end of a force prevents.
    """

    name: str
    scene: Scene
    duration: float
    motion: Motion
    mistakes: Mapping[str, Motion] = field(default_factory=dict)
    kn: float | None = None
    smooth: bool = True

    @property
    def body(self) -> int:
        """The number of the body that is observed."""
        return sum(len(group) for group in self.scene.bodies) - 1

    def asks(self, scheme: Scheme) -> list[Ask]:
        """The asks at several steps, the longest first; a single ask if the scheme has no step."""
        goal = History(self.duration, self.duration / OUTPUTS)
        steps = [self.duration / n for n in STEPS] if "dt" in scheme.knobs else [None]
        kn = self.kn if "kn" in scheme.knobs else None
        both = (Displacement(self.body), Velocity(self.body))
        seen = tuple(what for what in both if type(what) in scheme.observables)
        return [Ask(self.scene, goal, seen, Knobs(dt, kn)) for dt in steps]


def error(tiny: TinyScene, run: Run) -> float:
    """The largest error of what a run reports, relative to the largest value of its kind.

    NaN if anything that it reports is not a number.
    """
    moved, speed = tiny.motion(run.times)
    exact: dict[Observable, Vector] = {
        Displacement(tiny.body): moved,
        Velocity(tiny.body): speed,
    }
    errors = [
        np.abs(values - exact[what]).max() / np.abs(exact[what]).max()
        for what, values in run.values.items()
        if what in exact
    ]
    return float(np.max(errors))


def likeness(tiny: TinyScene, run: Run) -> str:
    """The known mistake that explains a wrong answer best; empty if none does."""
    values = run.values.get(Displacement(tiny.body))
    if values is None:
        return ""
    scale = float(np.abs(tiny.motion(run.times)[0]).max())
    apart = {
        words: float(np.abs(values - wrong).max()) / max(scale, float(np.abs(wrong).max()))
        for words, wrong in _mistakes(tiny, run.times)
    }
    nearest = min(apart, key=apart.__getitem__)
    return nearest if apart[nearest] <= ALIKE else ""


def _mistakes(tiny: TinyScene, t: Vector) -> Iterator[tuple[str, Vector]]:
    """The answer that each mistake would give: words -> displacements (k, 3)."""
    exact, velocity = tiny.motion(t)
    for words, motion in tiny.mistakes.items():
        yield words, motion(t)[0]
    spheres = tiny.scene.spheres
    start = spheres.position[-1] if len(spheres) else tiny.scene.blocks[-1].centroid()
    yield "nothing moves", 0 * exact
    yield "all signs are reversed", -exact
    yield "positions are written, and displacements since t = 0 asked for", exact + start
    yield "velocities are written in place of displacements", velocity
    yield "rows are one output late", np.concatenate([exact[:1], exact[:-1]])
    yield "rows are one output early", tiny.motion(t + t[1])[0]
    yield "time runs at half its pace", tiny.motion(t / 2)[0]
    for order in itertools.islice(itertools.permutations(range(3)), 1, None):  # not x, y, z
        yield f"x, y, z are {', '.join('xyz'[i] for i in order)}", exact[:, order]


def sphere(velocity: Vector, free: Mask = FREE, place: Vector = PLACE) -> Spheres:
    """A sphere that does not rotate, with a velocity (3,) [m/s]."""
    size, mass = np.array([RADIUS]), np.array([MASS])
    return Spheres(place[None], velocity[None], size, mass, free[None])


def thrown(pull: Vector, speed: Vector) -> Motion:
    """The path of a body thrown with a velocity (3,) [m/s] under an acceleration (3,) [m/s2]."""

    def motion(t: Vector) -> tuple[Vector, Vector]:
        return np.outer(t, speed) + np.outer(t**2 / 2, pull), speed + np.outer(t, pull)

    return motion


def steady(speed: Vector) -> Motion:
    """The path of a body that keeps a velocity (3,) [m/s]."""
    return thrown(np.zeros(3), speed)


def along(direction: Vector, way: Way) -> Motion:
    """A motion on a line along a direction (3,)."""

    def motion(t: Vector) -> tuple[Vector, Vector]:
        moved, speed = way(t)
        return np.outer(moved, direction), np.outer(speed, direction)

    return motion


def both(first: Motion, second: Motion) -> Motion:
    """The sum of two motions."""

    def motion(t: Vector) -> tuple[Vector, Vector]:
        (moved, speed), (further, faster) = first(t), second(t)
        return moved + further, speed + faster

    return motion
