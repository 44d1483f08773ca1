"""Vectors of spheres, and their projection on the directions that locks leave free."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from vv.scene import Mask, Vector

Index = npt.NDArray[np.intp]


def triple(vector: Vector) -> tuple[float, float, float]:
    """A (3,) array as a tuple of three numbers, as kernels take it."""
    return float(vector[0]), float(vector[1]), float(vector[2])


def projectors(axes: Vector, free: Mask) -> Vector | None:
    """(m, 3, 3) projectors on the free axes; None if all are free."""
    return None if free.all() else np.einsum("ka,mk,kb->mab", axes, free.astype(float), axes)


def projected(vectors: Vector, axes: Vector, free: Mask) -> Vector:
    """The components (m, 3) of the vectors along the free axes; a plain copy if all are free."""
    hold = projectors(axes, free)
    return np.array(vectors) if hold is None else np.einsum("mab,mb->ma", hold, vectors)
