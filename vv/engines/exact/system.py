"""Builds the equations of motion of a scene: the fewest unknowns, and contacts linear in them."""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from vv.ask import Model
from vv.engines.exact.bond_springs import Owners, Ties, untied
from vv.engines.exact.modelled import check_spheres, check_terms, counted
from vv.engines.exact.reachability import (
    RefusedError,
    Touch,
    can_close,
    reachable,
    tangents,
    touches,
)
from vv.scene import Scene, Term, Vector


@dataclass(frozen=True, eq=False)
class System:
    """M q'' = f - eta q' + spring forces, with n unknowns q, c contacts, s shear springs, h ties.

    owner: (n,) sphere of each unknown; direction: (n, 3) along which it moves; mass: (n,) [kg];
    eta [N s/m]; weight, load: (n,) [N]; velocity: (n,) at t = 0 [m/s].
    Gaps are gap + normal @ q, (c,) + (c, n) [m]; tangential travel is tangent @ q, (s, n) [m].
    depth: (c,) overlaps at which centres meet [m]; names: the bodies of each contact.
    springs: the contact of each shear spring. kn, ks [N/m]; mu; eta_n [N s/m] along normals.
    ties: the springs of bonds.
    """

    owner: Owners
    direction: Vector
    mass: Vector
    eta: float
    weight: Vector
    load: Vector
    velocity: Vector
    gap: Vector
    normal: Vector
    tangent: Vector
    depth: Vector
    names: tuple[tuple[int, int], ...]
    springs: tuple[int, ...]
    kn: float
    ks: float
    mu: float
    eta_n: float
    ties: Ties

    @functools.cached_property
    def rows(self) -> Vector:
        """Normal and tangential rows of contacts, and those of ties, stacked: (c + s + h, n)."""
        return np.vstack((self.normal, self.tangent, self.ties.rows))

    @property
    def ratio(self) -> float:
        """The shear spring's greatest stretch over the overlap, mu kn/ks; 0 without springs."""
        return self.mu * self.kn / self.ks if self.springs else 0.0


def assemble(scene: Scene) -> System:
    """The equations of motion of a scene; raises RefusedError if it is outside the class."""
    check_terms(scene)
    check_spheres(scene)
    rough = scene.contact.rubs
    candidates = list(touches(scene))
    spaces = reachable(scene, candidates)
    kept = [touch for touch in candidates if _matters(touch, spaces, rough)]
    shearing = [_tangent(touch, spaces) if rough else None for touch in kept]
    springs = tuple(c for c, tangent in enumerate(shearing) if tangent is not None)
    return equations(scene, spaces, kept, springs, [t for t in shearing if t is not None], untied)


def equations(
    scene: Scene,
    spaces: list[Vector],
    kept: list[Touch],
    springs: tuple[int, ...],
    along: list[Vector],
    tied: Callable[[Owners, Vector], Ties],
) -> System:
    """The system of spheres that move in given spaces, (d, 3) each, and of what acts on them.

    kept: the contacts; springs, along: see System, and the direction (3,) of each spring; tied:
    what makes the ties for given owner and direction. Raises RefusedError if nothing moves.
    """
    spheres, law = scene.spheres, scene.contact
    direction = np.concatenate(spaces)
    if not len(direction):
        raise RefusedError("nothing in the scene moves")
    owner = np.repeat(np.arange(len(spheres)), [len(space) for space in spaces])
    return System(
        owner=owner,
        direction=direction,
        mass=spheres.mass[owner],
        eta=scene.eta,
        weight=spheres.mass[owner] * (direction @ scene.gravity),
        load=np.einsum("nk,nk->n", direction, spheres.load[owner]),
        velocity=np.einsum("nk,nk->n", direction, spheres.velocity[owner]),
        gap=np.array([touch.gap for touch in kept]),
        normal=rows_of(kept, [touch.normal for touch in kept], owner, direction),
        tangent=rows_of([kept[c] for c in springs], along, owner, direction),
        depth=np.array([touch.depth for touch in kept]),
        names=tuple(touch.names for touch in kept),
        springs=springs,
        kn=law.kn,
        ks=law.ks,
        mu=law.mu,
        eta_n=law.eta_n,
        ties=tied(owner, direction),
    )


def describe(scene: Scene, system: System) -> Model:
    """What was built, read off the arrays of the system; the note names terms without effect."""
    walls = np.isinf(system.depth)
    acting = {
        Term.SPHERE_CONTACT: not walls.all(),
        Term.WALL_CONTACT: bool(walls.any()),
        Term.FRICTION: len(system.tangent) > 0,
        Term.GRAVITY: bool(system.weight.any()),
        Term.LOAD: bool(system.load.any()),
        Term.BOND_SHEAR: len(system.ties.rows) > len(system.ties.names),
    }
    inert = sorted(term.value for term in scene.terms() if not acting.get(term, True))
    unknowns = len(system.direction)
    note = (
        f"{counted(unknowns, 'displacement')} along fixed directions, out of "
        f"{counted(scene.unknowns(), 'freedom')}; {counted(len(system.gap), 'contact')} with "
        f"constant normals; {counted(len(system.tangent), 'shear spring')}"
    )
    if ties := system.ties.names:
        note += f"; {counted(len(ties), 'bond')} in {counted(len(system.ties.rows), 'spring')}"
    note += f"; without effect here: {', '.join(inert)}" if inert else ""
    return Model(unknowns, scene.terms(), note)


def _matters(touch: Touch, spaces: list[Vector], rough: bool) -> bool:
    """Whether a contact can act on the motion; raises RefusedError if its normal can turn."""
    space = np.concatenate([spaces[i] for i in touch.spheres])
    if not len(space) or not can_close(touch, spaces):
        return False
    across = tangents(touch, spaces)
    if touch.first is None:
        presses = (np.abs(space @ touch.normal) > touch.blur).any()
        return bool(presses) or (rough and len(across) > 0)
    if len(across):
        raise RefusedError("the contact normal between bodies {} and {} turns".format(*touch.names))
    return True


def _tangent(touch: Touch, spaces: list[Vector]) -> Vector | None:
    """The (3,) direction of shear in a contact, or None; raises RefusedError if it can turn.

    Forward is where the first unknown that shears the contact most carries its body.
    """
    along = tangents(touch, spaces)
    if len(along) > 1:
        raise RefusedError("the slip between bodies {} and {} can turn".format(*touch.names))
    if not len(along):
        return None
    parts = np.concatenate([spaces[i] for i in touch.spheres]) @ along[0]
    return np.asarray(along[0] * np.sign(parts[np.abs(parts).argmax()]))


def rows_of(kept: list[Touch], along: list[Vector], owner: Owners, direction: Vector) -> Vector:
    """How fast each contact opens along a given direction, per unknown: (contacts, n)."""
    rows = np.zeros((len(kept), len(owner)))
    for row, touch, vector in zip(rows, kept, along, strict=True):
        part = direction @ vector
        part[np.abs(part) <= touch.blur] = 0.0
        row[owner == touch.second] = part[owner == touch.second]
        if touch.first is not None:
            row[owner == touch.first] = -part[owner == touch.first]
    return rows
