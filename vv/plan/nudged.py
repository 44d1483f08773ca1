"""The same jobs with last digits of their scenes changed: how far does rounding move answers?"""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from typing import Any

import numpy as np

from vv.plan.plan import Plan
from vv.scene import Block, Scene, Wall

LAST = 2.0**-51  # of a number: one or two of the smallest steps to its neighbours


@dataclass(frozen=True)
class Nudge:
    """Relative changes of all masses and moments of inertia, of gravity, and of blocks' vertices.

    place: the largest change of a coordinate. Each coordinate has its own, drawn from the seed:
    where two sides of a symmetric scene balance, only a change that differs between them decides.
    Spheres and walls stay in place: where they touch at the start, they do so exactly on every
    platform, and a gap in the last digit would delay their contact by a step.
    """

    mass: float
    gravity: float
    place: float
    seed: int = 0


NUDGES = (
    Nudge(8 * LAST, 8 * LAST, 0.0),
    Nudge(LAST, -LAST, 2 * LAST, 1),
    Nudge(-LAST, LAST, 2 * LAST, 2),
    Nudge(2 * LAST, LAST, 2 * LAST, 3),
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
    """The scene with masses, gravity and vertices changed by a nudge."""
    chance, heavier = np.random.default_rng(nudge.seed), 1 + nudge.mass
    changed = []
    for group in scene.bodies:
        new: dict[str, Any] = {}
        if isinstance(group, Block):
            shares = chance.uniform(-nudge.place, nudge.place, group.vertices.shape)
            new["vertices"] = group.vertices * (1 + shares)
        if not isinstance(group, Wall):
            new |= {"mass": heavier * group.mass, "inertia": heavier * group.inertia}
        changed.append(dataclasses.replace(group, **new))
    gravity = (1 + nudge.gravity) * scene.gravity
    return dataclasses.replace(scene, bodies=tuple(changed), gravity=gravity)
