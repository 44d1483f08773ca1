"""Translates a block for YADE into a polyhedron, which meets an infinite wall across an axis."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from vv.ask import Ask
from vv.scene import Block, Scene, Vector, Wall, rotated
from vv.standins.penalty_springs import TOUCHING
from vv.standins.stand_in import why_no_spring_scene

MOST_STEPS = 10_000  # steps at most: each takes about 0.1 ms, thirty times that of a sphere
THINNEST = 0.1  # thickness over size below which YADE may miss contacts of polyhedra


def why_no_polyhedron(ask: Ask) -> str | None:
    """Why YADE's polyhedra cannot represent the scene of an ask; None if they can."""
    scene = ask.scene
    if len(scene.blocks) != 1 or len(scene.walls) != 1 or len(scene.spheres):
        return "YADE's polyhedra are verified for one block on one wall only"
    (block,) = scene.blocks
    if block.free_spin.any():
        return (
            f"block '{block.name}' can rotate; the force on its overlap acts at one point, and no "
            "spring can carry the moment of friction at t = 0: it would start to rock"
        )
    return why_no_spring_scene(ask) or _no_face(block, scene.walls[0]) or _too_long(ask)


def _no_face(block: Block, wall: Wall) -> str | None:
    size = float(np.ptp(block.vertices, axis=0).max())
    if float(np.ptp(block.vertices @ wall.normal)) < THINNEST * size:
        return (
            f"block '{block.name}' is thinner than {THINNEST:g} of its size; YADE may miss its "
            "contacts"
        )
    if _area(block, wall) == 0:
        return f"block '{block.name}' does not stand on a face; an edge has no area of contact"
    return None


def _too_long(ask: Ask) -> str | None:
    steps = 0 if ask.knobs.dt is None else ask.goal.steps(ask.knobs.dt)
    if steps > MOST_STEPS:
        return f"{steps} steps with polyhedra, of about 0.1 ms each; {MOST_STEPS} are run at most"
    return None


def _area(block: Block, wall: Wall) -> float:
    """The area [m2] of the face on the wall; 0 if there is none."""
    size = float(np.ptp(block.vertices, axis=0).max())
    on = np.abs((block.vertices - wall.point) @ wall.normal) < TOUCHING * size
    for face in block.faces:
        if on[list(face)].all():
            corners = block.vertices[list(face)]
            across = 0.5 * np.cross(corners, np.roll(corners, -1, axis=0)).sum(axis=0)
            return float(np.linalg.norm(across))
    return 0.0


def turn_of(scene: Scene) -> Vector:
    """The rotation (3, 3) that makes the wall normal to z; its rows are the new axes."""
    normal = scene.walls[0].normal
    along = scene.axes[np.abs(scene.axes @ normal).argmin()]
    first = along - (along @ normal) * normal
    first /= np.linalg.norm(first)
    return np.array([first, np.cross(normal, first), normal])


def laid(ask: Ask) -> Ask:
    """The ask in the frame of `turn_of`, in which the wall's normal is exactly z."""
    scene = rotated(ask.scene, turn_of(ask.scene))
    up = np.array([0.0, 0.0, 1.0])
    bodies = tuple(replace(g, normal=up) if isinstance(g, Wall) else g for g in scene.bodies)
    return replace(ask, scene=replace(scene, bodies=bodies))


def polyhedral(plan: dict[str, Any], scene: Scene, charged: Vector | None) -> dict[str, Any]:
    """The driver's ask with the one sphere as a polyhedron, for a scene that is `laid` already.

    charged: (1, 3) friction [N] in its shear spring at t = 0. YADE's normal force is kn/area times
    the volume of the overlap. YADE resets the shear force of a contact when it creates it, and then
    adds the shear of the whole first step. So in that step the block moves at the velocity that
    charges the spring, and an impulse then gives it the right momentum.
    """
    (block,), (wall,) = scene.blocks, scene.walls
    ks, dt = plan["ks"], plan["dt"]
    sliding = np.zeros(3) if charged is None or ks == 0 else -charged[0] / ks / dt
    (sphere,) = (body for body in plan["bodies"] if body["kind"] == "sphere")
    push = np.array(sphere["push"]) + sphere["mass"] / dt * (np.array(sphere["velocity"]) - sliding)
    made = {
        **sphere,
        "kind": "polyhedron",
        "vertices": (block.vertices - block.centroid()).tolist(),
        "velocity": sliding.tolist(),
        "push": push.tolist(),
    }
    area = _area(block, wall)
    bodies = [made if body is sphere else body for body in plan["bodies"]]
    return {**plan, "kn": plan["kn"] / area, "charged": [], "bodies": bodies, "volumes": True}
