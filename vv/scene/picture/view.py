"""Chooses the direction of view of a scene: that in which it extends least."""

from __future__ import annotations

import numpy as np

from vv.scene.arrays import Vector
from vv.scene.block import Block
from vv.scene.scene import Scene

FLAT = 0.02  # of the largest extent: a scene that is less deep is seen straight on
OBLIQUE = np.array([[0.87, -0.5, 0.0], [0.25, 0.43, 0.87]])  # rows: right and up, as seen
EDGE_ON = 1e-6  # of a face: what is seen edge on has no face to show
NAMES = ("x", "y", "z")


def plane(scene: Scene) -> Vector:
    """Directions to the right and up, (2, 3): of the frame, oblique to it where a scene is deep.

    A scene of blocks, and one that is flat, is seen straight on, with gravity, or else an
    oblique wall, below.
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
    """The axes of the frame to the right and up, with their signs; none of an oblique view."""
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
    """The corners (k, 3) [m] of the faces of a block that look at the reader."""
    found = []
    for face in block.faces:
        corners = block.vertices[list(face)]
        normal = np.cross(corners[1] - corners[0], corners[2] - corners[1])
        if normal @ towards(seen) > EDGE_ON * np.linalg.norm(normal):
            found.append(corners)
    return found


def _sight(scene: Scene, shown: Vector) -> Vector:
    """The unit direction (3,) along which least of what is to be shown points."""
    skew = np.linalg.eigh(shown.T @ shown)[1][:, 0]
    skew = skew * np.sign(skew[np.abs(skew).argmax()])
    axes = np.vstack([np.eye(3)[[1, 2, 0]], scene.axes[::-1], skew])
    hidden = [float(((shown @ axis) ** 2).sum()) for axis in axes]
    return np.asarray(axes[int(np.argmin(np.round(hidden, 9)))])


def _up(scene: Scene, sight: Vector) -> Vector:
    """Up (3,) across a line of sight: against gravity, off an oblique wall, or the last axis."""
    if scene.gravity.any():
        up = -scene.gravity
    else:
        oblique = (w.normal for w in scene.walls if np.abs(w.normal).max() < 1 - 1e-9)
        up = next((n for n in oblique if abs(n @ sight) < 0.5), np.eye(3)[2])
    up = up - (up @ sight) * sight
    if np.linalg.norm(up) < 1e-6 * np.linalg.norm(scene.gravity) or not up.any():
        up = np.eye(3)[1] - sight[1] * sight
    return np.asarray(up / np.linalg.norm(up))


def _directions(scene: Scene) -> Vector:
    """(n, 3) unit vectors of what a picture should show; of bodies, how they are spread.

    Of a block that is locked in some directions those in which it may move.
    """
    found = [wall.normal for wall in scene.walls for _ in range(4)]
    found += [scene.gravity, *scene.spheres.velocity, *scene.spheres.load]
    found += [v for block in scene.blocks for v in (block.velocity, block.load)]
    found += [
        way for block in scene.blocks if not block.free.all() for way in scene.axes[block.free]
    ]
    moves = [scene.wave, *(wall.motion for wall in scene.walls)]
    found += [along for motion in moves if motion for along, _, _ in motion.sines()]
    units = [v / np.linalg.norm(v) for v in found if np.linalg.norm(v) > 0]
    places = _places(scene)
    spread = places - places.mean(axis=0)
    size = float(np.abs(spread).max(initial=0.0)) or 1.0
    return np.vstack([*units, spread / size / np.sqrt(len(spread))])


def _places(scene: Scene) -> Vector:
    """Centres of spheres and corners of blocks, (n, 3) [m]."""
    return np.concatenate([scene.spheres.position, *(b.vertices for b in scene.blocks)])
