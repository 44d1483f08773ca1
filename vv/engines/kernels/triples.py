"""Operations on vectors of three numbers, inlined into kernels."""

from __future__ import annotations

from vv.engines.kernels.compiled import inlined
from vv.scene import Vector

Triple = tuple[float, float, float]
NOWHERE = (0.0, 0.0, 0.0)


@inlined
def at(rows: Vector, i: int) -> Triple:
    """Row i of an (n, 3) array."""
    return rows[i, 0], rows[i, 1], rows[i, 2]


@inlined
def put(rows: Vector, i: int, a: Triple) -> None:
    """rows[i] = a."""
    rows[i, 0], rows[i, 1], rows[i, 2] = a


@inlined
def add_scaled(a: Triple, scale: float, b: Triple) -> Triple:
    """a + scale b."""
    return a[0] + scale * b[0], a[1] + scale * b[1], a[2] + scale * b[2]


@inlined
def dot(a: Triple, b: Triple) -> float:
    """a . b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@inlined
def cross(a: Triple, b: Triple) -> Triple:
    """a x b."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
