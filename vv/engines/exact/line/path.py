"""Makes the path of a line: Taylor polynomials that start from the closed form."""

from __future__ import annotations

import numpy as np

from vv.engines.exact.kernel import ORDER
from vv.engines.exact.line.glide import SHORT, TERMS
from vv.engines.exact.line.model import Line
from vv.engines.exact.modes import BACKWARD, FORWARD, STUCK, Index
from vv.engines.exact.path import Path
from vv.engines.exact.system import System
from vv.scene import Vector


def path_of(system: System, line: Line, pieces: Vector, duration: float) -> Path:
    """The path of the pieces (p, 5) between events that `follow_one` has filled.

    A piece is divided into as many polynomials as the general kernel would need at least.
    """
    whole, h, late = _cut(line, pieces, duration)
    start, state, travel, x, v = pieces[whole].T
    swings = state == STUCK
    sign = (state == FORWARD) * 1.0 - (state == BACKWARD)
    a = line.a - sign * line.k**2 * (line.limit if line.slides else 0.0)
    rest = line.a / line.k**2
    y, speed = oscillations(x - rest, v, line, late)
    moved_free, slower = forced_motions(v, a, line.n, late)
    moved = np.where(swings, y - (x - rest), moved_free)
    speed = np.where(swings, speed, slower)
    pull = np.where(swings, -(line.k**2) * y, a) - 2 * line.n * speed
    row = float((system.tangent if line.slides else system.normal)[0, 0])
    lengths = (x + np.where(sign == 0, moved, 0.0))[:, None]
    if line.slides:
        lengths = np.hstack((np.full_like(lengths, system.gap[0]), lengths))
    return Path(
        system,
        start + late,
        h,
        np.ones(len(h)),
        _series(line, swings, travel + moved, speed, pull, h)[:, :, None] / row,
        state.astype(np.int64)[:, None],
        lengths,
    )


def parts_of(line: Line, pieces: Vector, duration: float) -> Index:
    """The number of polynomials (p,) of each piece: |K/m| h^2/4 + |D/m| h <= 1 in each."""
    stiff = np.where(pieces[:, 1] == STUCK, line.k**2, 0.0)
    rate = 2 * line.n + np.sqrt((2 * line.n) ** 2 + stiff)
    return np.maximum(np.ceil(_spans(pieces, duration) * rate / 2), 1).astype(np.int64)


def _cut(line: Line, pieces: Vector, duration: float) -> tuple[Index, Vector, Vector]:
    """The piece of each polynomial, its length [s], and its start within the piece [s]."""
    parts = parts_of(line, pieces, duration)
    whole = np.repeat(np.arange(len(pieces)), parts)
    rank = np.arange(len(whole)) - np.repeat(np.cumsum(parts) - parts, parts)
    h = (_spans(pieces, duration) / parts)[whole]
    return whole, h, rank * h


def _spans(pieces: Vector, duration: float) -> Vector:
    """The durations (p,) of the pieces [s]."""
    return np.diff(np.append(pieces[:, 0], duration))


def _series(
    line: Line, swings: Vector, travel: Vector, speed: Vector, pull: Vector, h: Vector
) -> Vector:
    """Taylor coefficients (p, ORDER + 1) [m] from displacement, velocity and acceleration."""
    series = np.empty((len(h), ORDER + 1))
    series[:, 0], series[:, 1], series[:, 2] = travel, h * speed, h * h / 2 * pull
    for k in range(1, ORDER - 1):
        turned = h * h * swings * line.k**2 * series[:, k]
        series[:, k + 2] = -(turned + (k + 1) * h * 2 * line.n * series[:, k + 1]) / (
            (k + 1) * (k + 2)
        )
    return series


def oscillations(y: Vector, v: Vector, line: Line, t: Vector) -> tuple[Vector, Vector]:
    """Displacements [m] and velocities [m/s] of an oscillation, as `oscillation`, for arrays."""
    w = np.sqrt(line.k**2 - line.n**2)
    b, fade = (v + line.n * y) / w, np.exp(-line.n * t)
    sine, cosine = np.sin(w * t), np.cos(w * t)
    return fade * (y * cosine + b * sine), fade * (v * cosine - (w * y + line.n * b) * sine)


def forced_motions(v: Vector, a: Vector, n: float, t: Vector) -> tuple[Vector, Vector]:
    """The same as `forced_motion`, for arrays."""
    if n == 0:
        return t * (v + a * t / 2), v + a * t
    z = 2 * n * t
    part = -np.expm1(-z) / (2 * n)
    second, term = np.zeros_like(t), t * t / 2
    for k in range(TERMS):
        second, term = second + term, term * np.where(z > SHORT, 0.0, -z / (k + 3))
    second = np.where(z > SHORT, (t - part) / (2 * n), second)
    return v * part + a * second, v - 2 * n * part * v + a * part
