"""Turns the files that the driver wrote about an ask into a Run."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from adapters.yade.setup import Setup
from vv.ask import Cost, Displacement, Model, Run, Status
from vv.scene import Term, Vector, why_load_is_no_lock

COSTS = ("setup", "solve_cpu", "solve_wall", "output", "repeats", "spread")


def parse(path: Path, setup: Setup, model: Model, started: float) -> Run | None:
    """The Run in the answer to the ask in the file `path`; None if there is no answer yet.

    model: what was described; its unknowns are replaced by YADE's own count. started: when the
    program was [s, monotonic]. An answer whose shape is not what was asked is an error.
    """
    answer, ask = path.with_name(path.name + ".answer"), setup.ask
    if not answer.exists():
        return None
    facts = json.loads(answer.read_text())
    cost = _cost(facts, started)
    if facts["status"] != "ran":
        return Run(Status(facts["status"]), facts["reason"], cost=cost)
    values = np.load(path.with_name(path.name + ".npy"), allow_pickle=False)
    times = ask.goal.times(ask.knobs.dt)
    due = (len(setup.watched), len(times), 3)
    if values.shape != due:
        return Run(Status.ERROR, f"the answer has shape {values.shape}; {due} was asked for")
    if fault := _drift(values, setup):
        return Run(Status.ERROR, fault)
    return Run(
        Status.RAN,
        times=times,
        values=dict(
            zip(ask.observables, values @ setup.frame, strict=False)
        ),  # then what was watched
        cost=cost,
        steps=facts["steps"],
        model=replace(model, unknowns=facts["unknowns"]),
    )


def _drift(values: Vector, setup: Setup) -> str | None:
    """Report a sphere that moved along a locked direction, where a dead load replaces the lock."""
    scene = setup.springs.scene
    if Term.OBLIQUE_LOCK not in scene.terms():
        return None
    for observable, moved in zip(setup.watched, values, strict=True):
        sphere = scene.sphere_index(observable.body)
        if isinstance(observable, Displacement) and (
            how := why_load_is_no_lock(scene, sphere, moved)
        ):
            return f"body {observable.body} {how}"
    return None


def _cost(facts: dict[str, Any], started: float) -> Cost:
    """The costs stated; start-up is carried by the first ask of a program, and 0 in the others."""
    startup = max(facts["ready"] - started, 0.0) if facts["ready"] else 0.0
    return Cost(startup=startup, **{name: facts[name] for name in COSTS if name in facts})
