"""Builds the equations of motion of a scene with the fewest unknowns and linear contacts."""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from vv.ask import Model
from vv.engines.exact.bond_springs import BondSprings, Owners, no_bond_springs
from vv.engines.exact.modelled import check_spheres, check_terms, count_in_words
from vv.engines.exact.modes import OPEN, STUCK, Equations, Index
from vv.engines.exact.reachability import (
    PossibleContact,
    RefusedError,
    can_close,
    possible_contacts,
    reachable_directions,
    tangents,
)
from vv.scene import Scene, Term, Vector


@dataclass(frozen=True, eq=False)
class System:
    """The equations M q'' = f - eta q' + spring forces, for n unknown displacements q [m].

    owner: (n,) sphere of each unknown; direction: (n, 3) of its motion; mass: (n,) [kg];
    eta [N s/m]; weight, load: (n,) [N]; velocity: (n,) at t = 0 [m/s]. The gaps of the c contacts
    are gap + normal @ q [m], with gap (c,) and normal (c, n); the tangential displacements of the
    s shear springs are tangent @ q [m], with tangent (s, n). depth: (c,) overlaps at which centres
    meet [m]; names: the bodies of each contact; springs: the contact of each shear spring;
    kn, ks [N/m]; mu; eta_n [N s/m] along normals; bond_springs: the h springs of bonds.
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
    bond_springs: BondSprings

    @functools.cached_property
    def rows(self) -> Vector:
        """Normal and tangential rows of contacts and rows of bond springs: (c + s + h, n)."""
        return np.vstack((self.normal, self.tangent, self.bond_springs.rows))

    @property
    def ratio(self) -> float:
        """The largest stretch of a shear spring over the overlap, mu kn/ks; 0 without any."""
        return self.mu * self.kn / self.ks if self.springs else 0.0

    @functools.cached_property
    def start(self) -> tuple[Equations, Vector, Vector, Index]:
        """The equations in the form of kernels, and velocities, lengths and states at t = 0.

        Shear springs have no stretch at t = 0.
        """
        spring, bonds = np.full(len(self.gap), -1), self.bond_springs
        spring[list(self.springs)] = np.arange(len(self.springs))
        known = Equations(
            mass=self.mass,
            load=self.weight + self.load,
            normal=self.normal,
            tangent=self.tangent,
            tied=bonds.rows,
            spring=spring,
            depth=self.depth,
            length=bonds.length,
            stiffness=bonds.stiffness,
            kn=self.kn,
            ks=self.ks,
            mu=self.mu,
            ratio=self.ratio,
            eta=self.eta,
            eta_n=self.eta_n,
        )
        lengths = np.concatenate((self.gap, np.zeros(len(self.springs)), bonds.stretch))
        return known, self.velocity, lengths, np.where(self.gap < 0, STUCK, OPEN)


def assemble(scene: Scene) -> System:
    """The equations of motion of a scene; raises RefusedError if it cannot be solved exactly."""
    check_terms(scene)
    check_spheres(scene)
    rough = scene.contact.carries_shear
    candidates = list(possible_contacts(scene))
    spaces = reachable_directions(scene, candidates)
    kept = [contact for contact in candidates if _acts_on_motion(contact, spaces, rough)]
    shearing = [_tangent(contact, spaces) if rough else None for contact in kept]
    springs = tuple(c for c, tangent in enumerate(shearing) if tangent is not None)
    return equations(
        scene, spaces, kept, springs, [t for t in shearing if t is not None], no_bond_springs
    )


def equations(
    scene: Scene,
    spaces: list[Vector],
    kept: list[PossibleContact],
    springs: tuple[int, ...],
    along: list[Vector],
    tied: Callable[[Owners, Vector], BondSprings],
) -> System:
    """The system of spheres that each move in a given space, spanned by directions (d, 3).

    kept: the contacts; springs: the contact of each shear spring; along: its direction (3,);
    tied: makes the bond springs from owner and direction. Raises RefusedError if nothing moves.
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
        gap=np.array([contact.gap for contact in kept]),
        normal=rows_of(kept, [contact.normal for contact in kept], owner, direction),
        tangent=rows_of([kept[c] for c in springs], along, owner, direction),
        depth=np.array([contact.depth for contact in kept]),
        names=tuple(contact.names for contact in kept),
        springs=springs,
        kn=law.kn,
        ks=law.ks,
        mu=law.mu,
        eta_n=law.eta_n,
        bond_springs=tied(owner, direction),
    )


def describe(scene: Scene, system: System) -> Model:
    """The model; its note counts unknowns and springs, and names the terms without effect."""
    walls = np.isinf(system.depth)
    acting = {
        Term.SPHERE_CONTACT: not walls.all(),
        Term.WALL_CONTACT: bool(walls.any()),
        Term.FRICTION: len(system.tangent) > 0,
        Term.GRAVITY: bool(system.weight.any()),
        Term.LOAD: bool(system.load.any()),
        Term.BOND_SHEAR: len(system.bond_springs.rows) > len(system.bond_springs.names),
    }
    inert = sorted(term.value for term in scene.terms() if not acting.get(term, True))
    unknowns = len(system.direction)
    note = (
        f"{count_in_words(unknowns, 'displacement')} along fixed directions, out of "
        f"{count_in_words(scene.unknowns(), 'freedom')}; "
        f"{count_in_words(len(system.gap), 'contact')} with constant normals; "
        f"{count_in_words(len(system.tangent), 'shear spring')}"
    )
    if bond_springs := system.bond_springs.names:
        springs = count_in_words(len(system.bond_springs.rows), "spring")
        note += f"; {count_in_words(len(bond_springs), 'bond')} in {springs}"
    note += f"; without effect here: {', '.join(inert)}" if inert else ""
    return Model(unknowns, scene.terms(), note)


def _acts_on_motion(contact: PossibleContact, spaces: list[Vector], rough: bool) -> bool:
    """Whether a contact can affect the motion; raises RefusedError if its normal can rotate."""
    space = np.concatenate([spaces[i] for i in contact.spheres])
    if not len(space) or not can_close(contact, spaces):
        return False
    across = tangents(contact, spaces)
    if contact.first is None:
        presses = (np.abs(space @ contact.normal) > contact.rounding).any()
        return bool(presses) or (rough and len(across) > 0)
    if len(across):
        raise RefusedError(
            "the contact normal between bodies {} and {} turns".format(*contact.names)
        )
    return True


def _tangent(contact: PossibleContact, spaces: list[Vector]) -> Vector | None:
    """The direction (3,) of shear in a contact, or None; raises RefusedError if it can turn.

    It points where the first of the unknowns that shear the contact most moves its body.
    """
    along = tangents(contact, spaces)
    if len(along) > 1:
        raise RefusedError("the slip between bodies {} and {} can turn".format(*contact.names))
    if not len(along):
        return None
    parts = np.concatenate([spaces[i] for i in contact.spheres]) @ along[0]
    return np.asarray(along[0] * np.sign(parts[np.abs(parts).argmax()]))


def rows_of(
    kept: list[PossibleContact], along: list[Vector], owner: Owners, direction: Vector
) -> Vector:
    """Relative velocities (k, n) of contacts along their directions, per unit rate of unknowns."""
    rows = np.zeros((len(kept), len(owner)))
    for row, contact, vector in zip(rows, kept, along, strict=True):
        part = direction @ vector
        part[np.abs(part) <= contact.rounding] = 0.0
        row[owner == contact.second] = part[owner == contact.second]
        if contact.first is not None:
            row[owner == contact.first] = -part[owner == contact.first]
    return rows
