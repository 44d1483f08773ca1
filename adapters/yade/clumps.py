"""Puts a block to YADE as a clump in place of the sphere that stands for it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from vv.standins.clump import Clump


def clumped(plan: dict[str, Any], made: Clump) -> dict[str, Any]:
    """The driver's ask with the one sphere as a clump of spheres that touch and points that do not.

    All springs together are those of the sphere. Rotations are free as the block's are.
    """
    count = len(made.corners)
    (charged,) = plan["charged"] or [None]
    bodies = [_clump(b, made) if b["kind"] == "sphere" else b for b in plan["bodies"]]
    return {
        **plan,
        "kn": plan["kn"] / count,
        "ks": plan["ks"] / count,
        "contacts": plan["contacts"] * int(made.touching.sum()),
        "charged": [{**charged, "forces": made.friction.tolist()}] if charged else [],
        "bodies": bodies,
    }


def _clump(sphere: dict[str, Any], made: Clump) -> dict[str, Any]:
    """The sphere's data with the members: each a position, a radius and a mass.

    What stands on the wall weighs nothing to speak of, so that the points alone make the centroid
    and the principal axes.
    """
    small = sphere["mass"] * 1e-18
    eighth, point = sphere["mass"] / 8, made.radius * 1e-3
    locked = "".join(
        name for name, free in zip("XYZ", made.block.free_spin, strict=True) if not free
    )
    return {
        **sphere,
        "kind": "clump",
        "blocked": "".join(axis for axis in sphere["blocked"] if axis in "xyz") + locked,
        "radius": made.radius,
        "inertia": sorted(np.linalg.eigvalsh(made.block.inertia).tolist()),
        "touching": [_member(corner, made.radius, small) for corner in made.corners],
        "points": [_member(place, point, eighth) for place in made.points],
    }


def _member(position: Any, radius: float, mass: float) -> dict[str, Any]:
    volume = 4 / 3 * math.pi * radius**3
    return {"position": position.tolist(), "radius": radius, "density": mass / volume}
