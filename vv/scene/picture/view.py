"""Chooses the direction of view of a scene: the direction in which the scene extends least."""

from __future__ import annotations

import numpy as np

from vv.scene.arrays import Vector
from vv.scene.block import Block
from vv.scene.scene import Scene

FLAT = 0.02  # fraction of the largest extent: a scene of less depth is drawn head-on
OBLIQUE = np.array([[0.87, -0.5, 0.0], [0.25, 0.43, 0.87]])  # rows: right and up in the picture
EDGE_ON = 1e-6  # cosine below which a face is edge-on and is not drawn
NAMES = ("x", "y", "z")


def plane(scene: Scene) -> Vector:
    """The directions to the right and up in the picture, (2, 3).

    A scene of blocks and a flat scene are drawn head-on, with the direction of gravity, or else an
    oblique wall, at the bottom. Other scenes are drawn in an oblique view.
    """
    shown = _directions(scene)
    sight = _sight(scene, shown)
    places = _places(scene)
    depth, size = np.ptp(places @ sight), np.ptp(places, axis=0).max()
    level = (scene.axes == np.eye(3)).all() and not scene.gravity[:2].any()
    if level and not scene.blocks and depth > FLAT * size:
        return OBLIQUE
    up = _up(scene, sight)
    right = np.cross(up, sight)
    return np.array([right * np.sign(right[np.abs(right).argmax()]), up])


def names(seen: Vector) -> tuple[str, ...]:
    """The axes of the frame to the right and up, with their signs; empty for an oblique view."""
    found = []
    for row in seen:
        axis = int(np.abs(row).argmax())
        if abs(row[axis]) < 1 - 1e-9:
            return ()
        found.append(("-" if row[axis] < 0 else "") + NAMES[axis])
    return tuple(found)


def towards(seen: Vector) -> Vector:
    """The unit direction (3,) from the scene to the reader."""
    return np.cross(seen[0], seen[1])


def faces(block: Block, seen: Vector) -> list[Vector]:
    """The corners (k, 3) [m] of the faces of a block that face the reader."""
    found = []
    for face in block.faces:
        corners = block.vertices[list(face)]
        normal = np.cross(corners[1] - corners[0], corners[2] - corners[1])
        if normal @ towards(seen) > EDGE_ON * np.linalg.norm(normal):
            found.append(corners)
    return found


def _sight(scene: Scene, shown: Vector) -> Vector:
    """The line of sight (3,), along which the shown directions have the least part."""
    skew = _least_seen(shown.T @ shown)
    axes = np.vstack([np.eye(3)[[1, 2, 0]], scene.axes[::-1], skew])
    hidden = [float(((shown @ axis) ** 2).sum()) for axis in axes]
    return np.asarray(axes[int(np.argmin(np.round(hidden, 9)))])


def _least_seen(seen: Vector) -> Vector:
    """The unit eigenvector (3,) of the smallest eigenvalue of a symmetric matrix (3, 3).

    Of several, as where all lies on one line, it is the one nearest to y, or else z or x, so that
    it does not depend on which of them a machine finds.
    """
    values, vectors = np.linalg.eigh(seen)
    least = vectors[:, values - values[0] <= 1e-9 * values[-1]]
    onto = least @ least.T
    found = onto[:, max((1, 2, 0), key=lambda axis: round(onto[axis, axis], 9))]
    return unit(found)


def _up(scene: Scene, sight: Vector) -> Vector:
    """The upward direction (3,): against gravity, away from an oblique wall, or the last axis."""
    if scene.gravity.any():
        up = -unit(scene.gravity)
    else:
        oblique = (w.normal for w in scene.walls if np.abs(w.normal).max() < 1 - 1e-9)
        up = next((n for n in oblique if abs(n @ sight) < 0.5), np.eye(3)[2])
    up = up - (up @ sight) * sight
    if np.linalg.norm(up) < 1e-6:
        up = np.eye(3)[1] - sight[1] * sight
    return unit(up)


def unit(vector: Vector) -> Vector:
    """The direction (3,) of a vector that is not zero, even if its square is."""
    scaled = vector / np.abs(vector).max()
    return np.asarray(scaled / np.linalg.norm(scaled))


def _directions(scene: Scene) -> Vector:
    """The directions (n, 3) that a picture should show, with the spread of the bodies.

    They are unit vectors of normals, loads and velocities, and of the free directions of blocks
    that are partly locked.
    """
    found = [wall.normal for wall in scene.walls for _ in range(4)]
    found += [scene.gravity, *scene.spheres.velocity, *scene.spheres.load]
    found += [v for block in scene.blocks for v in (block.velocity, block.load)]
    found += [
        way for block in scene.blocks if not block.free.all() for way in scene.axes[block.free]
    ]
    moves = [scene.wave, *(wall.motion for wall in scene.walls)]
    found += [along for motion in moves if motion for along, _, _ in motion.sines()]
    units = [unit(v) for v in found if v.any()]
    places = _places(scene)
    spread = places - places.mean(axis=0)
    size = float(np.abs(spread).max(initial=0.0)) or 1.0
    return np.vstack([*units, spread / size / np.sqrt(len(spread))])


def _places(scene: Scene) -> Vector:
    """Centres of spheres and corners of blocks, (n, 3) [m]."""
    return np.concatenate([scene.spheres.position, *(b.vertices for b in scene.blocks)])
