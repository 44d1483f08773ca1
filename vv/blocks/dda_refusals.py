"""What DDA does not run, and why."""

from __future__ import annotations

import numpy as np

from vv.ask import Ask
from vv.blocks.checks import moves_where_locked, overlaps, undetermined


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
    return moves_where_locked(scene) or undetermined(scene) or (overlaps(scene) if rigid else None)
