"""The in-house exact engine as a code of the framework."""

from __future__ import annotations

import dataclasses
import functools
import time
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import vv
from vv.ask import Ask, Cost, Method, Model, Run, Status
from vv.codes import Found, Scheme, python_script, timed
from vv.engines import exact

SCHEMES = (
    Scheme(
        "default",
        "from event to located event by Taylor series, in scenes whose contact normals and bonds "
        "stay; in rigid contact one body that slips along a line",
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
)
PREPARE: Mapping[str, exact.Prepare] = {
    "default": exact.prepare,
    "linearised": exact.prepare_linearised,
}
SOLVE = {"default": "solve", "linearised": "solve_linearised"}


class Exact:
    """The adapter; it holds no state."""

    name = "exact"
    schemes = SCHEMES

    def found(self) -> Found:
        """Part of vv: always there."""
        return Found(True, vv.__version__, str(Path(exact.__file__).parent))

    def refuses(self, ask: Ask, scheme: str) -> str | None:
        """Why a scene is outside the engine's class."""
        return exact.refusal(ask, PREPARE[scheme])

    def describe(self, ask: Ask, scheme: str) -> Model:
        """The smallest model of the scene; raises RefusedError if it has none."""
        return exact.model(ask.scene, PREPARE[scheme](ask))

    def native(self, ask: Ask, scheme: str) -> str:
        """A Python script that calls the engine."""
        return python_script(ask, "vv.engines.exact", SOLVE[scheme])

    def run(self, asks: Sequence[Ask], scheme: str, scratch: Path, repeat: float) -> Iterator[Run]:
        """Solve the asks in this process.

        Cost: setup is building the equations; solve is following the motion from event to event;
        output is evaluating the observables and the energies.
        """
        for ask in asks:
            try:
                yield _run(ask, PREPARE[scheme], repeat)
            except exact.RefusedError as reason:
                yield Run(Status.REFUSED, str(reason))


def _run(ask: Ask, prepare: exact.Prepare, repeat: float) -> Run:
    """One ask, part by part on the clock."""
    started = time.process_time()
    problem = prepare(ask)
    setup = time.process_time() - started
    try:
        path, cost = timed(functools.partial(exact.move, problem, exact.duration(ask)), repeat)
    except exact.StoppedError as reason:
        model = exact.model(ask.scene, problem)
        return Run(Status.DIVERGED, str(reason), cost=Cost(setup=setup), model=model)
    solved = time.process_time()
    run = exact.answer(ask, path)
    output = time.process_time() - solved
    return dataclasses.replace(run, cost=dataclasses.replace(cost, setup=setup, output=output))


ADAPTER = Exact()
