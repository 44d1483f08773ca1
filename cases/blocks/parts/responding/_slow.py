"""A block on a shaking foundation where its slip is slow: it turns sharply, and springs are late.

What is lost there in speed stays until friction has removed the whole speed of the base. Slip that
turns back and forth loses it in both directions in turn, so that half of it remains on average.
"""

from __future__ import annotations

import functools
from collections.abc import Callable

import numpy as np

from vv.case import Parameters
from vv.scene import Vector

Path = Callable[[Vector], Vector]  # times (k,) -> displacements (k, directions)

FINE, NEAR = 200.0, 1e-6  # samples of a period of the fastest sine, and the distance of two of them
RESTS = 1e-9  # of the fastest slip: what is slower rests


def friction(p: Parameters) -> float:
    """The largest friction over the mass [m/s2]: the base presses the block as it lifts it."""
    return p["mu"] * (p["g"] + p["Dz"] * (2 * np.pi * p["fz"]) ** 2)


def kept(p: Parameters) -> float:
    """The time [s] for which an error of speed remains: pi D w/(2 mu g), or the whole run."""
    ends = [np.pi * D * w / (2 * friction(p)) for D, w in _sines(p)] if p["mu"] else [np.inf]
    return float(min(max(ends), p["duration"]))


def late_springs(p: Parameters) -> float:
    """The time times w by which friction on springs reverses late where the error of speed stays.

    Springs have to be bent from mu N to -mu N: under a relative acceleration a of the base that
    takes 2 sqrt(mu g/a)/w, of which two thirds count; this speed is kept for a part of the run.
    """
    if not p["mu"]:
        return 0.0
    parts = (
        min(friction(p) / (D * w**2), 1.0) ** 0.5
        * min(np.pi * D * w / (2 * friction(p)), p["duration"])
        for D, w in _sines(p)
        if D
    )
    return float(4 / 3 * max(parts, default=0.0) / p["duration"])


def sharp_turns(p: Parameters, path: Path, way: float) -> Callable[[float], float]:
    """The error at a step [s] because the direction of slip turns as it passes close to rest.

    way: the largest displacement [m]. Slip that changes at a rate a passes within a time b of
    rest, at the speed a b: its direction turns at the rate b/(b^2 + t^2). Over a step the mean
    direction is shorter by (turn)^2/24, in all pi dt^2/(48 b), and at most by its whole length:
    then friction is wrong while it turns by more than that, for 1.2 sqrt(b dt) in all.
    """
    lost = friction(p) * kept(p) / 2 / way
    found = functools.cache(lambda: _passes(p, path)[1])

    def error(dt: float) -> float:
        passes = found()
        shorter = np.minimum(np.pi / 48 * dt**2 / passes, 1.2 * np.sqrt(passes * dt))
        return lost * float(shorter.max(initial=0.0))

    return error


def turned_back(p: Parameters, path: Path, gained: float) -> float:
    """The number of times that slip turns back in one step, each by the part of the run after it.

    gained: what the base gains in a step [m/s]. Slip that passes within half of that of rest has
    another direction at the end of the step.
    """
    when, _, least = _passes(p, path)
    return float((1.0 - when[least < gained / 2] / p["duration"]).sum())


def _sines(p: Parameters) -> list[tuple[float, float]]:
    """Amplitude [m] and angular frequency [1/s] along x and y."""
    return [(p[D], 2 * np.pi * p[f]) for D, f in (("D", "f"), ("Dy", "fy"))]


def _passes(p: Parameters, path: Path) -> tuple[Vector, Vector, Vector]:
    """When slip passes near rest [s], its least speed over the rate of its change [s], and that."""
    fastest = max(p["f"], p["fy"])
    t = np.linspace(0.0, p["duration"], int(FINE * fastest * p["duration"]) + 3)[1:-1]
    near = NEAR / fastest
    block = (path(t + near) - path(t - near))[:, :2] / (2 * near)
    base = np.stack([D * w * np.sin(w * t) for D, w in _sines(p)], axis=1)
    slip = base - block
    speed, change = np.hypot(*slip.T), np.diff(slip, axis=0)
    moving = np.minimum(speed[:-1], speed[1:]) > RESTS * speed.max()
    square = np.maximum((change**2).sum(axis=1), np.finfo(float).tiny)
    nearest = -(slip[:-1] * change).sum(axis=1) / square
    across = np.abs(slip[:-1, 0] * change[:, 1] - slip[:-1, 1] * change[:, 0]) / square
    here = moving & (nearest >= 0) & (nearest <= 1) & (across > 0)
    close = across[here] * np.sqrt(square[here])
    return t[:-1][here], np.asarray(across[here] * (t[1] - t[0])), np.asarray(close)
