"""Translates sinusoidal motion for YADE: forces directly, walls as its HarmonicMotionEngine."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np

from adapters.yade.given import Given
from adapters.yade.setup import Setup
from vv.scene import Harmonic, Pulse
from vv.standins.penalty_springs import acceleration_of

ON_TIME = 1e-6  # relative to a step: a time that is later by less belongs to the step


def shaken(given: Given, setup: Setup) -> Given:
    """A body acceleration as forces, from t = 0 on."""
    scene = setup.scene
    note = "body accelerations by HarmonicForceEngine at the time of the positions"
    force = scene.spheres.mass[:, None] * acceleration_of(scene.wave)
    return given.with_more(note, force=force, shaking=sines(scene.wave))


def pulsed(given: Given, setup: Setup) -> Given:
    """A body acceleration that ends: the first step in which it no longer acts."""
    pulse = setup.scene.shaking
    assert isinstance(pulse, Pulse)
    last = math.ceil(pulse.until / setup.ask.dt - ON_TIME)
    return given.with_more(f"the body acceleration is switched off at step {last}", ends=last)


def moving_walls(given: Given, setup: Setup) -> Given:
    """Walls with prescribed motion."""
    note = "walls driven by HarmonicMotionEngine, its velocity that which meets u after each step"
    motions = (driven(wall.motion, setup.ask.dt) for wall in setup.scene.walls)
    return replace(given.with_more(note), motion=dict(enumerate(motions)))


def sines(motion: Harmonic | None) -> list[dict[str, Any]]:
    """The sines of a motion: amplitude (3,), frequency [Hz], phase [rad]."""
    names = ("A", "f", "fi")
    parts = [] if motion is None else motion.sines()
    return [dict(zip(names, (along.tolist(), f, phase), strict=True)) for along, f, phase in parts]


def driven(motion: Harmonic | None, dt: float) -> list[dict[str, Any]]:
    """The sines of a wall as YADE's HarmonicMotionEngine takes them, for u = A cos(wt + fi).

    The engine sets the velocity of a whole step from the time at its start. With half a step added
    to the phase, and A reduced by sin(w dt/2)/(w dt/2), the wall has the exact position after every
    step, to rounding.
    """
    return [
        {
            "A": (np.array(sine["A"]) * float(np.sinc(sine["f"] * dt))).tolist(),
            "f": sine["f"],
            "fi": sine["fi"] - np.pi / 2 + np.pi * sine["f"] * dt,
        }
        for sine in sines(motion)
    ]
