"""The commands of every deck: box, atoms, contact law, time integration."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from adapters.liggghts.data import many, read_data
from adapters.liggghts.sections import Deck, Law
from adapters.liggghts.setup import OVERLAPPED, Setup
from adapters.liggghts.space import CROWD
from adapters.liggghts.words import AXES, bounds, group, numbers, parts
from vv.scene import Mask, Term, Vector
from vv.scene.neighbours import overlapping

BINS = 256  # per sphere, where there are many
ASIDE = 2.25  # in radii: bins narrower than two spheres are searched in vain
STRAIGHT = 1e-12  # relative to the distance of two spheres: less out of line is rounding


def bare(setup: Setup) -> Deck:
    """The sections that every deck has; terms add to them."""
    frozen = "spheres without any freedom are not integrated"
    listed = many(setup)
    zeros = {"kt": 0.0, "gamman": 0.0, "gammat": 0.0, "coefficientFriction": 0.0}
    return Deck(
        box=tuple(read_data(setup, _places(setup)) if listed else _box(setup)),
        neighbours=tuple(_neighbours(setup)),
        created=() if listed else tuple(_created(setup)),
        sized=() if listed else tuple(_sized(setup)),
        law=Law({"kn": setup.scene.contact.kn, **zeros}),
        integrated=tuple(_integrated(setup)),
        last=tuple(_locks(setup)),
        motion_notes=tuple(_motion_notes(setup)),
        notes=() if setup.moving.all() else (frozen,),
    )


def _box(setup: Setup) -> Iterator[str]:
    yield f"region          box block {bounds(*setup.room.outer)} units box"
    yield "create_box      1 box"


def _neighbours(setup: Setup) -> Iterator[str]:
    """Neighbour lists in a box far larger than the scene; rebuilt when half the skin is used up.

    LIGGGHTS discards the shear spring of a pair that has separated only when it rebuilds the list,
    and otherwise reuses it for the next contact of the pair. Where this can happen, the list is
    rebuilt in every step.
    """
    radius = float(setup.spheres.radius.max())
    yield f"neighbor        {0.2 * radius!r} bin"
    often = "every 1 check no " if meets_again(setup) else ""
    yield f"neigh_modify    delay 0 {often}binsize {max(ASIDE * radius, _bin(setup))!r}"


def _bin(setup: Setup) -> float:
    """The side of a bin [m]: few bins in so large a box, but more where there are many spheres.

    All spheres may lie in a corner of the box, and a bin should still hold few.
    """
    sides, count = setup.room.outer[1] - setup.room.outer[0], len(setup.spheres)
    if count < CROWD:
        return float(sides.max() / 20)
    return math.cbrt(sides.prod() / (BINS * count))


def meets_again(setup: Setup) -> bool:
    """Whether spheres with friction may separate and touch again.

    They cannot if locks hold them together, or if they represent blocks, which do not touch each
    other. Where no observable is asked for, as in timing, no answer depends on it.
    """
    if not (setup.ask.observables or setup.ask.energies):
        return False
    scene = setup.springs.scene
    spheres = scene.spheres
    if Term.FRICTION not in scene.terms() or setup.scheme == OVERLAPPED or setup.ask.scene.blocks:
        return False
    i, j = overlapping(spheres).T
    if len(i) < len(spheres) * (len(spheres) - 1) // 2:
        return True
    along = (spheres.position[j] - spheres.position[i]) @ scene.axes.T
    along[np.abs(along) < STRAIGHT * np.abs(along).max(axis=1, initial=0.0, keepdims=True)] = 0.0
    return bool(along[spheres.free[i] | spheres.free[j]].any())


def _created(setup: Setup) -> Iterator[str]:
    """Atoms in body order, so that ids are sphere numbers from 1."""
    for place in _places(setup).tolist():
        yield f"create_atoms    1 single {numbers(place)} units box"


def _places(setup: Setup) -> Vector:
    """The positions (n, 3) [m] where spheres are created, before they slide to those at t = 0."""
    places = np.array(setup.spheres.position)
    for i, way in setup.slides.items():
        places[i] -= way
    return places


def _sized(setup: Setup) -> Iterator[str]:
    """Radii; masses, which override densities; and velocities at t = 0."""
    spheres = setup.spheres
    yield "set             group all density 1"
    sizes, masses = (2 * spheres.radius).tolist(), spheres.mass.tolist()
    for number, (size, mass) in enumerate(zip(sizes, masses, strict=True), 1):
        yield f"set             atom {number} diameter {size!r} mass {mass!r}"
    for name, rows in (("v", spheres.velocity), ("omega", spheres.spin)):
        given = np.flatnonzero(rows.any(axis=1))
        for row, vector in zip(given.tolist(), rows[given].tolist(), strict=True):
            yield f"set             atom {row + 1} {parts(name, vector)}"


def _kinds(setup: Setup) -> tuple[tuple[str, str, Mask], ...]:
    """For spheres that move alike: the group, the style of integration, and the members (n,)."""
    shifted = setup.moving & ~setup.turning
    return ("shifted", "nve", shifted), ("turned", "nve/sphere", setup.turning)


def _integrated(setup: Setup) -> Iterator[str]:
    for name, style, members in _kinds(setup):
        if members.any():
            yield group(name, np.flatnonzero(members).tolist())
            yield f"fix {name} {name} {style}"


def _locks(setup: Setup) -> Iterator[str]:
    """A force of zero along locked axes, which cancels all others."""
    for pattern, held in setup.locks.items():
        name = "lock_" + "".join(a for a, locked in zip(AXES, pattern, strict=True) if locked)
        yield group(name, held)
        zeros = " ".join("0" if locked else "NULL" for locked in pattern)
        yield f"fix {name} {name} setforce {zeros}"


def _motion_notes(setup: Setup) -> Iterator[str]:
    if (setup.moving & ~setup.turning).any():
        yield "fix nve: all three translations, no rotation"
    if setup.turning.any():
        yield "fix nve/sphere for spheres that turn, with the inertia 2/5 m r2"
    if setup.locks:
        yield "a locked axis is a force of zero on it (fix setforce)"
