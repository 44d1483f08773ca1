"""What DDA does not run, and why."""

from __future__ import annotations

import numpy as np

from vv.ask import Ask
from vv.engines.blocks.checks import moves_where_locked, overlaps, undetermined
from vv.scene import Scene


def refuses(ask: Ask) -> str | None:
    """Why an ask cannot be run honestly; else None."""
    dt, goal, scene = ask.knobs.dt, ask.goal, ask.scene
    rigid = not np.isfinite(scene.contact.kn)
    if dt is None:
        return "Knobs.dt is None; DDA needs a step"
    if goal.steps(dt) == 0:
        return f"dt = {dt!r} s leaves no step in History.duration = {goal.duration!r} s"
    if not scene.blocks:
        return "the scene holds no block"
    if len(scene.spheres):
        return "the scene holds spheres; DDA knows blocks and walls"
    if rigid and ask.knobs.kn is None:
        return "Knobs.kn is None; a penalty scheme needs a stiffness for rigid contact"
    checks = (moves_where_locked, undetermined, _turns_its_strains_away)
    found = next((reason for check in checks if (reason := check(scene))), None)
    return found or (overlaps(scene) if rigid else None)


def _turns_its_strains_away(scene: Scene) -> str | None:
    """Which block turns about an axis across which it strains in one direction, but not in all."""
    for block in scene.blocks:
        for axis in np.flatnonzero(block.free_spin):
            across = np.delete(block.free, axis)
            if block.elastic and across.any() and not across.all():
                return (
                    f"block '{block.name}' strains and turns about axis {axis}, across which it is "
                    "free in one direction only: its strains would turn into ones that are locked"
                )
    return None
