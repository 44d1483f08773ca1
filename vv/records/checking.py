"""Checks that a run is complete: without a term, an output or a finite number it has failed."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterator

import numpy as np

from vv.ask import Ask, Knobs, Ledger, Method, Run, Status
from vv.case import (
    EnergyAllowance,
)
from vv.scene import Vector

LARGEST = 1e100  # SI units: beyond this a run has diverged; squares would soon overflow


def checked(run: Run, ask: Ask) -> Run:
    """The run, or a failure if terms or outputs are missing or numbers are not finite."""
    if run.status is not Status.RAN:
        return run
    if run.ledger and not all(map(math.isfinite, _energies(run.ledger))):
        return Run(Status.ERROR, "the energy ledger is not finite")
    return _observed(run, ask)


def _observed(run: Run, ask: Ask) -> Run:
    """The run, or a failure if a term, an output or a finite number is missing."""
    if run.model is None or ask.scene.terms() - run.model.terms:
        terms = ask.scene.terms() - (run.model.terms if run.model else frozenset())
        left_out = ", ".join(sorted(term.value for term in terms)) or "everything"
        return Run(Status.ERROR, f"the run does not say that it modelled: {left_out}")
    expected = ask.goal.times(ask.knobs.dt)
    same = run.times.shape == expected.shape
    if not same or not np.allclose(run.times, expected, rtol=1e-9, atol=0.0):
        return Run(Status.ERROR, f"reported {len(run.times)} of {len(expected)} output times")
    for observable in ask.observables:
        values = run.values.get(observable)
        if values is None or values.shape != (len(expected), 3):
            what = "not reported" if values is None else f"reported with shape {values.shape}"
            due = f"({len(expected)}, 3)"
            return Run(Status.ERROR, f"{observable} was asked in shape {due} and {what}")
        if (why := _unbounded(values, expected)) is not None:
            what = f"{type(observable).__name__.lower()} of body {observable.body}"
            return Run(Status.DIVERGED, f"{what} {why}")
    if ask.search is not None and (not len(run.tried) or run.tried.shape[1:] != (2,)):
        return Run(Status.ERROR, "the run does not say what was tried")
    return _energetic(run, ask)


def _energetic(run: Run, ask: Ask) -> Run:
    """The run, or a failure if a form of energy or a finite number is missing."""
    for form in ask.energies:
        energy, due = run.energies.get(form), run.times.shape
        if energy is None or energy.shape != due:
            what = "not reported" if energy is None else f"reported with shape {energy.shape}"
            return Run(Status.ERROR, f"energy '{form.value}' was asked in shape {due} and {what}")
        if (why := _unbounded(energy[:, None], run.times)) is not None:
            return Run(Status.DIVERGED, f"energy '{form.value}' {why}")
    return run


def _unbounded(values: Vector, times: Vector) -> str | None:
    """When values (k, n) are first not finite or beyond LARGEST, in words; None if never."""
    bounded = (np.abs(values) <= LARGEST).all(axis=1)  # False for nan too
    if bounded.all():
        return None
    first = int(np.argmin(bounded))
    finite = np.isfinite(values[first]).all()
    wrong = f"is beyond {LARGEST:g}" if finite else "is not finite"
    return f"{wrong} from t = {times[first]:.6g} s"


def within(run: Run, unexplained: EnergyAllowance | None, method: Method, knobs: Knobs) -> Run:
    """The run, with the bound of the case for its ledger if that is larger."""
    ledger = run.ledger
    if unexplained is None or ledger is None or ledger.bound is None:
        return run
    bound = max(ledger.bound, unexplained.at(method, knobs))
    return dataclasses.replace(run, ledger=dataclasses.replace(ledger, bound=bound))


def _energies(ledger: Ledger) -> Iterator[float]:
    """All numbers of a ledger."""
    yield from (*ledger.terms.values(), ledger.unaccounted, ledger.peak, ledger.bound or 0.0)
    yield from (evaluated for pair in ledger.audits.values() for evaluated in pair)
