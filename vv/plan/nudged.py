"""The same jobs with all masses changed in the last digit: how far does rounding move an answer?"""

from __future__ import annotations

import dataclasses

from vv.plan.plan import Plan
from vv.scene import Scene, Wall

LAST_DIGIT = 1 + 2.0**-51  # times a mass: one or two of the smallest steps between numbers


def with_masses_nudged(plan: Plan) -> Plan:
    """The plan with all masses and moments of inertia times LAST_DIGIT, and otherwise the same."""
    scenes = {id(job.ask.scene): job.ask.scene for job in plan.jobs}
    heavier = {name: _with_heavier_bodies(scene) for name, scene in scenes.items()}
    asks = {
        id(job.ask): dataclasses.replace(job.ask, scene=heavier[id(job.ask.scene)])
        for job in plan.jobs
    }
    jobs = tuple(dataclasses.replace(job, ask=asks[id(job.ask)]) for job in plan.jobs)
    return dataclasses.replace(plan, jobs=jobs)


def _with_heavier_bodies(scene: Scene) -> Scene:
    heavier = []
    for group in scene.bodies:
        names = () if isinstance(group, Wall) else ("mass", "inertia")
        changes = {name: LAST_DIGIT * getattr(group, name) for name in names}
        heavier.append(dataclasses.replace(group, **changes))
    return dataclasses.replace(scene, bodies=tuple(heavier))
