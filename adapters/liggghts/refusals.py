"""Reasons why LIGGGHTS cannot represent an ask although it has every term."""

from __future__ import annotations

import numpy as np

from adapters.liggghts.overlaps import why_not_overlapped
from adapters.liggghts.setup import CLUMP, HALF_STEP, OVERLAPPED, Setup, set_up
from adapters.liggghts.terms.bonds import why_not_harmonic
from adapters.liggghts.terms.forces import FEW
from adapters.liggghts.terms.hertz import why_not_viscous
from vv.ask import Ask
from vv.codes import behind_wall, no_drag, no_sphere, no_steps, turned_spin_lock
from vv.scene import Scene, why_locks_need_more_than_loads
from vv.standins.stand_in import spring_scene, why_no_spring_scene, without_rotations
from vv.standins.why_no_clump import why_no_clump

GROUPS = 32 - 3  # LIGGGHTS has 32; decks use all, shifted and turned otherwise


def refusal(ask: Ask, scheme: str) -> str | None:
    """The first reason to refuse the ask; None if there is none."""
    reason = why_no_clump(ask) if scheme == CLUMP else why_no_spring_scene(ask)
    if reason is not None:
        return reason
    scene = spring_scene(without_rotations(ask)).scene
    why = why_not_overlapped if scheme == OVERLAPPED else why_not_harmonic
    if (reason := why(scene)) is not None:
        return reason
    return (
        no_sphere(ask, scene)
        or _no_steps(ask)
        or _locked_motion(scene)
        or why_locks_need_more_than_loads(scene)
        or _nothing_free(scene)
        or _spin(scene, scheme)
        or turned_spin_lock(ask.scene, "fix rigid locks its own only")
        or behind_wall(scene)
        or why_not_viscous(scene)
        or _too_many_groups(set_up(ask, scheme))
        or (no_drag(scene) if scheme == HALF_STEP else None)
    )


def _no_steps(ask: Ask) -> str | None:
    return "dt is not set; LIGGGHTS needs a time step" if ask.knobs.dt is None else no_steps(ask)


def _locked_motion(scene: Scene) -> str | None:
    """Why a locked sphere that moves is refused: a force of zero would keep it moving."""
    spheres = scene.spheres
    along = np.where(spheres.free, 0.0, spheres.velocity @ scene.axes.T)
    about = np.where(spheres.free_spin, 0.0, spheres.spin @ scene.axes.T)
    allowed = 1e-12 * np.abs(spheres.velocity).max(axis=1, keepdims=True)
    if (np.abs(along) > allowed).any() or (np.abs(about) > 0).any():
        return "a sphere has a velocity or spin in a locked freedom, which LIGGGHTS would maintain"
    return None


def _nothing_free(scene: Scene) -> str | None:
    return None if scene.unknowns() else "no sphere is free to move"


def _spin(scene: Scene, scheme: str) -> str | None:
    """Why rotation is refused: fix nve/sphere has three axes or none, and the inertia 2/5 m r2."""
    spheres, turning = scene.spheres, scene.spheres.free_spin.any(axis=1)
    if not turning.any():
        return None
    if (turning & ~spheres.free_spin.all(axis=1)).any():
        return (
            "a sphere can rotate about some axes only; LIGGGHTS allows rotation about all or none"
        )
    if (
        np.abs(spheres.inertia / (0.4 * spheres.mass * spheres.radius**2) - 1)[turning] > 1e-12
    ).any():
        return "the inertia of a rotating sphere is not 2/5 m r2, which LIGGGHTS assumes"
    if scheme == HALF_STEP and scene.eta > 0:
        return (
            "raised masses would also raise the inertia of rotating spheres, on which drag has no "
            "effect"
        )
    return None


def _too_many_groups(setup: Setup) -> str | None:
    bodies = len(setup.clumps) if len(setup.clumps) > 1 else 0
    loads = len(setup.loads) if len(setup.loads) <= FEW else 0  # many loads take no groups
    groups = loads + len(setup.locks) + len(setup.shaken) + bodies
    if groups > GROUPS:
        return (
            f"{groups} different dead loads, locks, shaken masses and blocks; LIGGGHTS has "
            f"{GROUPS} groups for them"
        )
    return None
