"""Puts sines to YADE: as they are for forces, and as its HarmonicMotionEngine takes them."""

from __future__ import annotations

from typing import Any

import numpy as np

from vv.scene import Harmonic


def sines(motion: Harmonic | None) -> list[dict[str, Any]]:
    """The sines of a drive: amplitude (3,), frequency [Hz], phase [rad]."""
    names = ("A", "f", "fi")
    parts = [] if motion is None else motion.sines()
    return [dict(zip(names, (along.tolist(), f, phase), strict=True)) for along, f, phase in parts]


def driven(motion: Harmonic | None, dt: float) -> list[dict[str, Any]]:
    """The sines of a wall as YADE's HarmonicMotionEngine takes them, for u = A cos(wt + fi).

    The engine sets a velocity for a whole step from the time at its start. Half a step is added
    to the phase, and A reduced by sin(w dt/2)/(w dt/2): then the wall is where it must be after
    every step, to rounding.
    """
    return [
        {
            "A": (np.array(sine["A"]) * float(np.sinc(sine["f"] * dt))).tolist(),
            "f": sine["f"],
            "fi": sine["fi"] - np.pi / 2 + np.pi * sine["f"] * dt,
        }
        for sine in sines(motion)
    ]
