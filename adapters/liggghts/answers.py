"""Makes a Run from the rows that a deck wrote."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np

from adapters.liggghts.setup import Setup
from vv.ask import Displacement, Model, Run, Status
from vv.scene import Vector, why_load_is_no_lock


def rows(history: Path) -> Vector:
    """The numbers in a file of rows, (k, columns); raises ValueError for an incomplete row.

    It also does for a word that is not a number.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # on a file without rows
        return np.loadtxt(history, ndmin=2)


def parse(history: Path, setup: Setup, model: Model) -> Run:
    """The Run from a file of rows; the start, which LIGGGHTS does not write, is added.

    Missing rows, or rows of the wrong shape, are an error. Spheres outside the box or behind walls,
    and numbers that are not finite, mean divergence. A sphere that leaves the line on which a dead
    load should hold it is an error.
    """
    try:
        written = rows(history)
    except (OSError, ValueError) as error:
        return Run(Status.ERROR, f"the rows cannot be read: {error}")
    ask, seen = setup.ask, setup.watched
    times, stride = ask.goal.times(ask.dt), ask.goal.stride(ask.dt)
    due = (len(times) - 1, 2 + 3 * len(seen))
    if written.shape != due or (written[:, 0] != stride * np.arange(1, len(times))).any():
        return Run(Status.ERROR, f"the rows have shape {written.shape}; {due} was asked for")
    values = _with_start(written, setup)
    if fault := _lost(written, setup, times) or _not_finite(values, times):
        return Run(Status.DIVERGED, fault)
    if fault := _drift(values, setup):
        return Run(Status.ERROR, fault)
    observed = {o: values[:, k] for k, (o, _) in enumerate(seen[: len(ask.observables)])}
    return Run(Status.RAN, times=times, values=observed, steps=ask.goal.steps(ask.dt), model=model)


def _with_start(written: Vector, setup: Setup) -> Vector:
    """The observed values at all times, (k, watched, 3), from rows that begin after t = 0."""
    seen, speeds = setup.watched, setup.springs.scene.spheres.velocity
    first = [np.zeros(3) if isinstance(o, Displacement) else speeds[i] for o, i in seen]
    later = written[:, 2:].reshape(len(written), len(seen), 3)
    return np.concatenate([np.reshape(first, (1, len(seen), 3)), later])


def _lost(written: Vector, setup: Setup, times: Vector) -> str | None:
    """Whether atoms were lost: LIGGGHTS silently drops what leaves its box, and reports zeros."""
    count = len(setup.springs.scene.spheres)
    gone = np.flatnonzero(written[:, 1] != count)
    if not gone.size:
        return None
    return (
        f"{int(written[gone[0], 1])} of {count} spheres are left at t = "
        f"{times[gone[0] + 1]:.6g} s; others went through a wall, or farther from the start than "
        "ten radii and twice their free paths"
    )


def _not_finite(values: Vector, times: Vector) -> str | None:
    bad = ~np.isfinite(values).all(axis=(1, 2))
    return f"a value is not finite at t = {times[bad.argmax()]:.6g} s" if bad.any() else None


def _drift(values: Vector, setup: Setup) -> str | None:
    """Why the run is an error if a sphere left its free directions: a lock became a dead load."""
    for k, (observable, i) in enumerate(setup.watched):
        if isinstance(observable, Displacement) and (
            how := why_load_is_no_lock(setup.springs.scene, i, values[:, k])
        ):
            return f"sphere {i} {how}"
    return None
