"""The same jobs with last digits of their scenes changed: how far does rounding move answers?"""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

from vv.plan.plan import Plan
from vv.scene import Block, Scene, Wall

LAST = 2.0**-51  # of a number: one or two of the smallest steps to its neighbours


@dataclass(frozen=True)
class Nudge:
    """Relative changes of all masses and moments of inertia, of gravity, and of all positions."""

    mass: float
    gravity: float
    position: float


NUDGES = (
    Nudge(8 * LAST, 8 * LAST, 0.0),
    Nudge(LAST, -LAST, 2 * LAST),
    Nudge(-LAST, LAST, -3 * LAST),
    Nudge(2 * LAST, LAST, LAST),
)


def nudged_plan(plan: Plan, nudge: Nudge) -> Plan:
    """The plan with the scene of each job changed by a nudge, and otherwise the same."""
    scenes = {id(job.ask.scene): job.ask.scene for job in plan.jobs}
    moved = {name: nudged_scene(scene, nudge) for name, scene in scenes.items()}
    asks = {
        id(job.ask): dataclasses.replace(job.ask, scene=moved[id(job.ask.scene)])
        for job in plan.jobs
    }
    jobs = tuple(dataclasses.replace(job, ask=asks[id(job.ask)]) for job in plan.jobs)
    return dataclasses.replace(plan, jobs=jobs)


def nudged_scene(scene: Scene, nudge: Nudge) -> Scene:
    """The scene with masses, gravity and positions changed by a nudge."""
    changed = []
    for group in scene.bodies:
        if isinstance(group, Wall):
            factors = {"point": 1 + nudge.position}
        else:
            place = "vertices" if isinstance(group, Block) else "position"
            factors = {place: 1 + nudge.position, "mass": 1 + nudge.mass, "inertia": 1 + nudge.mass}
        new = {name: factor * getattr(group, name) for name, factor in factors.items()}
        changed.append(dataclasses.replace(group, **new))
    gravity = (1 + nudge.gravity) * scene.gravity
    return dataclasses.replace(scene, bodies=tuple(changed), gravity=gravity)
