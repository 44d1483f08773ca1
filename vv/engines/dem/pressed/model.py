"""Builds the model with two unknowns: a sphere moves along a wall's normal and one tangent."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from vv.ask import Displacement, Observable
from vv.engines.dem.leapfrog import Leapfrog
from vv.engines.dem.line.model import ALIGNED
from vv.scene import Harmonic, Scene, Term, Vector

if TYPE_CHECKING:
    from vv.engines.kernels.drive import Drive


MODELLED = frozenset(
    {
        Term.SPHERE,
        Term.WALL_CONTACT,
        Term.FRICTION,
        Term.DRAG,
        Term.GRAVITY,
        Term.LOAD,
        Term.ROTATION,
        Term.OBLIQUE_LOCK,
        Term.SHAKING,
        Term.BASE_MOTION,
    }
)
"""The terms of scenes that this model may serve."""


class PressedState(NamedTuple):
    """The arguments of `move_on_wall` that describe the scene, in its order and units."""

    velocity: Vector
    mass: float
    force: tuple[float, float]
    kn: float
    gap: float
    friction: tuple[float, float, float] | None
    eta: float | None
    shaking: Drive | None
    base: Drive | None


@dataclass(frozen=True, eq=False)
class Pressed:
    """The model of sphere `sphere`, with displacements along the first two rows of axes (3, 3).

    The first row is the wall's normal, the second a tangent; the third direction is locked. weight,
    load: (2,) their components [N] along the first two.
    """

    sphere: int
    axes: Vector
    weight: Vector
    load: Vector
    state: PressedState
    terms: frozenset[Term]
    words: str

    @property
    def unknowns(self) -> tuple[Vector, ...]:
        """The arrays with one number per unknown."""
        return (self.state.velocity,)

    def outputs(self, rows: int, spheres: tuple[int, ...]) -> tuple[Vector, ...]:
        """The arrays that the kernel fills, path and energy, whichever spheres are observed."""
        return np.empty((rows, 4)), np.empty((rows, 8))

    def kernel(self) -> Callable[..., int]:
        """The compiled kernel; the first call imports numba."""
        from vv.engines.dem.pressed.kernel import move_on_wall

        return move_on_wall

    def observed(self, path: Vector, index: int, sphere: int, what: Observable) -> Vector:
        """An observable (k, 3) of a sphere."""
        columns = path[:, :2] if isinstance(what, Displacement) else path[:, 2:]
        return columns @ self.axes[:2] if sphere == self.sphere else np.zeros((len(path), 3))

    def held(self, path: Vector, energy: Vector) -> Vector:
        """The terms of the energy ledger [J], (k, 7), or (k, 9) with shaking or a moving wall."""
        potential = -path[:, :2] @ np.stack([self.weight, self.load], axis=1) + 0.0
        driven = self.state.shaking is not None or self.state.base is not None
        works = -energy[:, 5:7] + 0.0 if driven else energy[:, :0]
        return np.concatenate([energy[:, :5], potential, works], axis=1)

    def put_in(self, energy: Vector) -> float:
        """Kinetic and elastic energy [J] at t = 0."""
        start = self.state.velocity
        return 0.5 * self.state.mass * float(start @ start) + float(energy[0, 1] + energy[0, 2])

    def bound(self, energy: Vector, leapfrog: Leapfrog, dt: float) -> float | None:
        """A bound of the change of energy [J]; None if the contact has opened or closed.

        All work is summed by the trapezoidal rule, so only the start contributes: there, m v- v+/2
        differs from m v(0)^2/2. A contact that opens within a step is computed to second order
        only.
        """
        start = self.state.velocity
        if energy[-1, 7] > 0:
            return None
        return abs(float(energy[0, 0]) - 0.5 * self.state.mass * float(start @ start))


def pressed(scene: Scene, charged: Vector | None = None) -> Pressed | None:
    """The model with two unknowns, or None if it does not serve the scene.

    It serves scenes with one sphere and one wall, in which the sphere is free along the normal and
    one tangent and does not rotate, and the wall does not move along the locked direction. charged:
    (1, 3) tangential force [N] at t = 0.
    """
    s, axes = scene.spheres, _axes(scene)
    if axes is None:
        return None
    base = _along(scene.walls[0].motion, axes)
    if (
        base is not None
        and (np.abs(base.direction[:, 2]) > ALIGNED * np.abs(base.direction).max()).any()
    ):
        return None
    rubs = Term.FRICTION in scene.terms()
    parts = {Term.GRAVITY: float(s.mass[0]) * scene.gravity, Term.LOAD: s.load[0]}
    weight, load = (axes[:2] @ parts[term] for term in (Term.GRAVITY, Term.LOAD))
    force = weight + load
    start = 0.0 if charged is None else float(charged[0] @ axes[1])
    state = PressedState(
        velocity=axes[:2] @ s.velocity[0],
        mass=float(s.mass[0]),
        force=(float(force[0]), float(force[1])),  # zero costs nothing: fewer kernels
        kn=scene.contact.kn,
        gap=float((s.position[0] - scene.walls[0].point) @ axes[0] - s.radius[0]),
        friction=(scene.contact.ks, scene.contact.mu, start) if rubs else None,
        eta=scene.eta if scene.eta > 0 else None,
        shaking=_along(scene.wave, axes),
        base=base,
    )
    words = "2 unknowns: a sphere along the normal of its wall and along the wall"
    return Pressed(0, axes, weight, load, state, scene.terms(), words)


def _axes(scene: Scene) -> Vector | None:
    """The unit normal, tangent and locked direction (3, 3) as rows; None for other scenes."""
    s = scene.spheres
    if scene.terms() - MODELLED:
        return None
    if len(s) != 1 or len(scene.walls) != 1 or s.free.sum() != 2 or s.free_spin.any():
        return None
    n, locked = scene.walls[0].normal, scene.axes[~s.free[0]][0]
    if abs(n @ locked) > ALIGNED:
        return None
    # the tangent points to the same side as the free axis of the scene closest to it
    free = scene.axes[s.free[0]]
    most = free[np.abs(free @ n).argmin()]
    slide = np.cross(locked, n)
    slide *= np.copysign(1.0 / np.linalg.norm(slide), slide @ most)
    return np.stack([n, slide, locked])


def _along(motion: Harmonic | None, axes: Vector) -> Drive | None:
    """The motion, with its components along the unit rows of axes (3, 3)."""
    if motion is None:
        return None
    from vv.engines.kernels.drive import drive

    sines = drive(motion)
    return sines._replace(direction=sines.direction @ axes.T)
