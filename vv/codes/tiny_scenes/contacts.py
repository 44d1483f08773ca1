"""Tiny scenes of a sphere that meets a wall or sphere head on: springs, dashpots, Hertz."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from vv.codes.tiny_scenes.tiny_scene import (
    FREE,
    KN,
    MASS,
    PLACE,
    RADIUS,
    Motion,
    Terms,
    TinyScene,
    Way,
    Z,
    along,
    sphere,
    steady,
)
from vv.scene import Contact, Harmonic, Hertz, Scene, Vector, Wall

RATE = np.sqrt(KN / MASS)  # 1/s
FACING = np.array([0.6, 0.0, 0.8])  # a wall's normal, along no axis of the frame
ETA_N = 0.4 * MASS * RATE  # N s/m: a fifth of the critical value
SWAY = 0.02  # m, of the wall
MODULUS, DAMPING, SHORT = 1e7, 0.2, 0.02  # Pa, -, s
NODES = 4000  # steps of the integration of a path without a closed form


def bounce(terms: Terms) -> TinyScene:
    """A sphere that touches a wall and moves into it."""
    return _against(Contact(KN), "bounce", _rebound(RATE), _met(FACING))


def collision(terms: Terms) -> TinyScene:
    """A sphere that touches a fixed sphere and moves into it."""
    held, flying = sphere(0 * Z, ~FREE, PLACE - 2 * RADIUS * Z), sphere(-Z)
    scene = Scene((held, flying), Contact(KN))
    return TinyScene("collision", scene, 0.15, along(Z, _rebound(RATE)), _met(Z))


def dashpot(terms: Terms) -> TinyScene:
    """A sphere that meets a spring and a dashpot, without tension."""
    wrong = {
        "the dashpot is left out": along(FACING, _rebound(RATE)),
        "the dashpot is twice as strong": along(FACING, _damped(2 * ETA_N)),
        "the dashpot is half as strong": along(FACING, _damped(ETA_N / 2)),
    }
    return _against(Contact(KN, eta_n=ETA_N), "dashpot", _damped(ETA_N), wrong)


def moving_wall(terms: Terms) -> TinyScene:
    """A sphere at rest is pushed off by a wall that oscillates at twice its own frequency."""
    sway = Harmonic(SWAY * FACING, np.full(3, RATE / np.pi))
    bodies = (Wall(PLACE - RADIUS * FACING, FACING, sway), sphere(0 * Z))
    wrong = {"the wall stands still": steady(0 * Z)}
    return TinyScene("moving wall", Scene(bodies, Contact(KN)), 0.1, along(FACING, _pushed), wrong)


def hertz(terms: Terms) -> TinyScene:
    """A sphere that meets an elastic wall."""
    wrong = {
        "contact is left out": steady(-FACING),
        "contact is twice as stiff": along(FACING, _elastic(2 * MODULUS)),
        "contact is half as stiff": along(FACING, _elastic(MODULUS / 2)),
    }
    return _against(_law(0.0), "Hertz's contact", _elastic(MODULUS), wrong, SHORT)


def viscous_hertz(terms: Terms) -> TinyScene:
    """A sphere that meets a viscous elastic wall, without tension."""
    wrong = {"viscosity is left out": along(FACING, _elastic(MODULUS))}
    return _against(_law(DAMPING), "viscous Hertz", _viscous, wrong, SHORT)


def _law(damping: float) -> Contact:
    return Contact(0.0, hertz=Hertz(MODULUS, damping=damping))


def _against(
    law: Contact, name: str, way: Way, wrong: Mapping[str, Motion], lasting: float = 0.15
) -> TinyScene:
    """A sphere that touches a wall and moves into it at 1 m/s."""
    scene = Scene((Wall(PLACE - RADIUS * FACING, FACING), sphere(-FACING)), law)
    return TinyScene(name, scene, lasting, along(FACING, way), wrong)


def _met(direction: Vector) -> Mapping[str, Motion]:
    return {
        "contact is left out": steady(-direction),
        "contact is twice as stiff": along(direction, _rebound(np.sqrt(2) * RATE)),
        "contact is half as stiff": along(direction, _rebound(np.sqrt(0.5) * RATE)),
        "contact has another mass, such as that of a radius and a density": along(
            direction, _rebound(np.sqrt(KN / (4 / 3 * np.pi * RADIUS**3)))
        ),
    }


def _rebound(rate: float) -> Way:
    """The displacement after contact with a spring at 1 m/s; rate: angular frequency [1/s]."""

    def way(t: Vector) -> tuple[Vector, Vector]:
        on, after = np.minimum(t, np.pi / rate), np.maximum(t - np.pi / rate, 0.0)
        return after - np.sin(rate * on) / rate, -np.cos(rate * on)

    return way


def damped(eta: float) -> tuple[Way, float]:
    """Overlap and its rate at a spring and a dashpot met at 1 m/s, and when their force ends [s].

    Schwager and Poeschel (2007): it ends where the acceleration does, before the overlap.
    """
    slow = eta / (2 * MASS)
    rate = np.sqrt(RATE**2 - slow**2)

    def overlap(t: Vector) -> tuple[Vector, Vector]:
        left, sine, cosine = np.exp(-slow * t), np.sin(rate * t), np.cos(rate * t)
        return left * sine / rate, left * (cosine - slow / rate * sine)

    return overlap, float(np.pi - np.arctan2(2 * slow * rate, rate**2 - slow**2)) / rate


def _damped(eta: float) -> Way:
    overlap, end = damped(eta)

    def way(t: Vector) -> tuple[Vector, Vector]:
        depth, closing = overlap(np.minimum(t, end))
        return -depth - np.maximum(t - end, 0.0) * closing, -closing

    return way


def _pushed(t: Vector) -> tuple[Vector, Vector]:
    """With the wall at a sin 2wt the overlap is (2a/3) sin wt (4 cos wt - 1), until it is zero."""
    on = RATE * np.minimum(t, np.arccos(0.25) / RATE)
    after = np.maximum(t - np.arccos(0.25) / RATE, 0.0)
    moved = SWAY / 3 * (2 * np.sin(on) - np.sin(2 * on))
    speed = SWAY / 3 * RATE * (2 * np.cos(on) - 2 * np.cos(2 * on))
    return moved + after * speed, speed


def _elastic(modulus: float) -> Way:
    """U/Umax at a share of the time to it is a power of an inverse beta function (Hertz 1882)."""
    from scipy.special import beta, betaincinv

    deepest = (1.25 * MASS / (4 / 3 * modulus * np.sqrt(RADIUS))) ** 0.4
    half = 0.4 * beta(0.4, 0.5) * deepest  # s, to the largest overlap, at 1 m/s

    def way(t: Vector) -> tuple[Vector, Vector]:
        share = np.minimum(np.minimum(t, 2 * half), 2 * half - np.minimum(t, 2 * half)) / half
        power = betaincinv(0.4, 0.5, share)  # (U/Umax)^(5/2)
        speed = np.where(t < half, -1.0, 1.0) * np.sqrt(1 - power)
        return np.maximum(t - 2 * half, 0.0) - deepest * power**0.4, speed

    return way


def _viscous(t: Vector) -> tuple[Vector, Vector]:
    """The path by the classical Runge-Kutta method, with an error far below every tolerance."""
    factor, step = 4 / 3 * MODULUS * math.sqrt(RADIUS), float(t[-1]) / NODES
    viscous = 2 * DAMPING * math.sqrt(1.5 * factor * MASS)

    def braked(depth: float, closing: float) -> float:
        deep = max(depth, 0.0)
        push = factor * deep**1.5 + viscous * deep**0.25 * closing
        return -max(float(push), 0.0) / MASS

    path = [(0.0, 1.0)]
    for _ in range(NODES):
        u, v = path[-1]
        a = braked(u, v)
        b = braked(u + step / 2 * v, v + step / 2 * a)
        c = braked(u + step / 2 * v + step**2 / 4 * a, v + step / 2 * b)
        d = braked(u + step * v + step**2 / 2 * b, v + step * c)
        moved = step * v + step**2 / 6 * (a + b + c)
        path.append((u + moved, v + step / 6 * (a + 2 * b + 2 * c + d)))
    found = -np.array(path)[np.rint(t / step).astype(int)]
    return found[:, 0], found[:, 1]
