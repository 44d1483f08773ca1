"""Builds the general model: spheres that move and rotate in space, with all their terms."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from vv.ask import Displacement, Observable, Reaction
from vv.engines.dem.leapfrog import Leapfrog
from vv.engines.dem.rows import Index, projected, projectors
from vv.engines.dem.space.bodies import Bodies
from vv.engines.dem.space.ledger import signed, width
from vv.engines.dem.space.neighbours import Near
from vv.engines.dem.space.placed import Placed, placed
from vv.engines.dem.terms import every
from vv.scene import Mask, Scene, Term, Vector


class SpaceState(NamedTuple):
    """The arguments of `move_in_space` that describe the scene, in its order.

    terms: the terms of the scene, each of a class in a file of `vv/engines/dem/terms/`.
    """

    bodies: Bodies
    terms: tuple[Any, ...]
    near: Near | None

    def of_each_term(self, name: str, absent: object, *given: object) -> list[Any]:
        """As the function `of_each_term`, for the terms of this state."""
        return of_each_term(self.terms, name, absent, *given)

    def term(self, kind: type) -> Any:
        """The term of a class, or None."""
        return next((term for term in self.terms if isinstance(term, kind)), None)


def of_each_term(terms: tuple[Any, ...], name: str, absent: object, *given: object) -> list[Any]:
    """The results of the function `name` in the file of each term; `absent` where it has none."""
    files = [sys.modules[type(term).__module__] for term in terms]
    return [
        getattr(file, name)(term, *given) if hasattr(file, name) else absent
        for file, term in zip(files, terms, strict=True)
    ]


@dataclass(frozen=True, eq=False)
class Space:
    """The general model of a scene.

    The moving spheres have rows 0 to m - 1; row[sphere] is m for spheres at rest.
    """

    row: Index
    state: SpaceState
    terms: frozenset[Term]
    words: str

    @property
    def unknowns(self) -> tuple[Vector, ...]:
        """The arrays with one number per unknown; locked components count as well."""
        bodies = self.state.bodies
        spin = bodies.spin if bodies.turns else None
        return (bodies.velocity,) if spin is None else (bodies.velocity, spin)

    def outputs(self, rows: int, spheres: tuple[int, ...]) -> tuple[Vector | Index, ...]:
        """The arrays that the kernel fills, path and energy, and the rows that it observes."""
        watched = self.row[np.array(spheres, np.intp)]
        across = 3 + 3 * len(self.unknowns) + (3 if self.state.bodies.locked else 0)
        forms = [form for booked in self.state.of_each_term("forms", ()) for form in booked]
        return np.empty((rows, len(watched), across)), np.zeros((rows, width(forms))), watched

    def kernel(self) -> Callable[..., int]:
        """The compiled kernel; the first call imports numba."""
        from vv.engines.dem.space.kernel import move_in_space

        return move_in_space

    def observed(self, path: Vector, index: int, sphere: int, what: Observable) -> Vector:
        """An observable (k, 3) of a sphere, the index-th of those observed."""
        if isinstance(what, Reaction):
            locked = self.state.bodies.locked
            return np.array(path[:, index, -3:]) if locked else np.zeros((len(path), 3))
        first = 0 if isinstance(what, Displacement) else 3
        return np.array(path[:, index, first : first + 3])

    def held(self, path: Vector, energy: Vector) -> Vector:
        """The terms of the energy ledger [J], (k, 7), (k, 9) or (k, 12), of the kernel's table."""
        return signed(energy)

    def put_in(self, energy: Vector) -> float:
        """Kinetic and elastic energy [J] at t = 0, including that of bonds that break at once."""
        s = self.state.bodies
        kinetic = 0.5 * float(s.mass @ (s.velocity**2).sum(axis=1))
        if s.spin is not None:
            kinetic += 0.5 * float(s.inertia @ (s.spin**2).sum(axis=1))
        return kinetic + float(energy[0, 1] + energy[0, 2] + energy[0, 10:].sum())

    def bound(self, energy: Vector, leapfrog: Leapfrog, dt: float) -> float | None:
        """None: no bound of the energy is known where contacts rotate."""
        return None


def space(scene: Scene, charged: Vector | None = None) -> Space:
    """The general model of a scene, without the terms that it lacks.

    charged: (n, 3) tangential force [N] of each sphere at its only wall at t = 0. Rotation is left
    out where neither friction nor bonds can change it: no observable shows it, and spheres without
    spin lose nothing by it.
    """
    here = placed(scene, charged)
    built = (file.build(here) for file in every.TERMS)
    terms = tuple(term for term in built if term is not None)
    turns = Term.ROTATION in scene.terms() and any(of_each_term(terms, "turns", False))
    state = SpaceState(_bodies(here, turns), terms, here.near)
    left_out = {term for file in every.TERMS for term in getattr(file, "STANDS_FOR", ())}
    left_out = left_out.difference(*state.of_each_term("models", ()))
    if not turns and scene.spheres.spin.any():
        left_out |= {Term.ROTATION}
    count = len(state.bodies.velocity)
    words = f"{3 * count * (2 if turns else 1)} unknowns: {count} moving spheres"
    words += " that turn" if turns else ""
    words += "".join(state.of_each_term("words", ""))
    return Space(here.row, state, scene.terms() - left_out, words)


def _bodies(here: Placed, turns: bool) -> Bodies:
    """The data of the moving spheres."""
    scene, moves, spheres = here.scene, here.moves, here.scene.spheres
    free, free_spin = spheres.free[moves], spheres.free_spin[moves]
    spin = np.zeros((0, 3)) if here.decides_at_run_time else None
    if turns:
        spin = projected(spheres.spin[moves], scene.axes, free_spin)
    return Bodies(
        velocity=projected(spheres.velocity[moves], scene.axes, free) + here.carried,
        spin=spin,
        mass=spheres.mass[moves],
        inertia=spheres.inertia[moves] if turns else np.zeros(0),
        hold=_projectors(scene, free),
        hold_spin=_projectors(scene, free_spin) if turns else np.zeros((0, 3, 3)),
        walls=len(scene.walls) if here.walls_move else 0,
    )


def _projectors(scene: Scene, free: Mask) -> Vector:
    """Projectors on the free axes, as in `Bodies`."""
    found = projectors(scene.axes, free)
    return np.zeros((0, 3, 3)) if found is None else found
