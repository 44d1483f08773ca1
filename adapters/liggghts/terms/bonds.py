"""Translates bonds for LIGGGHTS: harmonic bonds in a data file, or overlapping spheres."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from adapters.liggghts.overlaps import OVERLAP
from adapters.liggghts.sections import Deck
from adapters.liggghts.setup import Setup
from adapters.liggghts.words import numbers, printed
from vv.scene import Scene, Term, Vector

FILE = "bonded.data"  # written by each deck just before it is read
LASTING = {
    Term.BREAKAGE: (
        "its only bond style, harmonic, has no strength, and no fix of this build breaks bonds"
    ),
    Term.BOND_SHEAR: "its only bond style, harmonic, acts along bonds",
}


def harmonic(deck: Deck, setup: Setup) -> Deck:
    """Bonds without shear springs; in one scheme, contacts represent bonds instead.

    No command creates single bonds: a data file holds the box, the spheres and their bonds. Sizes
    and masses are set later, as for spheres without bonds.
    """
    if setup.scene.bonds is None:
        note = (
            f"bonds as contacts that overlap by {OVERLAP:g} of their length at t = 0, where dead "
            "loads cancel their forces: a surrogate, accurate to about that fraction in E"
        )
        return deck.with_more(notes=[note])
    made = [*printed(FILE, _data(setup.scene, setup.room.outer)), f"read_data       {FILE}"]
    bonds = tuple(_springs(setup.scene))
    law_note = (
        "bond_style harmonic with the coefficient kn/2, which has no shear spring; no pair_style"
    )
    return replace(
        deck,
        style="hybrid granular molecular",
        box=tuple(made),
        created=(),
        law=replace(deck.law, bonds=bonds, note=law_note),
    )


def _springs(scene: Scene) -> Iterator[str]:
    """The coefficients of harmonic bonds: their energy is K (L - length)^2, so K is kn/2."""
    yield "pair_style      none"
    yield "bond_style      harmonic"
    for number, (kn, length) in enumerate(_kinds(scene)[0].tolist()):
        yield f"bond_coeff      {number + 1} {kn / 2!r} {length!r}"


def why_not_harmonic(scene: Scene) -> str | None:
    """Why harmonic bonds cannot represent those of a scene; None if they can, or there are none."""
    beside = scene.terms() & {Term.SPHERE_CONTACT, Term.WALL_CONTACT}
    if scene.bonds is not None and beside:
        return (
            "the scene has contacts beside bonds; LIGGGHTS' harmonic bonds are verified without "
            "contacts only"
        )
    return None


def _kinds(scene: Scene) -> tuple[Vector, npt.NDArray[np.intp]]:
    """The distinct (kn, length) of the bonds, (k, 2), and the kind of each bond, (b,)."""
    assert scene.bonds is not None
    both = np.column_stack([scene.bonds.kn, scene.bonds.length])
    kinds, which = np.unique(both, axis=0, return_inverse=True)
    return kinds, which.ravel().astype(np.intp)


def _data(scene: Scene, outer: tuple[Vector, Vector]) -> Iterator[str]:
    kinds, which = _kinds(scene)
    yield from ("bonded spheres", "", f"{len(scene.spheres)} atoms", f"{len(which)} bonds")
    yield from ("1 atom types", f"{len(kinds)} bond types")
    for axis, low, high in zip("xyz", *(corner.tolist() for corner in outer), strict=True):
        yield f"{low!r} {high!r} {axis}lo {axis}hi"
    yield from ("", "Atoms", "")
    for i, place in enumerate(scene.spheres.position):
        yield f"{i + 1} 1 {numbers(place)} 1.0 1.0 1"  # then its diameter, density and molecule
    yield from ("", "Bonds", "")
    for b, ((i, j), kind) in enumerate(
        zip(scene.bonded_pairs.tolist(), which.tolist(), strict=True)
    ):
        yield f"{b + 1} {kind + 1} {i + 1} {j + 1}"
