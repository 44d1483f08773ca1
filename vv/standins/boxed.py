"""Describes scenes of rigid contact for codes whose bodies are all polyhedra: boxes are walls."""

from __future__ import annotations

from typing import Any

import numpy as np

from vv.ask import Ask
from vv.scene import Block, Harmonic, Pulse, Scene, Term, Vector, Wall, box_geometry

Plan = dict[str, Any]
THICKNESS = 0.5  # half the height of a box, over the size of the largest block
LEAST = 20.0  # half the sides of a box, over the same size, at least
BOXED = frozenset(  # the terms that the plain data of `boxed` describe completely
    {
        Term.BLOCK,
        Term.RIGID_CONTACT,
        Term.WALL_CONTACT,
        Term.FRICTION,
        Term.GRAVITY,
        Term.LOAD,
        Term.ROTATION,
        Term.OBLIQUE_LOCK,
        Term.SHAKING,
        Term.PULSE,
        Term.BASE_MOTION,
    }
)
ROUNDING = 1e-15  # components of a unit vector below this are zero


def why_no_boxes(ask: Ask) -> str | None:
    """Why rigid polyhedra alone cannot represent the scene of an ask; None if they can."""
    scene = ask.scene
    if not scene.contact.rigid:
        return "its contacts have no stiffness, but those of the scene do"
    moving = [wall for wall in scene.walls if wall.motion is not None]
    if len(moving) > 1:
        return f"{len(moving)} walls move; its input describes the motion of one"
    locked = [b for b in scene.blocks if (scene.axes @ b.velocity)[~b.free].any() and b.free.any()]
    if locked:
        return f"block '{locked[0].name}' moves along a direction that it is locked in"
    return None


def boxed(ask: Ask) -> Plan:
    """The input of a driver of rigid polyhedra: plain data in SI units, in the frame `scene.axes`.

    Blocks and walls have a body number, a centre, and vertices relative to it; walls also have the
    half sides of their box, its axes as rows, and the sines of their motion. Gravity and the sines
    of shaking act on all free blocks; shaking ends at the time `until` [s], or with the run if
    that is None. size: the largest extent of any block [m].
    """
    scene, axes = ask.scene, ask.scene.axes
    size = max(_size(block) for block in scene.blocks)
    half = max(LEAST * size, *(_reach(ask, block) for block in scene.blocks), 0.0)
    numbers = {kind: scene.body_numbers(kind) for kind in (Block, Wall)}
    return {
        "dt": ask.dt,
        "steps": ask.goal.steps(ask.dt),
        "stride": ask.goal.stride(ask.dt),
        "mu": float(scene.contact.mu),
        "size": size,
        "gravity": (axes @ scene.gravity).tolist(),
        "shaking": _sines(scene.wave, axes),
        "until": scene.shaking.until if isinstance(scene.shaking, Pulse) else None,
        "blocks": [
            _block(number, block, axes)
            for number, block in zip(numbers[Block], scene.blocks, strict=True)
        ],
        "walls": [
            _wall(number, wall, scene, half, size)
            for number, wall in zip(numbers[Wall], scene.walls, strict=True)
        ],
        "observe": [[type(seen).__name__.lower(), seen.body] for seen in ask.observables],
    }


def _block(number: int, block: Block, axes: Vector) -> Plan:
    return {
        "body": number,
        "name": block.name,
        "centre": (axes @ block.centroid()).tolist(),
        "vertices": ((block.vertices - block.centroid()) @ axes.T).tolist(),
        "faces": [list(face) for face in block.faces],
        "mass": block.mass,
        "inertia": (axes @ block.inertia @ axes.T).tolist(),
        "velocity": (axes @ block.velocity).tolist(),
        "spin": (axes @ block.spin).tolist(),
        "load": (axes @ block.load).tolist(),
        "free": block.free.tolist(),
        "free_spin": block.free_spin.tolist(),
    }


def _wall(number: int, wall: Wall, scene: Scene, half: float, size: float) -> Plan:
    """A box whose upper face is the wall, centred below the mean of the blocks' centroids."""
    normal = scene.axes @ wall.normal
    normal = np.where(np.abs(normal) < ROUNDING, 0.0, normal)
    middle = np.mean([scene.axes @ block.centroid() for block in scene.blocks], axis=0)
    below = middle - ((middle - scene.axes @ wall.point) @ normal) * normal
    along = np.eye(3)[np.abs(normal).argmin()]
    first = along - (along @ normal) * normal
    first /= np.linalg.norm(first)
    axes = np.stack([first, np.cross(normal, first), normal])
    sides = np.array([half, half, THICKNESS * size])
    vertices, faces = box_geometry(np.zeros(3), sides, axes)
    return {
        "body": number,
        "centre": (below - sides[2] * normal).tolist(),
        "vertices": vertices.tolist(),
        "faces": [list(face) for face in faces],
        "half": sides.tolist(),
        "axes": axes.tolist(),
        "motion": _sines(wall.motion, scene.axes),
    }


def _sines(motion: Harmonic | None, axes: Vector) -> list[list[Any]]:
    """Amplitude (3,) in the frame of the plan, angular frequency [rad/s] and phase of each sine."""
    found = [] if motion is None else motion.sines()
    return [[(axes @ a).tolist(), 2 * np.pi * f, phase] for a, f, phase in found]


def _size(block: Block) -> float:
    return float(np.ptp(block.vertices, axis=0).max())


def _reach(ask: Ask, block: Block) -> float:
    """A bound on the displacement [m] of a block along a wall: twice that without friction."""
    scene, t = ask.scene, ask.goal.duration
    pulled = scene.gravity + block.load / block.mass
    normal = scene.walls[0].normal if len(scene.walls) == 1 else np.zeros(3)
    along = [part - (part @ normal) * normal for part in (pulled, block.velocity)]
    reach = 0.5 * float(np.linalg.norm(along[0])) * t**2 + float(np.linalg.norm(along[1])) * t
    for a, f, _ in scene.wave.sines() if scene.wave else ():
        reach += float(np.linalg.norm(a)) * min(0.5 * t**2, t / (np.pi * f) if f else np.inf)
    for wall in scene.walls:
        reach += sum(2 * float(np.linalg.norm(a)) for a, _, _ in _moves(wall))
    return 2 * reach


def _moves(wall: Wall) -> list[tuple[Vector, float, float]]:
    return [] if wall.motion is None else list(wall.motion.sines())
