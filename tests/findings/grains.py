"""How many grains leave a silo, and how far a column of grains runs out, without rounding."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from cases.bulk import column_collapse, hopper
from cases.bulk.column_collapse import TALL, _edge
from reference_solutions.bulk import column
from reference_solutions.bulk.hopper import across, rate
from tests.findings.figures import Answer, Figure, measured_as
from vv.ask import Displacement
from vv.scene import Vector


def _places(answer: Answer, step: int) -> Vector:
    """Centres [m] of all grains that move, at an output."""
    spheres = answer.ask.scene.spheres
    moves = np.flatnonzero(spheres.free[:, 0])
    shifts = np.array([answer.run.values[Displacement(int(i))][step] for i in moves])
    return np.asarray(spheres.position[moves] + shifts)


def outflow(width: Callable[[float], float] = across) -> Figure:
    """The rate at which grains leave a silo over that of Beverloo's law, less 1.

    width: of the hole of the law from its clear width, both in diameters of the largest grain.
    """

    def figure(answer: Answer) -> float:
        count = int(answer.ask.scene.spheres.free[:, 0].sum())
        found = hopper._rate_between(
            answer.ask.scene, count, hopper.FROM, hopper.TO, answer.run
        )  # the case rounds it to a tenth
        unit = float(np.sqrt(hopper.MEAN * hopper.D / answer.given["g"]))
        law = rate(width(answer.given["opening"]) / hopper.MEAN, hopper.FILLED) / unit
        return found / law - 1.0

    return figure


def clear(width: float) -> float:
    """The clear width of a hole, taken for its width."""
    return width


def run_out(part: float = 1.0) -> Figure:
    """How far a column of grains runs out over its radius, at a part of the time of the case."""

    def figure(answer: Answer) -> float:
        step, layers = (
            round(part * column_collapse.ROWS),
            column.layers(TALL * answer.given["wide"]),
        )
        places = _places(answer, step)
        return _edge(places) / (column.radius(len(places) / layers) * column_collapse.D) - 1.0

    return figure


def short() -> Figure:
    """By which part of the measured run-out a column falls short of it."""
    return lambda answer: 1.0 - run_out()(answer) / measured_as("run-out")(answer)
