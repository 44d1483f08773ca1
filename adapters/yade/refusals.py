"""Reasons why YADE cannot represent an ask although it has every term."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from adapters.yade.polyhedra import why_no_polyhedron
from adapters.yade.setup import CLUMP, HALF_STEP, POLYHEDRA, framed
from adapters.yade.terms.bonds import why_no_bonds
from adapters.yade.terms.hertz import why_no_material, why_not_viscous
from vv.ask import Ask, Reaction
from vv.codes import behind_wall, no_drag, no_sphere, turned_spin_lock
from vv.scene import Scene, Term, why_locks_need_more_than_loads
from vv.standins.stand_in import spring_scene, why_no_spring_scene, without_rotations
from vv.standins.why_no_clump import why_no_clump

NO_BLOCK: Mapping[str, Callable[[Ask], str | None]] = {
    CLUMP: why_no_clump,
    POLYHEDRA: why_no_polyhedron,
}


def refusal(ask: Ask, scheme: str) -> str | None:
    """The first reason to refuse the ask; None if there is none."""
    reason = NO_BLOCK.get(scheme, why_no_spring_scene)(ask)
    if reason is not None:
        return reason
    scene = spring_scene(without_rotations(framed(ask, scheme))).scene
    return (
        no_sphere(ask, scene)
        or _locked_spin(scene)
        or why_locks_need_more_than_loads(scene)
        or turned_spin_lock(ask.scene, "YADE locks its own axes only")
        or _turns_about_two(ask.scene)
        or behind_wall(scene)
        or why_no_bonds(scene)
        or why_no_material(scene.contact.hertz)
        or why_not_viscous(scene)
        or _oblique_reaction(ask)
        or (no_drag(scene) if scheme == HALF_STEP else None)
    )


def _locked_spin(scene: Scene) -> str | None:
    """Why a body that spins about a locked axis is refused: YADE keeps it spinning."""
    about = np.where(scene.spheres.free_spin, 0.0, scene.spheres.spin @ scene.axes.T)
    if about.any():
        return "a sphere has a spin in a locked freedom, which YADE would maintain"
    return None


def _turns_about_two(scene: Scene) -> str | None:
    """Why a block that rotates about two axes is refused: it has products of inertia."""
    for block in scene.blocks:
        if int(block.free_spin.sum()) == 2:
            return (
                f"block '{block.name}' can rotate about two axes; for a body with a locked "
                "rotation YADE uses moments about the axes of the frame, which change as it "
                "rotates"
            )
    return None


def _oblique_reaction(ask: Ask) -> str | None:
    if Term.OBLIQUE_LOCK in ask.scene.terms() and any(
        isinstance(seen, Reaction) for seen in ask.observables
    ):
        return "the reaction of oblique locks, which dead loads replace, is not known"
    return None
