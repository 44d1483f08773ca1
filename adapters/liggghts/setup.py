"""Translates an ask for LIGGGHTS once; refusals, decks and answers follow from this setup."""

from __future__ import annotations

import functools
from dataclasses import dataclass, replace

import numpy as np

from adapters.liggghts.clumps import as_atoms, members
from adapters.liggghts.overlaps import overlapped
from adapters.liggghts.space import Space, space
from vv.ask import Ask, Displacement, Observable
from vv.scene import Mask, Scene, Spheres, Term, Vector, spheres_held_by_loads, with_loads_for_locks
from vv.standins.clump import Clump, clumps
from vv.standins.stand_in import SpringScene, spring_scene, without_rotations

Alike = dict[tuple[float, ...], list[int]]  # groups of spheres: a common property and their indices
PLAIN, HALF_STEP, CLUMP, OVERLAPPED = "default", "half-step-mass", "clump", "pre-overlapped"


@dataclass(frozen=True, eq=False)
class Setup:
    """The translation of an ask for LIGGGHTS under a scheme.

    springs: its scene with spheres and springs in place of blocks and rigid contact. released: that
    scene with dead loads in place of oblique locks. scene: that scene with the masses, the atoms or
    the overlaps of the scheme, as LIGGGHTS gets it. clumps: the blocks as rigid bodies, in the
    scheme of that name. watched: what is written, each with the index of its sphere: first what was
    asked for, then the displacements of spheres on which a dead load replaces a lock.
    """

    ask: Ask
    scheme: str
    springs: SpringScene
    released: Scene
    scene: Scene
    clumps: tuple[Clump, ...]
    watched: tuple[tuple[Observable, int], ...]

    @property
    def spheres(self) -> Spheres:
        """The atoms of LIGGGHTS, in their order."""
        return self.scene.spheres

    @property
    def terms(self) -> frozenset[Term]:
        """The terms of the ask's scene, and those that represent some of them."""
        overlaps = self.scheme == OVERLAPPED
        return self.ask.scene.terms() | (self.scene if overlaps else self.released).terms()

    @functools.cached_property
    def turning(self) -> Mask:
        """A mask (n,) of the spheres whose rotations are integrated."""
        return np.asarray(self.spheres.free_spin.any(axis=1))

    @functools.cached_property
    def moving(self) -> Mask:
        """A mask (n,) of the spheres that are integrated at all."""
        return np.asarray(self.spheres.free.any(axis=1)) | self.turning

    @functools.cached_property
    def room(self) -> Space:
        """The space in which spheres may be; a rigid body needs as much as its sphere."""
        scene = self.released if self.scheme == CLUMP else self.scene
        return space(scene, self.ask.goal.duration)

    @functools.cached_property
    def slides(self) -> dict[int, Vector]:
        """How far (3,) [m] each sphere must slide to give its shear spring the initial force."""
        charged, ks = self.springs.charged, self.scene.contact.ks
        if charged is None or not charged.any():
            return {}
        held = dict(enumerate(charged))
        if self.clumps:
            held = {
                atom: row
                for one, atoms in zip(self.clumps, self.parts, strict=True)
                for atom, row in zip(atoms[1:], one.friction, strict=False)
            }
        return {i: -row / ks for i, row in held.items() if row.any()}

    @functools.cached_property
    def parts(self) -> list[list[int]]:
        """The indices of the atoms of each rigid body: its centre, its corners, its points."""
        return members(self.clumps)

    @functools.cached_property
    def loads(self) -> Alike:
        """The dead loads [N] on moving spheres, each with the indices of the spheres."""
        return _alike(self.spheres.load, self.moving & self.spheres.load.any(axis=1))

    @functools.cached_property
    def locks(self) -> Alike:
        """The patterns of locked axes of moving spheres, each with the indices of the spheres."""
        return _alike(~self.spheres.free, self.moving & ~self.spheres.free.all(axis=1))

    @functools.cached_property
    def shaken(self) -> Alike:
        """The masses [kg] on which a body acceleration acts, each with the indices of its spheres.

        They are those of the scene, also where the scheme integrates raised masses.
        """
        scene = self.released if self.scheme == HALF_STEP else self.scene
        present = self.moving & (scene.shaking is not None)
        return _alike(scene.spheres.mass[:, None], present)


def set_up(ask: Ask, scheme: str) -> Setup:
    """The LIGGGHTS setup of an ask, to which `refusals` must not object.

    Raises ValueError for an ask without dt, or one that `with_loads_for_locks` refuses.
    """
    springs = spring_scene(without_rotations(ask))
    loose = with_loads_for_locks(springs.scene)
    made = clumps(ask, springs) if scheme == CLUMP else ()
    scene = loose
    if scheme == OVERLAPPED:
        scene = overlapped(loose)
    elif scheme == HALF_STEP:
        scene = heavier(loose, loose.eta * ask.dt / 2)
    elif made:
        scene = as_atoms(loose, made)
    return Setup(ask, scheme, springs, loose, scene, made, _watched(ask, springs.scene))


def heavier(scene: Scene, extra: float) -> Scene:
    """The scene with `extra` [kg] on every mass, and the weight kept as a dead load.

    With extra = eta dt/2 the drag of LIGGGHTS, M (v+ - v-)/dt = F - eta v-, becomes that of the
    mean velocity, m (v+ - v-)/dt = F - eta (v+ + v-)/2, which is second order.
    """
    if extra == 0.0:
        return scene
    bodies = tuple(
        replace(g, mass=g.mass + extra, load=g.load + g.mass[:, None] * scene.gravity)
        if isinstance(g, Spheres)
        else g
        for g in scene.bodies
    )
    return replace(scene, bodies=bodies, gravity=np.zeros(3))


def _watched(ask: Ask, scene: Scene) -> tuple[tuple[Observable, int], ...]:
    more = [d for d in map(Displacement, spheres_held_by_loads(scene)) if d not in ask.observables]
    return tuple((o, scene.sphere_index(o.body)) for o in (*ask.observables, *more))


def _alike(rows: Vector | Mask, present: Mask) -> Alike:
    """The distinct rows in order of their first appearance, each with the indices of its equals."""
    groups: Alike = {}
    indices = np.flatnonzero(present)
    for i, row in zip(indices.tolist(), rows[indices].tolist(), strict=True):
        groups.setdefault(tuple(row), []).append(i)
    return groups
