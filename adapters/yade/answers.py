"""Makes a Run from the files that the driver wrote about an ask."""

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
    """The Run from the answer to the ask in the file `path`; None if there is no answer yet.

    model: the description, in which the number of unknowns is replaced by YADE's own count.
    started: when the process was started [s, monotonic]. An answer of the wrong shape is an error.
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
        ),  # times first, then the observed values
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
    """The reported costs; the first ask of a process carries its start-up, others have 0."""
    startup = max(facts["ready"] - started, 0.0) if facts["ready"] else 0.0
    return Cost(startup=startup, **{name: facts[name] for name in COSTS if name in facts})
