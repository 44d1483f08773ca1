"""Scenes of one or two boxes drawn independently of each other, for statistics.

Those of `tests/scenes/random_scenes.py` are not independent: hypothesis repeats and varies what it
drew, and draws other scenes in another version.
"""

from __future__ import annotations

import numpy as np

from tests.scenes.blocks.block_scenes import box
from vv.scene import Block, Contact, Harmonic, Scene, Vector, Wall

UP = np.array([0.0, 0.0, 1.0])


def drawn(random: np.random.Generator) -> Scene:
    """Boxes on a floor, over it or in the open: locked or not, thrown, spinning, pulled.

    A floor rises only where every box may rise: others can jam, which has no answer.
    """
    blocks: list[Block] = []
    top = 0.0
    for name in "ab"[: random.integers(1, 3)]:
        half, axes = random.uniform(0.1, 0.6, 3), _axes(random)
        reach = np.linalg.norm(half) if _even(random) else half @ np.abs(axes[:, 2])
        top += float(reach)
        blocks.append(_box(random, name, top, half, axes))
        top += float(reach)
    rises = all(block.free[2] for block in blocks)
    moves = Harmonic(_vector(random, 0.05) * [1.0, 1.0, float(rises)], np.ones(3))
    floor = Wall(np.zeros(3), UP, moves if random.random() < 1 / 3 else None)
    weight = np.array([*random.uniform(-3.0, 3.0, 2), -9.81])
    return Scene(
        (*[floor] * _even(random), *blocks),
        Contact(np.inf, mu=random.choice([0.0, 0.2, 0.6, 1.5])),
        gravity=weight * random.choice([1.0, 1e-3, 0.0]),
    )


def _box(random: np.random.Generator, name: str, top: float, half: Vector, axes: Vector) -> Block:
    free, spins = random.random((2, 3)) < 0.5
    return box(
        name, [*random.uniform(-0.1, 0.1, 2), top], half, axes, free=free, free_spin=spins,
        velocity=_vector(random, 1.0) * _even(random) * free,
        spin=_vector(random, 2.0) * _even(random) * spins,
        load=_vector(random, 300.0) * _even(random),
    )  # fmt: skip


def _axes(random: np.random.Generator) -> Vector:
    """Three orthonormal rows, every other time those of the frame."""
    if _even(random):
        return np.eye(3)
    normal = random.normal(size=3)
    normal /= np.linalg.norm(normal)
    mirrored = np.eye(3) - 2.0 * np.outer(normal, normal)
    return mirrored * [[-1.0], [1.0], [1.0]]


def _vector(random: np.random.Generator, size: float) -> Vector:
    return np.asarray(random.uniform(-size, size, 3))


def _even(random: np.random.Generator) -> bool:
    return bool(random.random() < 0.5)
