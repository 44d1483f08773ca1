"""The YADE setup of an ask, from which refusals, input and answers follow."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from adapters.yade.polyhedra import laid, turn_of
from vv.ask import Ask, Displacement, Observable
from vv.scene import Mask, Scene, Term, Vector, spheres_held_by_loads, with_loads_for_locks
from vv.scene.initial_forces import unbonded
from vv.scene.neighbours import overlapping
from vv.standins.clump import Clump, clumps
from vv.standins.stand_in import SpringScene, spring_scene, without_rotations

PLAIN, HALF_STEP, CLUMP, POLYHEDRA = "default", "half-step-mass", "clump", "polyhedra"
LEAST_GAP = 1e-12  # relative to a radius: smaller overlaps are rounding


@dataclass(frozen=True, eq=False)
class Setup:
    """The translation of an ask for YADE under a scheme.

    asked: the original ask; ask: the same in the frame of YADE's input, whose axes are the rows of
    frame (3, 3). springs: its scene with spheres and springs in place of blocks and rigid contact;
    scene: that with dead loads in place of oblique locks. extra: what the scheme adds to every mass
    [kg]. clumps: the blocks as clumps, in the scheme of that name. watched: the observables asked
    for, then displacements of spheres on which a dead load replaces a lock. touching: (n,) which
    spheres overlap another body at the start; the next field is the number of these contacts.
    """

    asked: Ask
    ask: Ask
    frame: Vector
    scheme: str
    springs: SpringScene
    scene: Scene
    extra: float
    clumps: tuple[Clump, ...]
    watched: tuple[Observable, ...]
    touching: Mask
    contacts: int

    @property
    def terms(self) -> frozenset[Term]:
        """The terms of the ask's scene, and those that represent some of them."""
        return self.asked.scene.terms() | self.scene.terms()


def set_up(asked: Ask, scheme: str) -> Setup:
    """The YADE setup of an ask, to which `refusals` must not object.

    In the scheme half-step-mass the mass is m + eta dt/2. With it, drag from the velocity of the
    last half step, m (v+ - v-)/dt = F - eta v-, becomes drag from the mean velocity; the weight
    stays m g. Raises ValueError for an ask without dt, or one that `with_loads_for_locks` refuses.
    """
    ask = framed(asked, scheme)
    frame = turn_of(asked.scene) if scheme == POLYHEDRA else np.eye(3)
    springs = spring_scene(without_rotations(ask))
    scene = with_loads_for_locks(springs.scene)
    extra = scene.eta * ask.dt / 2 if scheme == HALF_STEP else 0.0
    made = clumps(ask, springs) if scheme == CLUMP else ()
    more = [
        d
        for d in map(Displacement, spheres_held_by_loads(springs.scene))
        if d not in ask.observables
    ]
    watched = (*ask.observables, *more)
    start = initial_contacts(scene)
    return Setup(asked, ask, frame, scheme, springs, scene, extra, made, watched, *start)


def framed(ask: Ask, scheme: str) -> Ask:
    """The ask in the frame of YADE."""
    return laid(ask) if scheme == POLYHEDRA else ask


def initial_contacts(scene: Scene) -> tuple[Mask, int]:
    """Which spheres overlap another body at the start, (n,), and the number of these contacts.

    Contacts between bodies without any freedom are not counted, nor are bonds.
    """
    spheres = scene.spheres
    moving = np.asarray(spheres.free.any(axis=1) | spheres.free_spin.any(axis=1))
    pairs = unbonded(scene, overlapping(spheres, LEAST_GAP))
    pairs = pairs[moving[pairs].any(axis=1)]
    touching, contacts = np.zeros(len(spheres), bool), len(pairs)
    touching[pairs] = True
    for wall in scene.walls:
        gap = (spheres.position - wall.point) @ wall.normal - spheres.radius
        pressed = moving & (gap < -LEAST_GAP * spheres.radius)
        touching |= pressed
        contacts += int(pressed.sum())
    return touching, contacts
