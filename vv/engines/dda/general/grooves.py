"""Turns the axes of a scene so that one runs along the groove that its walls form."""

from __future__ import annotations

import dataclasses

import numpy as np

from vv.scene import Scene

FLAT = 1e-12  # the third singular value of normals that are all across one direction


def along_groove(scene: Scene) -> Scene:
    """The scene with an axis along all of its walls, if two differ and its blocks move freely.

    Unknowns are displacements along the scene's axes. In a narrow groove forces across it are many
    times the weight, and the rounding of each unknown would reach the slip along it. Blocks of
    which a direction is locked keep the scene's axes, and so do those that strain, whose strains
    are told along these.
    """
    held = any(
        block.strains or not block.free.all() or block.free_spin.any() != block.free_spin.all()
        for block in scene.blocks
    )
    if held or len(scene.walls) < 2:
        return scene
    _, sizes, axes = np.linalg.svd(np.array([wall.normal for wall in scene.walls]))
    if not (sizes[1] > FLAT and (len(sizes) < 3 or sizes[2] < FLAT)):
        return scene
    axes = axes[[2, 0, 1]]
    return dataclasses.replace(scene, axes=axes * np.sign(np.linalg.det(axes)))
