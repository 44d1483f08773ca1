"""Represents scenes of blocks and rigid contact by spheres and springs."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

import numpy as np

from vv.ask import NO_STIFFNESS, Ask
from vv.scene import Block, Scene, Term, Vector, Wall
from vv.standins.penalty_springs import (
    TOUCHING,
    as_spheres,
    base_velocity,
    fastest,
    found_once,
    friction_at_start,
    softened,
    why_no_point,
)
from vv.standins.separation import why_not_apart

SHEAR = 25.0
"""ks/kn of the springs that represent rigid contact, which does not define ks.

The normal spring causes an error of order 1/kn. The shear spring lags by a time sqrt(mu N/(ks a))
whenever slip changes its direction, which causes the larger error, of order ks^-1/2: therefore it
is the stiffer one.
"""
STANDS_IN = frozenset({Term.BLOCK, Term.RIGID_CONTACT})


@dataclass(frozen=True, eq=False)
class SpringScene:
    """A scene of spheres and springs that represents another scene.

    charged: friction (n, 3) [N] in the shear springs at t = 0, None for zero. terms: the terms of
    the original scene that it represents; notes: how it represents them, one fact each.
    """

    scene: Scene
    charged: Vector | None
    terms: frozenset[Term]
    notes: tuple[str, ...]


@found_once
def spring_scene(ask: Ask) -> SpringScene:
    """The scene that a code with springs and spheres solves; `why_no_spring_scene` must be None.

    Springs kn, ks = SHEAR kn represent rigid contact. They start in the limit of rigid contact:
    compressed by the normal force and sheared by the friction of the wall at t = 0. Springs that
    belong to the scene itself start without shear.
    """
    scene, kn = ask.scene, ask.knobs.kn
    terms = scene.terms() & STANDS_IN
    notes = []
    charged = None
    if Term.BLOCK in terms:
        scene = as_spheres(scene)
        notes.append("a sphere of its mass stands for a block that cannot turn")
    if Term.RIGID_CONTACT in terms and kn is not None:
        if scene.walls:
            charged = friction_at_start(scene)
        scene = softened(scene, kn, SHEAR)
        notes.append(
            f"springs kn = {kn:g}, ks = {SHEAR * kn:g} N/m, charged as rigid contact is at t = 0"
        )
    return SpringScene(scene, charged, terms, tuple(notes))


@found_once
def without_rotations(ask: Ask) -> Ask:
    """The ask with its blocks locked against rotation, as the spheres that represent them are.

    A code that represents a block by a rigid body adds the rotations itself.
    """
    if not any(block.free_spin.any() for block in ask.scene.blocks):
        return ask
    return dataclasses.replace(ask, scene=_locked(ask.scene))


@found_once
def _locked(scene: Scene) -> Scene:
    """The scene with its blocks locked against rotation."""
    bodies = tuple(
        dataclasses.replace(g, free_spin=np.zeros(3, bool)) if isinstance(g, Block) else g
        for g in scene.bodies
    )
    return dataclasses.replace(scene, bodies=bodies)


@found_once
def why_no_spring_scene(ask: Ask) -> str | None:
    """Why springs and spheres cannot represent the scene of an ask; None if they can."""
    reason = why_no_point(ask.scene) if ask.scene.blocks else None
    if reason is None and len(ask.scene.blocks) > 1:
        reason = why_not_apart(ask)
    if reason is not None or Term.RIGID_CONTACT not in ask.scene.terms():
        return reason
    if ask.knobs.kn is None:
        return NO_STIFFNESS
    if not ask.scene.blocks:
        return _bounces(ask.scene, apart=False)
    return _bounces(as_spheres(ask.scene), apart=True)


def _bounces(scene: Scene, apart: bool) -> str | None:
    """Why springs would differ from rigid contact at an impact or under a locked body, else None.

    apart: whether several bodies are known never to touch each other.
    """
    s = scene.spheres
    if (len(s) > 1 and not apart) or len(scene.walls) > 1:
        return "springs stand in for rigid contact between one body and one wall only"
    pairs = ((i, wall) for wall in scene.walls for i in range(len(s)))
    return next((reason for i, wall in pairs if (reason := _bounces_off(scene, i, wall))), None)


def _bounces_off(scene: Scene, i: int, wall: Wall) -> str | None:
    s = scene.spheres
    gap = float((s.position[i] - wall.point) @ wall.normal - s.radius[i])
    if abs(gap) > TOUCHING * s.radius[i]:
        return (
            f"the body is {gap:.3g} m off its wall at t = 0; rigid contact does not define a "
            "rebound, springs would return all energy"
        )
    closing = float((s.velocity[i] - base_velocity(wall.motion)) @ wall.normal)
    if abs(closing) > TOUCHING * (np.linalg.norm(s.velocity[i]) + fastest(wall.motion)):
        return f"the body leaves its wall at {closing:.3g} m/s at t = 0; springs would oscillate"
    locked = scene.axes[~s.free[i]]
    if np.abs(locked @ wall.normal).max(initial=0.0) > TOUCHING:
        return "the body is locked along the normal of its wall; the normal force is not determined"
    return None
