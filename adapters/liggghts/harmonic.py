"""Writes bonds without shear springs as LIGGGHTS' harmonic bonds, in a data file a deck makes."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from adapters.liggghts.words import numbers, printed
from vv.scene import Scene, Term, Vector

FILE = "bonded.data"  # made by each deck anew, just before it is read
LASTING = {
    Term.BREAKAGE: "harmonic, its only style of bonds, has no strength; no fix here parts bonds",
    Term.BOND_SHEAR: "harmonic, its only style of bonds, acts along them",
}
BONDED_STYLE = "hybrid granular molecular"


def bonded_atoms(scene: Scene, outer: tuple[Vector, Vector]) -> Iterator[str]:
    """Commands that write the box, the spheres and their bonds to a file, and read it.

    No command makes bonds by name. Sizes and masses are set later, as for spheres without.
    """
    yield from printed(FILE, _data(scene, outer))
    yield f"read_data       {FILE}"


def bond_commands(scene: Scene) -> Iterator[str]:
    """The springs: a harmonic bond holds the energy K (L - length)^2, so K is kn/2."""
    yield "pair_style      none"
    yield "bond_style      harmonic"
    for number, (kn, length) in enumerate(_kinds(scene)[0].tolist()):
        yield f"bond_coeff      {number + 1} {kn / 2!r} {length!r}"


def why_not_harmonic(scene: Scene) -> str | None:
    """Why harmonic bonds cannot stand in a scene; None if they can, or there are none."""
    beside = scene.terms() & {Term.SPHERE_CONTACT, Term.WALL_CONTACT}
    if scene.bonds is not None and beside:
        return "contacts beside bonds; LIGGGHTS' harmonic bonds were verified without contacts only"
    return None


def _kinds(scene: Scene) -> tuple[Vector, npt.NDArray[np.intp]]:
    """The different (kn, length) of the bonds, (k, 2), and which of them each bond has, (b,)."""
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
