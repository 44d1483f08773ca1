"""Exact engine: small scenes of constant contact normals, solved from event to event."""

from __future__ import annotations

from vv.ask import Ask, Displacement, Run, Status
from vv.exact.flow import StoppedError, follow
from vv.exact.ledger import ledger
from vv.exact.path import Path
from vv.exact.reach import RefusedError
from vv.exact.system import TERMS, System, assemble, describe

__all__ = [
    "TERMS",
    "Path",
    "RefusedError",
    "StoppedError",
    "System",
    "answer",
    "assemble",
    "describe",
    "duration",
    "follow",
    "prepare",
    "refusal",
    "solve",
]


def prepare(ask: Ask) -> System:
    """The equations to solve for an ask; raises RefusedError."""
    system = assemble(ask.scene)
    for observable in ask.observables:
        try:
            ask.scene.sphere_index(observable.body)
        except ValueError as reason:
            raise RefusedError(str(reason)) from None
    return system


def refusal(ask: Ask) -> str | None:
    """Why an ask is outside the engine's class, or None."""
    try:
        prepare(ask)
    except RefusedError as reason:
        return str(reason)
    return None


def solve(ask: Ask) -> Run:
    """The run of an ask, without cost: refused, diverged, or exact to rounding."""
    try:
        system = prepare(ask)
    except RefusedError as reason:
        return Run(Status.REFUSED, str(reason))
    try:
        path = follow(system, duration(ask))
    except StoppedError as reason:
        return Run(Status.DIVERGED, str(reason), model=describe(ask.scene, system))
    return answer(ask, path)


def duration(ask: Ask) -> float:
    """The last time asked for [s]."""
    return float(ask.goal.times(ask.knobs.dt)[-1])


def answer(ask: Ask, path: Path) -> Run:
    """What an ask wants to know of a path."""
    system, times = path.system, ask.goal.times(ask.knobs.dt)
    q, v = path.at(times)
    values = {}
    for observable in ask.observables:
        own = system.owner == ask.scene.sphere_index(observable.body)
        along = q if isinstance(observable, Displacement) else v
        values[observable] = along[:, own] @ system.direction[own]
    return Run(
        Status.RAN,
        times=times,
        values=values,
        steps=len(path.start),
        model=describe(ask.scene, system),
        ledger=ledger(path),
    )
