"""Translates blocks for YADE into clumps, in place of the spheres that represent them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from vv.standins.clump import Clump


def clumped(plan: dict[str, Any], made: Sequence[Clump]) -> dict[str, Any]:
    """The driver's ask with clumps: spheres that touch walls, and points without contact.

    All springs of a block together are as stiff as those of its sphere. Rotations are free as the
    block's.
    """
    count, clumps = len(made[0].corners), iter(made)
    numbers = [n for n, body in enumerate(plan["bodies"]) if body["kind"] == "sphere"]
    (wall,) = set(range(len(plan["bodies"]))) - set(numbers)
    return {
        **plan,
        "kn": plan["kn"] / count,
        "ks": plan["ks"] / count,
        "contacts": sum(int(one.touching.sum()) for one in made) if plan["contacts"] else 0,
        "charged": [
            {"wall": wall, "body": number, "forces": one.friction.tolist()}
            for number, one in zip(numbers, made, strict=True)
            if one.friction.any()
        ],
        "bodies": [
            _clump(body, next(clumps)) if body["kind"] == "sphere" else body
            for body in plan["bodies"]
        ],
    }


def _clump(sphere: dict[str, Any], made: Clump) -> dict[str, Any]:
    """The sphere's data with the members of the clump: positions, radii and masses.

    The spheres that touch walls have negligible mass, so that the points alone give centroid and
    principal axes. A block that begins to tip has other contact forces than the sphere; velocities
    and spins half a step before t = 0 take this into account.
    """
    small = sphere["mass"] * 1e-18
    eighth, point = sphere["mass"] / 8, made.radius * 1e-3
    locked = "".join(name for name, free in zip("XYZ", made.free_spin, strict=True) if not free)
    return {
        **sphere,
        "kind": "clump",
        "push": (np.array(sphere["push"]) - made.extra / 2).tolist(),
        "twist": (np.array(sphere["twist"]) - made.moment / 2).tolist(),
        "blocked": "".join(axis for axis in sphere["blocked"] if axis in "xyz") + locked,
        "radius": made.radius,
        "inertia": _moments(made),
        "touching": [_member(corner, made.radius, small) for corner in made.corners],
        "points": [_member(place, point, eighth) for place in made.points],
    }


def _moments(made: Clump) -> list[float]:
    """The moments of inertia (3,) [kg m2] in YADE's order: the principal ones, the smallest first.

    If a rotation is locked, YADE uses the moments about the axes of the frame.
    """
    if made.free_spin.all() or not made.free_spin.any():
        return sorted(np.linalg.eigvalsh(made.block.inertia).tolist())
    return [float(moment) for moment in np.diag(made.block.inertia)]


def _member(position: Any, radius: float, mass: float) -> dict[str, Any]:
    volume = 4 / 3 * math.pi * radius**3
    return {"position": position.tolist(), "radius": radius, "density": mass / volume}
