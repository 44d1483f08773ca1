"""Translates walls for YADE: infinite ones across an axis of the frame, or facets."""

from __future__ import annotations

import numpy as np

from adapters.yade.given import Given, Plan
from adapters.yade.setup import Setup
from vv.scene import Wall
from vv.standins.penalty_springs import fastest

FACET = 1e3  # size of a wall's triangle over that of scene and paths; it costs no accuracy


def walls(given: Given, setup: Setup) -> Given:
    """The representation of walls; `plan` creates the bodies."""
    oblique = [not across(wall) for wall in setup.scene.walls]
    notes = {
        "walls across an axis are YADE walls": not all(oblique),
        "oblique walls are facets far larger than the scene": any(oblique),
    }
    return given.with_more(*(note for note, holds in notes.items() if holds))


def across(wall: Wall) -> bool:
    """Whether a wall is normal to an axis of the frame."""
    return bool(np.abs(wall.normal).max() == 1.0)


def wall_body(wall: Wall, size: float) -> Plan:
    """YADE's infinite wall normal to an axis of the frame, or a triangle of that size [m]."""
    common = {"point": wall.point.tolist(), "normal": wall.normal.tolist()}
    if across(wall):
        return {"kind": "wall", **common}
    return {"kind": "facet", **common, "corners": (size * wall.facet_corners).tolist()}


def facet_size(setup: Setup) -> float:
    """A size [m] far beyond the scene and any path without collisions."""
    scene, time = setup.springs.scene, setup.ask.goal.duration
    spheres = scene.spheres
    places = np.vstack([spheres.position, *(wall.point for wall in scene.walls)])
    speed = float(np.linalg.norm(spheres.velocity, axis=1).max())
    speed += sum(fastest(wall.motion) for wall in scene.walls)
    shaken = np.abs(scene.wave.amplitude).sum() if scene.wave else 0.0
    fall = float(np.linalg.norm(scene.gravity) + shaken) * time
    reach = float(np.ptp(places, axis=0).max() + spheres.radius.max() + (speed + fall) * time)
    return FACET * reach
