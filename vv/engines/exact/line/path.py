"""The motion of a line as Taylor polynomials, each from the closed form where it starts."""

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
    """The path of pieces (p, 5) between events, as `follow_one` filled them.

    A piece is cut into as many polynomials as the general kernel would take for it at least.
    """
    whole, h, late = _cut(line, pieces, duration)
    start, state, way, x, v = pieces[whole].T
    swings = state == STUCK
    sign = (state == FORWARD) * 1.0 - (state == BACKWARD)
    a = line.a - sign * line.k**2 * (line.limit if line.slides else 0.0)
    rest = line.a / line.k**2
    y, speed = swung_at(x - rest, v, line, late)
    glided, slower = glided_at(v, a, line.n, late)
    moved = np.where(swings, y - (x - rest), glided)
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
        _series(line, swings, way + moved, speed, pull, h)[:, :, None] / row,
        state.astype(np.int64)[:, None],
        lengths,
    )


def parts_of(line: Line, pieces: Vector, duration: float) -> Index:
    """Into how many polynomials each piece is cut (p,): |K/m| h^2/4 + |D/m| h <= 1."""
    stiff = np.where(pieces[:, 1] == STUCK, line.k**2, 0.0)
    rate = 2 * line.n + np.sqrt((2 * line.n) ** 2 + stiff)
    return np.maximum(np.ceil(_spans(pieces, duration) * rate / 2), 1).astype(np.int64)


def _cut(line: Line, pieces: Vector, duration: float) -> tuple[Index, Vector, Vector]:
    """For each polynomial its piece, its length [s] and how late in the piece it begins [s]."""
    parts = parts_of(line, pieces, duration)
    whole = np.repeat(np.arange(len(pieces)), parts)
    rank = np.arange(len(whole)) - np.repeat(np.cumsum(parts) - parts, parts)
    h = (_spans(pieces, duration) / parts)[whole]
    return whole, h, rank * h


def _spans(pieces: Vector, duration: float) -> Vector:
    """How long each piece lasts (p,) [s]."""
    return np.diff(np.append(pieces[:, 0], duration))


def _series(
    line: Line, swings: Vector, way: Vector, speed: Vector, pull: Vector, h: Vector
) -> Vector:
    """Taylor coefficients (p, ORDER + 1) [m], from place, velocity and acceleration."""
    series = np.empty((len(h), ORDER + 1))
    series[:, 0], series[:, 1], series[:, 2] = way, h * speed, h * h / 2 * pull
    for k in range(1, ORDER - 1):
        turned = h * h * swings * line.k**2 * series[:, k]
        series[:, k + 2] = -(turned + (k + 1) * h * 2 * line.n * series[:, k + 1]) / (
            (k + 1) * (k + 2)
        )
    return series


def swung_at(y: Vector, v: Vector, line: Line, t: Vector) -> tuple[Vector, Vector]:
    """What `swung` gives, for arrays."""
    w = np.sqrt(line.k**2 - line.n**2)
    b, fade = (v + line.n * y) / w, np.exp(-line.n * t)
    sine, cosine = np.sin(w * t), np.cos(w * t)
    return fade * (y * cosine + b * sine), fade * (v * cosine - (w * y + line.n * b) * sine)


def glided_at(v: Vector, a: Vector, n: float, t: Vector) -> tuple[Vector, Vector]:
    """What `glided` gives, for arrays."""
    if n == 0:
        return t * (v + a * t / 2), v + a * t
    z = 2 * n * t
    part = -np.expm1(-z) / (2 * n)
    second, term = np.zeros_like(t), t * t / 2
    for k in range(TERMS):
        second, term = second + term, term * np.where(z > SHORT, 0.0, -z / (k + 3))
    second = np.where(z > SHORT, (t - part) / (2 * n), second)
    return v * part + a * second, v - 2 * n * part * v + a * part
