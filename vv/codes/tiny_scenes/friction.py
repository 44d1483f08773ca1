"""Tiny scenes of a sphere with friction on a wall: it sticks, slips, oscillates, rolls."""

from __future__ import annotations

import dataclasses

import numpy as np

from vv.codes.tiny_scenes.contacts import ETA_N, damped
from vv.codes.tiny_scenes.tiny_scene import (
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
    both,
    sphere,
    steady,
)
from vv.scene import Contact, Scene, Vector, Wall

ACROSS = np.array([0.6, 0.8, 0.0])  # the direction of slip
LASTING = 0.5  # s
SLIPS = 0.547161  # rad of its swing, a, at which it slips; with a tan a = 1/3 it stops at 4 a
RATE = 10 * SLIPS / LASTING  # 1/s, so that both moments are multiples of the steps
PRESSED, DEPTH = 60.0, 2e-4  # N, m
TURNING = 3.5  # ratio by which slip changes faster if the sphere can rotate: 1 + 5/2
TURNED_BACK = -1.5  # the same if friction turns it the other way: 1 - 5/2, so that slip grows
BACK = (-TURNED_BACK / TURNING) ** 0.5  # rate of its growth over that of the swing
STIFF, ROUGH, FAST = 1500.0, 0.3, 2.0  # N/m, -, m/s, of slip on a viscous contact
UNLIMITED = "friction has no limit, or twice the right one"
REVERSED = "the shear force is reversed"


def skid(terms: Terms) -> TinyScene:
    """A sphere pressed on a wall: it slides, is stopped by the shear spring, and moves back."""
    wrong = {
        "friction is left out": steady(ACROSS),
        "friction is half as strong": _skid(RATE, 0.5 * _reach(RATE)),
        "the shear spring is twice as stiff": _skid(np.sqrt(2) * RATE, 0.5 * _reach(RATE)),
        "the shear spring is half as stiff": _skid(np.sqrt(0.5) * RATE, 2 * _reach(RATE)),
        UNLIMITED: _skid(RATE, np.inf),
        REVERSED: along(ACROSS, _driven(RATE)),
    }
    return _on_floor("skid", 1.0, _skid(RATE, _reach(RATE)), wrong, turns=False)


def roll(terms: Terms) -> TinyScene:
    """The same sphere, free to rotate: it rolls when slip ends."""
    wrong = {
        "rotation is left out": _skid(RATE / np.sqrt(TURNING), _reach(RATE)),
        "friction is left out": steady(ACROSS),
        "friction is half as strong": _roll(0.5 * _reach(RATE)),
        UNLIMITED: _roll(np.inf),
        REVERSED: _of_centre(_driven(RATE)),
        "friction turns it the other way": _of_centre(_driven(RATE * BACK), TURNED_BACK),
    }
    made = _on_floor("roll", TURNING, _roll(_reach(RATE)), wrong, turns=True)
    return dataclasses.replace(made, smooth=False)  # codes measure levers to either surface


def viscous_skid(terms: Terms) -> TinyScene:
    """A sphere that meets a viscous wall obliquely and slips; the dashpot adds normal force."""
    law = Contact(KN, STIFF, ROUGH, eta_n=ETA_N)
    scene = Scene((Wall(PLACE - RADIUS * Z, Z), sphere(FAST * ACROSS - Z)), law)
    wrong = {
        "friction is left out": both(steady(FAST * ACROSS), _landing),
        "friction is twice as strong": _slipping(2 * ROUGH),
    }
    return TinyScene("viscous skid", scene, 0.15, _slipping(ROUGH), wrong, smooth=False)


def _on_floor(
    name: str, times: float, motion: Motion, wrong: dict[str, Motion], turns: bool
) -> TinyScene:
    """A sphere locked along a wall's normal; times: the factor by which slip accelerates."""
    ks = RATE**2 * MASS / times
    law = Contact(PRESSED / DEPTH, ks, ks * _reach(RATE) / PRESSED)
    body = sphere(ACROSS, Z == 0)
    spins = np.full((1, 3), turns)
    bodies = (Wall(PLACE - (RADIUS - DEPTH) * Z, Z), dataclasses.replace(body, free_spin=spins))
    return TinyScene(name, Scene(bodies, law), LASTING, motion, wrong)


def _reach(rate: float) -> float:
    """The slip [m] at which the spring reaches the friction limit: mu N/ks."""
    return float(np.sin(SLIPS)) / rate


def _slip(t: Vector, rate: float, reach: float) -> tuple[Vector, Vector]:
    """Slip [m] and its rate from 1 m/s: on the spring, sliding, and back on the spring.

    A spring with its limit beyond 1/rate reverses before it yields.
    """
    reach = min(reach, 1.0 / rate)
    begins = float(np.arcsin(reach * rate)) / rate
    fast, brake = float(np.cos(rate * begins)), reach * rate**2
    ends = begins + fast / brake
    on, slides, back = np.minimum(t, begins), np.clip(t, begins, ends) - begins, t - ends
    swing = rate * np.maximum(back, 0.0)
    moved = np.sin(rate * on) / rate + fast * slides - brake * slides**2 / 2
    speed = np.where(t < begins, np.cos(rate * on), fast - brake * slides)
    return moved - reach * (1 - np.cos(swing)), speed - reach * rate * np.sin(swing)


def _skid(rate: float, reach: float) -> Motion:
    return along(ACROSS, lambda t: _slip(t, rate, reach))


def _driven(rate: float) -> Way:
    """Slip [m] and its rate from 1 m/s, if the spring acts in the wrong direction.

    rate: 1/s, at which slip grows while the spring, which yields where that of RATE does, holds.
    """
    reach = _reach(RATE)
    begins = float(np.arcsinh(reach * rate)) / rate
    drive = reach * rate**2

    def way(t: Vector) -> tuple[Vector, Vector]:
        on, slides = np.minimum(t, begins), np.maximum(t - begins, 0.0)
        moved = np.sinh(rate * on) / rate + np.cosh(rate * begins) * slides + drive * slides**2 / 2
        return moved, np.cosh(rate * on) + drive * slides

    return way


def _roll(reach: float) -> Motion:
    return _of_centre(lambda t: _slip(t, RATE, reach))


def _of_centre(slip: Way, turning: float = TURNING) -> Motion:
    """The motion of the centre, with 1/3.5 of the change of slip; the spin has the rest."""

    def way(t: Vector) -> tuple[Vector, Vector]:
        moved, speed = slip(t)
        return t + (moved - t) / turning, 1 + (speed - 1) / turning

    return along(ACROSS, way)


def _landing(t: Vector) -> tuple[Vector, Vector]:
    """The displacement along the normal of a sphere that meets the wall at 1 m/s."""
    overlap, end = damped(ETA_N)
    depth, closing = overlap(np.minimum(t, end))
    way, speed = -depth - np.maximum(t - end, 0.0) * closing, -closing
    return np.outer(way, Z), np.outer(speed, Z)


def _slipping(mu: float) -> Motion:
    """On the spring until it yields; from then on slip loses mu times what the normal way does."""
    overlap, end = damped(ETA_N)
    rate, begins = np.sqrt(STIFF / MASS), _yields(mu)
    deep, sinking = (float(part) for part in overlap(np.array(begins)))
    start, speed = FAST * np.sin(rate * begins) / rate, FAST * np.cos(rate * begins)

    def way(t: Vector) -> tuple[Vector, Vector]:
        on, slides = np.minimum(t, begins), np.clip(t, begins, end) - begins
        depth, closing = overlap(begins + slides)
        left = speed - mu * (sinking - closing)
        moved = start + (speed - mu * sinking) * slides + mu * (depth - deep)
        early = t < begins
        far = np.where(early, FAST * np.sin(rate * on) / rate, moved)
        fast = np.where(early, FAST * np.cos(rate * on), left)
        return far + np.maximum(t - end, 0.0) * left, fast

    return both(along(ACROSS, way), _landing)


def _yields(mu: float) -> float:
    """When the shear spring reaches mu times spring and dashpot [s], by bisection."""
    overlap, end = damped(ETA_N)
    rate = np.sqrt(STIFF / MASS)

    def within(t: float) -> bool:
        depth, closing = (float(part) for part in overlap(np.array(t)))
        held = STIFF * FAST * np.sin(rate * t) / rate
        return bool(held < mu * (KN * depth + ETA_N * closing))

    low, high = 0.0, end
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if within(middle) else (low, middle)
    return low
