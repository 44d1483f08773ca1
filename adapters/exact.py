"""The in-house exact engine as a code of the framework."""

from __future__ import annotations

import dataclasses
import time
from pathlib import Path

import vv
from vv.ask import Ask, Cost, Method, Model, Run, Status
from vv.codes import Found, Scheme, timed
from vv.codes.in_house import InHouse, Solver, compiled
from vv.engines import exact

SCHEMES = (
    Scheme(
        "default",
        "from event to located event, in closed form where one unknown meets one contact, else by "
        "Taylor series, in scenes whose contact normals and bonds stay; in rigid contact one body "
        "that slips on a wall",
        Method.EXACT,
        exact.TERMS,
        knobs=(),
    ),
    Scheme(
        "linearised",
        "bonds to first order in the displacements, as if they did not turn, by Taylor series",
        Method.LINEARISED,
        exact.BONDS,
        knobs=(),
    ),
    Scheme(
        "second-order",
        "one body that slips on a rigid wall, in steps of dt: with forces at their means over a "
        "step its slip has a closed form; where it turns slowly, the midpoint rule",
        Method.SECOND_ORDER,
        exact.RIGID,
    ),
)


def _solver(scheme: Scheme, function: str, prepare: exact.Prepare) -> Solver:
    """The engine, with the equations that `prepare` makes of an ask, or its refusal."""

    def refuses(ask: Ask) -> str | None:
        return exact.refusal(ask, prepare)

    def describe(ask: Ask) -> Model:
        return exact.model(ask.scene, prepare(ask))

    def solve(ask: Ask, repeat: float) -> Run:
        try:
            return _run(ask, prepare, repeat)
        except exact.RefusedError as reason:
            return Run(Status.REFUSED, str(reason))

    return Solver(scheme, function, refuses, describe, solve)


def _run(ask: Ask, prepare: exact.Prepare, repeat: float) -> Run:
    """Run one ask and time each part.

    Cost: setup is building the equations; startup is loading or compiling the kernel; solve is
    computing the motion from event to event into arrays that are allocated before, as for the
    kernels of the other in-house codes; output is evaluating the observables and the energies.
    Raises exact.RefusedError.
    """
    began = time.process_time()
    problem = prepare(ask)
    flow = exact.ready(problem, exact.duration(ask))
    built = time.process_time()
    flow.warm()
    before = Cost(setup=built - began, startup=time.process_time() - built)
    try:
        told, cost = timed(flow.follow, repeat)
        solved = time.process_time()
        path = flow.path(told)
    except exact.StoppedError as reason:
        model = exact.model(ask.scene, problem)
        return Run(Status.DIVERGED, str(reason), cost=before, model=model)
    run = exact.answer(ask, path)
    output = time.process_time() - solved
    cost = dataclasses.replace(cost, setup=before.setup, startup=before.startup, output=output)
    return dataclasses.replace(run, cost=cost)


def found() -> Found:
    """The engine is part of vv, so it is always installed."""
    return Found(True, vv.__version__, str(Path(exact.__file__).parent))


SOLVERS = (
    _solver(SCHEMES[0], "solve", exact.prepare),
    _solver(SCHEMES[1], "solve_linearised", exact.prepare_linearised),
    compiled(SCHEMES[2], "solve_second_order", exact.steps_refused, exact.prepare_steps),
)
ADAPTER = InHouse("exact", "vv.engines.exact", SOLVERS, found)
