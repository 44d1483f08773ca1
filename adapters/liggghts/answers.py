"""Turns what a deck wrote, its rows and its log, into a Run and its cost."""

from __future__ import annotations

import re
import warnings
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from adapters.liggghts.deck import COUNTED, UNCOUNTED
from adapters.liggghts.translate import moving, spinning, watched
from vv.ask import Ask, Displacement, Model, Run, Status
from vv.scene import Scene, Vector, why_load_is_no_lock
from vv.standins.stand_in import stood_for

LOOP = re.compile(r"^Loop time of (\S+)", re.MULTILINE)
CHARGING = re.compile(f"^{UNCOUNTED}.*?^{COUNTED}", re.MULTILINE | re.DOTALL)
OUTPUT = re.compile(r"^(?:Outpt|Fix history print) *time \(%\) = (\S+)", re.MULTILINE)


@dataclass(frozen=True)
class Loops:
    """LIGGGHTS' own times of the runs in a log, (k,) [s]: the loop without and with its output."""

    solve: Vector
    whole: Vector


def loops(log: str) -> Loops:
    """The times a log states. LIGGGHTS counts elapsed time, from before the first to after the
    last step of a run; writing rows and thermo lines is part of it and is stated too. The step
    that charges springs is set-up.
    """
    runs = LOOP.split(CHARGING.sub("", log))[1:]  # the time, then the text up to the next
    whole = np.array([float(time) for time in runs[::2]])
    output = np.array([sum(map(float, OUTPUT.findall(text))) for text in runs[1::2]])
    return Loops(np.maximum(whole - output, 0.0), whole)


def rows(history: Path) -> Vector:
    """The numbers of a file of rows, (k, columns); a row cut short or no number is an error.

    Raises ValueError.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # about a file without rows
        return np.loadtxt(history, ndmin=2)


def parse(history: Path, ask: Ask, model: Model) -> Run:
    """The Run in a file of rows: the start, which LIGGGHTS does not write, is known.

    Rows that are missing or of the wrong shape are an error; spheres that are not where they
    may be, and numbers that are not finite, are divergence; a sphere that leaves the line on
    which a dead load should hold it is an error.
    """
    try:
        told = rows(history)
    except (OSError, ValueError) as error:
        return Run(Status.ERROR, f"the rows cannot be read: {error}")
    seen, times, stride = watched(ask), ask.goal.times(ask.dt), ask.goal.stride(ask.dt)
    due = (len(times) - 1, 2 + 3 * len(seen))
    if told.shape != due or (told[:, 0] != stride * np.arange(1, len(times))).any():
        return Run(Status.ERROR, f"the rows have shape {told.shape}; {due} was asked for")
    values = _with_start(told, ask)
    if fault := _lost(told, ask, times) or _not_finite(values, times):
        return Run(Status.DIVERGED, fault)
    if fault := _drift(values, ask):
        return Run(Status.ERROR, fault)
    observed = {o: values[:, k] for k, (o, _) in enumerate(seen[: len(ask.observables)])}
    return Run(Status.RAN, times=times, values=observed, steps=ask.goal.steps(ask.dt), model=model)


def _with_start(told: Vector, ask: Ask) -> Vector:
    """What is watched at all times, (k, watched, 3), from rows that begin after t = 0."""
    seen, spheres = watched(ask), stood_for(ask).scene.spheres
    first = [np.zeros(3) if isinstance(o, Displacement) else spheres.velocity[i] for o, i in seen]
    later = told[:, 2:].reshape(len(told), len(seen), 3)
    return np.concatenate([np.reshape(first, (1, len(seen), 3)), later])


def _lost(told: Vector, ask: Ask, times: Vector) -> str | None:
    """LIGGGHTS drops what leaves its box without a word, and states zeros for it."""
    count = len(stood_for(ask).scene.spheres)
    gone = np.flatnonzero(told[:, 1] != count)
    if not gone.size:
        return None
    return (
        f"{int(told[gone[0], 1])} of {count} spheres are where they may be at t = "
        f"{times[gone[0] + 1]:.6g} s; others went through a wall, or farther from the start than "
        "ten radii and twice their free paths"
    )


def _not_finite(values: Vector, times: Vector) -> str | None:
    bad = ~np.isfinite(values).all(axis=(1, 2))
    return f"a value is not finite at t = {times[bad.argmax()]:.6g} s" if bad.any() else None


def _drift(values: Vector, ask: Ask) -> str | None:
    """How far a sphere left the directions it is free in: a lock that became a dead load."""
    scene = stood_for(ask).scene
    for k, (observable, i) in enumerate(watched(ask)):
        if isinstance(observable, Displacement) and (
            how := why_load_is_no_lock(scene, i, values[:, k])
        ):
            return f"sphere {i} {how}"
    return None


def unknowns(scene: Scene) -> int:
    """The freedoms LIGGGHTS integrates: three or six for each sphere that moves, locked or not."""
    turning = int(spinning(scene.spheres).sum())
    return 3 * int(moving(scene.spheres).sum()) + 3 * turning
