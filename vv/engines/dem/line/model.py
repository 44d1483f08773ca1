"""Builds the model with one unknown, for scenes that need no more."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from vv.ask import Displacement, Observable
from vv.engines.dem.leapfrog import Leapfrog
from vv.scene import Scene, Term, Vector, Wall

ALIGNED = 1e-9  # sine of the angle below which a motion counts as parallel to a normal or to a wall
ROUNDING = 1e-14  # fraction of a force below which a component counts as rounding


MODELLED = frozenset(
    {
        Term.SPHERE,
        Term.SPHERE_CONTACT,
        Term.WALL_CONTACT,
        Term.FRICTION,
        Term.DRAG,
        Term.GRAVITY,
        Term.LOAD,
        Term.ROTATION,
        Term.OBLIQUE_LOCK,
        Term.CONTACT_VISCOSITY,
    }
)
"""The terms of scenes that this model may serve."""


class LineState(NamedTuple):
    """The arguments of `move_on_line` that describe the scene, in its order and units."""

    velocity: Vector
    mass: float
    force: float | None
    normal: tuple[float, float] | None
    friction: tuple[float, float] | None
    eta: float | None
    eta_n: float | None


@dataclass(frozen=True, eq=False)
class Line:
    """The model of one sphere, whose unknown q is its displacement along the unit vector `along`.

    weight, load: their components [N] along it.
    """

    sphere: int
    along: Vector
    weight: float
    load: float
    state: LineState
    terms: frozenset[Term]
    words: str

    @property
    def unknowns(self) -> tuple[Vector, ...]:
        """The arrays with one number per unknown."""
        return (self.state.velocity,)

    def outputs(self, rows: int, spheres: tuple[int, ...]) -> tuple[Vector, ...]:
        """The arrays that the kernel fills, path and energy, whichever spheres are observed."""
        return np.empty((rows, 2)), np.empty((rows, 6))

    def kernel(self) -> Callable[..., int]:
        """The compiled kernel; the first call imports numba."""
        from vv.engines.dem.line.kernel import move_on_line

        return move_on_line

    def observed(self, path: Vector, index: int, sphere: int, what: Observable) -> Vector:
        """An observable (k, 3) of a sphere."""
        moves = sphere == self.sphere
        column = path[:, 0 if isinstance(what, Displacement) else 1]
        return column[:, None] * self.along if moves else np.zeros((len(path), 3))

    def held(self, path: Vector, energy: Vector) -> Vector:
        """The terms of the energy ledger [J], (k, 7)."""
        potential = -path[:, :1] * np.array([self.weight, self.load]) + 0.0
        return np.concatenate([energy[:, :5], potential], axis=1)

    def put_in(self, energy: Vector) -> float:
        """Kinetic and elastic energy [J] at t = 0."""
        start = float(self.state.velocity[0])
        return 0.5 * self.state.mass * start**2 + float(energy[0, 1])

    def bound(self, energy: Vector, leapfrog: Leapfrog, dt: float) -> float | None:
        """A bound of the change of kinetic, elastic and dissipated energy together [J]."""
        s, start = self.state, float(self.state.velocity[0])
        force = (s.force or 0.0) - (s.eta or 0.0) * start
        if s.normal is not None and s.normal[1] < 0.0:
            force += max(-s.normal[0] * s.normal[1] - (s.eta_n or 0.0) * start, 0.0)
        kicked, back = dt * force / s.mass, leapfrog.back
        first = (start - back * kicked) * (start + (1.0 - back) * kicked)
        return 0.5 * s.mass * abs(first - start**2) + float(energy[-1, 5])


def line(scene: Scene) -> Line | None:
    """The model with one unknown, or None if the scene needs more.

    It serves scenes in which one sphere can move in one direction and at most one other body is
    present, fixed. The motion must be along the contact normal, so that nothing is sheared, or
    along a wall, so that the overlap is constant and the lock balances the normal force.
    """
    spheres = scene.spheres
    moving = np.flatnonzero(spheres.free.any(axis=1))
    if spheres.free.sum() != 1 or spheres.free_spin.any() or len(spheres) + len(scene.walls) > 2:
        return None
    if scene.terms() - MODELLED:
        return None
    i = int(moving[0])
    along = scene.axes[spheres.free[i]][0]
    normal, gap = _partner(scene, i)
    part = float(normal @ along)
    if np.linalg.norm(normal - part * along) <= ALIGNED and normal.any():
        along = along if part > 0 else -along
        return _built(scene, i, along, (scene.contact.kn, gap), None, "along the contact normal")
    if not normal.any():
        return _built(scene, i, along, None, None, "along a line, free of contact")
    if abs(part) <= ALIGNED and scene.walls:
        cap = scene.contact.mu * scene.contact.kn * max(-gap, 0.0)
        friction = (scene.contact.ks, cap) if scene.contact.ks * cap > 0 else None
        return _built(scene, i, along, None, friction, "along a wall, at constant overlap")
    return None


def _partner(scene: Scene, i: int) -> tuple[Vector, float]:
    """The normal from the other body to sphere i, and their gap [m]; zeros if there is none."""
    spheres = scene.spheres
    for wall in scene.walls:
        return wall.normal, _wall_gap(wall, spheres.position[i], float(spheres.radius[i]))
    for j in range(len(spheres)):
        if j != i:
            offset = spheres.position[i] - spheres.position[j]
            distance = float(np.linalg.norm(offset))
            return offset / distance, distance - float(spheres.radius[i] + spheres.radius[j])
    return np.zeros(3), 0.0


def _wall_gap(wall: Wall, position: Vector, radius: float) -> float:
    return float((position - wall.point) @ wall.normal) - radius


def _built(
    scene: Scene,
    i: int,
    along: Vector,
    normal: tuple[float, float] | None,
    friction: tuple[float, float] | None,
    words: str,
) -> Line:
    spheres, mass = scene.spheres, float(scene.spheres.mass[i])
    parts = {Term.GRAVITY: mass * scene.gravity, Term.LOAD: spheres.load[i]}
    acting = {
        term: float(part @ along)
        for term, part in parts.items()
        if abs(part @ along) > ROUNDING * np.linalg.norm(part)
    }
    contact = Term.WALL_CONTACT if scene.walls else Term.SPHERE_CONTACT
    viscous = normal is not None and scene.contact.eta_n > 0
    there = {
        Term.SPHERE: True,
        contact: normal is not None or friction is not None,
        Term.FRICTION: friction is not None,
        Term.DRAG: scene.eta > 0,
        Term.OBLIQUE_LOCK: Term.OBLIQUE_LOCK in scene.terms(),
        Term.CONTACT_VISCOSITY: viscous,
    }
    constant = normal is not None or bool(acting)  # zero at a contact costs nothing: fewer kernels
    state = LineState(
        velocity=np.array([spheres.velocity[i] @ along]),
        mass=mass,
        force=sum(acting.values(), start=0.0) if constant else None,
        normal=normal,
        friction=friction,
        eta=scene.eta if scene.eta > 0 else None,
        eta_n=scene.contact.eta_n if viscous else None,
    )
    terms = frozenset(term for term, used in there.items() if used) | frozenset(acting)
    weight, load = (acting.get(term, 0.0) for term in (Term.GRAVITY, Term.LOAD))
    return Line(
        i, along, weight, load, state, terms, f"1 unknown: the displacement of a sphere {words}"
    )
