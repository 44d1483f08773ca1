"""Tiny scenes of a sphere bonded to a fixed one: pulled, sheared, torn off."""

from __future__ import annotations

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
    Z,
    along,
    sphere,
    steady,
)
from vv.scene import Bonds, Contact, Scene, Vector

RATE = np.sqrt(KN / MASS)  # 1/s
SOFT = 0.4  # ks/kn
FACING = np.array([0.6, 0.0, 0.8])  # along which spheres are bonded
ACROSS = np.array([0.6, 0.8, 0.0])
GENTLY = 1e-6  # m/s: so slow that the rotation of the bond is negligible
TORN = 0.5  # m/s: the loss of velocity when the bond breaks


def pulled(terms: Terms) -> TinyScene:
    """A sphere that oscillates along the bond."""
    wrong = {
        "the bond is left out": steady(FACING),
        "the bond is twice as stiff": _swing(np.sqrt(2) * RATE, FACING),
        "the bond is half as stiff": _swing(np.sqrt(0.5) * RATE, FACING),
    }
    return _bonded("bond", FACING, FACING, 0.0, _swing(RATE, FACING), wrong)


def sheared(terms: Terms) -> TinyScene:
    """A sphere that oscillates across the bond."""
    rate, speed = np.sqrt(SOFT) * RATE, GENTLY * ACROSS
    wrong = {
        "a bond resists no shear": steady(speed),
        "a bond is as stiff across as along": _swing(RATE, speed),
        "a bond is twice as stiff across": _swing(np.sqrt(2) * rate, speed),
        "a bond is half as stiff across": _swing(np.sqrt(0.5) * rate, speed),
    }
    return _bonded("shear of a bond", Z, speed, SOFT * KN, _swing(rate, speed), wrong)


def broken(terms: Terms) -> TinyScene:
    """A sphere that flies off when the bond breaks, at half the force that would hold it."""
    strength = TORN * KN / RATE

    def way(t: Vector) -> tuple[Vector, Vector]:
        breaks = float(np.arcsin(TORN)) / RATE
        on, after = np.minimum(t, breaks), np.maximum(t - breaks, 0.0)
        return np.sin(RATE * on) / RATE + after * np.cos(RATE * on), np.cos(RATE * on)

    wrong = {
        "the bond does not break": _swing(RATE, FACING),
        "the bond is left out": steady(FACING),
    }
    return _bonded("breakage", FACING, FACING, 0.0, along(FACING, way), wrong, strength)


def _swing(rate: float, speed: Vector) -> Motion:
    """The oscillation with an initial velocity (3,) [m/s]; rate: angular frequency [1/s]."""
    return along(speed, lambda t: (np.sin(rate * t) / rate, np.cos(rate * t)))


def _bonded(
    name: str,
    facing: Vector,
    speed: Vector,
    ks: float,
    motion: Motion,
    wrong: dict[str, Motion],
    strength: float = np.inf,
) -> TinyScene:
    """A sphere with a velocity (3,) [m/s], bonded to a fixed one in a direction from it."""
    bodies = (sphere(0 * Z, ~FREE, PLACE - 2 * RADIUS * facing), sphere(speed))
    bond = Bonds(np.array([[0, 1]]), 2 * RADIUS, KN, ks, strength)  # type: ignore[arg-type]
    scene = Scene(bodies, Contact(KN), bonds=bond)
    return TinyScene(name, scene, 0.15, motion, wrong, smooth=np.isinf(strength))
