"""Scenes for the program inside YADE: masses, radii, loads and directions are unlike."""

from __future__ import annotations

import sys
from typing import Any

from tests.support.adapters.still_yade import Omega, Utils

DT = 0.1

OMEGA, UTILS = Omega(), Utils()

INSIDE = "adapters.yade.inside"


def part(driver: Any, name: str) -> Any:
    """A module that the driver is made of."""
    assert driver
    return sys.modules[f"{INSIDE}.{name}"]


def sphere(**changes: Any) -> dict[str, Any]:
    """It starts half a step early: v0 - a dt/2, a = (4/2 + 1, 0, 6/2 - 5)."""
    whole = {
        "kind": "sphere", "position": [1.0, 2.0, 3.0], "initial": [1.5, 0.0, -2.0],
        "velocity": [1.5 - 3.0 * 0.05, 0.0, -2.0 + 2.0 * 0.05], "spin": [0.1, 0.0, 0.0],
        "radius": 0.5, "mass": 2.0, "inertia": 0.2, "shaken": 1.8, "force": [4.0, 0.0, 6.0],
        "push": [0.0] * 3, "twist": [0.0] * 3, "carried": [0.0] * 3, "held": [0.0] * 3,
        "blocked": "yXYZ",
    }  # fmt: skip
    return {**whole, **changes}


def wall(**changes: Any) -> dict[str, Any]:
    whole = {"kind": "wall", "point": [0.0, 0.0, -9.0], "normal": [0.0, 0.0, 1.0], "motion": []}
    return {**whole, **changes}


def asked(*bodies: dict[str, Any], **changes: Any) -> dict[str, Any]:
    whole = {
        "dt": DT, "steps": 4, "stride": 2, "kn": 3e6, "ks": 1.5e6, "mu": 0.5, "eta_n": 0.0,
        "hertz": {}, "gravity": [1.0, 0.0, -5.0], "drag": 0.0, "shaking": [], "ends": None,
        "charged": [], "bonds": [], "contacts": 0, "moves": True, "volumes": False,
        "bodies": [*bodies] or [sphere()], "observe": [["displacement", 0], ["velocity", 0]],
    }  # fmt: skip
    return {**whole, **changes}
