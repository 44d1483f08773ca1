"""Builds the equations of bonded spheres: exact if no bond rotates, else to first order.

All motions that can occur lie in the Krylov space of the initial velocities and forces under the
mass, drag and stiffness matrices. Its dimension is often much smaller than the number of degrees
of freedom: it is one for a unit that expands and contracts uniformly.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator

import numpy as np

from vv.engines.exact.bond_springs import BondSprings, Owners
from vv.engines.exact.modelled import check_spheres, check_terms
from vv.engines.exact.reachability import (
    DIRECTION_ROUNDING,
    PossibleContact,
    RefusedError,
    directions_of_motion,
)
from vv.engines.exact.system import System, equations, rows_of
from vv.scene import Scene, Vector


def assemble_bonded(scene: Scene) -> System:
    """The equations of bonds whose directions are constant, at any amplitude.

    Raises RefusedError if a bond can rotate.
    """
    bonds = list(_checked(scene))
    no_shear = np.zeros(len(bonds))
    motions = _motions(scene, bonds, no_shear)
    for bond in bonds:
        relative = motions[:, bond.second] - motions[:, bond.spheres[0]]
        across = relative - np.outer(relative @ bond.normal, bond.normal)
        if np.abs(across).max(initial=0.0) > bond.rounding:
            raise RefusedError("the bond between bodies {} and {} turns".format(*bond.names))
    return _system_of(scene, bonds, motions, no_shear)


def assemble_linearised(scene: Scene) -> System:
    """The equations to first order in the displacements, with constant directions of bonds.

    Raises RefusedError for a scene without bonds, and for bonds that carry a force at t = 0: it
    rotates with the bond, which is an effect of first order and not modelled.
    """
    if scene.bonds is None:
        raise RefusedError("a scene without bonds has nothing to linearise")
    bonds = list(_checked(scene))
    for bond in bonds:
        if abs(bond.gap) > bond.rounding * bond.depth:
            raise RefusedError(
                "the bond between bodies {} and {} carries a force at t = 0".format(*bond.names)
            )
    return _system_of(scene, bonds, _motions(scene, bonds, scene.bonds.ks), scene.bonds.ks)


def _checked(scene: Scene) -> Iterator[PossibleContact]:
    """The bonds as contacts, whose depth is the length and whose gap is the stretch at t = 0 [m].

    Raises RefusedError for terms that are not modelled.
    """
    check_terms(scene)
    check_spheres(scene)
    assert scene.bonds is not None
    place = scene.spheres.position
    size = float(np.abs(place).max())
    for (i, j), names, free in zip(
        scene.bonded_pairs.tolist(), scene.bonds.pairs.tolist(), scene.bonds.length, strict=True
    ):
        offset = place[j] - place[i]
        length = float(np.linalg.norm(offset))
        rounding = DIRECTION_ROUNDING * (1 + size / length)
        stretch = length - float(free) if abs(length - free) > rounding * length else 0.0
        yield PossibleContact(i, j, tuple(names), offset / length, stretch, length, rounding)


def _motions(scene: Scene, bonds: list[PossibleContact], ks: Vector) -> Vector:
    """An orthonormal basis (k, n, 3) of a space that contains all motions that can occur."""
    spheres = scene.spheres
    hold = np.einsum("ka,nk,kb->nab", scene.axes, spheres.free, scene.axes)
    push = functools.partial(_push, scene, bonds, ks)
    weight = spheres.mass[:, None] * scene.gravity + spheres.load
    stretched = push(0 * weight, np.array([bond.gap for bond in bonds]))
    light = hold / spheres.mass[:, None, None]
    most = 6 * float((scene.bonds.kn + ks).max() / spheres.mass.min())  # type: ignore[union-attr]
    rounding = max(bond.rounding for bond in bonds)
    found = np.zeros((0, *weight.shape))
    waiting = [_unit(spheres.velocity), _unit(np.einsum("nab,nb->na", light, weight + stretched))]
    while waiting:
        new = np.einsum("nab,nb->na", hold, waiting.pop(0))
        for _ in range(2):  # twice, so that rounding does not spoil orthogonality
            new = new - np.tensordot(np.tensordot(found, new, 2), found, 1)
        if np.abs(new).max() <= rounding:
            continue
        found = np.concatenate((found, [_unit(new)]))
        slowed = found[-1] * (spheres.mass.min() / spheres.mass)[:, None]
        pulled = np.einsum("nab,nb->na", light, push(found[-1], 0.0)) / most
        waiting += [pulled, slowed] if scene.eta > 0 else [pulled]
    return found


def _push(
    scene: Scene, bonds: list[PossibleContact], ks: Vector, q: Vector, stretch: Vector | float
) -> Vector:
    """Forces (n, 3) [N] of bonds at small displacements q (n, 3) [m] and an initial stretch [m]."""
    assert scene.bonds is not None
    i, j = scene.bonded_pairs.T
    n = np.array([bond.normal for bond in bonds])
    relative = q[j] - q[i]
    along = np.einsum("bk,bk->b", relative, n)
    pull = (scene.bonds.kn * (along + stretch) - ks * along)[:, None] * n + ks[:, None] * relative
    force = np.zeros_like(q)
    np.add.at(force, i, pull)
    np.add.at(force, j, -pull)
    return force


def _unit(motion: Vector) -> Vector:
    """A motion over its norm; zero stays zero."""
    size = float(np.linalg.norm(motion))
    return motion / size if size > 0 else motion


def _system_of(scene: Scene, bonds: list[PossibleContact], motions: Vector, ks: Vector) -> System:
    """The system with one unknown for each direction in which a sphere can move."""
    rounding = max(bond.rounding for bond in bonds)
    spaces = [
        directions_of_motion(scene.axes[free], list(motions[:, i]), rounding)
        for i, free in enumerate(scene.spheres.free)
    ]

    def bond_springs(owner: Owners, direction: Vector) -> BondSprings:
        assert scene.bonds is not None
        across = [np.linalg.svd(bond.normal[None])[2][1:] for bond in bonds]
        sheared = [
            (bond, axis, k)
            for bond, axes, k in zip(bonds, across, ks, strict=True)
            for axis in axes
            if k > 0
        ]
        kept = [*bonds, *(bond for bond, _, _ in sheared)]
        along = [*(bond.normal for bond in bonds), *(axis for _, axis, _ in sheared)]
        return BondSprings(
            rows=rows_of(kept, along, owner, direction),
            stiffness=np.array([*scene.bonds.kn, *(k for _, _, k in sheared)]),
            stretch=np.array([*(bond.gap for bond in bonds), *(0.0 for _ in sheared)]),
            length=np.array([bond.depth for bond in bonds]),
            names=tuple(bond.names for bond in bonds),
        )

    return equations(scene, spaces, [], (), [], bond_springs)
